//! Whether readings can show that a sensor is wrong.

use hexbench_core::{Dataset, Hexapod};
use hexbench_model::error::ModelError;
use hexbench_model::estimation::fit::{Fit, fit_baseline};
use hexbench_model::estimation::fit_named::{Added, fit_wanted};
use hexbench_model::results::diagnose::prepare;
use hexbench_model::terms::catalogue;
use hexbench_truth::campaign::{SensorReadings, SimulatedCase};

use crate::trial::TrialError;

/// Chi-square of a fault beyond which readings show it: six standard deviations.
pub const SHOWN: f64 = 36.0;

/// Chi-square that a fault of the first sensor, at its true size, adds to readings without noise beside springs and the hidden effect;
/// sensors, joints and loads stand in it to their tolerances. `case`: before it is read.
///
/// # Errors
/// As [`SimulatedCase::read_with`] and [`fit_baseline`].
pub(super) fn information(mut case: SimulatedCase, how: SensorReadings) -> Result<f64, TrialError> {
    let hidden = case.spec.hidden_effects();
    let pose_rows = [case.measurements.clone(), case.holdout.clone()];
    let mut left = |fault| {
        [case.measurements, case.holdout] = pose_rows.clone();
        case.read_with(SensorReadings { fault, is_noisy: false, ..how })?;
        Ok::<_, TrialError>(known(&case.hexapod, &case.measurements, &hidden)?.lack_of_fit)
    };
    Ok(left(how.fault)? - left(None)?)
}

/// Springs and the hidden effects; springs alone where the file cannot test those.
fn known(hexapod: &Hexapod, data: &Dataset, hidden: &[&str]) -> Result<Fit, ModelError> {
    let campaign = prepare(hexapod, data)?;
    let terms: Result<Vec<Added>, _> = hidden.iter().map(|id| Added::named(id, &catalogue())).collect();
    let with = terms.and_then(|terms| fit_wanted(&campaign, &terms));
    with.map_or_else(|_| fit_baseline(&campaign), |(_, fit)| Ok(fit))
}
