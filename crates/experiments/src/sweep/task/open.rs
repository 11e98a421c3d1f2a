//! Trials of a study handed over, for an algorithm of somebody else.

use std::sync::{Arc, Mutex, PoisonError};

use hexbench_core::{Dataset, Hexapod};

use super::diagnose::measured;
use crate::sweep::bench::BlockSetup;
use crate::sweep::columns::Status;
use crate::sweep::draw::{SweepPurpose, generator};
use crate::sweep::runner::Runner;

/// What a laboratory would hand over in a trial, and what is hidden in its machine.
#[derive(Debug, Clone)]
pub struct OpenTrial {
    /// The machine as its drawings and its author state it.
    pub hexapod: Hexapod,
    /// Readings to learn from.
    pub measurements: Dataset,
    /// Readings to judge by.
    pub holdout: Dataset,
    /// The same without noise.
    pub ideal: Dataset,
    /// True stiffness of each leg, N/m.
    pub true_stiffness: [f64; 6],
    /// Ids of the hidden effects.
    pub hidden: Vec<&'static str>,
    /// Size of the one hidden effect in the unit of its kind; none outside the catalogue, and of several.
    pub true_size: Option<f64>,
}

/// Cell, and block of trials that share a machine.
type Place = (usize, u64);
/// A block of trials, or why it has no readings.
type SharedBlock = Arc<Result<BlockSetup, Status>>;

/// The trials of a study: with the task `diagnose` those that it diagnoses.
pub struct OpenTrials {
    runner: Runner,
    /// The block of the last trial.
    block: Mutex<Option<(Place, SharedBlock)>>,
}

impl OpenTrials {
    /// Of a study.
    pub fn of(runner: Runner) -> Self {
        Self { runner, block: Mutex::default() }
    }

    /// The study, ready to run.
    pub fn runner(&self) -> &Runner {
        &self.runner
    }

    /// A trial of a cell; both count from 0 and are of the study.
    ///
    /// # Errors
    /// Why it has no readings.
    pub fn trial(&self, cell: usize, trial: u64) -> Result<OpenTrial, Status> {
        let study = self.runner.study();
        let bench = self.block((cell, trial / study.redraw));
        let bench = bench.as_ref().as_ref().map_err(|status| *status)?;
        let at = study.axes.cell(cell);
        let mut noise = generator(study.seed, SweepPurpose::Noise, at.index, trial);
        let [measurements, holdout] =
            measured(bench, &mut noise, |purpose| generator(study.seed, purpose, at.position[0], trial));
        Ok(OpenTrial {
            hexapod: bench.hexapod.clone(),
            measurements,
            holdout,
            ideal: bench.holdout.dataset("ideal.csv", None),
            true_stiffness: bench.true_stiffness,
            hidden: bench.hidden.clone(),
            true_size: bench.true_size,
        })
    }

    fn block(&self, place: Place) -> SharedBlock {
        let mut last = self.block.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, block)) = last.as_ref().filter(|(at, _)| *at == place) {
            return Arc::clone(block);
        }
        let cell = self.runner.study().axes.cell(place.0);
        let block = Arc::new(BlockSetup::draw(&self.runner, &cell, place.1));
        *last = Some((place, Arc::clone(&block)));
        block
    }
}
