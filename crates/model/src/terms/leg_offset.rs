//! `leg-offset`: zero lengths of the legs are off.

use hexbench_core::Vector6;

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, LEGS, Need, Rich, Scale, Term, TermInfo, each};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

pub(super) struct LegOffset;

static INFO: TermInfo = TermInfo {
    id: "leg-offset",
    title: "Zero lengths of the legs are off",
    chapter: Chapter::AbsolutePoses,
    physics: "Each leg differs from its encoder reading by a constant length.",
    equation: "e_i = offset_i",
    source: "Merlet, Parallel Robots, 2nd ed. 2006, ch. 7 (calibration)",
    shows: "poses are measured absolutely",
    how_to_isolate: "measure absolute poses over the whole workspace",
    parameters: &each(&LEGS, "um", 1e6, Scale::Fixed(1e-3), false),
    shape: None,
    needs: &[Need::Absolute],
    rich: Rich::None,
};

impl Term for LegOffset {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, _: &Machine, _: &Condition, _: f64, out: &mut Vec<Action>) {
        out.extend((0..6).map(|leg| Action::Elongation(Vector6::ith(leg, 1.0))));
    }
}
