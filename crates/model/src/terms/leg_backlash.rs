//! `leg-backlash`: play in the legs.
//!
//! Flanks that meet all at once are the usual version; in the other one the contact closes over some newtons.

use std::sync::Arc;

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, ParameterInfo, Rich, Scale, Shape, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

/// Prior share of contacts that close gradually.
const SOFT: f64 = 0.2;

const INFO: TermInfo = TermInfo {
    id: "leg-backlash",
    title: "Play in the legs",
    chapter: Chapter::Legs,
    physics: "A leg jumps through its play when its force changes sign.",
    equation: "e = gap/2 (sgn f - sgn f0)",
    source: "Kalas et al. 2018: a preload was needed to suppress the play in the actuators",
    shows: "the force of a leg reverses between reference and load",
    how_to_isolate: "reverse the force of single legs: pull upwards or sideways beyond the preload",
    parameters: &[ParameterInfo::new("gap", "um", 1e6, Scale::Fixed(20e-6), true)],
    shape: None,
    needs: &[],
    rich: Rich::PerLeg,
};

const SOFT_INFO: TermInfo = TermInfo {
    title: "Play in the legs, with soft contact",
    equation: "e = gap/2 (tanh(f / w) - tanh(f0 / w))",
    shape: Some(Shape { name: "contact-width", unit: "N", per_si: 1.0, bounds: [1e-3, 1e6] }),
    rich: Rich::None,
    ..INFO
};

static VERSIONS: [TermInfo; 2] = [INFO, SOFT_INFO];

/// Play whose contact closes at once, or over a width.
#[derive(Clone, Copy)]
pub(super) struct LegBacklash {
    is_soft: bool,
}

/// The usual version.
pub(super) const LEG_BACKLASH: LegBacklash = LegBacklash { is_soft: false };

impl LegBacklash {
    /// Side of the play on which a leg rests, from -1 to 1.
    fn side(self, f: f64, width: f64) -> f64 {
        match f {
            _ if self.is_soft => (f / width).tanh(),
            0.0 => 0.0,
            _ => f.signum(),
        }
    }
}

impl Term for LegBacklash {
    fn info(&self) -> &TermInfo {
        &VERSIONS[usize::from(self.is_soft)]
    }

    fn actions(&self, _: &Machine, at: &Condition, shape: f64, out: &mut Vec<Action>) {
        let side = |f: f64| self.side(f, shape);
        out.push(Action::Elongation(0.5 * (at.force.map(side) - at.reference_force.map(side))));
    }

    fn shape_grid(&self, conditions: &[Condition]) -> Vec<f64> {
        // Where no leg reverses, a soft contact is a bent spring and no play.
        let reverses = |c: &Condition| (0..6).any(|leg| c.force[leg] * c.reference_force[leg] < 0.0);
        if !self.is_soft || !conditions.iter().any(reverses) {
            return Vec::new();
        }
        // From widths that only legs near their reversal notice to half the typical change of force.
        let n = (6 * conditions.len()).max(1) as f64;
        let square: f64 = conditions.iter().map(|c| c.force_change().norm_squared()).sum();
        let typical = (square / n).sqrt().max(1e-3);
        (0..4).map(|k| typical * 0.03 * 2.5f64.powi(k)).collect()
    }

    fn version(&self) -> Option<&'static str> {
        self.is_soft.then_some("soft")
    }

    fn versions(&self) -> Vec<(f64, Arc<dyn Term>)> {
        vec![(SOFT, Arc::new(Self { is_soft: true }))]
    }
}
