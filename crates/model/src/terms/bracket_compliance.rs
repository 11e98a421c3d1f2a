//! `bracket-compliance`: joint mounts yield sideways.

use hexbench_core::Vector3;

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, ParameterInfo, Rich, Scale, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

pub(super) struct BracketCompliance;

static INFO: TermInfo = TermInfo {
    id: "bracket-compliance",
    title: "Joint mounts yield sideways",
    chapter: Chapter::Joints,
    physics: "The mounts of the base joints are softer along the base plane than along its normal. The lateral compliance is the excess of the one over the other: a compliance that is equal in all directions is part of the leg stiffness.",
    equation: "a = c_lat [f n_x, f n_y, 0] less the same at f0, e = n . a",
    source: "Kalas et al. 2018, list of suspects: incomplete stiffness model",
    shows: "the inclination of the legs varies",
    how_to_isolate: "measure at poses far from the center, where the legs are steeper and flatter",
    parameters: &[ParameterInfo::new("lateral-compliance", "nm/N", 1e9, Scale::Compliance, true)],
    shape: None,
    needs: &[],
    rich: Rich::PerLeg,
};

impl Term for BracketCompliance {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        let sideways = |leg: usize| {
            let pull = at.pull_change(leg);
            Vector3::new(pull.x, pull.y, 0.0)
        };
        out.push(Action::Shift(std::array::from_fn(sideways)));
    }
}
