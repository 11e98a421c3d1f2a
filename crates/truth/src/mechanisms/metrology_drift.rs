//! The metrology frame moves with time: `metrology-drift`.
//!
//! Tripod, floor or probe head creep while the load settles: the six numbers read drift at constant rates.

use hexbench_core::{Hexapod, Pose};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, normal3, parsed};
use crate::Instant;

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "metrology-drift",
    title: "The metrology frame moves with time",
    physics: "reading += rates * elapsed",
    shows: Shows::Deflection,
    draw,
    parse: parsed::<MetrologyDrift>,
};

/// The metrology frame moves with time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MetrologyDrift {
    /// Of a, b, c (m/s) and alpha, beta, gamma (rad/s).
    pub rates: [f64; 6],
}

impl Mechanism for MetrologyDrift {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn read(&self, moment: &Instant<'_>, pose: &mut Pose) {
        *pose =
            Pose::from_array(std::array::from_fn(|k| pose.to_array()[k] + self.rates[k] * moment.elapsed()));
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { rates: self.rates.map(|x| x * factor) })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("drift".to_owned(), json!(self.rates))])
    }
}

fn draw(_: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    const USUAL_M_PER_S: f64 = 2e-9;
    const USUAL_RAD_PER_S: f64 = 1.2e-8;
    let ([a, b, c], [x, y, z]) = (normal3(rng, USUAL_M_PER_S), normal3(rng, USUAL_RAD_PER_S));
    Box::new(MetrologyDrift { rates: [a, b, c, x, y, z] })
}
