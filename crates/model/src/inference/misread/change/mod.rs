//! One misstatement that a file may contain.

mod apply;
mod touches;

use std::ops::Range;

use hexbench_core::{Hexapod, LineRange, Vector3, Wrench};

pub(super) use self::apply::{halves, joined};
use super::hypotheses::{factors_of, is_ratio};
use super::pose::{PoseMistake, PoseOf};
use super::row_order::RowOrder;
use super::sensors::SENSOR_FACTORS;
use super::turn::{AngleOrder, SignedAxes};

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
    /// A column of readings is off by so much in every row, m or rad.
    ZeroError(ReadingColumn, f64),
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

/// One column of readings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReadingColumn {
    /// One of the six numbers of a deflection, from zero.
    Pose(u8),
    /// The one of this name, of a sensor.
    Sensor(&'static str),
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
    /// The columns of their translations as they stand, those of the rotations as they are.
    TranslationColumns,
    /// The columns of their rotations as they stand, those of the translations as they are.
    RotationColumns,
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
    /// The columns of the positions of the poses as they stand, those of the angles as they are.
    PosePositionColumns,
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
    /// True for vectors in axes of their own, false for columns that only stand in each other's place.
    pub(in crate::inference::misread) fn is_of_vectors(self) -> bool {
        use Target::{BaseJoints, Joints, PlatformJoints, Points, Poses, Readings, Wrench};
        matches!(self, Readings | Points | Wrench | Poses | Joints | BaseJoints | PlatformJoints)
    }

    /// Which of the six numbers of a deflection other axes are about; none of those of anything else.
    pub(in crate::inference::misread) fn pose_numbers(self) -> Range<usize> {
        match self {
            Self::Readings | Self::ReadingColumns => 0..6,
            Self::TranslationColumns => 0..3,
            Self::RotationColumns => 3..6,
            _ => 0..0,
        }
    }

    /// By what other axes multiply rotations and moments: left-handed ones reverse those that are vectors.
    pub(in crate::inference::misread) fn hand(self, axes: SignedAxes) -> f64 {
        if self.is_of_vectors() { axes.handedness() } else { 1.0 }
    }

    /// True for what each row has by itself, whatever its rotations mean.
    fn is_of_rows(self) -> bool {
        matches!(
            self,
            Self::ReadingColumns
                | Self::TranslationColumns
                | Self::RotationColumns
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
    /// Numbers of it that are fitted.
    pub fn sizes(&self) -> usize {
        match self {
            Self::Turned(..) | Self::Origin(..) | Self::SensorMoved(..) => 3,
            Self::SensorTurned(..) => 2,
            Self::Preload(load) => load.to_array().iter().filter(|x| **x != 0.0).count(),
            Self::Joint(..) | Self::ZeroError(..) => 1,
            // The ratio of two units is known.
            Self::Scaled(group, factor) => usize::from(!is_ratio(factors_of(*group), *factor)),
            Self::SensorScaled(_, factor) => {
                usize::from(!SENSOR_FACTORS.iter().any(|of| is_ratio(of, *factor)))
            }
            _ => 0,
        }
    }
}
