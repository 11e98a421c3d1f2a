//! `leg-coupling`: two legs share a bracket.

use hexbench_core::Vector3;

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, Need, ParameterInfo, Rich, Scale, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

pub(super) struct LegCoupling;

static INFO: TermInfo = TermInfo {
    id: "leg-coupling",
    title: "Two legs share a bracket",
    chapter: Chapter::Joints,
    physics: "The force of one leg moves the joint of its neighbor on the same bracket.",
    equation: "a_i = c_x (f_j n_j less the same at f0), e_i += n_i . a_i for each pair",
    source: "Klimchik et al. 2014, Mech. Mach. Theory 81 (coupled compliances)",
    shows: "lateral loads are measured",
    how_to_isolate: "load sideways and about the vertical axis, so that the legs of a pair take opposite forces",
    parameters: &[ParameterInfo::new("cross-compliance", "nm/N", 1e9, Scale::Compliance, false)],
    shape: None,
    needs: &[Need::Brackets],
    rich: Rich::PerLeg,
};

impl Term for LegCoupling {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, machine: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        let mut shift = [Vector3::zeros(); 6];
        for &[i, j] in &machine.bracket_pairs {
            shift[i] += at.pull_change(j);
            shift[j] += at.pull_change(i);
        }
        out.push(Action::Shift(shift));
    }
}
