//! What reads a deflection when no full pose does: gauges, reflectors, levels, scales.
//!
//! A sensor reads the difference between the loaded and the reference state. With `p` a point of the platform (mobile frame) and
//! `[R, t]` the pose of the platform:
//!
//! ```text
//! distance      u . (R_l p + t_l - R_r p - t_r)     u: direction, fixed axes
//! point              R_l p + t_l - R_r p - t_r       three numbers, fixed axes
//! inclination   a . rotation vector                  a: axis, fixed axes
//! leg-length    |q_i| loaded - |q_i| reference       q_i: from base joint to platform joint
//! function      f(R_l, t_l) - f(R_r, t_r)            f: of the pose, as its owner wrote it
//! ```

use std::fmt;
use std::sync::Arc;

use nalgebra::Rotation3;

use crate::{Measurand, Metrology, Pose, Tolerances, Vector3};

/// Standard deviation of a number that was not read (m or rad): it weighs nothing beside any that was.
pub const UNREAD: f64 = 1e15;

/// A sensor of a machine. SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensor {
    /// Name, with which its columns begin.
    pub name: String,
    /// What it reads.
    pub kind: SensorKind,
    /// What it shows over what it should: one, unless it was found to show too much or too little.
    pub gain: f64,
    /// Its tolerances over those of the machine, in the order of [`SensorInput::ALL`]: one, unless it is known to be worse than others.
    pub looseness: [f64; 3],
}

/// What is known of a sensor to a tolerance only.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SensorInput {
    /// The point that it looks at.
    Point,
    /// The direction in which, or the axis about which it reads.
    Direction,
    /// What it shows over what it should.
    Gain,
}

impl SensorInput {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Point, Self::Direction, Self::Gain];

    /// How many numbers it is.
    pub fn count(self) -> usize {
        if self == Self::Gain { 1 } else { 3 }
    }

    /// Standard deviation of each of them, m, rad or relative.
    pub fn standard_deviation(self, tolerances: &Tolerances) -> f64 {
        match self {
            Self::Point => tolerances.sensor_point,
            Self::Direction => tolerances.sensor_direction,
            Self::Gain => tolerances.sensor_gain,
        }
    }
}

/// What a sensor reads, and the standard deviation of one reading.
#[derive(Debug, Clone, PartialEq)]
pub enum SensorKind {
    /// Displacement of a point along a direction: dial gauge, interferometer, capacitive probe.
    Distance {
        /// Point of the platform, mobile frame, m.
        point: Vector3,
        /// Unit vector, fixed axes.
        direction: Vector3,
        /// m.
        sigma: f64,
    },
    /// Displacement of a point: reflector of a tracker, ball of a coordinate measuring machine.
    Point {
        /// Point of the platform, mobile frame, m.
        point: Vector3,
        /// Along each of the fixed axes, m.
        sigma: [f64; 3],
    },
    /// Rotation about an axis: level, autocollimator.
    Inclination {
        /// Unit vector, fixed axes.
        axis: Vector3,
        /// rad.
        sigma: f64,
    },
    /// Growth of the distance between the two joints of a leg: scale beside it.
    LegLength {
        /// Leg, from zero.
        leg: usize,
        /// m.
        sigma: f64,
    },
    /// Change of a function of the pose that its owner wrote. No file holds it.
    Function {
        /// m or rad.
        of: PoseFunction,
        /// True for an angle.
        is_angle: bool,
        /// m or rad.
        sigma: f64,
    },
}

/// A number, m or rad, that a pose of the platform gives; asked for many poses at once.
#[derive(Clone)]
pub struct PoseFunction(Arc<OfPoses>);

/// Values at many poses.
type OfPoses = dyn Fn(&[Pose]) -> Vec<f64> + Send + Sync;

impl PoseFunction {
    /// This function, which must be smooth over deflections.
    pub fn new(of: impl Fn(&Pose) -> f64 + Send + Sync + 'static) -> Self {
        Self::of_many(move |poses| poses.iter().map(&of).collect())
    }

    /// The same, where many values at once cost little more than one: one for each pose.
    pub fn of_many(of: impl Fn(&[Pose]) -> Vec<f64> + Send + Sync + 'static) -> Self {
        Self(Arc::new(of))
    }

    /// Its values at `N` poses; not a number where it gives fewer.
    pub fn at<const N: usize>(&self, poses: &[Pose; N]) -> [f64; N] {
        let values = (self.0)(poses);
        std::array::from_fn(|k| values.get(k).copied().unwrap_or(f64::NAN))
    }
}

impl fmt::Debug for PoseFunction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("PoseFunction")
    }
}

/// The same function: what two of them compute is not compared.
impl PartialEq for PoseFunction {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl SensorKind {
    /// Its word in files.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Distance { .. } => "distance",
            Self::Point { .. } => "point",
            Self::Inclination { .. } => "inclination",
            Self::LegLength { .. } => "leg-length",
            Self::Function { .. } => "function",
        }
    }

    /// The point of the platform that it looks at, mobile frame, m; none where it looks at none.
    pub fn point(&self) -> Option<&Vector3> {
        match self {
            Self::Distance { point, .. } | Self::Point { point, .. } => Some(point),
            Self::Inclination { .. } | Self::LegLength { .. } | Self::Function { .. } => None,
        }
    }

    /// The direction in which, or the axis about which it reads, fixed axes; none where it has none.
    pub fn direction(&self) -> Option<&Vector3> {
        match self {
            Self::Distance { direction, .. } => Some(direction),
            Self::Inclination { axis, .. } => Some(axis),
            Self::Point { .. } | Self::LegLength { .. } | Self::Function { .. } => None,
        }
    }

    fn point_mut(&mut self) -> Option<&mut Vector3> {
        match self {
            Self::Distance { point, .. } | Self::Point { point, .. } => Some(point),
            Self::Inclination { .. } | Self::LegLength { .. } | Self::Function { .. } => None,
        }
    }

    fn direction_mut(&mut self) -> Option<&mut Vector3> {
        match self {
            Self::Distance { direction, .. } => Some(direction),
            Self::Inclination { axis, .. } => Some(axis),
            Self::Point { .. } | Self::LegLength { .. } | Self::Function { .. } => None,
        }
    }

    /// The leg beside which it stands, from zero.
    pub fn leg(&self) -> Option<usize> {
        if let Self::LegLength { leg, .. } = self { Some(*leg) } else { None }
    }

    /// Numbers in one reading.
    pub fn numbers(&self) -> usize {
        if matches!(self, Self::Point { .. }) { 3 } else { 1 }
    }

    /// True when it reads angles.
    pub fn is_angle(&self) -> bool {
        matches!(self, Self::Inclination { .. } | Self::Function { is_angle: true, .. })
    }

    /// Standard deviation of one of its numbers, m or rad.
    pub fn sigma(&self, number: usize) -> f64 {
        match self {
            Self::Point { sigma, .. } => sigma[number],
            Self::Distance { sigma, .. }
            | Self::Inclination { sigma, .. }
            | Self::LegLength { sigma, .. }
            | Self::Function { sigma, .. } => *sigma,
        }
    }
}

impl Sensor {
    /// A sensor as good as any.
    pub fn new(name: impl Into<String>, kind: SensorKind) -> Self {
        Self { name: name.into(), kind, gain: 1.0, looseness: [1.0; 3] }
    }

    /// True for what it has: a scale beside a leg has neither a point nor a direction of its own.
    pub fn has(&self, input: SensorInput) -> bool {
        match input {
            SensorInput::Point => self.kind.point().is_some(),
            SensorInput::Direction => self.kind.direction().is_some(),
            SensorInput::Gain => true,
        }
    }

    /// Its tolerance of an input over that of the machine.
    pub fn looseness_of(&self, input: SensorInput) -> f64 {
        self.looseness[input as usize]
    }

    /// Knows an input to so many times its tolerance.
    pub fn loosen(&mut self, input: SensorInput, looseness: f64) {
        self.looseness[input as usize] = looseness;
    }

    /// Puts its point elsewhere by a distance (mobile frame, m), turns its direction by a rotation vector (fixed axes, rad), or makes what it
    /// shows larger by a share.
    pub fn put_off(&mut self, input: SensorInput, errors: &[f64]) {
        match input {
            SensorInput::Point => {
                self.kind.point_mut().into_iter().for_each(|p| *p += Vector3::from_column_slice(errors));
            }
            SensorInput::Direction => {
                let turn = Rotation3::new(Vector3::from_column_slice(errors));
                self.kind.direction_mut().into_iter().for_each(|direction| *direction = turn * *direction);
            }
            SensorInput::Gain => self.gain *= 1.0 + errors[0],
        }
    }

    /// The same sensor with a noise so many times as large.
    #[must_use]
    pub fn with_noise(mut self, factor: f64) -> Self {
        match &mut self.kind {
            SensorKind::Point { sigma, .. } => sigma.iter_mut().for_each(|sigma| *sigma *= factor),
            SensorKind::Distance { sigma, .. }
            | SensorKind::Inclination { sigma, .. }
            | SensorKind::LegLength { sigma, .. }
            | SensorKind::Function { sigma, .. } => *sigma *= factor,
        }
        self
    }

    /// Name of one of its columns, without unit: `g1`, or `ball_x`.
    pub fn column(&self, number: usize) -> String {
        match self.kind {
            SensorKind::Point { .. } => format!("{}_{}", self.name, ["x", "y", "z"][number]),
            _ => self.name.clone(),
        }
    }
}

/// What a number that was or was not read is measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum NumberKind {
    /// It was not read.
    #[default]
    Unread,
    /// A length, m.
    Length,
    /// An angle, rad.
    Angle,
}

/// What one number of a row reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Channel {
    /// One of the six pose numbers: translations, then rotations.
    Pose(usize),
    /// One number of a sensor.
    Sensor {
        /// Index of the sensor in its machine.
        sensor: usize,
        /// Which of its numbers.
        number: usize,
    },
    /// Nothing: a place that is left over.
    #[default]
    Nothing,
}

impl Channel {
    /// The six numbers of a full pose.
    pub const POSE: [Self; 6] =
        [Self::Pose(0), Self::Pose(1), Self::Pose(2), Self::Pose(3), Self::Pose(4), Self::Pose(5)];

    /// The channels of some pose numbers and of all sensors, in the order of their columns.
    pub fn all(pose: impl IntoIterator<Item = usize>, sensors: &[Sensor]) -> Vec<Self> {
        let numbers = |(sensor, s): (usize, &Sensor)| {
            (0..s.kind.numbers()).map(move |number| Self::Sensor { sensor, number })
        };
        let of_sensors = sensors.iter().enumerate().flat_map(numbers);
        pose.into_iter().map(Self::Pose).chain(of_sensors).collect()
    }

    /// Channels six at a time, as observations hold them.
    pub fn in_blocks(channels: &[Self]) -> Vec<[Self; 6]> {
        let block = |part: &[Self]| std::array::from_fn(|k| part.get(k).copied().unwrap_or_default());
        channels.chunks(6).map(block).collect()
    }

    /// True when it reads an angle.
    pub fn is_angle(self, sensors: &[Sensor]) -> bool {
        match self {
            Self::Pose(k) => k >= 3,
            Self::Sensor { sensor, .. } => sensors.get(sensor).is_some_and(|s| s.kind.is_angle()),
            Self::Nothing => false,
        }
    }

    /// Name of its column, without unit.
    pub fn name(self, sensors: &[Sensor], measurand: Measurand) -> String {
        match self {
            Self::Pose(k) => measurand.names()[k].to_owned(),
            Self::Sensor { sensor, number } => {
                sensors.get(sensor).map_or_else(String::new, |s| s.column(number))
            }
            Self::Nothing => String::new(),
        }
    }

    /// Its unit in files and on pages.
    pub fn unit(self, sensors: &[Sensor]) -> &'static str {
        if self.is_angle(sensors) { "urad" } else { "um" }
    }

    /// Name of its column with the unit of files, um or urad.
    pub fn column(self, sensors: &[Sensor], measurand: Measurand) -> String {
        format!("{}_{}", self.name(sensors, measurand), self.unit(sensors))
    }

    /// Standard deviation that the machine states for it, m or rad.
    pub fn stated_sigma(self, sensors: &[Sensor], metrology: Option<Metrology>) -> Option<f64> {
        match self {
            Self::Pose(k) if k < 3 => metrology.map(|m| m.sigma_translation),
            Self::Pose(_) => metrology.map(|m| m.sigma_rotation),
            Self::Sensor { sensor, number } => sensors.get(sensor).map(|s| s.kind.sigma(number)),
            Self::Nothing => Some(UNREAD),
        }
    }
}
