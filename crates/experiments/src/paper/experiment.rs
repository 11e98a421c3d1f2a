//! One simulated experiment by the paper's procedure.

use hexbench_core::Dataset;
use hexbench_truth::World;

use super::bench::{Covariates, PaperMachine, identification, validation};
use super::error::PaperError;
use super::identify::{Identified, PaperEstimator};
use super::suspects::uncorrected;

/// Streams of random numbers, one for each set of readings.
const IDENTIFICATION: u64 = 1;
const VALIDATION: u64 = 2;

/// Readings, springs, and errors on the validation poses.
#[derive(Debug)]
pub struct Experiment {
    /// Nine readings at the poses of Table 1.
    pub identification: Dataset,
    /// Ten readings at the poses of Table 3.
    pub validation: Dataset,
    /// By the paper's estimator.
    pub paper: EstimatorResult,
    /// By weighted least squares.
    pub weighted: EstimatorResult,
    /// Root mean square of the measured deflections over the validation poses, um and urad.
    pub before: [f64; 6],
}

/// What one estimator makes of the readings.
#[derive(Debug)]
pub struct EstimatorResult {
    /// The springs.
    pub identified: Identified,
    /// Error of prediction, um and urad.
    pub error: [f64; 6],
    /// The same as expected of noise when springs are all there is.
    pub expected: [f64; 6],
    /// Chance of errors as large as these if springs are all there is.
    pub chance: f64,
}

impl Experiment {
    /// Loads, measures, identifies, predicts.
    pub(crate) fn run(bench: &PaperMachine, world: &World) -> Result<Self, PaperError> {
        let read = |rows: &[_], source, stream| bench.measure(world, rows, Covariates::None, source, stream);
        let readings = read(&identification(), "Table 1", IDENTIFICATION)?;
        let held_out = read(&validation(), "Table 3", VALIDATION)?;
        let outcome = |estimator| EstimatorResult::of(bench, &readings, &held_out, estimator);
        Ok(Self {
            paper: outcome(PaperEstimator::Paper)?,
            weighted: outcome(PaperEstimator::Weighted)?,
            before: uncorrected(&held_out),
            identification: readings,
            validation: held_out,
        })
    }
}

impl EstimatorResult {
    fn of(
        bench: &PaperMachine,
        readings: &Dataset,
        held_out: &Dataset,
        estimator: PaperEstimator,
    ) -> Result<Self, PaperError> {
        let identified = Identified::from(bench, readings, estimator)?;
        Ok(Self {
            error: identified.prediction_error(bench, held_out)?,
            expected: identified.expected_error(bench, held_out)?,
            chance: identified.chance(held_out)?,
            identified,
        })
    }
}
