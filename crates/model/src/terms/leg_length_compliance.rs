//! `leg-length-compliance`: leg compliance grows with leg length.

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, ParameterInfo, Rich, Scale, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

pub(super) struct LegLengthCompliance;

static INFO: TermInfo = TermInfo {
    id: "leg-length-compliance",
    title: "Leg compliance grows with leg length",
    chapter: Chapter::Legs,
    physics: "The screw or rod of a leg yields more the further the leg is extended.",
    equation: "e = s ((q - q_home) f - (q0 - q_home) f0), q the present length",
    source: "Merlet, Parallel Robots, 2nd ed. 2006, ch. 9 (stiffness of actuated links)",
    shows: "the poses use a long stroke",
    how_to_isolate: "repeat the loads at poses with short and with long legs",
    parameters: &[ParameterInfo::new("slope", "nm/(N mm)", 1e6, Scale::CompliancePerLength, false)],
    shape: None,
    needs: &[],
    rich: Rich::PerLeg,
};

impl Term for LegLengthCompliance {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, machine: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        let [reference, loaded] =
            [0, 1].map(|s| (at.states[s].lengths - machine.home_lengths).component_mul(&at.spring_forces[s]));
        out.push(Action::Elongation(loaded - reference));
    }
}
