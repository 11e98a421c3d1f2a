//! `joint-rotation-stiffness`: flexure joints resist rotation.

use hexbench_core::{Matrix3, Matrix6};
use nalgebra::Matrix3x6;

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, ParameterInfo, Rich, Scale, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

pub(super) struct JointRotationStiffness;

static INFO: TermInfo = TermInfo {
    id: "joint-rotation-stiffness",
    title: "Flexure joints resist rotation",
    chapter: Chapter::Joints,
    physics: "Flexure joints bend when a leg changes direction: at the base end against the base, at the platform end against the platform.",
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

    fn actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        let (mut base, mut platform) = (Matrix6::zeros(), Matrix6::zeros());
        for leg in 0..6 {
            let (turn, against_platform) = direction_changes(at, leg);
            base += turn.tr_mul(&turn);
            platform += against_platform.tr_mul(&against_platform);
        }
        out.extend([Action::Stiffness(base), Action::Stiffness(platform)]);
    }
}

/// `G_b` and `G_p` (3x6) of one leg: change of the leg's direction in the fixed frame, and against the platform.
fn direction_changes(at: &Condition, leg: usize) -> (Matrix3x6<f64>, Matrix3x6<f64>) {
    let n = at.legs.directions[leg];
    let across = (Matrix3::identity() - n * n.transpose()) / at.legs.lengths[leg];
    let mut turn = Matrix3x6::zeros();
    turn.fixed_columns_mut::<3>(0).copy_from(&across);
    turn.fixed_columns_mut::<3>(3).copy_from(&(-across * at.legs.arms[leg].cross_matrix()));
    let mut against_platform = turn;
    let rotation = turn.fixed_columns::<3>(3) + n.cross_matrix();
    against_platform.fixed_columns_mut::<3>(3).copy_from(&rotation);
    (turn, against_platform)
}
