//! One campaign on the bench: loaded once, asked about any selection of terms.

mod refusal;

pub use refusal::{Kind, Refusal};

use crate::wire::{
    Ask, Catalogue, Diagnosed, Export, Exported, Guess, Limits, Open, Opened, Revealed, Selection, Text, View,
};

/// Files given on the command line, as text.
#[derive(Debug, Clone)]
pub struct Given {
    /// hexapod.toml
    pub hexapod: Text,
    /// measurements.csv
    pub data: Text,
    /// holdout.csv
    pub holdout: Option<Text>,
}

/// Everything there is to choose from.
pub fn catalogue(limits: Limits) -> Catalogue {
    let help = crate::wire::FormulaHelp {
        variables: vec![],
        functions: vec![],
        units: vec![],
        example: String::new(),
    };
    Catalogue {
        version: env!("CARGO_PKG_VERSION"),
        terms: vec![],
        cases: vec![],
        machines: vec![],
        plans: vec![],
        effects: vec![],
        formula: help,
        limits,
    }
}

/// A campaign on the bench.
#[derive(Debug)]
pub struct Bench {}

impl Bench {
    /// Loads, reads or simulates.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn open(_: &Open, _: Option<&Given>, _: &Limits) -> Result<Self, Refusal> {
        Err(Refusal::bad_input("cannot open yet", ""))
    }

    /// What it is, and the springs alone.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn opened(&self, _id: &str) -> Result<Opened, Refusal> {
        Err(Refusal::bad_input("cannot open yet", ""))
    }

    /// Springs with the selected terms.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn view(&self, _: &Selection) -> Result<View, Refusal> {
        Err(Refusal::bad_input("cannot view yet", ""))
    }

    /// The diagnosis.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn diagnose(&self, _: &Ask) -> Result<Diagnosed, Refusal> {
        Err(Refusal::bad_input("cannot diagnose yet", ""))
    }

    /// A file to take home.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn export(&self, _: &Export) -> Result<Exported, Refusal> {
        Err(Refusal::bad_input("cannot export yet", ""))
    }

    /// What is hidden.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn reveal(&self, _: &Guess) -> Result<Revealed, Refusal> {
        Err(Refusal::bad_input("cannot reveal yet", ""))
    }
}
