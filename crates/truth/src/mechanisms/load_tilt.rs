//! Load directions are tilted: `load-tilt`.
//!
//! The frame in which the load directions were set up (plumb line, pulleys) is turned against the fixed frame by two small
//! angles. Moments stay.

use hexbench_core::{Hexapod, Vector3};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, normal3};
use crate::{Instant, Setup, so3};

/// A set-up that leans further than this is seen by eye, rad.
const LARGEST_RAD: f64 = 0.2;

/// Load directions are tilted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadTilt {
    /// Rotation vector about x and y, rad.
    pub angles: [f64; 2],
}

impl Registered for LoadTilt {
    const ID: &'static str = "load-tilt";
    const TITLE: &'static str = "Load directions are tilted";
    const PHYSICS: &'static str = "F -> rotation(alpha_x, alpha_y, 0) F in both states";
    const SHOWS: Shows = Shows::Deflection;

    fn draw(_: &Hexapod, rng: &mut Pcg64) -> Self {
        const USUAL_RAD: f64 = 0.02;
        let [x, y, _] = normal3(rng, USUAL_RAD);
        Self { angles: [x, y] }
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        let tilt = so3::exp(&Vector3::new(self.angles[0], self.angles[1], 0.0));
        setup.wrench.force = tilt * setup.wrench.force;
        for force in &mut setup.forces {
            force.force = tilt * force.force;
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { angles: self.angles.map(|x| x * factor) }
    }

    fn largest_factor(&self) -> f64 {
        LARGEST_RAD / self.angles[0].hypot(self.angles[1]).max(f64::MIN_POSITIVE)
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("tilt", json!(self.angles))]
    }
}
