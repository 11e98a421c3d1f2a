//! Joint mounts yield sideways: `bracket-compliance`.
//!
//! Each base joint stands on a post that is stiff along the base normal (z) and soft across it. `(f_x, f_y)` is what the leg
//! pulls at the joint.

use hexbench_core::{Hexapod, Matrix3, Vector3};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows};
use crate::{Instant, Setup, setup::Bracket};

/// Joint mounts yield sideways.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BracketCompliance {
    /// Compliance in x and in y `c_lat`, m/N.
    pub lateral_compliance: f64,
}

impl Registered for BracketCompliance {
    const ID: &'static str = "bracket-compliance";
    const TITLE: &'static str = "Joint mounts yield sideways";
    const PHYSICS: &'static str = "base joint i moves by c_lat (f_x, f_y, 0)";
    const SHOWS: Shows = Shows::Deflection;

    fn draw(_: &Hexapod, _: &mut Pcg64) -> Self {
        Self { lateral_compliance: 1e-7 }
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        let compliance = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 0.0)) * self.lateral_compliance;
        setup.brackets.extend((0..6).map(|leg| Bracket { displaced: leg, pulled: leg, compliance }));
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { lateral_compliance: self.lateral_compliance * factor }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("bracket", json!(self.lateral_compliance))]
    }
}
