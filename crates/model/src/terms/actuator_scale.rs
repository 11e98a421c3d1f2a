//! `actuator-scale`: encoders or leads have a gain error.

use hexbench_core::Vector6;

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, LEGS, Need, Rich, Scale, Term, TermInfo, each};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

pub(super) struct ActuatorScale;

static INFO: TermInfo = TermInfo {
    id: "actuator-scale",
    title: "Encoders or leads have a gain error",
    chapter: Chapter::AbsolutePoses,
    physics: "Each leg moves slightly more or less than commanded.",
    equation: "e_i = gain_i (q_i - q_home,i)",
    source: "ISO 230-2:2014 (positioning accuracy of linear axes)",
    shows: "poses are measured absolutely and use a long stroke",
    how_to_isolate: "measure absolute poses with short and with long legs",
    parameters: &each(&LEGS, "um/m", 1e6, Scale::Fixed(1e-2), false),
    shape: None,
    needs: &[Need::Absolute],
    rich: Rich::None,
};

impl Term for ActuatorScale {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        out.extend((0..6).map(|leg| Action::Elongation(Vector6::ith(leg, at.extension[leg]))));
    }
}
