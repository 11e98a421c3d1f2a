//! Joints that resist when their leg changes direction against what carries them.
//!
//! With `n` the direction of a leg, `q` its length and `P = (I - n n') / q`, a twist `[v; w]` of the platform and a displacement `a` of
//! the base joint turn the leg by `dn = P (v + w x r - a)`, and against the platform by `dn - w x n`. The joints store
//! `k_b |dn|^2 / 2 + k_p |dn - w x n|^2 / 2`. Fixed axes, mobile origin.

use hexbench_core::{Matrix3, Matrix6, Vector3, Vector6};
use nalgebra::Matrix3x6;

use crate::machine::kinematics::Legs;

/// Stiffness (6x6) of the joints of all legs, each `[base end, platform end]` in N m/rad.
pub(crate) fn stiffness(legs: &Legs, [base, platform]: [f64; 2]) -> Matrix6 {
    let of = |leg| {
        let (turn, against_platform) = direction_changes(legs, leg);
        base * turn.tr_mul(&turn) + platform * against_platform.tr_mul(&against_platform)
    };
    (0..6).map(of).sum()
}

/// Wrench on the platform when the base joints are displaced.
pub(crate) fn wrench(legs: &Legs, [base, platform]: [f64; 2], shift: &[Vector3; 6]) -> Vector6 {
    let of = |leg| {
        let (turn, against_platform) = direction_changes(legs, leg);
        let turned = across(legs, leg) * shift[leg];
        base * turn.tr_mul(&turned) + platform * against_platform.tr_mul(&turned)
    };
    (0..6).map(of).sum()
}

fn across(legs: &Legs, leg: usize) -> Matrix3 {
    let n = legs.directions[leg];
    (Matrix3::identity() - n * n.transpose()) / legs.lengths[leg]
}

/// `G_b` and `G_p` (3x6) of one leg: change of the leg's direction in the fixed frame, and against the platform.
fn direction_changes(legs: &Legs, leg: usize) -> (Matrix3x6<f64>, Matrix3x6<f64>) {
    let (n, across) = (legs.directions[leg], across(legs, leg));
    let mut turn = Matrix3x6::zeros();
    turn.fixed_columns_mut::<3>(0).copy_from(&across);
    turn.fixed_columns_mut::<3>(3).copy_from(&(-across * legs.arms[leg].cross_matrix()));
    let mut against_platform = turn;
    let rotation = turn.fixed_columns::<3>(3) + n.cross_matrix();
    against_platform.fixed_columns_mut::<3>(3).copy_from(&rotation);
    (turn, against_platform)
}
