//! What a change touches, and what it leaves alone.

use super::{Change, Group, ReadingColumn, ReferencePoint, Sensors, Signed, Target};
use crate::inference::examination::FindingKind;
use crate::inference::misread::pose::PoseOf;

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
            Self::ZeroError(..) => FindingKind::ZeroError,
            Self::Pose(PoseOf::Command, _) => FindingKind::CommandedPose,
            Self::Pose(PoseOf::Instrument, _) => FindingKind::MeasuredPose,
            Self::Within(_, multiple) => multiple.everywhere().kind(),
        }
    }

    /// True for mistakes of one kind, which are not made side by side: two sensors may be wrong, one of them in one way.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        match (self.sensors(), other.sensors()) {
            (Some(one), Some(other)) => one == other,
            _ => self.kind() == other.kind(),
        }
    }

    /// The sensors that it alone concerns.
    fn sensors(&self) -> Option<Sensors> {
        match *self {
            Self::SensorReversed(which) | Self::SensorScaled(which, _) => Some(which),
            Self::SensorMoved(name, _)
            | Self::SensorTurned(name, _)
            | Self::ZeroError(ReadingColumn::Sensor(name), _) => Some(Sensors::One(name)),
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
            | Self::ZeroError(..)
            | Self::Pose(PoseOf::Instrument, _) => true,
            Self::Scaled(group, _) => group.part().keeps_legs(),
            Self::Renamed(target, _) | Self::Turned(target, _) => target.part().keeps_legs(),
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
    pub(crate) fn is_of_loads_or_legs(&self) -> bool {
        match self {
            Self::Reversed(signed) => {
                matches!(signed, Signed::Wrench | Signed::Forces | Signed::Moments | Signed::Load(_))
            }
            Self::Scaled(group, _) => group.part().is_of_loads_or_legs(),
            Self::Renamed(target, _) | Self::Turned(target, _) => target.part().is_of_loads_or_legs(),
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
}

/// What numbers of a file are about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    Readings,
    Loads,
    Poses,
    Joints,
    Noise,
}

impl Part {
    fn keeps_legs(self) -> bool {
        !matches!(self, Self::Poses | Self::Joints)
    }

    fn is_of_loads_or_legs(self) -> bool {
        matches!(self, Self::Loads | Self::Joints)
    }
}

impl Group {
    fn part(self) -> Part {
        match self {
            Self::Translations | Self::Rotations | Self::Readings | Self::Reading(_) => Part::Readings,
            Self::Forces | Self::Moments | Self::Loads | Self::Load(_) => Part::Loads,
            Self::PosePositions | Self::PoseAngles => Part::Poses,
            Self::BaseJoints | Self::PlatformJoints | Self::Joints => Part::Joints,
            Self::Noise => Part::Noise,
        }
    }
}

impl Target {
    fn part(self) -> Part {
        match self {
            Self::Readings
            | Self::ReadingColumns
            | Self::TranslationColumns
            | Self::RotationColumns
            | Self::Points => Part::Readings,
            Self::Wrench | Self::WrenchColumns | Self::ForceColumns | Self::MomentColumns => Part::Loads,
            Self::Poses | Self::PosePositionColumns | Self::PoseAngleColumns => Part::Poses,
            Self::Joints | Self::BaseJoints | Self::PlatformJoints => Part::Joints,
        }
    }
}
