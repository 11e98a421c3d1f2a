//! What the charts are drawn from: residuals of the springs alone and of the final model, per condition and leg.

use hexbench_core::Vector6;
use hexbench_model::campaign::Condition;
use hexbench_model::compare::legs::{LegSpace, leg_space};
use hexbench_model::error::ModelError;
use hexbench_model::fit::Fit;
use hexbench_model::linearization::Linearization;
use hexbench_model::residuals::{Residual, residuals};

use crate::Subject;

/// One model on the fitted readings.
pub(crate) struct Seen {
    pub(crate) lin: Linearization,
    pub(crate) legs: LegSpace,
    pub(crate) readings: Vec<Residual>,
}

/// The springs alone and the final model.
pub(crate) struct Data {
    pub(crate) before: Seen,
    /// Absent when nothing was added.
    pub(crate) after: Option<Seen>,
}

impl Data {
    /// Residuals of both models.
    pub(crate) fn of(subject: &Subject<'_>) -> Result<Self, ModelError> {
        let study = subject.study;
        let seen = |fit: &Fit| -> Result<Seen, ModelError> {
            let lin = Linearization::at(&study.campaign, &fit.point)?;
            let readings = residuals(&study.campaign, &subject.data.observations, &lin);
            Ok(Seen { legs: leg_space(&study.campaign, &lin), lin, readings })
        };
        let last = study.fits.last().filter(|_| study.fits.len() > 1);
        Ok(Self { before: seen(&study.outcome.baseline)?, after: last.map(seen).transpose()? })
    }

    /// Conditions with the residual elongations (um) of the springs alone and what the added effects explain of them; thinned to
    /// what an eye can tell apart.
    pub(crate) fn conditions(&self) -> impl Iterator<Item = (&Condition, Vector6, Option<Vector6>)> {
        const MOST: usize = 150;
        let n = self.before.lin.conditions.len();
        (0..n).step_by(n.div_ceil(MOST).max(1)).map(|i| {
            let left = self.before.legs.elongation[i];
            let explained = self.after.as_ref().map(|a| (left - a.legs.elongation[i]) * 1e6);
            (&self.before.lin.conditions[i], left * 1e6, explained)
        })
    }
}
