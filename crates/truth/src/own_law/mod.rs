//! An elongation of legs defined by a formula in a scene: `out:formula`.
//!
//! ```text
//! e_i += factor * formula(f_i, q_i, pose, wrench, ...)        for each leg it names
//! ```
//!
//! The formula gives the additional length of a leg in a state of the machine, including the reference state; as for every
//! mechanism, the deflection is the difference of both. Together with the leg spring, the elongation must increase with the force,
//! or the leg has no equilibrium.

mod formula;

use std::collections::BTreeMap;
use std::sync::Arc;

pub use formula::LawFormula;
use hexbench_core::Wrench;
use hexbench_core::parser_words::of_json;
use serde::Deserialize;
use serde_json::{Map, Value, json};

use crate::{Instant, Mechanism, Phase, Setup};

/// Id of every such effect.
pub const OWN_LAW: &str = "out:formula";

/// Variables of a formula; parameters follow.
const VARIABLES: [&str; 20] = [
    "f",
    "q",
    "q_home",
    "leg",
    "approach",
    "delta_T",
    "elapsed",
    "a",
    "b",
    "c",
    "alpha",
    "beta",
    "gamma",
    "fx",
    "fy",
    "fz",
    "mx",
    "my",
    "mz",
    "is_loaded",
];
/// Place of the leg force among the variables.
const FORCE: usize = 0;

/// The elongation of a leg by a formula, at a moment: everything but the leg force is settled.
#[derive(Debug, Clone, PartialEq)]
pub struct OwnElongation {
    formula: Arc<LawFormula>,
    variables: Vec<f64>,
    factor: f64,
}

impl OwnElongation {
    /// Elongation (m) and its slope (m/N) at a leg force (N).
    pub fn at(&self, force: f64) -> (f64, f64) {
        const STEP: f64 = 1e-5;
        let step = STEP * force.abs().max(1.0);
        let mut variables = self.variables.clone();
        let mut value = |force| {
            variables[FORCE] = force;
            self.factor * self.formula.value(&variables)
        };
        let [low, high] = [value(force - step), value(force + step)];
        (value(force), (high - low) / (2.0 * step))
    }
}

/// An effect whose law is a formula.
#[derive(Debug, Clone)]
pub struct OwnLaw {
    formula: Arc<LawFormula>,
    stated: Stated,
    factor: f64,
}

/// As the truth file has it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
struct Stated {
    /// Elongation of a leg, m.
    elongation: String,
    /// Legs that it acts on, from 1; all without.
    legs: Option<Vec<usize>>,
    /// Numbers with names, SI.
    #[serde(flatten)]
    parameters: BTreeMap<String, f64>,
}

impl OwnLaw {
    /// The effect with the keys of a truth file.
    ///
    /// # Errors
    /// What is wrong with them.
    pub(crate) fn parse(value: Value) -> Result<Box<dyn Mechanism>, String> {
        let stated: Stated = serde_json::from_value(value).map_err(|cause| of_json(&cause))?;
        if let Some(name) = stated.parameters.keys().find(|name| VARIABLES.contains(&name.as_str())) {
            return Err(format!("`{name}` is a variable of formulas and no name for a number"));
        }
        let legs = stated.legs.iter().flatten();
        if stated.legs.as_ref().is_some_and(Vec::is_empty)
            || legs.into_iter().any(|leg| !(1..=6).contains(leg))
        {
            return Err("legs are numbers from 1 to 6".to_owned());
        }
        let names: Vec<&str> =
            VARIABLES.into_iter().chain(stated.parameters.keys().map(String::as_str)).collect();
        let formula = Arc::new(LawFormula::new(&stated.elongation, &names)?);
        Ok(Box::new(Self { formula, stated, factor: 1.0 }))
    }

    fn acts_on(&self, leg: usize) -> bool {
        self.stated.legs.as_ref().is_none_or(|legs| legs.contains(&(leg + 1)))
    }

    fn variables(&self, moment: &Instant<'_>, leg: usize) -> Vec<f64> {
        let situation = moment.situation;
        let pose = situation.pose.to_array();
        let wrench: Wrench = match moment.phase {
            Phase::Reference => situation.reference,
            Phase::Overload => situation.exceeded(),
            Phase::Loaded => situation.wrench,
        };
        let of_leg = [0.0, moment.nominal_lengths[leg], moment.home_lengths[leg], leg as f64 + 1.0];
        let surroundings = [situation.approach.sign(), moment.delta_t(), moment.elapsed()];
        let is_loaded = if moment.is_loaded() { 1.0 } else { 0.0 };
        let all = of_leg.into_iter().chain(surroundings).chain(pose).chain(wrench.to_array());
        all.chain([is_loaded]).chain(self.stated.parameters.values().copied()).collect()
    }
}

impl Mechanism for OwnLaw {
    fn id(&self) -> &'static str {
        OWN_LAW
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        for leg in (0..6).filter(|leg| self.acts_on(*leg)) {
            let variables = self.variables(moment, leg);
            let formula = Arc::clone(&self.formula);
            setup.laws[leg].own.push(OwnElongation { formula, variables, factor: self.factor });
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { factor: self.factor * factor, ..self.clone() })
    }

    fn parameters(&self) -> Map<String, Value> {
        let Stated { elongation, legs, parameters } = &self.stated;
        let stated =
            json!({ "elongation": elongation, "legs": legs, "factor": self.factor, "numbers": parameters });
        Map::from_iter([("formula".to_owned(), stated)])
    }
}
