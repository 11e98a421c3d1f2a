//! Rotations of the two states behind a reading.

use hexbench_core::{Matrix3, Observation, Pose, Vector3};

/// Rotation of the platform in the reference state, taken as commanded, and in the loaded state.
pub(super) fn states(row: &Observation) -> [Matrix3; 2] {
    let turn = Vector3::from_row_slice(&row.measured[3..]);
    let loaded = Pose { angles: row.pose.angles + turn, ..row.pose };
    [row.pose.rotation(), loaded.rotation()]
}

/// Extrinsic X-Y-Z angles of a rotation.
pub(super) fn angles(r: &Matrix3) -> Vector3 {
    Pose::from_rotation(Vector3::zeros(), r).angles
}

/// Translations of a reading.
pub(super) fn translation(row: &Observation) -> Vector3 {
    Vector3::from_row_slice(&row.measured[..3])
}

/// Writes three numbers of a reading, `from` the translations (0) or the rotations (3).
pub(super) fn write(row: &mut Observation, from: usize, values: &Vector3) {
    row.measured[from..from + 3].copy_from_slice(values.as_slice());
}
