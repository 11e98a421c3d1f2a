//! Two legs share one bracket: `leg-coupling`.
//!
//! The bracket of a pair of base joints yields under both legs. What each leg does to its own joint is part of its own
//! compliance; this is what it does to the neighbor's. Pairs: as the drawing states, else nearest neighbors.

use hexbench_core::{Hexapod, Matrix3};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows};
use crate::{Instant, Setup, setup::Bracket};

/// Two legs share one bracket.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LegCoupling {
    /// Displacement of one joint per force of the other leg `c_x`, m/N.
    pub cross_compliance: f64,
}

impl Registered for LegCoupling {
    const ID: &'static str = "leg-coupling";
    const TITLE: &'static str = "Two legs share one bracket";
    const PHYSICS: &'static str = "base joint i moves by c_x f_j n_j for its neighbor j";
    const SHOWS: Shows = Shows::Deflection;

    fn draw(_: &Hexapod, _: &mut Pcg64) -> Self {
        Self { cross_compliance: 2e-8 }
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        let compliance = Matrix3::identity() * self.cross_compliance;
        for [i, j] in moment.hexapod.bracket_pairs() {
            setup.brackets.push(Bracket { displaced: i, pulled: j, compliance });
            setup.brackets.push(Bracket { displaced: j, pulled: i, compliance });
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { cross_compliance: self.cross_compliance * factor }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("coupling", json!(self.cross_compliance))]
    }
}
