//! Terms chosen by hand: fitted beside the springs, and judged on readings that no fit has seen.

use hexbench_core::{Dataset, Hexapod};

use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::equations::Equations;
use crate::estimation::estimate::{Estimates, LegCompliances, estimates_with};
use crate::estimation::fit::{Fit, Start, TermSpec};
use crate::estimation::fit_named::{Added, fit_wanted};
use crate::estimation::foreseen::{Foreseen, KnownInputs, Misfit, Predictive, held_campaign};
use crate::estimation::linearization::Linearization;
use crate::estimation::noise::NoiseLevel;
use crate::estimation::residuals::{
    ErrorSummary, Residual, errors_of, leave_poses_out, residuals, summarise,
};
use crate::inference::discrepancy::LegDiscrepancy;
use crate::inference::gain::UNLIKELY;
use crate::inference::seen::SeenReadings;

/// Which readings no fit has seen; in files, its words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(into = "&'static str")]
pub enum HeldOut {
    /// Those of a file of their own.
    File,
    /// Each pose (or group of poses) in turn, the model fitted to the others.
    PosesInTurn,
}

impl HeldOut {
    /// As files and pages call it.
    pub fn word(self) -> &'static str {
        match self {
            Self::File => "holdout file",
            Self::PosesInTurn => "poses left out in turn",
        }
    }
}

impl From<HeldOut> for &'static str {
    fn from(held_out: HeldOut) -> Self {
        held_out.word()
    }
}

/// A machine, the readings to fit, and the readings to judge by.
#[derive(Debug, Clone, Copy)]
pub struct JudgedTask<'a> {
    /// The machine as drawn.
    pub hexapod: &'a Hexapod,
    /// Readings to fit.
    pub data: &'a Dataset,
    /// The same, prepared.
    pub campaign: &'a Campaign,
    /// Readings to judge by; without them poses are left out in turn.
    pub holdout: Option<&'a Dataset>,
}

/// A fit with its errors.
#[derive(Debug, Clone)]
pub struct FitWithErrors {
    /// The fit.
    pub fit: Fit,
    /// Residuals of the readings fitted.
    pub residuals: Vec<Residual>,
    /// Their size.
    pub fitted: ErrorSummary,
    /// Errors on readings held out; absent where none can be.
    pub held_out: Option<HeldOutErrors>,
    /// What the fit leaves of the legs beyond the noise.
    pub left: LegDiscrepancy,
}

/// The same, with what a page shows of every reading.
#[derive(Debug, Clone)]
pub struct FitInDetail {
    /// The fit with its errors.
    pub judged: FitWithErrors,
    /// The model at its end, without what columns of other terms need.
    pub linearization: Linearization,
    /// What the fits foresee of the readings that were held out together; empty where none can be.
    pub foreseen: Vec<Foreseen>,
}

/// Errors of a fit on readings held out.
#[derive(Debug, Clone, Copy)]
pub struct HeldOutErrors {
    /// Their size.
    pub summary: ErrorSummary,
    /// Chance of errors as large as these if the model is right, with all that is known of noise, tolerances and parameters; absent
    /// where the noise is not known apart from the residuals.
    pub chance: Option<f64>,
}

/// Chance that useless parameters take as much off the misfit of the readings fitted as those of a larger model do, beside how the
/// readings scatter about that model; absent where it has no parameter more, or no degree of freedom left.
///
/// ```text
/// F = (chi2 - chi2') / (n - n') / (chi2' / n')      follows F(n - n', n')
/// ```
pub fn chance_of_gain(smaller: &Fit, larger: &Fit) -> Option<f64> {
    let gained = Misfit {
        chi2: (smaller.lack_of_fit - larger.lack_of_fit).max(0.0),
        numbers: smaller.lack_of_fit_dof - larger.lack_of_fit_dof,
    };
    let scatter = NoiseLevel { sum: larger.lack_of_fit, dof: larger.lack_of_fit_dof };
    (scatter.dof > 0.0 && scatter.sum > 0.0).then(|| gained.chance(scatter).ok()).flatten()
}

/// True when an error is what the noise gives: by its chance where that is known, else by its size.
pub fn is_at_the_noise(error: &ErrorSummary, chance: Option<f64>) -> bool {
    chance.map_or_else(|| error.is_at_the_noise(), |chance| chance > UNLIKELY)
}

impl FitWithErrors {
    /// Error on readings held out, else on the readings fitted.
    pub fn error(&self) -> ErrorSummary {
        self.held_out.as_ref().map_or(self.fitted, |held_out| held_out.summary)
    }

    /// True when that error is what the noise gives.
    pub fn is_at_the_noise(&self) -> bool {
        is_at_the_noise(&self.error(), self.held_out.as_ref().and_then(|held_out| held_out.chance))
    }

    /// Its numbers; what it leaves of a leg is part of the uncertainty of the leg's stiffness.
    pub fn estimates(&self) -> Estimates {
        estimates_with(&LegCompliances::of(&self.fit).open_by(&self.left.share), &self.fit)
    }
}

impl JudgedTask<'_> {
    /// Fits springs and these terms, added one after the other, and judges them.
    ///
    /// # Errors
    /// As [`crate::estimation::fit_named::fit_named`]; [`ModelError::Mismatch`] when the readings held out are of another kind.
    pub fn fit(&self, terms: &[Added]) -> Result<FitWithErrors, ModelError> {
        let (wanted, fit) = fit_wanted(self.campaign, terms)?;
        self.judge(fit, Some(&wanted))
    }

    /// Judges a fit; `wanted` asks for it again where poses are left out.
    ///
    /// # Errors
    /// [`ModelError::Mismatch`] when the readings held out are of another kind, [`ModelError::SingularPose`].
    pub fn judge(&self, fit: Fit, wanted: Option<&[TermSpec]>) -> Result<FitWithErrors, ModelError> {
        let seen = SeenReadings::at(self.campaign, &fit.point)?;
        let mut judged = self.beside(fit, &seen);
        let held_out = self.held_out_keeping(&judged.fit, wanted, Some(seen.equations), drop)?;
        judged.held_out = held_out.map(|(errors, _)| errors);
        Ok(judged)
    }

    /// Judges a fit as [`Self::judge`] does, with every reading in detail.
    ///
    /// # Errors
    /// As [`Self::judge`].
    pub fn judge_in_detail(&self, fit: Fit, wanted: Option<&[TermSpec]>) -> Result<FitInDetail, ModelError> {
        let (seen, linearization) = SeenReadings::with_model(self.campaign, &fit.point)?;
        let mut judged = self.beside(fit, &seen);
        let held_out =
            self.held_out_keeping(&judged.fit, wanted, Some(seen.equations), |foreseen| foreseen)?;
        let (held_out, foreseen) = held_out.unzip();
        judged.held_out = held_out;
        Ok(FitInDetail { judged, linearization, foreseen: foreseen.unwrap_or_default() })
    }

    /// A fit beside what it leaves of every averaged reading, before any is held out.
    fn beside(&self, fit: Fit, seen: &SeenReadings) -> FitWithErrors {
        let residuals = residuals(self.campaign, &self.data.observations, |i| seen.equations.residual(i));
        let fitted = summarise(&residuals, Some(fit.dof));
        let left = seen.left(self.campaign, fit.lack_of_fit_dof);
        FitWithErrors { fit, residuals, fitted, held_out: None, left }
    }

    /// Where held-out errors come from.
    pub fn held_out(&self) -> HeldOut {
        if self.holdout.is_some() { HeldOut::File } else { HeldOut::PosesInTurn }
    }

    /// Errors of a fit on the holdout file, else on poses left out in turn, and what the fits foresee there; `wanted` asks for the fit
    /// again without them. Absent where too few poses, or poses that alone determine a spring, leave nothing to be judged by.
    ///
    /// # Errors
    /// As [`JudgedTask::judge`].
    pub fn held_out_errors(
        &self,
        fit: &Fit,
        wanted: Option<&[TermSpec]>,
    ) -> Result<Option<(HeldOutErrors, Vec<Foreseen>)>, ModelError> {
        self.held_out_keeping(fit, wanted, None, |foreseen| foreseen)
    }

    /// The same with what is kept of that, thousands of bytes a condition; `equations`: those at the fit, where they are at hand.
    fn held_out_keeping<T: Send>(
        &self,
        fit: &Fit,
        wanted: Option<&[TermSpec]>,
        equations: Option<Equations>,
        keep: impl Fn(Foreseen) -> T + Sync,
    ) -> Result<Option<(HeldOutErrors, Vec<T>)>, ModelError> {
        if let Some(held) = self.holdout {
            same_kind(self.data, held)?;
            let rows = &held.observations;
            let held = held_campaign(self.campaign, held, &fit.point)?;
            let predictive = match equations {
                Some(there) => Predictive::knowing(fit, KnownInputs::by(&there, self.campaign)),
                None => Predictive::of(self.campaign, fit)?,
            };
            let foreseen = predictive.foreseen(held.clone())?;
            let chance = self.chance(foreseen.misfit);
            let summary = summarise(&errors_of(&foreseen.errors(), &held, rows), None);
            return Ok(Some((HeldOutErrors { summary, chance }, vec![keep(foreseen)])));
        }
        let rows = &self.data.observations;
        let left = wanted.and_then(|wanted| {
            let start = Start::where_known(self.campaign, wanted, &fit.point, equations).ok()?;
            leave_poses_out(self.campaign, rows, wanted, start, keep).ok()
        });
        Ok(left.map(|left| {
            let summary = summarise(&left.residuals, None);
            let chance = self.chance(left.misfit(fit.lack_of_fit_dof));
            (HeldOutErrors { summary, chance }, left.kept)
        }))
    }

    /// Chance of a misfit, where the noise is known apart from what the model leaves.
    fn chance(&self, misfit: Misfit) -> Option<f64> {
        let known = self.campaign.noise.allows_verdict();
        known.then(|| misfit.chance(self.campaign.noise_level()).ok()).flatten()
    }
}

/// Readings to fit and to judge by must be of one kind.
///
/// # Errors
/// [`ModelError::Mismatch`].
pub fn same_kind(data: &Dataset, holdout: &Dataset) -> Result<(), ModelError> {
    if data.is_absolute() == holdout.is_absolute() {
        return Ok(());
    }
    let (a, b) = (&data.source, &holdout.source);
    Err(ModelError::Mismatch(format!("{a} and {b} are of different kinds (deflections, absolute poses)")))
}
