//! What a laboratory reads instead of a full pose, and what may be wrong with a sensor.

use hexbench_core::{Hexapod, Sensor, SensorKind, Vector3};

/// Standard deviation of a gauge, m.
const GAUGE: f64 = 0.2e-6;
/// Of each coordinate of a ball, m.
pub(super) const BALL: f64 = 0.6e-6;
/// Of a level, rad.
const LEVEL: f64 = 1.5e-6;

/// What a laboratory reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum SensorSet {
    /// Six pose numbers.
    Poses,
    /// Six pose numbers, a fifth of the cells empty.
    PosesWithGaps,
    /// Three balls on the platform.
    ThreeBalls,
    /// Six gauges around the platform.
    SixGauges,
    /// Three gauges.
    ThreeGauges,
    /// One ball and two gauges.
    BallAndGauges,
    /// Three translations and two levels.
    TranslationsAndLevels,
    /// Three translations.
    Translations,
    /// A scale beside each leg.
    Scales,
}

hexbench_core::worded! {
    /// One word for names of trials.
    SensorSet::word {
        Poses => "poses",
        PosesWithGaps => "poses-with-gaps",
        ThreeBalls => "three-balls",
        SixGauges => "six-gauges",
        ThreeGauges => "three-gauges",
        BallAndGauges => "ball-and-gauges",
        TranslationsAndLevels => "translations-and-levels",
        Translations => "translations",
        Scales => "scales",
    }
}

impl SensorSet {
    /// How many of the six pose numbers are read.
    pub(super) fn pose_numbers(self) -> usize {
        match self {
            Self::Poses | Self::PosesWithGaps => 6,
            Self::TranslationsAndLevels | Self::Translations => 3,
            _ => 0,
        }
    }

    /// The sensors, on a ring beyond the joints and above them.
    pub(super) fn sensors(self, hexapod: &Hexapod) -> Vec<Sensor> {
        let radius = ring_radius(hexapod);
        let at = |degrees: f64| {
            let (s, c) = degrees.to_radians().sin_cos();
            Vector3::new(radius * c, radius * s, 0.3 * radius)
        };
        let along = |degrees: f64| {
            let (s, c) = degrees.to_radians().sin_cos();
            Vector3::new(-s, c, 0.0)
        };
        let gauge = |name: &str, degrees: f64, direction: Vector3| {
            Sensor::new(name, SensorKind::Distance { point: at(degrees), direction, sigma: GAUGE })
        };
        let ball = |name: &str, degrees: f64| {
            Sensor::new(name, SensorKind::Point { point: at(degrees), sigma: [BALL; 3] })
        };
        let level =
            |name: &str, axis: Vector3| Sensor::new(name, SensorKind::Inclination { axis, sigma: LEVEL });
        let up = Vector3::z();
        match self {
            Self::Poses | Self::PosesWithGaps | Self::Translations => Vec::new(),
            Self::ThreeBalls => vec![ball("ball1", 20.0), ball("ball2", 140.0), ball("ball3", 260.0)],
            Self::SixGauges => vec![
                gauge("z1", 0.0, up),
                gauge("z2", 120.0, up),
                gauge("z3", 240.0, up),
                gauge("t1", 60.0, along(60.0)),
                gauge("t2", 180.0, along(180.0)),
                gauge("t3", 300.0, along(300.0)),
            ],
            Self::ThreeGauges => vec![
                gauge("z1", 15.0, up),
                gauge("t1", 130.0, along(130.0)),
                gauge("t2", 250.0, (along(250.0) + up).normalize()),
            ],
            Self::BallAndGauges => {
                vec![ball("ball", 25.0), gauge("g1", 145.0, up), gauge("g2", 265.0, up)]
            }
            Self::TranslationsAndLevels => {
                vec![level("level_x", Vector3::x()), level("level_y", Vector3::y())]
            }
            Self::Scales => (0..6)
                .map(|leg| {
                    Sensor::new(format!("scale{}", leg + 1), SensorKind::LegLength { leg, sigma: GAUGE })
                })
                .collect(),
        }
    }
}

/// Radius of the ring on which sensors stand, m.
pub(super) fn ring_radius(hexapod: &Hexapod) -> f64 {
    1.2 * hexapod.platform_radius()
}

/// What is wrong with the first sensor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SensorFault {
    /// It reads with the other sign.
    Sign,
    /// Its numbers are inches.
    Factor,
    /// It stands 10 mm beside its place.
    Place,
    /// It shows 5 % too much.
    Gain,
}

hexbench_core::worded! {
    /// The kind of finding that calls it by its name.
    SensorFault::word {
        Sign => "sensor-sign",
        Factor => "sensor-factor",
        Place => "sensor-place",
        Gain => "sensor-gain",
    }
}
