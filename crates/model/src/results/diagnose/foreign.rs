//! A file of readings held out that is not of the machine, or not read like the measurements.

use std::sync::Arc;

use hexbench_core::{Dataset, Hexapod};

use super::READINGS_OF_PART;
use super::judged::prepare;
use super::report::StepReport;
use crate::effects::term::Term;
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::{Fit, fit_baseline};
use crate::estimation::foreseen::held_out_residuals;
use crate::estimation::residuals::summarise;
use crate::inference::diagnosis::explain;
use crate::inference::examination::{Finding, FindingKind};
use crate::inference::misread::{Change, Readable, Way, other_readings};

/// Held-out readings missed by this many times what the fitted ones are missed by do not belong to them.
const FOREIGN: f64 = 3.0;
/// Springs of their own miss such readings by at most this share of it.
const OWN_SHARE: f64 = 0.4;
/// They explain a machine without effects: what springs cannot explain, the measurements may not have shown.
const OWN_LEVEL: f64 = 2.0;

/// The two files, and what is known of them.
pub struct TwoFiles<'a> {
    /// The machine as stated.
    pub hexapod: &'a Hexapod,
    /// The measurements.
    pub data: &'a Dataset,
    /// The readings held out.
    pub holdout: &'a Dataset,
    /// The catalogue.
    pub terms: &'a [Arc<dyn Term>],
}

impl TwoFiles<'_> {
    /// What is wrong with the held-out readings, when the measurements do not predict them.
    pub(super) fn finding(&self, steps: &[StepReport]) -> Option<Finding> {
        let last = steps.last()?;
        let missed = last.holdout.as_ref()?.chi2_reduced.sqrt();
        self.finding_by(missed, last.fitted.chi2_reduced.sqrt())
    }

    /// The same before anything but springs is fitted.
    ///
    /// # Errors
    /// As [`held_out_residuals`].
    pub fn finding_by_springs(
        &self,
        campaign: &Campaign,
        springs: &Fit,
    ) -> Result<Option<Finding>, ModelError> {
        let errors = held_out_residuals(campaign, self.holdout, &springs.point)?;
        let missed = summarise(&errors, None).chi2_reduced.sqrt();
        Ok(self.finding_by(missed, springs.chi2_reduced().sqrt()))
    }

    /// `missed`, `fitted`: errors of the held-out and of the fitted readings over the noise.
    fn finding_by(&self, missed: f64, fitted: f64) -> Option<Finding> {
        let fitted = fitted.max(1.0);
        if self.holdout.is_absolute() || missed < FOREIGN * fitted || self.is_explained_together(missed) {
            return None;
        }
        let (why, next) = match self.reason(missed) {
            Some(why) => (why, "use a holdout file of the same machine, written like the measurements"),
            None if fitted < OWN_LEVEL => (
                "springs of their own miss them too, and no effect of the catalogue explains both files: another machine, another \
                 setup, or something that only the held-out poses and loads show"
                    .to_owned(),
                "compare machine, setup and columns of the two files; repeat some held-out readings in the measurements",
            ),
            None => return None,
        };
        Some(Finding {
            size: format!("{missed:.1} times the noise"),
            text: format!(
                "the held-out readings are missed by {missed:.1} times the noise, the measurements by {fitted:.1}: the two files do \
                 not belong together; {why}. The held-out file is set aside"
            ),
            next: next.to_owned(),
            ..Finding::of(FindingKind::Holdout)
        })
    }

    /// What the held-out file is by itself: another machine of springs, or the same machine, written otherwise.
    fn reason(&self, missed: f64) -> Option<String> {
        let campaign = prepare(self.hexapod, self.holdout).ok()?;
        let own = fit_baseline(&campaign).ok()?.chi2_reduced().sqrt();
        let way = other_readings(self.hexapod, self.holdout, Readable::Everything)
            .and_then(|r| r.ways.into_iter().next());
        // The machine is that of the measurements.
        let is_of_readings = |way: &Way| !way.has_size() && way.changes.iter().all(Change::keeps_legs);
        let better = way.filter(|way| is_of_readings(way) && way.level < OWN_SHARE * missed);
        if better.is_none() && own > OWN_LEVEL.min(OWN_SHARE * missed) {
            return None;
        }
        Some(better.map_or_else(
            || {
                format!(
                    "springs fitted to them alone miss them by {own:.1}: they seem to be of another machine, or of this one after a \
                     change"
                )
            },
            |way| way.meaning(),
        ))
    }

    /// True when springs and effects fitted to both files take most of it away: held-out poses and loads show what the others leave
    /// open. True as well where nobody can tell.
    fn is_explained_together(&self, missed: f64) -> bool {
        let part = self.data.some_poses(READINGS_OF_PART);
        let Some(both) = part.as_ref().unwrap_or(self.data).joined(self.holdout) else { return true };
        let left = || -> Result<f64, ModelError> {
            let campaign = prepare(self.hexapod, &both)?;
            let best = explain(&campaign, self.terms)?.best;
            let errors = held_out_residuals(&campaign, self.holdout, &best.point)?;
            Ok(summarise(&errors, None).chi2_reduced.sqrt())
        };
        left().map_or(true, |left| left < OWN_SHARE * missed)
    }
}
