//! Axes that were named otherwise, and angles that turn in another order.

use hexbench_core::{AngleConvention, Matrix3, Pose, Vector3};

/// Axes of the file in terms of those meant: entry `k` is the axis of the file, from 1 and with its sign, that is axis `k`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct SignedAxes([i8; 3]);

impl SignedAxes {
    /// Every naming of three axes but the one of the file.
    pub fn all() -> Vec<Self> {
        let orders = [[1, 2, 3], [1, 3, 2], [2, 1, 3], [2, 3, 1], [3, 1, 2], [3, 2, 1]];
        let signed = |order: [i8; 3], signs: u8| {
            Self(std::array::from_fn(|k| if signs & (1 << k) == 0 { order[k] } else { -order[k] }))
        };
        let every = orders.iter().flat_map(|&order| (0..8).map(move |signs| signed(order, signs)));
        every.filter(|axes| axes.0 != [1, 2, 3]).collect()
    }

    /// From three signed axes; `None` unless each axis occurs once.
    pub const fn new(axes: [i8; 3]) -> Option<Self> {
        let [x, y, z] = axes;
        match (x.unsigned_abs(), y.unsigned_abs(), z.unsigned_abs()) {
            (1, 2, 3) | (1, 3, 2) | (2, 1, 3) | (2, 3, 1) | (3, 1, 2) | (3, 2, 1) => Some(Self(axes)),
            _ => None,
        }
    }

    /// The three signed axes.
    pub fn axes(self) -> [i8; 3] {
        self.0
    }

    /// A vector of the file in the axes meant; left-handed axes also reverse rotations and moments.
    pub fn renamed(self, v: &Vector3) -> Vector3 {
        Vector3::from_fn(|k, _| f64::from(self.0[k].signum()) * v[usize::from(self.0[k].unsigned_abs()) - 1])
    }

    /// The axis meant by an axis of the file, both from zero, and its sign.
    pub(super) fn meant_by(self, axis: usize) -> (usize, f64) {
        let is_it = |k: &usize| usize::from(self.0[*k].unsigned_abs()) == axis + 1;
        let meant = (0..3).find(is_it).unwrap_or(axis);
        (meant, f64::from(self.0[meant].signum()))
    }

    /// The same of a pose: its rotation is that of the body, seen in other axes.
    pub fn pose(self, pose: &Pose) -> Pose {
        let columns = [Vector3::x(), Vector3::y(), Vector3::z()].map(|e| self.renamed(&e));
        let turn = Matrix3::from_columns(&columns);
        Pose::from_rotation(turn * pose.translation, &(turn * pose.rotation() * turn.transpose()))
    }

    /// 1 for right-handed axes, -1 for left-handed ones.
    pub fn handedness(self) -> f64 {
        let columns = [Vector3::x(), Vector3::y(), Vector3::z()].map(|e| self.renamed(&e));
        Matrix3::from_columns(&columns).determinant().signum()
    }

    /// True when one axis points the other way, or all three do, and none has another name.
    pub(super) fn is_a_sign(self) -> bool {
        let reversed = self.0.iter().filter(|axis| **axis < 0).count();
        self.0.map(i8::abs) == [1, 2, 3] && reversed != 2
    }

    /// True when z stays the vertical axis.
    pub fn keeps_vertical(self) -> bool {
        self.0[2].abs() == 3
    }
}

/// Order in which the three angles of a pose turn the platform, about fixed axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AngleOrder {
    /// x, then y, then z: the order of the file format, where the machine states another.
    Xyz,
    /// x, then z, then y.
    Xzy,
    /// y, then x, then z.
    Yxz,
    /// y, then z, then x.
    Yzx,
    /// z, then x, then y.
    Zxy,
    /// z, then y, then x: the same as x, y, z about axes that move with the platform.
    Zyx,
    /// The three numbers are a rotation vector.
    RotationVector,
    /// x, then y, then z, but from the platform to the fixed frame.
    Inverse,
}

// The likely ones first.
hexbench_core::worded! {
    /// One word, as `--read-as` takes it.
    AngleOrder::word,
    /// What it means, in a sentence.
    text {
        Xyz => "fixed-x-y-z", "the angles turn about the fixed axes x, y, z, one after the other";
        Zyx => "moving-x-y-z", "the angles turn about axes x, y, z that move with the platform, as the U, V, W of many controllers do";
        Xzy => "fixed-x-z-y", "the angles turn about the fixed axes x, z, y, one after the other";
        Yxz => "fixed-y-x-z", "the angles turn about the fixed axes y, x, z, one after the other";
        Yzx => "fixed-y-z-x", "the angles turn about the fixed axes y, z, x, one after the other";
        Zxy => "fixed-z-x-y", "the angles turn about the fixed axes z, x, y, one after the other";
        RotationVector => "rotation-vector", "the three angles are the components of a rotation vector";
        Inverse => "inverse", "the angles turn from the platform to the fixed frame";
    }
}

impl AngleOrder {
    /// The convention of files that says so; none of the inverse.
    pub fn convention(self) -> Option<AngleConvention> {
        match self {
            Self::Xyz => Some(AngleConvention::FixedXyz),
            Self::Xzy => Some(AngleConvention::FixedXzy),
            Self::Yxz => Some(AngleConvention::FixedYxz),
            Self::Yzx => Some(AngleConvention::FixedYzx),
            Self::Zxy => Some(AngleConvention::FixedZxy),
            Self::Zyx => Some(AngleConvention::FixedZyx),
            Self::RotationVector => Some(AngleConvention::RotationVector),
            Self::Inverse => None,
        }
    }

    /// Rotation matrix of three angles, rad.
    pub fn rotation(self, angles: &Vector3) -> Matrix3 {
        match self.convention() {
            Some(convention) => convention.rotation(angles),
            None => AngleConvention::default().rotation(angles).transpose(),
        }
    }

    /// A pose whose angles turn in this order.
    pub fn pose(self, stated: &Pose) -> Pose {
        Pose::from_rotation(stated.translation, &self.rotation(&stated.angles))
    }

    /// Rotation vector (fixed axes, rad) of a small change of the angles.
    pub fn turned_by(self, angles: &Vector3, change: &Vector3) -> Vector3 {
        small_rotation(&self.rotation(angles), &self.rotation(&(angles + change)))
    }
}

/// Rotation vector from one attitude to another close by, rad.
pub(super) fn small_rotation(from: &Matrix3, to: &Matrix3) -> Vector3 {
    let r = to * from.transpose();
    0.5 * Vector3::new(r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Rotation3;

    #[test]
    fn three_axes_have_forty_seven_other_names() {
        let all = SignedAxes::all();
        let distinct: std::collections::HashSet<_> = all.iter().collect();
        assert_eq!((all.len(), distinct.len()), (47, 47));
        assert_eq!(all.iter().filter(|a| a.handedness() > 0.0).count(), 23);
    }

    #[test]
    fn a_pose_in_other_axes_moves_points_as_vectors_are_renamed() {
        let pose = Pose::from_array([0.01, -0.02, 0.03, 0.2, -0.3, 0.4]);
        let point = Vector3::new(0.1, 0.2, -0.05);
        for axes in SignedAxes::all() {
            let there = axes.pose(&pose);
            let moved = there.translation + there.rotation() * axes.renamed(&point);
            let expected = axes.renamed(&(pose.translation + pose.rotation() * point));
            assert!((moved - expected).norm() < 1e-15, "{axes:?}");
        }
    }

    #[test]
    fn moving_axes_are_fixed_axes_in_the_other_order() {
        let angles = Vector3::new(0.3, -0.2, 0.5);
        let r = AngleOrder::Zyx.rotation(&angles);
        let x = Rotation3::from_axis_angle(&Vector3::x_axis(), 0.3);
        let y = Rotation3::from_axis_angle(&(x * Vector3::y_axis()), -0.2);
        let z = Rotation3::from_axis_angle(&(y * x * Vector3::z_axis()), 0.5);
        assert!(((z * y * x).matrix() - r).amax() < 1e-15);
    }

    #[test]
    fn small_changes_of_angles_are_rotation_vectors() {
        let angles = Vector3::new(0.3, -0.2, 0.5);
        let change = Vector3::new(1e-6, -2e-6, 3e-6);
        let same = crate::machine::kinematics::euler_rate_matrix(&Vector3::new(0.3, -0.2, 0.5)) * change;
        let pose = |a: &Vector3| Pose { translation: Vector3::zeros(), angles: *a }.rotation();
        let found = small_rotation(&pose(&angles), &pose(&(angles + change)));
        assert!((found - same).norm() < 1e-11, "{found} {same}");
    }
}
