//! Vectors and places in the types of either library.

use hexbench_core::{Matrix3, Vector3};
use hexbench_truth::equilibrium::Body;
use rapier3d_f64::math::{Matrix, Pose, Rotation, Vector};

pub(crate) fn to_engine(v: &Vector3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

pub(crate) fn from_engine(v: Vector) -> Vector3 {
    Vector3::new(v.x, v.y, v.z)
}

/// Rotation of orthonormal axes.
pub(crate) fn rotation(axes: &Matrix3) -> Rotation {
    let column = |i: usize| Vector::new(axes[(0, i)], axes[(1, i)], axes[(2, i)]);
    Rotation::from_mat3(&Matrix::from_cols(column(0), column(1), column(2))).normalize()
}

pub(crate) fn pose(body: &Body) -> Pose {
    Pose::from_parts(to_engine(&body.origin), rotation(&body.axes))
}

/// Place of a body of the engine.
pub(crate) fn body(pose: &Pose) -> Body {
    let turned = |v: Vector| from_engine(pose.rotation * v);
    Body {
        origin: from_engine(pose.translation),
        axes: Matrix3::from_columns(&[turned(Vector::X), turned(Vector::Y), turned(Vector::Z)]),
    }
}

/// Right-handed orthonormal axes whose first is a unit vector.
pub(crate) fn axes_along(x: &Vector3) -> Matrix3 {
    let helper = if x.z.abs() < 0.8 { Vector3::z() } else { Vector3::x() };
    let y = helper.cross(x).normalize();
    Matrix3::from_columns(&[*x, y, x.cross(&y)])
}
