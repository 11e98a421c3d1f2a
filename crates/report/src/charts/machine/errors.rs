//! How the error falls to the noise, step by step.

use hexbench_model::inference::selection::FitWithErrors;
use hexbench_model::results::diagnose::Diagnosis;

use super::super::figures::{FINAL, SPRINGS};
use crate::number::multiple;
use crate::plot::Rungs;
use crate::words::ladder;

/// Steps that are drawn.
const MOST_STEPS: usize = 5;

/// Errors in multiples of the noise, the springs alone first.
pub(in super::super) struct ErrorSteps {
    held_out: bool,
    /// Standard deviation of the last one where the noise is all there is.
    band: f64,
    steps: Vec<(String, f64)>,
}

impl ErrorSteps {
    /// The steps of a diagnosis.
    pub(in super::super) fn of(found: &Diagnosis) -> Self {
        Self {
            held_out: found.steps.iter().all(|s| s.holdout.is_some()),
            band: found.steps.last().map_or(0.0, |s| s.error().band()),
            steps: found.steps.iter().map(|s| (ladder::name(s), s.error().times_noise())).collect(),
        }
    }

    /// The springs alone, then springs with terms, by a name.
    pub(in super::super) fn of_fits(springs: &FitWithErrors, model: &FitWithErrors, name: String) -> Self {
        let with = (name, model.error().times_noise());
        let alone = ("springs alone".to_owned(), springs.error().times_noise());
        Self {
            held_out: springs.held_out.is_some() && model.held_out.is_some(),
            band: model.error().band(),
            steps: std::iter::once(alone).chain(Some(with).filter(|(name, _)| !name.is_empty())).collect(),
        }
    }

    /// A group of bars more.
    pub(super) fn drawn(&self, rungs: Rungs) -> Rungs {
        let read = if self.held_out { "held-out" } else { "fitted" };
        let rungs = rungs.group(format!("Error on {read} readings")).line("noise", 1.0, 2.0 * self.band);
        self.steps.iter().take(MOST_STEPS).enumerate().fold(rungs, |rungs, (k, (name, times))| {
            let look = if k == 0 { SPRINGS } else { FINAL };
            rungs.bar(name, *times, format!("{} x noise", multiple(*times)), look)
        })
    }
}
