//! What a scene is measured with.

use hexbench_core::{
    Channel, Hexapod, Measurand, Metrology, Pose, UNREAD, Vector3,
    files::{Dimension, Fault, Item, KeyUnit, TomlSection},
};

use crate::{
    TruthError,
    metrology::{Balls, Cmm, InstrumentNoise},
};

/// The instrument of a scene.
#[derive(Debug, Clone, PartialEq)]
pub enum Instrument {
    /// Independent noise on the six numbers of a reading.
    Numbers(InstrumentNoise),
    /// Balls touched by a coordinate measuring machine.
    Balls(Box<Cmm>),
    /// The sensors of the machine, beside some of the six numbers or none.
    Sensors(PoseNumbersRead),
}

/// Which of the six numbers of a deflection are read beside sensors.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseNumbersRead {
    /// Indices: translations, then rotations.
    pub numbers: Vec<usize>,
    /// Their noise; none where none is read.
    pub noise: Option<InstrumentNoise>,
}

impl PoseNumbersRead {
    /// What is read in every row.
    pub(super) fn channels(&self, hexapod: &Hexapod) -> Vec<Channel> {
        Channel::all(self.numbers.iter().copied(), &hexapod.sensors)
    }

    /// Standard deviation of what a channel reads, m or rad; all errors are independent.
    pub(super) fn sigma(&self, channel: Channel, hexapod: &Hexapod) -> f64 {
        channel.stated_sigma(&hexapod.sensors, self.noise.map(|noise| noise.metrology())).unwrap_or(UNREAD)
    }
}

const KEYS: &[KeyUnit] = &[
    KeyUnit::plain("kind"),
    KeyUnit::with_unit("sigma_translation", Dimension::Length, "um"),
    KeyUnit::with_unit("sigma_rotation", Dimension::Angle, "urad"),
    KeyUnit::plain("blunder_share"),
    KeyUnit::plain("blunder_sigmas"),
    KeyUnit::with_unit("balls", Dimension::Length, "mm"),
    KeyUnit::with_unit("base_balls", Dimension::Length, "mm"),
    KeyUnit::with_unit("sigma_ball", Dimension::Length, "um"),
    KeyUnit::with_unit("sigma_base_ball", Dimension::Length, "um"),
    KeyUnit::plain("drift_um_per_h"),
    KeyUnit::plain("drift_urad_per_h"),
    KeyUnit::plain("scale_ppm_per_K"),
    KeyUnit::with_unit("blunder", Dimension::Length, "um"),
    KeyUnit::plain("read"),
];
const OF_SENSORS: &[&str] = &["kind", "read", "sigma_translation", "sigma_rotation"];
const OF_NUMBERS: &[&str] =
    &["kind", "sigma_translation", "sigma_rotation", "blunder_share", "blunder_sigmas"];
const OF_BALLS: &[&str] = &[
    "kind",
    "balls",
    "base_balls",
    "sigma_ball",
    "sigma_base_ball",
    "drift_um_per_h",
    "drift_urad_per_h",
    "scale_ppm_per_K",
    "blunder_share",
    "blunder",
];
const SIGMA: &str = "a standard deviation";
const SECONDS_PER_HOUR: f64 = 3600.0;

impl Instrument {
    /// What the hexapod's file states about it: one reading of a deflection or of an absolute pose; none where only sensors are read.
    ///
    /// # Errors
    /// [`TruthError::Balls`] for balls that do not determine a pose.
    pub fn metrology(&self, measurand: Measurand) -> Result<Option<Metrology>, TruthError> {
        let cmm = match self {
            Self::Numbers(noise) => return Ok(Some(noise.metrology())),
            Self::Sensors(read) => return Ok(read.noise.map(|noise| noise.metrology())),
            Self::Balls(cmm) => cmm,
        };
        let readings = if measurand == Measurand::AbsolutePose { 1.0 } else { 2.0 };
        let variance = cmm.covariance_at(&Pose::default())?.diagonal() * readings;
        let typical = |first: usize| (variance.fixed_rows::<3>(first).sum() / 3.0).sqrt();
        Ok(Some(Metrology { sigma_translation: typical(0), sigma_rotation: typical(3) }))
    }

    /// The same with a noise so many times as large; that of sensors is the machine's own.
    #[must_use]
    pub fn with_noise(mut self, factor: f64) -> Self {
        let scale = |noise: &mut InstrumentNoise| {
            noise.sigma_translation *= factor;
            noise.sigma_rotation *= factor;
        };
        match &mut self {
            Self::Numbers(noise) => scale(noise),
            Self::Sensors(read) => read.noise.iter_mut().for_each(scale),
            Self::Balls(cmm) => {
                cmm.platform.sigma *= factor;
                cmm.base.iter_mut().for_each(|base| base.sigma *= factor);
            }
        }
        self
    }

    /// Three balls on the platform that tell a reading as well as independent noise on its six numbers; none for another instrument.
    ///
    /// From the covariance of [`Balls::covariance`] for a triangle of radius r: s^2 / 3 of each translation, in the mean 5 s^2 / (9 r^2) of a
    /// rotation, twice that for the difference of two records.
    pub fn as_balls(&self, measurand: Measurand) -> Option<Self> {
        let Self::Numbers(noise) = self else { return None };
        let records = if measurand == Measurand::AbsolutePose { 1.0 } else { 2.0 };
        let sigma = noise.sigma_translation * (3.0_f64 / records).sqrt();
        let radius = (5.0_f64 / 3.0).sqrt() * noise.sigma_translation / noise.sigma_rotation;
        Some(Self::Balls(Box::new(Cmm {
            platform: Balls::triangle(radius, sigma),
            base: None,
            drift: [0.0; 6],
            scale_per_k: 0.0,
            blunder_share: noise.blunder_rate,
            blunder: noise.blunder_sigmas * sigma,
        })))
    }

    /// Reads `[instrument]`.
    pub(super) fn read(top: &TomlSection<'_>) -> Result<Self, Fault> {
        let table = top.section("instrument", "[instrument]", KEYS)?;
        let kind = table.require("kind")?;
        match kind.string()? {
            "numbers" => {
                refuse_others(&table, OF_NUMBERS, "numbers")?;
                numbers(&table).map(Self::Numbers)
            }
            "balls" => {
                refuse_others(&table, OF_BALLS, "balls")?;
                cmm(&table).map(|cmm| Self::Balls(Box::new(cmm)))
            }
            "sensors" => {
                refuse_others(&table, OF_SENSORS, "sensors")?;
                sensors(&table).map(Self::Sensors)
            }
            _ => Err(kind.breaks(
                "an instrument reads \"numbers\", \"balls\" or \"sensors\"",
                "Write one of the three.",
            )),
        }
    }
}

fn refuse_others(table: &TomlSection<'_>, known: &[&str], kind: &str) -> Result<(), Fault> {
    let mut strays = KEYS.iter().map(KeyUnit::name).filter(|key| !known.contains(key));
    match strays.find_map(|key| table.get(key)) {
        None => Ok(()),
        Some(stray) => {
            Err(stray.breaks(format!("an instrument of the kind \"{kind}\" has no such key"), "Remove it."))
        }
    }
}

fn number_or(table: &TomlSection<'_>, key: &str, usual: f64) -> Result<f64, Fault> {
    table.get(key).map_or(Ok(usual), Item::number)
}

fn share(table: &TomlSection<'_>) -> Result<f64, Fault> {
    let Some(item) = table.get("blunder_share") else { return Ok(0.0) };
    match item.number()? {
        share if (0.0..=1.0).contains(&share) => Ok(share),
        _ => Err(item.breaks("a share lies between 0 and 1", "Write for example 0.01 for one in a hundred.")),
    }
}

/// Names of the six numbers in `read`.
const NUMBERS: [&str; 6] = Measurand::DeflectionEuler.names();

fn sensors(table: &TomlSection<'_>) -> Result<PoseNumbersRead, Fault> {
    let Some(item) = table.get("read") else {
        return Ok(PoseNumbersRead { numbers: Vec::new(), noise: None });
    };
    let mut numbers = Vec::new();
    for member in item.list()? {
        let name = member.string()?;
        let next = || format!("Write some of {}, each once.", NUMBERS.join(", "));
        match NUMBERS.iter().position(|n| *n == name) {
            Some(k) if !numbers.contains(&k) => numbers.push(k),
            _ => {
                return Err(
                    member.breaks(format!("\"{name}\" is no number of a deflection, or the second"), next())
                );
            }
        }
    }
    numbers.sort_unstable();
    let noise = InstrumentNoise {
        sigma_translation: table.require("sigma_translation")?.positive(SIGMA)?,
        sigma_rotation: table.require("sigma_rotation")?.positive(SIGMA)?,
        ..InstrumentNoise::default()
    };
    Ok(PoseNumbersRead { numbers, noise: Some(noise) })
}

fn numbers(table: &TomlSection<'_>) -> Result<InstrumentNoise, Fault> {
    Ok(InstrumentNoise {
        sigma_translation: table.require("sigma_translation")?.positive(SIGMA)?,
        sigma_rotation: table.require("sigma_rotation")?.positive(SIGMA)?,
        blunder_rate: share(table)?,
        blunder_sigmas: number_or(table, "blunder_sigmas", InstrumentNoise::default().blunder_sigmas)?,
    })
}

fn cmm(table: &TomlSection<'_>) -> Result<Cmm, Fault> {
    let sigma = table.require("sigma_ball")?.positive(SIGMA)?;
    let sigma_base = table.get("sigma_base_ball").map_or(Ok(sigma), |item| item.positive(SIGMA))?;
    let [um, urad] = [rates(table, "drift_um_per_h")?, rates(table, "drift_urad_per_h")?];
    Ok(Cmm {
        platform: balls(table.require("balls")?, sigma)?,
        base: table.get("base_balls").map(|item| balls(item, sigma_base)).transpose()?,
        drift: std::array::from_fn(|k| if k < 3 { um[k] } else { urad[k - 3] }),
        scale_per_k: number_or(table, "scale_ppm_per_K", 0.0)? * 1e-6,
        blunder_share: share(table)?,
        blunder: number_or(table, "blunder", 50e-6)?,
    })
}

/// Three rates, millionths per hour, in SI.
fn rates(table: &TomlSection<'_>, key: &str) -> Result<[f64; 3], Fault> {
    let rates = table.get(key).map_or(Ok([0.0; 3]), |item| item.numbers::<3>("three rates"))?;
    Ok(rates.map(|rate| rate * 1e-6 / SECONDS_PER_HOUR))
}

fn balls(item: &Item<'_>, sigma: f64) -> Result<Balls, Fault> {
    let point = |row: &Item<'_>| row.numbers::<3>("three coordinates [x, y, z]").map(Vector3::from);
    let balls = Balls { centres: item.list()?.iter().map(point).collect::<Result<_, _>>()?, sigma };
    match balls.register(&balls.centres) {
        Ok(_) => Ok(balls),
        Err(_) => Err(item.breaks("three balls or more that are not on one line are needed", "Add a ball.")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn balls_in_place_of_numbers_are_as_good() {
        let noise =
            InstrumentNoise { sigma_translation: 0.4e-6, sigma_rotation: 5e-6, ..InstrumentNoise::default() };
        for measurand in [Measurand::AbsolutePose, Measurand::DeflectionEuler] {
            let balls = Instrument::Numbers(noise).as_balls(measurand).unwrap();
            let found = balls.metrology(measurand).unwrap().unwrap();
            assert!((found.sigma_translation / 0.4e-6 - 1.0).abs() < 1e-12, "{found:?}");
            assert!((found.sigma_rotation / 5e-6 - 1.0).abs() < 1e-12, "{found:?}");
            assert!(balls.as_balls(measurand).is_none());
        }
    }
}
