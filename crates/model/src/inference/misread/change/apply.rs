//! A file read with one change.

use hexbench_core::{
    AngleConvention, Dataset, Hexapod, Measurand, Observation, Pose, Sensor, SensorInput, UNREAD, Vector3,
    Wrench,
};
use nalgebra::Rotation3;

use super::{Change, Group, ReferencePoint, Signed, Target};
use crate::inference::misread::turn::{SignedAxes, small_rotation};
use crate::machine::kinematics::euler_rate_matrix;

impl Change {
    /// Reads machine and measurements that way.
    pub fn apply(&self, hexapod: &mut Hexapod, data: &mut Dataset) {
        if let Self::Within(lines, multiple) = self {
            let mut other = data.clone();
            multiple.everywhere().apply(hexapod, &mut other);
            let inside = data.observations.iter_mut().zip(other.observations);
            inside.filter(|(row, _)| lines.contains(row.line)).for_each(|(row, other)| *row = other);
            return;
        }
        if let Self::Pose(of, mistake) = self {
            mistake.apply(*of, hexapod.angles, data);
            return;
        }
        self.apply_to_machine(hexapod);
        if let Self::Rows(order) = self {
            order.apply(data);
            return;
        }
        self.rescale(data, &hexapod.sensors);
        if self.rename_columns(data, &hexapod.sensors) {
            return;
        }
        if self.needs_rotation_vectors() {
            to_rotation_vectors(data);
        }
        self.restate_angles(hexapod.angles, data);
        for row in &mut data.observations {
            self.apply_to_row(row, data.measurand);
        }
        match self {
            Self::OtherRotations | Self::Angles(_) if data.measurand == Measurand::DeflectionEuler => {
                data.measurand = Measurand::DeflectionRotationVector;
            }
            Self::OtherRotations => data.measurand = Measurand::DeflectionEuler,
            Self::Preload(_) | Self::LoadIsChange => data.columns.reference = true,
            _ => {}
        }
    }

    /// Angles that mean something else are read from what the file says, not from what its machine says that they mean.
    fn restate_angles(&self, convention: AngleConvention, data: &mut Dataset) {
        if convention == AngleConvention::default() {
            return;
        }
        match self {
            Self::Angles(_) => *data = convention.as_stated(data).into_owned(),
            Self::PoseAngles(_) => data
                .observations
                .iter_mut()
                .for_each(|row| row.pose.angles = convention.from_fixed_xyz(&row.pose.angles)),
            _ => {}
        }
    }

    /// Numbers of a rotation that are to be read in other axes are a vector there.
    fn needs_rotation_vectors(&self) -> bool {
        matches!(
            self,
            Self::Renamed(Target::Readings, _)
                | Self::Turned(Target::Readings, _)
                | Self::Origin(ReferencePoint::ReadingsMobile, _)
        )
    }

    fn apply_to_machine(&self, hexapod: &mut Hexapod) {
        let Hexapod { base_joints: base, platform_joints: platform, .. } = hexapod;
        let mut all = |turn: &dyn Fn(&Vector3) -> Vector3, target: Target| {
            if matches!(target, Target::Joints | Target::BaseJoints) {
                for joint in base.iter_mut() {
                    *joint = turn(joint);
                }
            }
            if matches!(target, Target::Joints | Target::PlatformJoints) {
                for joint in platform.iter_mut() {
                    *joint = turn(joint);
                }
            }
        };
        match *self {
            Self::Renamed(target, axes) => all(&|v| axes.renamed(v), target),
            Self::Turned(target, by) => all(&|v| Rotation3::new(by) * v, target),
            Self::Scaled(group, factor) => match group {
                Group::BaseJoints => all(&|v| v * factor, Target::BaseJoints),
                Group::PlatformJoints => all(&|v| v * factor, Target::PlatformJoints),
                Group::Joints => all(&|v| v * factor, Target::Joints),
                Group::Noise => {
                    if let Some(metrology) = &mut hexapod.metrology {
                        metrology.sigma_translation *= factor;
                        metrology.sigma_rotation *= factor;
                    }
                }
                _ => {}
            },
            Self::LegOrder(order) => *platform = order.map(|k| platform[usize::from(k)]),
            Self::JointsExchanged => std::mem::swap(base, platform),
            Self::Origin(ReferencePoint::PlatformJoints, from) => {
                for joint in platform.iter_mut() {
                    *joint -= from;
                }
            }
            Self::Joint(coordinate, off) => *coordinate.of_mut(hexapod) += off,
            Self::SensorMoved(name, by) => {
                if let Some(sensor) = named(hexapod, name) {
                    sensor.put_off(SensorInput::Point, by.as_slice());
                }
            }
            Self::SensorTurned(name, by) => {
                if let Some(sensor) = named(hexapod, name) {
                    sensor.put_off(SensorInput::Direction, by.as_slice());
                }
            }
            Self::SensorsExchanged(one, other) => {
                let at = |name: &str| hexapod.sensors.iter().position(|s| s.name == name);
                if let (Some(one), Some(other)) = (at(one), at(other)) {
                    let kind = hexapod.sensors[one].kind.clone();
                    hexapod.sensors[one].kind = std::mem::replace(&mut hexapod.sensors[other].kind, kind);
                }
            }
            _ => {}
        }
    }

    fn apply_to_row(&self, row: &mut Observation, measurand: Measurand) {
        let rotation = row.pose.rotation();
        match *self {
            Self::Reversed(signed) => reverse(signed, row),
            Self::StatesExchanged => std::mem::swap(&mut row.wrench, &mut row.reference),
            Self::Scaled(group, factor) => scale(group, factor, row),
            Self::Renamed(target, axes) => rename(target, axes, row),
            Self::Turned(target, by) => turn_axes(target, &Rotation3::new(by), row),
            Self::Origin(origin, at) => refer_to(origin, &at, row),
            Self::WrenchMobile => for_both(row, |w| {
                w.force = rotation * w.force;
                w.moment = rotation * w.moment;
            }),
            Self::MomentsMobile => for_both(row, |w| w.moment = rotation * w.moment),
            Self::DeflectionMobile => from_mobile_axes(row, measurand),
            Self::Angles(order) => {
                let (shift, turn) = halves(&row.measured);
                match measurand {
                    Measurand::DeflectionEuler => {
                        row.measured = joined(&shift, &order.turned_by(&row.pose.angles, &turn));
                    }
                    Measurand::AbsolutePose => {
                        row.measured = Pose::from_rotation(shift, &order.rotation(&turn)).to_array();
                    }
                    Measurand::DeflectionRotationVector => {}
                }
                row.pose = order.pose(&row.pose);
            }
            Self::PoseAngles(order) => row.pose = order.pose(&row.pose),
            Self::Preload(load) => {
                row.reference.force += load.force;
                row.reference.moment += load.moment;
            }
            Self::LoadIsChange => add_reference(row, 1.0),
            Self::LoadHoldsReference => add_reference(row, -1.0),
            _ => {}
        }
    }
}

/// Vectors in axes that are turned.
fn turn_axes(target: Target, by: &Rotation3<f64>, row: &mut Observation) {
    match target {
        Target::Readings | Target::ReadingColumns => {
            let (shift, turn) = halves(&row.measured);
            row.measured = joined(&(by * shift), &(by * turn));
        }
        Target::Wrench | Target::WrenchColumns => for_both(row, |w| {
            w.force = by * w.force;
            w.moment = by * w.moment;
        }),
        Target::Poses => {
            let r = by.matrix() * row.pose.rotation() * by.matrix().transpose();
            row.pose = Pose::from_rotation(by * row.pose.translation, &r);
        }
        Target::TranslationColumns
        | Target::RotationColumns
        | Target::ForceColumns
        | Target::MomentColumns
        | Target::PosePositionColumns
        | Target::PoseAngleColumns
        | Target::Points
        | Target::Joints
        | Target::BaseJoints
        | Target::PlatformJoints => {}
    }
}

/// Numbers about another point.
fn refer_to(origin: ReferencePoint, at: &Vector3, row: &mut Observation) {
    let on_platform = row.pose.rotation() * at;
    match origin {
        ReferencePoint::MomentsFixed => {
            let arm = at - row.pose.translation;
            for_both(row, |w| w.moment += arm.cross(&w.force));
        }
        ReferencePoint::MomentsMobile => for_both(row, |w| w.moment += on_platform.cross(&w.force)),
        ReferencePoint::ReadingsMobile => {
            let (shift, turn) = halves(&row.measured);
            row.measured = joined(&(shift - turn.cross(&on_platform)), &turn);
        }
        ReferencePoint::Poses => row.pose.translation -= at,
        ReferencePoint::PlatformJoints => {}
    }
}

/// A deflection that was written in the axes of the platform.
fn from_mobile_axes(row: &mut Observation, measurand: Measurand) {
    let (shift, turn) = halves(&row.measured);
    let rotation = row.pose.rotation();
    let mut turn = rotation * turn;
    if measurand == Measurand::DeflectionEuler {
        // The numbers are a small rotation in mobile axes; the file wants changes of angles.
        let rates = euler_rate_matrix(&row.pose.angles).try_inverse();
        turn = rates.map_or(turn, |m| m * turn);
    }
    row.measured = joined(&(rotation * shift), &turn);
}

/// Rotations of deflections as rotation vectors, where they are differences of Euler angles.
fn to_rotation_vectors(data: &mut Dataset) {
    if data.measurand != Measurand::DeflectionEuler {
        return;
    }
    data.measurand = Measurand::DeflectionRotationVector;
    for row in &mut data.observations {
        let (shift, turn) = halves(&row.measured);
        let there = Pose { translation: row.pose.translation, angles: row.pose.angles + turn };
        row.measured = joined(&shift, &small_rotation(&row.pose.rotation(), &there.rotation()));
    }
}

fn named<'a>(hexapod: &'a mut Hexapod, name: &str) -> Option<&'a mut Sensor> {
    hexapod.sensors.iter_mut().find(|s| s.name == name)
}

/// The load of the reference state so many times on top of that of the loaded one.
fn add_reference(row: &mut Observation, times: f64) {
    row.wrench.force += times * row.reference.force;
    row.wrench.moment += times * row.reference.moment;
}

/// Numbers in other axes.
fn rename(target: Target, axes: SignedAxes, row: &mut Observation) {
    let hand = target.hand(axes);
    match target {
        Target::Readings | Target::ReadingColumns | Target::TranslationColumns | Target::RotationColumns => {
            let (shift, turn) = halves(&row.measured);
            let measured = joined(&axes.renamed(&shift), &(axes.renamed(&turn) * hand));
            let sigma = row.sigma.map(|sigma| renamed_sigma(axes, &sigma));
            for k in target.pose_numbers() {
                row.measured[k] = measured[k];
                if let Some((old, new)) = row.sigma.as_mut().zip(sigma) {
                    old[k] = new[k];
                }
            }
        }
        Target::Wrench | Target::WrenchColumns => for_both(row, |w| {
            w.force = axes.renamed(&w.force);
            w.moment = axes.renamed(&w.moment) * hand;
        }),
        Target::ForceColumns => for_both(row, |w| w.force = axes.renamed(&w.force)),
        Target::MomentColumns => for_both(row, |w| w.moment = axes.renamed(&w.moment)),
        Target::Poses => row.pose = axes.pose(&row.pose),
        Target::PosePositionColumns => row.pose.translation = axes.renamed(&row.pose.translation),
        Target::PoseAngleColumns => row.pose.angles = axes.renamed(&row.pose.angles),
        Target::Points | Target::Joints | Target::BaseJoints | Target::PlatformJoints => {}
    }
}

/// Loads with the other sign; measured numbers are multiplied by what they read.
fn reverse(signed: Signed, row: &mut Observation) {
    let loads = |row: &mut Observation, range: std::ops::Range<usize>| {
        for_both(row, |w| {
            let mut all = w.to_array();
            all[range.clone()].iter_mut().for_each(|x| *x = -*x);
            *w = Wrench::from_array(all);
        });
    };
    match signed {
        Signed::Wrench => loads(row, 0..6),
        Signed::Forces => loads(row, 0..3),
        Signed::Moments => loads(row, 3..6),
        Signed::Load(k) => loads(row, usize::from(k)..usize::from(k) + 1),
        Signed::Reference => row.reference = Wrench::from_array(row.reference.to_array().map(|x| -x)),
        Signed::Readings | Signed::Translations | Signed::Rotations | Signed::Reading(_) => {}
    }
}

/// Loads, poses and noise times a factor.
fn scale(group: Group, factor: f64, row: &mut Observation) {
    if matches!(group, Group::Forces | Group::Loads) {
        for_both(row, |w| w.force *= factor);
    }
    if matches!(group, Group::Moments | Group::Loads) {
        for_both(row, |w| w.moment *= factor);
    }
    match group {
        Group::PosePositions => row.pose.translation *= factor,
        Group::PoseAngles => row.pose.angles *= factor,
        Group::Load(k) => for_both(row, |w| {
            let mut all = w.to_array();
            all[usize::from(k)] *= factor;
            *w = Wrench::from_array(all);
        }),
        Group::Noise => {
            let scaled = |x: f64| if x < UNREAD { x * factor } else { x };
            row.sigma = row.sigma.map(|s| s.map(scaled));
        }
        _ => {}
    }
}

fn for_both(row: &mut Observation, mut change: impl FnMut(&mut Wrench)) {
    change(&mut row.wrench);
    change(&mut row.reference);
}

/// Translation and rotation of a reading.
pub(crate) fn halves(measured: &[f64; 6]) -> (Vector3, Vector3) {
    (Vector3::from_column_slice(&measured[..3]), Vector3::from_column_slice(&measured[3..]))
}

pub(crate) fn joined(shift: &Vector3, turn: &Vector3) -> [f64; 6] {
    [shift.x, shift.y, shift.z, turn.x, turn.y, turn.z]
}

fn renamed_sigma(axes: SignedAxes, sigma: &[f64; 6]) -> [f64; 6] {
    let (shift, turn) = halves(sigma);
    joined(&axes.renamed(&shift).abs(), &axes.renamed(&turn).abs())
}
