//! What a scene is measured with.

use hexbench_core::{
    Measurand, Metrology, Pose, Vector3,
    files::{Fault, Item, Key, Kind, Section},
};

use crate::{
    TruthError,
    metrology::{Balls, Cmm, Noise},
};

/// The instrument of a scene.
#[derive(Debug, Clone, PartialEq)]
pub enum Instrument {
    /// Independent noise on the six numbers of a reading.
    Numbers(Noise),
    /// Balls touched by a coordinate measuring machine.
    Balls(Box<Cmm>),
}

const KEYS: &[Key] = &[
    Key::plain("kind"),
    Key::with_unit("sigma_translation", Kind::Length, "um"),
    Key::with_unit("sigma_rotation", Kind::Angle, "urad"),
    Key::plain("blunder_share"),
    Key::plain("blunder_sigmas"),
    Key::with_unit("balls", Kind::Length, "mm"),
    Key::with_unit("base_balls", Kind::Length, "mm"),
    Key::with_unit("sigma_ball", Kind::Length, "um"),
    Key::with_unit("sigma_base_ball", Kind::Length, "um"),
    Key::plain("drift_um_per_h"),
    Key::plain("drift_urad_per_h"),
    Key::plain("scale_ppm_per_K"),
    Key::with_unit("blunder", Kind::Length, "um"),
];
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
    /// What the hexapod's file states about it: one reading of a deflection or of an absolute pose.
    ///
    /// # Errors
    /// [`TruthError::Balls`] for balls that do not determine a pose.
    pub fn metrology(&self, measurand: Measurand) -> Result<Metrology, TruthError> {
        let cmm = match self {
            Self::Numbers(noise) => return Ok(noise.metrology()),
            Self::Balls(cmm) => cmm,
        };
        let readings = if measurand == Measurand::AbsolutePose { 1.0 } else { 2.0 };
        let variance = cmm.covariance_at(&Pose::default())?.diagonal() * readings;
        let typical = |first: usize| (variance.fixed_rows::<3>(first).sum() / 3.0).sqrt();
        Ok(Metrology { sigma_translation: typical(0), sigma_rotation: typical(3) })
    }

    /// Reads `[instrument]`.
    pub(super) fn read(top: &Section<'_>) -> Result<Self, Fault> {
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
            _ => Err(kind.breaks("an instrument reads \"numbers\" or \"balls\"", "Write one of the two.")),
        }
    }
}

fn refuse_others(table: &Section<'_>, known: &[&str], kind: &str) -> Result<(), Fault> {
    let mut strays = KEYS.iter().map(Key::name).filter(|key| !known.contains(key));
    match strays.find_map(|key| table.get(key)) {
        None => Ok(()),
        Some(stray) => {
            Err(stray.breaks(format!("an instrument of the kind \"{kind}\" has no such key"), "Remove it."))
        }
    }
}

fn number_or(table: &Section<'_>, key: &str, usual: f64) -> Result<f64, Fault> {
    table.get(key).map_or(Ok(usual), Item::number)
}

fn share(table: &Section<'_>) -> Result<f64, Fault> {
    let Some(item) = table.get("blunder_share") else { return Ok(0.0) };
    match item.number()? {
        share if (0.0..=1.0).contains(&share) => Ok(share),
        _ => Err(item.breaks("a share lies between 0 and 1", "Write for example 0.01 for one in a hundred.")),
    }
}

fn numbers(table: &Section<'_>) -> Result<Noise, Fault> {
    Ok(Noise {
        sigma_translation: table.require("sigma_translation")?.positive(SIGMA)?,
        sigma_rotation: table.require("sigma_rotation")?.positive(SIGMA)?,
        blunder_rate: share(table)?,
        blunder_sigmas: number_or(table, "blunder_sigmas", Noise::default().blunder_sigmas)?,
    })
}

fn cmm(table: &Section<'_>) -> Result<Cmm, Fault> {
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
fn rates(table: &Section<'_>, key: &str) -> Result<[f64; 3], Fault> {
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
