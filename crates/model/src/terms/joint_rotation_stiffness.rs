//! `joint-rotation-stiffness`: flexure joints resist rotation.

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, ParameterInfo, Rich, Scale, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

pub(super) struct JointRotationStiffness;

static INFO: TermInfo = TermInfo {
    id: "joint-rotation-stiffness",
    title: "Flexure joints resist rotation",
    chapter: Chapter::Joints,
    physics: "Flexure joints bend when a leg changes direction: at the base end against the base, at the platform end against the platform. At every commanded pose they are straight.",
    equation: "K = sum k_b G_b' G_b + k_p G_p' G_p, with dn = G_b [v; w] and R d(R' n) = G_p [v; w]",
    source: "Smith, Flexures, 2000; Dehaeze, PhD thesis 2021, ch. 5 (flexible joints of a Stewart platform)",
    shows: "the joints are stiff compared with the legs",
    how_to_isolate: "tilt the platform far and load it with moments",
    parameters: &[
        ParameterInfo::new("base-end", "N m/rad", 1.0, Scale::AngularStiffness, true),
        ParameterInfo::new("platform-end", "N m/rad", 1.0, Scale::AngularStiffness, true),
    ],
    shape: None,
    needs: &[],
    rich: Rich::None,
};

impl Term for JointRotationStiffness {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, _: &Machine, _: &Condition, _: f64, out: &mut Vec<Action>) {
        out.extend([Action::Bending([1.0, 0.0]), Action::Bending([0.0, 1.0])]);
    }
}
