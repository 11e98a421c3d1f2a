//! What a scene is measured with.

use hexbench_core::{
    Metrology,
    files::{Fault, Item, Key, Kind, Problem, Section},
};

use crate::metrology::Noise;

/// The instrument of a scene.
#[derive(Debug, Clone, PartialEq)]
pub enum Instrument {
    /// Independent noise on the six numbers of a reading.
    Numbers(Noise),
}

const KEYS: &[Key] = &[
    Key::plain("kind"),
    Key::with_unit("sigma_translation", Kind::Length, "um"),
    Key::with_unit("sigma_rotation", Kind::Angle, "urad"),
    Key::plain("blunder_share"),
    Key::plain("blunder_sigmas"),
];

impl Instrument {
    /// What the hexapod's file states about it.
    pub fn metrology(&self) -> Metrology {
        match self {
            Self::Numbers(noise) => noise.metrology(),
        }
    }

    /// Reads `[instrument]`.
    pub(super) fn read(top: &Section<'_>) -> Result<Self, Fault> {
        let table = top.section("instrument", "[instrument]", KEYS)?;
        match table.require("kind")?.string()? {
            "numbers" => numbers(&table).map(Self::Numbers),
            _ => Err(table.require("kind")?.fault(Problem::Rule {
                rule: "an instrument is of the kind \"numbers\"".into(),
                next: "Write kind = \"numbers\".".into(),
            })),
        }
    }
}

fn numbers(table: &Section<'_>) -> Result<Noise, Fault> {
    const QUANTITY: &str = "a standard deviation";
    let usual = Noise::default();
    let or = |key: &str, usual: f64| table.get(key).map_or(Ok(usual), Item::number);
    let share = or("blunder_share", usual.blunder_rate)?;
    if !(0.0..=1.0).contains(&share) {
        return Err(table.require("blunder_share")?.fault(Problem::Rule {
            rule: "a share lies between 0 and 1".into(),
            next: "Write for example 0.01 for one reading in a hundred.".into(),
        }));
    }
    Ok(Noise {
        sigma_translation: table.require("sigma_translation")?.positive(QUANTITY)?,
        sigma_rotation: table.require("sigma_rotation")?.positive(QUANTITY)?,
        blunder_rate: share,
        blunder_sigmas: or("blunder_sigmas", usual.blunder_sigmas)?,
    })
}
