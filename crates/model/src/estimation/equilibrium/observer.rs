//! What the numbers of a reading say of a motion of the platform.

use hexbench_core::{
    Channel, Hexapod, Matrix3, Matrix6, Measurand, Pose, PoseFunction, SensorKind, Vector3, Vector6,
};

use crate::estimation::campaign::Campaign;
use crate::estimation::frames::ReadingAxes;
use crate::machine::geometry::Machine;
use crate::machine::kinematics::Legs;
use crate::machine::placement::Placement;

/// Step of the differences of a function of the pose, m and rad: what they leave out and what rounding adds are 1e-9 of lengths of a meter.
const POSE_STEP: f64 = 3e-5;
/// The same of its second differences: 1e-8 of them.
const CURVATURE_STEP: f64 = 1e-4;

impl Campaign {
    /// Measured coordinates from the geometric twist: Euler differences for Euler readings, and the lever arm of
    /// the target in absolute mode.
    pub(super) fn observer(&self, machine: &Machine, place: &Placement, measured: &[f64; 6]) -> Matrix6 {
        match self.measurand {
            Measurand::DeflectionRotationVector | Measurand::DeflectionEuler => {
                return pose_numbers(self.measurand, place);
            }
            Measurand::AbsolutePose => {}
        }
        let lever = place.rotation * machine.target_frame.translation.vector;
        let axes = *machine.metrology_frame.rotation.to_rotation_matrix().matrix();
        observer_matrix(&axes, &lever, &self.axes.rates(measured))
    }
}

/// The six numbers of a deflection per unit of the geometric twist at the mobile origin.
fn pose_numbers(measurand: Measurand, place: &Placement) -> Matrix6 {
    if measurand != Measurand::DeflectionEuler {
        return Matrix6::identity();
    }
    observer_matrix(
        &Matrix3::identity(),
        &Vector3::zeros(),
        &ReadingAxes::default().rates(&place.pose().to_array()),
    )
}

/// What the numbers of a deflection read per unit of the geometric twist at the mobile origin, a row each.
pub(crate) fn observer_of(
    hexapod: &Hexapod,
    measurand: Measurand,
    channels: &[Channel; 6],
    pose: &Pose,
    legs: &Legs,
) -> Matrix6 {
    let place = pose.into();
    looks(hexapod, channels, &place, legs, &pose_numbers(measurand, &place))
}

/// The same, given the rows of all pose numbers.
pub(super) fn looks(
    hexapod: &Hexapod,
    channels: &[Channel; 6],
    place: &Placement,
    legs: &Legs,
    pose_numbers: &Matrix6,
) -> Matrix6 {
    let rotation = place.rotation;
    let along = |u: &Vector3, arm: &Vector3| {
        let moment = arm.cross(u);
        Vector6::new(u.x, u.y, u.z, moment.x, moment.y, moment.z)
    };
    let row = |channel: Channel| match channel {
        Channel::Nothing => Vector6::zeros(),
        Channel::Pose(k) => pose_numbers.row(k).transpose(),
        Channel::Sensor { sensor, number } => {
            let Some(sensor) = hexapod.sensors.get(sensor) else { return Vector6::zeros() };
            sensor.gain
                * match &sensor.kind {
                    SensorKind::Distance { point, direction, .. } => along(direction, &(rotation * point)),
                    SensorKind::Point { point, .. } => along(&Vector3::ith(number, 1.0), &(rotation * point)),
                    SensorKind::Inclination { axis, .. } => {
                        Vector6::new(0.0, 0.0, 0.0, axis.x, axis.y, axis.z)
                    }
                    SensorKind::LegLength { leg, .. } => along(&legs.directions[*leg], &legs.arms[*leg]),
                    SensorKind::Function { of, .. } => pose_rates(of, place),
                }
        }
    };
    Matrix6::from_rows(&channels.map(|channel| row(channel).transpose()))
}

/// What a function of the pose changes per unit of the geometric twist at the mobile origin, fixed axes: central differences.
fn pose_rates(of: &PoseFunction, place: &Placement) -> Vector6 {
    let steps = [POSE_STEP, -POSE_STEP];
    let beside = |n: usize| place.moved(&Vector6::ith(n / 2, 1.0), steps[n % 2]).pose();
    let values = of.at::<12>(&std::array::from_fn(beside));
    Vector6::from_fn(|k, _| (values[2 * k] - values[2 * k + 1]) / (2.0 * POSE_STEP))
}

/// By how much a function of the pose reads a motion otherwise when the pose has moved by a twist before, to first order in both.
pub(crate) fn pose_curvature(of: &PoseFunction, place: &Placement, twist: &Vector6, motion: &Vector6) -> f64 {
    let sizes = [twist, motion].map(Vector6::norm);
    if sizes.contains(&0.0) {
        return 0.0;
    }
    let steps = [CURVATURE_STEP, -CURVATURE_STEP];
    let beside = |n: usize| {
        let turned = place.moved(twist, steps[n % 2] / sizes[0]);
        turned.moved(motion, steps[n / 2] / sizes[1]).pose()
    };
    let [both, after, before, none] = of.at::<4>(&std::array::from_fn(beside));
    (both - after - before + none) / (4.0 * CURVATURE_STEP.powi(2)) * sizes[0] * sizes[1]
}

/// `diag(I, rates) diag(axes, axes) [I, -[lever]x; 0, I]`.
fn observer_matrix(axes: &Matrix3, lever: &Vector3, rates: &Matrix3) -> Matrix6 {
    let mut h = Matrix6::zeros();
    h.fixed_view_mut::<3, 3>(0, 0).copy_from(axes);
    h.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-axes * lever.cross_matrix()));
    h.fixed_view_mut::<3, 3>(3, 3).copy_from(&(rates * axes));
    h
}
