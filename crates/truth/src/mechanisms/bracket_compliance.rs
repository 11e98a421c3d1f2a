//! Joint mounts yield sideways: `bracket-compliance`.
//!
//! Each base joint stands on a post that is stiff along the base normal (z) and soft across it. `(f_x, f_y)` is what the leg
//! pulls at the joint.

use hexbench_core::{Hexapod, Matrix3, Vector3};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, parsed};
use crate::{Instant, Setup, setup::Bracket};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "bracket-compliance",
    title: "Joint mounts yield sideways",
    physics: "base joint i moves by c_lat (f_x, f_y, 0)",
    shows: Shows::Deflection,
    draw,
    parse: parsed::<BracketCompliance>,
};

/// Joint mounts yield sideways.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BracketCompliance {
    /// Compliance in x and in y `c_lat`, m/N.
    pub lateral_compliance: f64,
}

impl Mechanism for BracketCompliance {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        let compliance = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 0.0)) * self.lateral_compliance;
        setup.brackets.extend((0..6).map(|leg| Bracket { displaced: leg, pulled: leg, compliance }));
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { lateral_compliance: self.lateral_compliance * factor })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("bracket".to_owned(), json!(self.lateral_compliance))])
    }
}

fn draw(_: &Hexapod, _: &mut Pcg64) -> Box<dyn Mechanism> {
    Box::new(BracketCompliance { lateral_compliance: 1e-7 })
}
