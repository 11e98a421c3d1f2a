//! Measurements: what was commanded, what was applied, what was read.

use std::collections::BTreeMap;

use crate::{Approach, Channel, LineRange, LoadSequences, Pose, Sensor, UNREAD, Wrench};

/// Poses that show what a machine does.
const LEAST_POSES: usize = 18;

/// What the six measured numbers of an observation are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Measurand {
    /// Loaded minus reference; rotation as differences of the Euler angles.
    DeflectionEuler,
    /// Loaded minus reference; rotation as a rotation vector in fixed axes.
    DeflectionRotationVector,
    /// The pose itself, in an unknown constant metrology frame, of an unknown constant target frame.
    AbsolutePose,
}

impl Measurand {
    /// What readings of this kind are called, in the plural.
    pub fn readings(self) -> &'static str {
        match self {
            Self::DeflectionEuler | Self::DeflectionRotationVector => "deflections",
            Self::AbsolutePose => "absolute poses",
        }
    }

    /// Names of the six numbers of such a reading, without unit: those of their columns, for absolute poses without `measured_`.
    pub const fn names(self) -> [&'static str; 6] {
        match self {
            Self::DeflectionEuler => ["da", "db", "dc", "dalpha", "dbeta", "dgamma"],
            Self::DeflectionRotationVector => ["da", "db", "dc", "drx", "dry", "drz"],
            Self::AbsolutePose => ["a", "b", "c", "alpha", "beta", "gamma"],
        }
    }
}

/// One reading. SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Observation {
    /// Number of the pose as the file gives it.
    pub pose_id: i64,
    /// Number of the repeat as the file gives it.
    pub repeat: i64,
    /// Line of the file, from 1, header included.
    pub line: u64,
    /// Commanded pose.
    pub pose: Pose,
    /// Wrench in the loaded state.
    pub wrench: Wrench,
    /// Wrench in the reference state; zero when the file has no such columns.
    pub reference: Wrench,
    /// How the load was reached.
    pub approach: Approach,
    /// Factor by which an overloaded approach exceeded the change of load first.
    pub overload: f64,
    /// Structure temperature at the loaded reading minus at the reference reading, K.
    pub delta_t: f64,
    /// Time from the reference reading to the loaded reading, s.
    pub elapsed: f64,
    /// Time the reference load had rested on the machine when the reference was read, s; none when the file does not say.
    pub reference_age: Option<f64>,
    /// Number of the reference reading that this one was taken against, as the file gives it; none when the file does not say.
    pub reference_record: Option<i64>,
    /// Place of the reading in the sequence in which loads were put on; none when the file does not say.
    pub order: Option<i64>,
    /// What the six numbers are: one of the [`Dataset::blocks`].
    pub block: usize,
    /// Measured values: translation (m), rotation (rad), meaning as in [`Measurand`]; of other blocks, what their channels read.
    pub measured: [f64; 6],
    /// Standard deviation of each measured value when the row states it, m and rad; [`UNREAD`] of one that was not read.
    pub sigma: Option<[f64; 6]>,
}

impl Observation {
    /// Nothing read yet at a pose under loads, on the direct way, at once and at one temperature: pose 1, repeat 1, of no line.
    pub fn unread(pose: Pose, wrench: Wrench, reference: Wrench) -> Self {
        Self {
            pose_id: 1,
            repeat: 1,
            line: 0,
            pose,
            wrench,
            reference,
            approach: Approach::Direct,
            overload: Approach::OVERLOAD,
            delta_t: 0.0,
            elapsed: 0.0,
            reference_age: None,
            reference_record: None,
            order: None,
            block: 0,
            measured: [0.0; 6],
            sigma: None,
        }
    }

    /// True for a number that was read.
    pub fn is_read(&self, number: usize) -> bool {
        self.sigma.is_none_or(|sigma| sigma[number] < UNREAD)
    }

    /// How many of the six numbers were read.
    pub fn numbers(&self) -> usize {
        (0..6).filter(|&k| self.is_read(k)).count()
    }
}

/// Which optional columns the file had; a term whose column is missing cannot be tested.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Columns {
    /// All six `ref_*` columns.
    pub reference: bool,
    /// `approach`.
    pub approach: bool,
    /// `overload`.
    pub overload: bool,
    /// `delta_T_*`.
    pub delta_t: bool,
    /// `elapsed_*`.
    pub elapsed: bool,
    /// `ref_age_*`.
    pub reference_age: bool,
    /// `ref_record`.
    pub reference_record: bool,
    /// `order`.
    pub order: bool,
    /// All six `sigma_*` columns.
    pub sigma: bool,
}

impl Columns {
    /// Those that both files have.
    fn common(self, other: Self) -> Self {
        Self {
            reference: self.reference && other.reference,
            approach: self.approach && other.approach,
            overload: self.overload && other.overload,
            delta_t: self.delta_t && other.delta_t,
            elapsed: self.elapsed && other.elapsed,
            reference_age: self.reference_age && other.reference_age,
            reference_record: self.reference_record && other.reference_record,
            order: self.order && other.order,
            sigma: self.sigma && other.sigma,
        }
    }
}

/// A measurement file as read.
#[derive(Debug, Clone, PartialEq)]
pub struct Dataset {
    /// Name of the file, for messages.
    pub source: String,
    /// Meaning of the measured values.
    pub measurand: Measurand,
    /// Optional columns present.
    pub columns: Columns,
    /// What the six numbers of observations are; the first block alone, a full pose, unless something else was read. A row of a
    /// file with more than six numbers makes several observations, which share its line.
    pub blocks: Vec<[Channel; 6]>,
    /// The loads before each reading, where the file states their sequence.
    pub sequences: LoadSequences,
    /// Readings of the table from which these are drawn; none where they are all of it.
    pub drawn_from: Option<usize>,
    /// The rows in file order.
    pub observations: Vec<Observation>,
}

impl Dataset {
    /// What the six numbers of an observation are.
    pub fn channels(&self, observation: &Observation) -> [Channel; 6] {
        self.blocks.get(observation.block).copied().unwrap_or(Channel::POSE)
    }

    /// All that observations may read, in the order of the blocks.
    pub fn all_channels(&self) -> impl Iterator<Item = Channel> + Clone {
        self.blocks.iter().flatten().copied().filter(|channel| *channel != Channel::Nothing)
    }

    /// Which of the six numbers of an observation a channel is; none where it was not read.
    pub fn place_of(&self, observation: &Observation, channel: Channel) -> Option<usize> {
        let place = self.channels(observation).iter().position(|own| *own == channel)?;
        observation.is_read(place).then_some(place)
    }

    /// The rows of the file: observations that share a line.
    pub fn rows(&self) -> impl Iterator<Item = &[Observation]> {
        self.observations.chunk_by(|one, next| one.line == next.line && one.block != next.block)
    }

    /// A table of full poses.
    pub fn of_poses(
        source: impl Into<String>,
        measurand: Measurand,
        columns: Columns,
        observations: Vec<Observation>,
    ) -> Self {
        let (blocks, sequences) = (Self::pose_blocks(), LoadSequences::of(&observations));
        Self { source: source.into(), measurand, columns, blocks, sequences, drawn_from: None, observations }
    }

    /// The blocks of a file in which every row is a full pose.
    pub fn pose_blocks() -> Vec<[Channel; 6]> {
        vec![Channel::POSE]
    }

    /// True when something else was read than a full pose in every row.
    pub fn has_other_readings(&self) -> bool {
        self.blocks != [Channel::POSE] || self.observations.iter().any(|o| o.numbers() < 6)
    }

    /// Deflections of full poses with all that is known of their conditions; nothing is stated of their noise.
    pub fn of_deflections(source: &str, observations: Vec<Observation>) -> Self {
        let columns =
            Columns { reference: true, approach: true, delta_t: true, elapsed: true, ..Columns::default() };
        Self::of_poses(source, Measurand::DeflectionEuler, columns, observations)
    }

    /// The same rows as they are to be read by sensors alone, each number as well as its sensor states; nothing is measured yet.
    #[must_use]
    pub fn to_be_read_by(&self, sensors: &[Sensor]) -> Self {
        let blocks = Channel::in_blocks(&Channel::all([], sensors));
        let sigma =
            |channels: &[Channel; 6]| channels.map(|c| c.stated_sigma(sensors, None).unwrap_or(UNREAD));
        let read = |row: &Observation| {
            let row = Observation { measured: [0.0; 6], ..*row };
            let of_block = |(block, channels)| Observation { block, sigma: Some(sigma(channels)), ..row };
            blocks.iter().enumerate().map(of_block).collect::<Vec<_>>()
        };
        Self {
            measurand: Measurand::DeflectionRotationVector,
            columns: Columns { sigma: true, ..self.columns },
            observations: self.observations.iter().flat_map(read).collect(),
            sequences: self.sequences.clone(),
            source: self.source.clone(),
            drawn_from: self.drawn_from,
            blocks,
        }
    }

    /// True in absolute mode.
    pub fn is_absolute(&self) -> bool {
        self.measurand == Measurand::AbsolutePose
    }

    /// About so many readings: those at every so many-th pose; none where there are not twice as many, or too few poses to leave some out.
    pub fn some_poses(&self, readings: usize) -> Option<Self> {
        let every = self.observations.len().div_ceil(readings.max(1));
        if every < 3 {
            return None;
        }
        let mut known: BTreeMap<[u64; 6], usize> = BTreeMap::new();
        let mut is_kept = |o: &&Observation| {
            let next = known.len();
            known.entry(o.pose.bits()).or_insert(next).is_multiple_of(every)
        };
        let observations = self.observations.iter().filter(&mut is_kept).copied().collect();
        (known.len() >= LEAST_POSES * every).then(|| Self {
            observations,
            source: self.source.clone(),
            blocks: self.blocks.clone(),
            sequences: self.sequences.clone(),
            ..*self
        })
    }

    /// The readings of both files, with the columns that both have; none where they read different things.
    pub fn joined(&self, other: &Self) -> Option<Self> {
        if self.measurand != other.measurand || self.blocks != other.blocks {
            return None;
        }
        // The sequence of the other file comes after this one's.
        let orders = |data: &Self| data.observations.iter().filter_map(|o| o.order).collect::<Vec<_>>();
        let last = orders(self).into_iter().max().unwrap_or_default();
        let later = last - orders(other).into_iter().min().unwrap_or_default() + 1;
        let further =
            other.observations.iter().map(|o| Observation { order: o.order.map(|n| n + later), ..*o });
        Some(Self {
            columns: self.columns.common(other.columns),
            blocks: self.blocks.clone(),
            sequences: self.sequences.and(&other.sequences, later),
            observations: self.observations.iter().copied().chain(further).collect(),
            source: self.source.clone(),
            ..*self
        })
    }

    /// The readings of all other lines, and the lines that are left out, in the order of the file.
    ///
    /// # Errors
    /// The first of `lines` that holds no reading.
    pub fn without(&self, lines: &[LineRange]) -> Result<(Self, Vec<u64>), LineRange> {
        let holds = |range: &LineRange| self.observations.iter().any(|o| range.contains(o.line));
        if let Some(empty) = lines.iter().find(|range| !holds(range)) {
            return Err(*empty);
        }
        let (out, kept): (Vec<_>, Vec<_>) =
            self.observations.iter().partition(|o| lines.iter().any(|range| range.contains(o.line)));
        let observations = kept.into_iter().copied().collect();
        let rest = Self {
            source: self.source.clone(),
            measurand: self.measurand,
            columns: self.columns,
            blocks: self.blocks.clone(),
            sequences: self.sequences.clone(),
            drawn_from: self.drawn_from,
            observations,
        };
        Ok((rest, out.iter().map(|o| o.line).collect()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn deflections(poses: usize) -> Dataset {
        let row = |k: usize| {
            let pose = Pose::from_array([1e-3 * k as f64, 0.0, 0.0, 0.0, 0.0, 0.0]);
            Observation::unread(pose, Wrench::default(), Wrench::default())
        };
        Dataset::of_deflections("one", (0..poses).map(row).collect())
    }

    #[test]
    fn some_poses_are_those_of_a_third_of_the_readings_or_less() {
        let left = |readings| deflections(90).some_poses(readings).map(|some| some.observations.len());
        assert_eq!([30, 45, 90].map(left), [Some(30), None, None]);
    }

    #[test]
    fn files_are_joined_where_they_read_the_same() {
        let (one, other) = (deflections(3), deflections(2));
        assert_eq!(one.joined(&other).map(|both| both.observations.len()), Some(5));
        let absolute = Dataset { measurand: Measurand::AbsolutePose, ..other };
        assert!(one.joined(&absolute).is_none() && absolute.is_absolute() && !one.is_absolute());
    }
}
