//! `leg-backlash`: play in the legs.

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, ParameterInfo, Rich, Scale, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

pub(super) struct LegBacklash;

static INFO: TermInfo = TermInfo {
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

impl Term for LegBacklash {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        let side = |f: f64| if f == 0.0 { 0.0 } else { f.signum() };
        out.push(Action::Elongation(0.5 * (at.force.map(side) - at.reference_force.map(side))));
    }
}
