//! The metrology frame moves with time: `metrology-drift`.
//!
//! Tripod, floor or probe head creep while the load settles: the six numbers read drift at constant rates.

use hexbench_core::{Hexapod, Pose};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, normal6};
use crate::Instant;

/// The metrology frame moves with time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MetrologyDrift {
    /// Of a, b, c (m/s) and alpha, beta, gamma (rad/s).
    pub rates: [f64; 6],
}

impl Registered for MetrologyDrift {
    const ID: &'static str = "metrology-drift";
    const TITLE: &'static str = "The metrology frame moves with time";
    const PHYSICS: &'static str = "reading += rates * elapsed";
    const SHOWS: Shows = Shows::Deflection;

    fn draw(_: &Hexapod, rng: &mut Pcg64) -> Self {
        const USUAL_M_PER_S: f64 = 2e-9;
        const USUAL_RAD_PER_S: f64 = 1.2e-8;
        Self { rates: normal6(rng, [USUAL_M_PER_S, USUAL_RAD_PER_S]) }
    }

    fn read(&self, moment: &Instant<'_>, pose: &mut Pose) {
        *pose =
            Pose::from_array(std::array::from_fn(|k| pose.to_array()[k] + self.rates[k] * moment.elapsed()));
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { rates: self.rates.map(|x| x * factor) }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("drift", json!(self.rates))]
    }
}
