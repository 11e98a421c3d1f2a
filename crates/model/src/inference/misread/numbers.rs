//! What a change does to measured numbers, each by what it reads: a file may have some of the six pose numbers, and sensors beside them.

use std::ops::Range;

use hexbench_core::{Channel, Dataset, Sensor};

use super::change::{Change, Group, ReadingColumn, Sensors, Signed, Target};

impl Sensors {
    /// True for the number of a sensor that is one of these.
    fn has(self, channel: Channel, sensors: &[Sensor]) -> bool {
        let Channel::Sensor { sensor, number } = channel else { return false };
        sensors.get(sensor).is_some_and(|s| match self {
            Self::One(name) => s.name == name || s.column(number) == name,
            Self::All(kind) => s.kind.word() == kind,
        })
    }
}

impl ReadingColumn {
    /// True for the column that a channel reads.
    pub(super) fn is(self, channel: Channel, sensors: &[Sensor]) -> bool {
        match (self, channel) {
            (Self::Pose(one), Channel::Pose(k)) => k == usize::from(one),
            (Self::Sensor(name), Channel::Sensor { sensor, number }) => {
                sensors.get(sensor).is_some_and(|s| s.column(number) == name)
            }
            _ => false,
        }
    }
}

impl Change {
    /// By what it multiplies the number that a channel reads; 1 for a change of anything else.
    pub(super) fn factor(&self, channel: Channel, sensors: &[Sensor]) -> f64 {
        let is_one_of = || self.pose_numbers().is_some_and(|numbers| reads_one_of(channel, &numbers));
        let (concerns, factor) = match *self {
            Self::Reversed(Signed::Readings) => (true, -1.0),
            Self::Scaled(Group::Readings, factor) => (true, factor),
            Self::Reversed(_) => (is_one_of(), -1.0),
            Self::Scaled(_, factor) => (is_one_of(), factor),
            Self::SensorReversed(which) => (which.has(channel, sensors), -1.0),
            Self::SensorScaled(which, factor) => (which.has(channel, sensors), factor),
            _ => return 1.0,
        };
        if concerns { factor } else { 1.0 }
    }

    /// Which of the six pose numbers another sign or unit is about; none for loads, for whatever is read, and for other changes.
    pub(super) fn pose_numbers(&self) -> Option<Range<usize>> {
        match *self {
            Self::Reversed(Signed::Translations) | Self::Scaled(Group::Translations, _) => Some(0..3),
            Self::Reversed(Signed::Rotations) | Self::Scaled(Group::Rotations, _) => Some(3..6),
            Self::Reversed(Signed::Reading(one)) | Self::Scaled(Group::Reading(one), _) => {
                Some(usize::from(one)..usize::from(one) + 1)
            }
            _ => None,
        }
    }

    /// The zero error of the number that a channel reads; none for a change of anything else.
    fn zero_error(&self, channel: Channel, sensors: &[Sensor]) -> f64 {
        match *self {
            Self::ZeroError(column, error) if column.is(channel, sensors) => error,
            _ => 0.0,
        }
    }

    /// Multiplies the measured numbers that it concerns, and takes a zero error off them.
    pub(super) fn rescale(&self, data: &mut Dataset, sensors: &[Sensor]) {
        if !matches!(
            self,
            Self::Reversed(_)
                | Self::Scaled(..)
                | Self::SensorReversed(_)
                | Self::SensorScaled(..)
                | Self::ZeroError(..)
        ) {
            return;
        }
        let scale = |channel: Channel| (self.factor(channel, sensors), self.zero_error(channel, sensors));
        let scales: Vec<[(f64, f64); 6]> = data.blocks.iter().map(|block| block.map(scale)).collect();
        for row in &mut data.observations {
            let Some(scales) = scales.get(row.block) else { continue };
            row.measured.iter_mut().zip(scales).for_each(|(x, (factor, zero))| *x = *x * factor - zero);
        }
    }

    /// Names the columns otherwise in which axes of deflections or of points are meant otherwise: each number is that of another axis,
    /// with its sign. True for a change that is no more than that: deflections in other axes are, where not every row has all six.
    pub(super) fn rename_columns(&self, data: &mut Dataset, sensors: &[Sensor]) -> bool {
        let Self::Renamed(target, axes) = *self else { return false };
        let of_poses = target.pose_numbers();
        if target != Target::Points && (of_poses.is_empty() || !data.has_other_readings()) {
            return false;
        }
        let hand = target.hand(axes);
        let renamed = |channel: Channel| match channel {
            Channel::Pose(k) if of_poses.contains(&k) => {
                let (axis, sign) = axes.meant_by(k % 3);
                let hand = if k < 3 { 1.0 } else { hand };
                (Channel::Pose(k / 3 * 3 + axis), sign * hand)
            }
            Channel::Sensor { sensor, number } if of_poses.is_empty() && is_point(sensor, sensors) => {
                let (axis, sign) = axes.meant_by(number);
                (Channel::Sensor { sensor, number: axis }, sign)
            }
            other => (other, 1.0),
        };
        let blocks: Vec<[(Channel, f64); 6]> = data.blocks.iter().map(|block| block.map(renamed)).collect();
        for row in &mut data.observations {
            let Some(block) = blocks.get(row.block) else { continue };
            row.measured.iter_mut().zip(block).for_each(|(x, (_, sign))| *x *= sign);
        }
        data.blocks = blocks.into_iter().map(|block| block.map(|(channel, _)| channel)).collect();
        true
    }
}

fn is_point(sensor: usize, sensors: &[Sensor]) -> bool {
    sensors.get(sensor).is_some_and(|s| s.kind.numbers() == 3)
}

/// True for a channel that reads one of these pose numbers.
pub(super) fn reads_one_of(channel: Channel, numbers: &Range<usize>) -> bool {
    matches!(channel, Channel::Pose(k) if numbers.contains(&k))
}

#[cfg(test)]
mod tests {
    use hexbench_core::{Measurand, SensorKind, Vector3};

    use super::super::turn::SignedAxes;
    use super::*;
    use crate::test_machine::readings;

    #[test]
    fn the_columns_of_a_point_are_those_of_other_axes_with_their_signs() {
        let point = SensorKind::Point { point: Vector3::new(0.1, 0.0, 0.0), sigma: [1e-6; 3] };
        let sensors = vec![Sensor::new("ball", point)];
        let (_, mut data) = readings(Measurand::DeflectionRotationVector, sensors.clone());
        data.observations.iter_mut().for_each(|row| row.measured = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        let before = data.clone();
        let axes = SignedAxes::new([2, -1, 3]).unwrap();
        assert!(Change::Renamed(Target::Points, axes).rename_columns(&mut data, &sensors));
        for number in 0..3 {
            let (axis, sign) = axes.meant_by(number);
            let place =
                before.blocks[0].iter().position(|c| *c == Channel::Sensor { sensor: 0, number }).unwrap();
            assert_eq!(data.blocks[0][place], Channel::Sensor { sensor: 0, number: axis });
            let [is, was] = [&data, &before].map(|d| d.observations[4].measured[place]);
            assert!((is - sign * was).abs() < f64::EPSILON, "{number}");
        }
        assert!(!Change::Renamed(Target::Wrench, axes).rename_columns(&mut data, &sensors));
    }

    #[test]
    fn a_sign_or_a_unit_concerns_the_numbers_of_its_group() {
        let rotations = Change::Scaled(Group::Rotations, 60.0);
        let found = [2, 3, 5].map(|k| rotations.factor(Channel::Pose(k), &[]).to_bits());
        assert_eq!(found, [1.0_f64, 60.0, 60.0].map(f64::to_bits));
    }
}
