//! One trial in numbers.

use hexbench_model::estimation::fit::Fit;
use hexbench_model::estimation::residuals::{prediction_errors, summarise};
use hexbench_model::results::diagnose::{DiagnoseOptions, StepReport};
use hexbench_model::results::discover::discover;
use hexbench_model::terms::catalogue;
use hexbench_truth::campaign::{CaseKind, SimulatedCase};
use hexbench_truth::laboratory;
use serde::{Deserialize, Serialize};

use super::fate::{LawFate, is_law_of, is_sayable};
use super::protocol::DISTANCES;
use crate::harness::words::{self, Word};
use crate::trial::TrialError;

/// What a law may leave of held-out readings without their noise, over the noise of a reading: it raises the error of readings by a
/// twentieth, which nobody sees in them.
pub(crate) const MOST_LEFT: f64 = 1.0 / 3.0;

/// What was hidden, and what was found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DiscoveryRecord {
    /// Ids of the hidden effects.
    #[serde(with = "words::list")]
    pub hidden: Vec<Word>,
    /// Family of the machine.
    #[serde(with = "words")]
    pub family: Word,
    /// Distance of the hidden effect.
    pub distance: Option<f64>,
    /// True when a law was found.
    pub found: bool,
    /// Formulas of the law found and of those that look like it; none where none was found.
    pub formulas: Vec<String>,
    /// Catalogue effects named beside the law, or without one.
    pub beside: Vec<String>,
    /// Stated probability that a law is at work.
    pub probability: f64,
    /// Held-out errors of springs and of the final model, times the noise.
    pub held_out: [f64; 2],
    /// What springs and the final model leave of the held-out readings as they would be without noise: root mean square, times the noise.
    pub left: [f64; 2],
}

impl DiscoveryRecord {
    /// Draws a campaign and searches.
    pub(crate) fn of(kind: CaseKind, index: usize, seed: u64) -> Result<Self, TrialError> {
        let distance = (kind != CaseKind::Clean).then_some(DISTANCES);
        let case = SimulatedCase::draw_in(&laboratory::CAREFUL, kind, index, seed, distance)?;
        let options = DiagnoseOptions::default();
        let study = discover(&case.hexapod, &case.measurements, Some(&case.holdout), &catalogue(), &options)?;
        let exact = case.ideal_holdout()?;
        let noise = study.diagnosis.campaign.noise;
        let left = |fit: Option<&Fit>| {
            let errors = fit.map(|fit| prediction_errors(&case.hexapod, &exact, noise, &fit.point));
            errors.and_then(Result::ok).map_or(f64::NAN, |errors| summarise(&errors, None).times_noise())
        };
        let d = study.discovery;
        let error = |step: Option<&StepReport>| step.map_or(f64::NAN, |s| s.error().times_noise());
        Ok(Self {
            hidden: case.spec.hidden_effects(),
            family: case.spec.family,
            distance: case.spec.distance,
            found: d.found,
            formulas: if d.found { d.laws.iter().map(|l| l.formula.clone()).collect() } else { Vec::new() },
            beside: d.beside,
            probability: d.probability,
            held_out: [error(d.steps.first()), error(d.steps.last())],
            left: [study.fits.first(), study.fits.last()].map(left),
        })
    }

    /// The hidden effect outside the catalogue.
    pub fn outside(&self) -> Option<&'static str> {
        self.hidden.iter().copied().find(|id| hexbench_truth::mechanisms::is_outside(id))
    }

    /// True when a law of the grammar describes what is hidden.
    pub fn is_sayable(&self) -> bool {
        self.outside().is_some_and(is_sayable)
    }

    /// True when the final model foresees held-out readings.
    fn foresees(&self) -> bool {
        self.left[1] <= MOST_LEFT
    }

    /// True when the formula is that of the hidden effect, and the final model does not foresee held-out readings all the same.
    pub(crate) fn is_right_and_uncertain(&self) -> bool {
        self.fate() == LawFate::Wrong && self.outside().is_some_and(|id| is_law_of(id, &self.formulas))
    }

    /// What it came to.
    pub fn fate(&self) -> LawFate {
        match (self.outside(), self.found) {
            (None, true) => LawFate::Invented,
            (Some(id), true) if is_law_of(id, &self.formulas) && self.foresees() => LawFate::Right,
            (Some(_), true) if self.foresees() => LawFate::Equivalent,
            (Some(_), true) => LawFate::Wrong,
            (_, false) if self.beside.is_empty() => LawFate::Nothing,
            (_, false) => LawFate::Catalogue,
        }
    }
}
