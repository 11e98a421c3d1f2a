//! Two legs share one bracket: `leg-coupling`.
//!
//! The bracket of a pair of base joints yields under both legs. What each leg does to its own joint is part of its own
//! compliance; this is what it does to the neighbor's. Pairs: as the drawing states, else nearest neighbors.

use hexbench_core::{Hexapod, Matrix3};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, parsed};
use crate::{Instant, Setup, setup::Bracket};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "leg-coupling",
    title: "Two legs share one bracket",
    physics: "base joint i moves by c_x f_j n_j for its neighbor j",
    shows: Shows::Deflection,
    draw,
    parse: parsed::<LegCoupling>,
};

/// Two legs share one bracket.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LegCoupling {
    /// Displacement of one joint per force of the other leg `c_x`, m/N.
    pub cross_compliance: f64,
}

impl Mechanism for LegCoupling {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        let compliance = Matrix3::identity() * self.cross_compliance;
        for [i, j] in moment.hexapod.bracket_pairs() {
            setup.brackets.push(Bracket { displaced: i, pulled: j, compliance });
            setup.brackets.push(Bracket { displaced: j, pulled: i, compliance });
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { cross_compliance: self.cross_compliance * factor })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("coupling".to_owned(), json!(self.cross_compliance))])
    }
}

fn draw(_: &Hexapod, _: &mut Pcg64) -> Box<dyn Mechanism> {
    Box::new(LegCoupling { cross_compliance: 2e-8 })
}
