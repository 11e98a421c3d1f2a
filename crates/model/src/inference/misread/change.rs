//! One thing that a file may mean otherwise than it says, and the file read that way.

use hexbench_core::{
    AngleConvention, Dataset, Hexapod, LineRange, Measurand, Pose, SensorKind, UNREAD, Vector3, Wrench,
};
use nalgebra::Rotation3;

use super::pose::{PoseMistake, PoseOf};
use super::row_order::RowOrder;
use super::turn::{AngleOrder, SignedAxes, small_rotation};
use crate::inference::examination::FindingKind;
use crate::machine::kinematics::euler_rate_matrix;

/// Another reading of a file. Lengths in m, angles in rad, loads in N and N m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Change {
    /// Numbers with the other sign.
    Reversed(Signed),
    /// Loaded and reference state exchanged.
    StatesExchanged,
    /// A group of numbers times a factor.
    Scaled(Group, f64),
    /// Axes named otherwise.
    Renamed(Target, SignedAxes),
    /// Axes turned by a rotation vector.
    Turned(Target, Vector3),
    /// Platform joint of each leg, from zero.
    LegOrder([u8; 6]),
    /// Base and platform joints exchanged.
    JointsExchanged,
    /// Another point of origin, away from the one stated.
    Origin(ReferencePoint, Vector3),
    /// One coordinate of a joint is off by so much.
    Joint(JointCoordinate, f64),
    /// The wrench is written in the axes of the platform.
    WrenchMobile,
    /// Its moments are, its forces are not.
    MomentsMobile,
    /// The deflections are written in the axes of the platform.
    DeflectionMobile,
    /// Angles of the poses, and of the deflections too, turn in another order.
    Angles(AngleOrder),
    /// Angles of the poses alone turn in another order.
    PoseAngles(AngleOrder),
    /// Rotations of the deflections are a rotation vector, or differences of Euler angles, whichever the file does not say.
    OtherRotations,
    /// A constant load in the reference state that the file does not have; with the other sign, one in the loaded state.
    Preload(Wrench),
    /// The loaded columns hold the change of load already.
    LoadIsChange,
    /// The loaded columns hold the load of the reference state twice.
    LoadHoldsReference,
    /// Rows belong together in another order.
    Rows(RowOrder),
    /// Sensors read with the other sign.
    SensorReversed(Sensors),
    /// Their numbers times a factor.
    SensorScaled(Sensors, f64),
    /// A sensor looks at a point that is elsewhere by so much, mobile frame.
    SensorMoved(&'static str, Vector3),
    /// It looks in a direction, or about an axis, that is turned by a rotation vector.
    SensorTurned(&'static str, Vector3),
    /// The numbers of two sensors stand in each other's columns.
    SensorsExchanged(&'static str, &'static str),
    /// A pose of every row means something else.
    Pose(PoseOf, PoseMistake),
    /// A sign, a unit or an axis of some lines of the file only.
    Within(LineRange, Multiple),
}

/// What may begin or end within a file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Multiple {
    /// Numbers with the other sign.
    Reversed(Signed),
    /// A group of numbers times a factor.
    Scaled(Group, f64),
    /// Sensors that read with the other sign.
    SensorReversed(Sensors),
    /// Their numbers times a factor.
    SensorScaled(Sensors, f64),
    /// Columns named otherwise.
    Renamed(Target, SignedAxes),
    /// A pose that means something else.
    Pose(PoseOf, PoseMistake),
}

impl Multiple {
    /// The same in all lines.
    pub fn everywhere(self) -> Change {
        match self {
            Self::Reversed(signed) => Change::Reversed(signed),
            Self::Scaled(group, factor) => Change::Scaled(group, factor),
            Self::SensorReversed(which) => Change::SensorReversed(which),
            Self::SensorScaled(which, factor) => Change::SensorScaled(which, factor),
            Self::Renamed(target, axes) => Change::Renamed(target, axes),
            Self::Pose(of, mistake) => Change::Pose(of, mistake),
        }
    }

    /// What a change does to every row by itself; none of any other change.
    pub fn of(change: Change) -> Option<Self> {
        match change {
            Change::Reversed(signed) => Some(Self::Reversed(signed)),
            Change::Scaled(group, factor) => Some(Self::Scaled(group, factor)),
            Change::SensorReversed(which) => Some(Self::SensorReversed(which)),
            Change::SensorScaled(which, factor) => Some(Self::SensorScaled(which, factor)),
            Change::Renamed(target, axes) if target.is_of_rows() => Some(Self::Renamed(target, axes)),
            Change::Pose(of, mistake) if mistake.is_of_rows() => Some(Self::Pose(of, mistake)),
            _ => None,
        }
    }
}

/// Sensors that share a sign or a unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sensors {
    /// The one of this name, or one number of it by the name of its column.
    One(&'static str),
    /// All of a kind, by its word in files.
    All(&'static str),
}

/// Numbers that may have the other sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Signed {
    /// All six numbers of a deflection.
    Readings,
    /// Its translations.
    Translations,
    /// Its rotations.
    Rotations,
    /// One of the six, from zero.
    Reading(u8),
    /// All six components of the loads, in both states.
    Wrench,
    /// Their forces.
    Forces,
    /// Their moments.
    Moments,
    /// One of the six, from zero.
    Load(u8),
    /// All six components of the loads in the reference state.
    Reference,
}

/// Numbers that share a unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Group {
    /// Translations of the readings.
    Translations,
    /// Rotations of the readings.
    Rotations,
    /// Both.
    Readings,
    /// Forces of both states.
    Forces,
    /// Moments of both states.
    Moments,
    /// Both.
    Loads,
    /// Positions of the poses.
    PosePositions,
    /// Angles of the poses.
    PoseAngles,
    /// Base joints.
    BaseJoints,
    /// Platform joints.
    PlatformJoints,
    /// Both.
    Joints,
    /// One of the six numbers of the readings, from zero.
    Reading(u8),
    /// One of the six components of the loads, from zero.
    Load(u8),
    /// The stated noise.
    Noise,
}

/// What may be written in other axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// Deflections: translations and rotations as vectors.
    Readings,
    /// The columns of the deflections as they stand, whatever their axes were.
    ReadingColumns,
    /// The three numbers of every sensor that reads a point.
    Points,
    /// Loads of both states: forces and moments as vectors.
    Wrench,
    /// The columns of the loads as they stand, whatever their axes were.
    WrenchColumns,
    /// The columns of the forces as they stand, those of the moments as they are.
    ForceColumns,
    /// The columns of the moments as they stand, those of the forces as they are.
    MomentColumns,
    /// Commanded poses.
    Poses,
    /// The columns of the angles of the poses as they stand.
    PoseAngleColumns,
    /// All joints.
    Joints,
    /// Base joints.
    BaseJoints,
    /// Platform joints.
    PlatformJoints,
}

impl Target {
    /// True for what each row has by itself, whatever its rotations mean.
    fn is_of_rows(self) -> bool {
        matches!(
            self,
            Self::ReadingColumns
                | Self::Wrench
                | Self::WrenchColumns
                | Self::ForceColumns
                | Self::MomentColumns
        )
    }
}

/// What may refer to another point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReferencePoint {
    /// Moments about a point of the fixed frame.
    MomentsFixed,
    /// Moments about a point of the platform, mobile frame.
    MomentsMobile,
    /// Deflections of a point of the platform, mobile frame.
    ReadingsMobile,
    /// Poses that start elsewhere: positions minus this.
    Poses,
    /// Platform joints from another origin: coordinates minus this.
    PlatformJoints,
}

/// A coordinate of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct JointCoordinate {
    /// True at the platform.
    pub platform: bool,
    /// Leg, from zero.
    pub leg: u8,
    /// x, y, z from zero.
    pub axis: u8,
}

impl JointCoordinate {
    /// All 36 of them.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..36u8).map(|k| Self { platform: k >= 18, leg: k % 18 / 3, axis: k % 3 })
    }

    /// Its value, m.
    pub fn of(self, hexapod: &Hexapod) -> f64 {
        let joints = if self.platform { &hexapod.platform_joints } else { &hexapod.base_joints };
        joints[usize::from(self.leg)][usize::from(self.axis)]
    }

    fn of_mut(self, hexapod: &mut Hexapod) -> &mut f64 {
        let joints = if self.platform { &mut hexapod.platform_joints } else { &mut hexapod.base_joints };
        &mut joints[usize::from(self.leg)][usize::from(self.axis)]
    }
}

impl Change {
    /// Kind of the mistake.
    pub fn kind(&self) -> FindingKind {
        match self {
            Self::Reversed(Signed::Readings | Signed::Translations | Signed::Reading(0..=2)) => {
                FindingKind::DeflectionSign
            }
            Self::Reversed(Signed::Rotations | Signed::Reading(_)) => FindingKind::RotationSign,
            Self::Reversed(Signed::Wrench | Signed::Forces | Signed::Load(0..=2) | Signed::Reference) => {
                FindingKind::WrenchSign
            }
            Self::Reversed(Signed::Moments | Signed::Load(_)) => FindingKind::MomentSign,
            Self::StatesExchanged => FindingKind::StatesExchanged,
            Self::Scaled(..) => FindingKind::Unit,
            Self::Renamed(..) | Self::Turned(..) | Self::SensorTurned(..) => FindingKind::Axes,
            Self::LegOrder(_) => FindingKind::LegOrder,
            Self::JointsExchanged => FindingKind::JointsExchanged,
            Self::Origin(..) => FindingKind::Origin,
            Self::Joint(..) => FindingKind::Geometry,
            Self::WrenchMobile | Self::MomentsMobile => FindingKind::WrenchFrame,
            Self::DeflectionMobile => FindingKind::DeflectionFrame,
            Self::Angles(_) | Self::PoseAngles(_) => FindingKind::AngleConvention,
            Self::OtherRotations => FindingKind::RotationConvention,
            Self::Preload(_) | Self::LoadIsChange | Self::LoadHoldsReference => FindingKind::ReferenceMissing,
            Self::Rows(_) => FindingKind::RowOrder,
            Self::SensorReversed(_) => FindingKind::SensorSign,
            Self::SensorScaled(..) => FindingKind::SensorFactor,
            Self::SensorMoved(..) => FindingKind::SensorPlace,
            Self::SensorsExchanged(..) => FindingKind::SensorsExchanged,
            Self::Pose(PoseOf::Command, _) => FindingKind::CommandedPose,
            Self::Pose(PoseOf::Instrument, _) => FindingKind::MeasuredPose,
            Self::Within(_, multiple) => multiple.everywhere().kind(),
        }
    }

    /// True for mistakes of one kind, which are not made side by side: two sensors may be wrong, one of them in one way.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        match (self.sensors(), other.sensors()) {
            (Some(one), Some(other)) => one == other,
            _ => self.kind() == other.kind(),
        }
    }

    /// The sensors that it alone concerns.
    fn sensors(&self) -> Option<Sensors> {
        match *self {
            Self::SensorReversed(which) | Self::SensorScaled(which, _) => Some(which),
            Self::SensorMoved(name, _) | Self::SensorTurned(name, _) => Some(Sensors::One(name)),
            _ => None,
        }
    }

    /// True when legs stand as they did: neither joints nor poses are concerned.
    pub(crate) fn keeps_legs(&self) -> bool {
        match self {
            Self::Reversed(_)
            | Self::StatesExchanged
            | Self::WrenchMobile
            | Self::MomentsMobile
            | Self::DeflectionMobile
            | Self::OtherRotations
            | Self::Preload(_)
            | Self::LoadIsChange
            | Self::LoadHoldsReference
            | Self::SensorReversed(_)
            | Self::SensorScaled(..)
            | Self::SensorMoved(..)
            | Self::SensorTurned(..)
            | Self::SensorsExchanged(..)
            | Self::Pose(PoseOf::Instrument, _) => true,
            Self::Scaled(group, _) => !matches!(
                group,
                Group::PosePositions
                    | Group::PoseAngles
                    | Group::BaseJoints
                    | Group::PlatformJoints
                    | Group::Joints
            ),
            Self::Renamed(target, _) | Self::Turned(target, _) => {
                matches!(
                    target,
                    Target::Readings
                        | Target::ReadingColumns
                        | Target::Points
                        | Target::Wrench
                        | Target::WrenchColumns
                        | Target::ForceColumns
                        | Target::MomentColumns
                )
            }
            Self::Origin(origin, _) => {
                !matches!(origin, ReferencePoint::Poses | ReferencePoint::PlatformJoints)
            }
            Self::LegOrder(_)
            | Self::JointsExchanged
            | Self::Joint(..)
            | Self::Angles(_)
            | Self::PoseAngles(_)
            | Self::Pose(PoseOf::Command, _)
            | Self::Rows(_) => false,
            Self::Within(_, multiple) => multiple.everywhere().keeps_legs(),
        }
    }

    /// True when it changes what the readings are beside their stated noise.
    pub(crate) fn is_of_the_scale(&self) -> bool {
        matches!(
            self,
            Self::Scaled(
                Group::Translations | Group::Rotations | Group::Readings | Group::Reading(_) | Group::Noise,
                _
            ) | Self::SensorScaled(..)
        )
    }

    /// True when it changes all readings alike, or what is stated of their noise.
    pub(crate) fn is_of_all_readings(&self) -> bool {
        matches!(self, Self::Scaled(Group::Readings | Group::Noise, _))
    }

    /// True when it leaves readings and commanded poses as they are: all that differences between loads at a pose tell.
    pub(super) fn is_of_loads_or_legs(&self) -> bool {
        match self {
            Self::Reversed(signed) => {
                matches!(signed, Signed::Wrench | Signed::Forces | Signed::Moments | Signed::Load(_))
            }
            Self::Scaled(group, _) => matches!(
                group,
                Group::Forces
                    | Group::Moments
                    | Group::Loads
                    | Group::Load(_)
                    | Group::BaseJoints
                    | Group::PlatformJoints
                    | Group::Joints
            ),
            Self::Renamed(target, _) | Self::Turned(target, _) => matches!(
                target,
                Target::Wrench
                    | Target::WrenchColumns
                    | Target::ForceColumns
                    | Target::MomentColumns
                    | Target::Joints
                    | Target::BaseJoints
                    | Target::PlatformJoints
            ),
            Self::Origin(origin, _) => {
                !matches!(origin, ReferencePoint::ReadingsMobile | ReferencePoint::Poses)
            }
            Self::Rows(order) => order.is_of_loads(),
            Self::LegOrder(_)
            | Self::JointsExchanged
            | Self::Joint(..)
            | Self::WrenchMobile
            | Self::MomentsMobile => true,
            Self::Within(_, multiple) => multiple.everywhere().is_of_loads_or_legs(),
            _ => false,
        }
    }

    /// Numbers of it that are fitted.
    pub fn sizes(&self) -> usize {
        match self {
            Self::Turned(..) | Self::Origin(..) | Self::SensorMoved(..) => 3,
            Self::SensorTurned(..) => 2,
            Self::Preload(load) => load.to_array().iter().filter(|x| **x != 0.0).count(),
            Self::Joint(..) => 1,
            _ => 0,
        }
    }

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
        self.multiply(data, &hexapod.sensors);
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
                if let Some(SensorKind::Distance { point, .. } | SensorKind::Point { point, .. }) =
                    kind_of(hexapod, name)
                {
                    *point += by;
                }
            }
            Self::SensorTurned(name, by) => {
                if let Some(
                    SensorKind::Distance { direction: along, .. }
                    | SensorKind::Inclination { axis: along, .. },
                ) = kind_of(hexapod, name)
                {
                    *along = Rotation3::new(by) * *along;
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

    fn apply_to_row(&self, row: &mut hexbench_core::Observation, measurand: Measurand) {
        let (mut shift, mut turn) = halves(&row.measured);
        let rotation = row.pose.rotation();
        match *self {
            Self::Reversed(signed) => reverse(signed, row),
            Self::StatesExchanged => std::mem::swap(&mut row.wrench, &mut row.reference),
            Self::Scaled(group, factor) => scale(group, factor, row),
            Self::Renamed(target, axes) => match target {
                Target::Readings | Target::ReadingColumns => {
                    let hand = if target == Target::Readings { axes.handedness() } else { 1.0 };
                    row.measured = joined(&axes.renamed(&shift), &(axes.renamed(&turn) * hand));
                    row.sigma = row.sigma.map(|s| renamed_sigma(axes, &s));
                }
                Target::Wrench | Target::WrenchColumns => {
                    let hand = if target == Target::Wrench { axes.handedness() } else { 1.0 };
                    for_both(row, |w| {
                        w.force = axes.renamed(&w.force);
                        w.moment = axes.renamed(&w.moment) * hand;
                    });
                }
                Target::ForceColumns => for_both(row, |w| w.force = axes.renamed(&w.force)),
                Target::MomentColumns => for_both(row, |w| w.moment = axes.renamed(&w.moment)),
                Target::Poses => row.pose = axes.pose(&row.pose),
                Target::PoseAngleColumns => row.pose.angles = axes.renamed(&row.pose.angles),
                Target::Points | Target::Joints | Target::BaseJoints | Target::PlatformJoints => {}
            },
            Self::Turned(target, by) => {
                let by = Rotation3::new(by);
                match target {
                    Target::Readings | Target::ReadingColumns => {
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
                    Target::ForceColumns
                    | Target::MomentColumns
                    | Target::PoseAngleColumns
                    | Target::Points
                    | Target::Joints
                    | Target::BaseJoints
                    | Target::PlatformJoints => {}
                }
            }
            Self::Origin(origin, at) => match origin {
                ReferencePoint::MomentsFixed => {
                    let arm = at - row.pose.translation;
                    for_both(row, |w| w.moment += arm.cross(&w.force));
                }
                ReferencePoint::MomentsMobile => {
                    let arm = rotation * at;
                    for_both(row, |w| w.moment += arm.cross(&w.force));
                }
                ReferencePoint::ReadingsMobile => {
                    shift -= turn.cross(&(rotation * at));
                    row.measured = joined(&shift, &turn);
                }
                ReferencePoint::Poses => row.pose.translation -= at,
                ReferencePoint::PlatformJoints => {}
            },
            Self::WrenchMobile => for_both(row, |w| {
                w.force = rotation * w.force;
                w.moment = rotation * w.moment;
            }),
            Self::MomentsMobile => for_both(row, |w| w.moment = rotation * w.moment),
            Self::DeflectionMobile => {
                turn = rotation * turn;
                if measurand == Measurand::DeflectionEuler {
                    // The numbers are a small rotation in mobile axes; the file wants changes of angles.
                    let rates = euler_rate_matrix(&row.pose.angles).try_inverse();
                    turn = rates.map_or(turn, |m| m * turn);
                }
                row.measured = joined(&(rotation * shift), &turn);
            }
            Self::Angles(order) => {
                if measurand == Measurand::DeflectionEuler {
                    turn = order.turned_by(&row.pose.angles, &turn);
                    row.measured = joined(&shift, &turn);
                }
                if measurand == Measurand::AbsolutePose {
                    row.measured = Pose::from_rotation(shift, &order.rotation(&turn)).to_array();
                }
                row.pose = Pose::from_rotation(row.pose.translation, &order.rotation(&row.pose.angles));
            }
            Self::PoseAngles(order) => {
                row.pose = Pose::from_rotation(row.pose.translation, &order.rotation(&row.pose.angles));
            }
            Self::Preload(load) => {
                row.reference = Wrench {
                    force: row.reference.force + load.force,
                    moment: row.reference.moment + load.moment,
                };
            }
            Self::LoadIsChange => add_reference(row, 1.0),
            Self::LoadHoldsReference => add_reference(row, -1.0),
            _ => {}
        }
    }
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

fn kind_of<'a>(hexapod: &'a mut Hexapod, name: &str) -> Option<&'a mut SensorKind> {
    hexapod.sensors.iter_mut().find(|s| s.name == name).map(|s| &mut s.kind)
}

/// The load of the reference state so many times on top of that of the loaded one.
fn add_reference(row: &mut hexbench_core::Observation, times: f64) {
    row.wrench.force += times * row.reference.force;
    row.wrench.moment += times * row.reference.moment;
}

/// Loads with the other sign; measured numbers are multiplied by what they read.
fn reverse(signed: Signed, row: &mut hexbench_core::Observation) {
    let loads = |row: &mut hexbench_core::Observation, range: std::ops::Range<usize>| {
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
fn scale(group: Group, factor: f64, row: &mut hexbench_core::Observation) {
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

fn for_both(row: &mut hexbench_core::Observation, mut change: impl FnMut(&mut Wrench)) {
    change(&mut row.wrench);
    change(&mut row.reference);
}

/// Translation and rotation of a reading.
pub(super) fn halves(measured: &[f64; 6]) -> (Vector3, Vector3) {
    (Vector3::from_column_slice(&measured[..3]), Vector3::from_column_slice(&measured[3..]))
}

pub(super) fn joined(shift: &Vector3, turn: &Vector3) -> [f64; 6] {
    [shift.x, shift.y, shift.z, turn.x, turn.y, turn.z]
}

fn renamed_sigma(axes: SignedAxes, sigma: &[f64; 6]) -> [f64; 6] {
    let (shift, turn) = halves(sigma);
    joined(&axes.renamed(&shift).abs(), &axes.renamed(&turn).abs())
}
