//! `leg-coupling`: two legs share a bracket.

use hexbench_core::Vector6;

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, Need, ParameterInfo, Rich, Scale, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

pub(super) struct LegCoupling;

static INFO: TermInfo = TermInfo {
    id: "leg-coupling",
    title: "Two legs share a bracket",
    chapter: Chapter::Joints,
    physics: "The force of one leg moves the joint of its neighbour on the same bracket.",
    equation: "e_i += c_x (n_i . n_j) (f_j - f0_j) for each pair",
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
        let change = at.force_change();
        let mut e = Vector6::zeros();
        for &[i, j] in &machine.bracket_pairs {
            let cosine = at.legs.directions[i].dot(&at.legs.directions[j]);
            e[i] += cosine * change[j];
            e[j] += cosine * change[i];
        }
        out.push(Action::Elongation(e));
    }
}
