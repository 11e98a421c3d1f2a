//! `leg-weight`: the legs are not massless.

use hexbench_core::{Vector3, Vector6};

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, Need, ParameterInfo, Rich, Scale, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

pub(super) struct LegWeight;

static INFO: TermInfo = TermInfo {
    id: "leg-weight",
    title: "The legs are not massless",
    chapter: Chapter::AbsolutePoses,
    physics: "Half the weight of each uniform leg rests on its platform joint and half on its base joint; gravity points along -z.",
    equation: "dF at every platform joint = -w/2 z",
    source: "Merlet, Parallel Robots, 2nd ed. 2006, ch. 9 (gravity of the links)",
    shows: "poses are measured absolutely under two loads",
    how_to_isolate: "measure absolute poses over the workspace under two loads",
    parameters: &[ParameterInfo::new("weight-per-leg", "N", 1.0, Scale::Weight(100.0), true)],
    shape: None,
    needs: &[Need::Absolute, Need::Loads],
    rich: Rich::None,
};

impl Term for LegWeight {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        let share = -0.5 * Vector3::z();
        let moment: Vector3 = at.legs.arms.iter().map(|arm| arm.cross(&share)).sum();
        out.push(Action::Wrench(Vector6::new(0.0, 0.0, 6.0 * share.z, moment.x, moment.y, moment.z)));
    }
}
