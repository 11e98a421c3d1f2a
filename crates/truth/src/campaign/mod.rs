//! Campaigns: a machine, a plan, effects of a chosen visibility, and their files.

mod absolute;
mod alike;
mod case;
mod fault;
mod files;
mod input_errors;
pub mod machines;
mod measure;
mod plan;
mod redraw;
mod scheme;
mod sensor_readings;
mod sensor_set;
mod signature;

pub use alike::AlikeReadings;
pub use case::{CaseKind, CaseSpec, EffectOf, SimulatedCase, resized};
pub(crate) use fault::Stage;
pub use input_errors::InputErrors;
pub use measure::{SimulatedCampaign, measure};
pub use plan::{MeasurementPlan, PlanKind, PlanRow, Schemes};
pub(crate) use scheme::pose_of;
pub use scheme::{Poses, Scheme, Spread, usual_half_range_mm_deg};
pub use sensor_readings::SensorReadings;
pub use sensor_set::{SensorFault, SensorSet};
pub use signature::{Yardstick, rms};

use rand::RngExt;
use rand_pcg::Pcg64;

/// One of several, at random.
fn pick<T: Copy>(rng: &mut Pcg64, choices: &[T]) -> T {
    choices[rng.random_range(0..choices.len())]
}

/// A value with as many decimals as the files carry, so that what is written is what was simulated.
pub(crate) fn rounded(value: f64) -> f64 {
    const DECIMALS: f64 = 1e6;
    (value * DECIMALS).round() / DECIMALS
}
