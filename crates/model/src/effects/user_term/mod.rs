//! A term that a user describes in a small file instead of Rust.
//!
//! ```toml
//! format = "term/1"
//! id = "square-spring"
//! title = "Legs that soften with the square of the force"
//! elongation = "size * (f*abs(f) - f0*abs(f0)) / 100"      # of each leg, m
//!
//! [[parameters]]
//! name = "size"
//! unit = "nm/N"
//! scale = 20            # its physically sensible size, in that unit
//! positive = true
//! ```
//!
//! Instead of `elongation` there may be `wrench`, six formulas for the change of the wrench on the platform between
//! reference and load (N, N m, mobile origin, fixed axes; "" for zero). Everything in formulas is SI. Variables of a
//! leg: `f`, `f0`, `df` (N), `q`, `q_home` (m), `nx`, `ny`, `nz`, `leg` (1 to 6). Variables of the reading: `approach`,
//! `delta_T`, `elapsed`, `a`, `b`, `c`, `alpha`, `beta`, `gamma`, `fx` ... `mz`, `ref_fx` ... `ref_mz`. A formula must be
//! linear in its parameters; what is not goes into `[shape]` (one number, profiled): name, unit, bounds, grid.

mod file;
mod help;
mod linearity;
mod variables;

use std::path::Path;
use std::sync::Arc;

use hexbench_core::Vector6;
use thiserror::Error;

use crate::effects::chain::Action;
use crate::effects::formula::{Formula, FormulaError};
use crate::effects::intern;
use crate::effects::term::{Chapter, Need, ParameterInfo, Rich, Shape, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

use file::File;
pub use help::{EXAMPLE, FormulaVariable, functions, units, variables};
use variables::{OF_LEG, OF_READING};

/// Largest file read, bytes.
const LARGEST_FILE: u64 = 1 << 20;

/// Why a text does not describe a term.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum UserTermError {
    /// The file cannot be read.
    #[error("cannot be read: {0}")]
    Read(String),
    /// Not TOML, an unknown key, a missing key, a value of another type.
    #[error("{0}")]
    Toml(String),
    /// A key whose value breaks a rule.
    #[error("{key}: {why}")]
    Rule {
        /// The key.
        key: &'static str,
        /// The rule.
        why: String,
    },
    /// A text that is no formula.
    #[error("{key} = \"{formula}\": {error}")]
    Formula {
        /// The key.
        key: &'static str,
        /// As written, shortened.
        formula: String,
        /// What is wrong.
        error: FormulaError,
    },
    /// A formula that bends with a parameter.
    #[error(
        "`{formula}` is not linear in `{parameter}` (twice the value must give twice the effect, zero none); declare one \
         such number as [shape] with name, unit, bounds and grid"
    )]
    NotLinear {
        /// The formula.
        formula: String,
        /// The parameter.
        parameter: String,
    },
    /// A formula without finite value at ordinary readings.
    #[error("`{formula}` has no finite value at ordinary readings, for example at {at}")]
    NoValue {
        /// The formula.
        formula: String,
        /// Where it was tried.
        at: String,
    },
}

impl UserTermError {
    fn rule(key: &'static str, why: String) -> Self {
        Self::Rule { key, why }
    }
}

/// What the formulas give.
enum Effect {
    Elongation(Formula),
    Wrench(Vec<Option<Formula>>),
}

/// A term from a file.
struct UserTerm {
    info: TermInfo,
    definition: String,
    effect: Effect,
    grid: Vec<f64>,
}

/// The term a TOML text describes.
///
/// # Errors
/// [`UserTermError`].
///
/// # Example
/// ```
/// let text = r#"
///     format = "term/1"
///     id = "warm-legs"
///     title = "Legs grow when warm"
///     elongation = "rate * q * delta_T"
///     [[parameters]]
///     name = "rate"
///     unit = "um/(m K)"
///     scale = 12
/// "#;
/// let term = hexbench_model::effects::user_term::parse(text)?;
/// assert_eq!(term.info().id, "warm-legs");
/// # Ok::<(), hexbench_model::effects::user_term::UserTermError>(())
/// ```
pub fn parse(text: &str) -> Result<Arc<dyn Term>, UserTermError> {
    let file = File::parse(text)?;
    let parameters = file.parameters()?;
    let shape = file.shape()?;
    refuse_same_name(&parameters, shape.as_ref().map(|s| &s.0))?;
    let grid = shape.as_ref().map_or_else(Vec::new, |s| s.1.clone());
    let effect = effect(&file, &parameters, shape.as_ref().map(|s| &s.0))?;
    refuse_idle_parameters(&effect, &parameters, shape.as_ref().map(|s| &s.0))?;
    check_linearity(&effect, &parameters, &grid)?;
    let info = info(&file, &parameters, shape.map(|s| s.0), &effect);
    Ok(Arc::new(UserTerm { info, definition: text.to_owned(), effect, grid }))
}

/// The term a file describes.
///
/// # Errors
/// [`UserTermError`].
pub fn read(path: &Path) -> Result<Arc<dyn Term>, UserTermError> {
    let unreadable = |e: std::io::Error| UserTermError::Read(e.to_string());
    if std::fs::metadata(path).map_err(unreadable)?.len() > LARGEST_FILE {
        return Err(UserTermError::Read(
            "a term file is a few lines; this one is larger than 1 MiB".to_owned(),
        ));
    }
    parse(&std::fs::read_to_string(path).map_err(unreadable)?)
}

fn refuse_same_name(parameters: &[ParameterInfo], shape: Option<&Shape>) -> Result<(), UserTermError> {
    let same = shape.filter(|s| parameters.iter().any(|p| p.name == s.name));
    same.map_or(Ok(()), |s| Err(UserTermError::rule("shape", format!("`{}` is also a parameter", s.name))))
}

fn effect(file: &File, parameters: &[ParameterInfo], shape: Option<&Shape>) -> Result<Effect, UserTermError> {
    let own: Vec<&str> = parameters.iter().map(|p| p.name).chain(shape.map(|s| s.name)).collect();
    let of_reading: Vec<&str> = OF_READING.into_iter().chain(own.iter().copied()).collect();
    let of_leg: Vec<&str> = OF_LEG.into_iter().chain(of_reading.iter().copied()).collect();
    match (&file.elongation, &file.wrench) {
        (Some(text), None) => Ok(Effect::Elongation(formula("elongation", text, &of_leg)?)),
        (None, Some(texts)) => {
            let parse =
                |t: &String| (!t.trim().is_empty()).then(|| formula("wrench", t, &of_reading)).transpose();
            Ok(Effect::Wrench(texts.iter().map(parse).collect::<Result<_, _>>()?))
        }
        _ => Err(UserTermError::rule(
            "elongation",
            "exactly one of elongation and wrench is needed".to_owned(),
        )),
    }
}

fn formula(key: &'static str, text: &str, names: &[&str]) -> Result<Formula, UserTermError> {
    let shown = || text.chars().take(60).collect();
    Formula::parse(text, names).map_err(|error| UserTermError::Formula { key, formula: shown(), error })
}

impl Effect {
    fn formulas(&self) -> Vec<&Formula> {
        match self {
            Self::Elongation(f) => vec![f],
            Self::Wrench(all) => all.iter().flatten().collect(),
        }
    }

    /// Number of variables before the parameters in the formulas' list of names.
    fn variables(&self) -> Vec<&'static str> {
        match self {
            Self::Elongation(_) => OF_LEG.into_iter().chain(OF_READING).collect(),
            Self::Wrench(_) => OF_READING.to_vec(),
        }
    }

    fn uses(&self, name: &str) -> bool {
        let index = self.variables().iter().position(|v| *v == name);
        index.is_some_and(|k| self.formulas().iter().any(|f| f.uses(k)))
    }
}

fn refuse_idle_parameters(
    effect: &Effect,
    parameters: &[ParameterInfo],
    shape: Option<&Shape>,
) -> Result<(), UserTermError> {
    let first = effect.variables().len();
    let names = parameters.iter().map(|p| p.name).chain(shape.map(|s| s.name));
    for (k, name) in names.enumerate() {
        if !effect.formulas().iter().any(|f| f.uses(first + k)) {
            return Err(UserTermError::rule("parameters", format!("`{name}` appears in no formula")));
        }
    }
    Ok(())
}

fn check_linearity(effect: &Effect, parameters: &[ParameterInfo], grid: &[f64]) -> Result<(), UserTermError> {
    let variables = effect.variables();
    effect.formulas().into_iter().try_for_each(|f| linearity::check(f, &variables, parameters, grid))
}

fn info(file: &File, parameters: &[ParameterInfo], shape: Option<Shape>, effect: &Effect) -> TermInfo {
    let equation = effect.formulas().iter().map(|f| f.text()).collect::<Vec<_>>().join("; ");
    let covariates = [("elapsed", Need::Elapsed), ("approach", Need::Approach), ("delta_T", Need::DeltaT)];
    let needs: Vec<Need> =
        covariates.into_iter().filter(|(name, _)| effect.uses(name)).map(|c| c.1).collect();
    TermInfo {
        id: intern::text(&file.id),
        title: intern::text(&file.title),
        chapter: Chapter::Own,
        physics: intern::text(&file.physics),
        equation: intern::text(&equation),
        source: "a term file of the user",
        shows: "the variables of its formula vary",
        how_to_isolate: "vary the variables of the formula of the user's term, one at a time",
        parameters: intern::parameters(parameters),
        shape,
        needs: intern::needs(&needs),
        rich: Rich::None,
    }
}

impl UserTerm {
    /// Value of one formula with parameter `k` at one and the others at zero.
    fn unit(&self, formula: &Formula, variables: &[f64], k: usize, shape: f64) -> f64 {
        let mut values = variables.to_vec();
        values.extend((0..self.info.parameters.len()).map(|j| f64::from(u8::from(j == k))));
        values.push(shape);
        formula.value(&values)
    }

    fn elongation(
        &self,
        formula: &Formula,
        machine: &Machine,
        at: &Condition,
        k: usize,
        shape: f64,
    ) -> Vector6 {
        let reading = variables::of_reading(at);
        Vector6::from_fn(|leg, _| {
            let mut values = variables::of_leg(machine, at, leg).to_vec();
            values.extend(&reading);
            self.unit(formula, &values, k, shape)
        })
    }

    fn wrench(&self, formulas: &[Option<Formula>], at: &Condition, k: usize, shape: f64) -> Vector6 {
        let reading = variables::of_reading(at);
        Vector6::from_fn(|axis, _| {
            let formula = formulas.get(axis).and_then(Option::as_ref);
            formula.map_or(0.0, |f| self.unit(f, &reading, k, shape))
        })
    }

    fn vector(&self, machine: &Machine, at: &Condition, k: usize, shape: f64) -> Vector6 {
        match &self.effect {
            Effect::Elongation(f) => self.elongation(f, machine, at, k, shape),
            Effect::Wrench(all) => self.wrench(all, at, k, shape),
        }
    }

    /// The variables with which the effect went wrong in component `index` (leg or axis, from zero).
    fn story(&self, machine: &Machine, at: &Condition, index: usize) -> String {
        let mut values = variables::of_reading(at);
        if matches!(self.effect, Effect::Elongation(_)) {
            values.splice(0..0, variables::of_leg(machine, at, index));
        }
        let formulas = self.effect.formulas();
        variables::describe(&self.effect.variables(), &values, |k| formulas.iter().any(|f| f.uses(k)))
    }
}

impl Term for UserTerm {
    fn info(&self) -> &TermInfo {
        &self.info
    }

    fn actions(&self, machine: &Machine, at: &Condition, shape: f64, out: &mut Vec<Action>) {
        for k in 0..self.info.parameters.len() {
            let vector = self.vector(machine, at, k, shape);
            out.push(match &self.effect {
                Effect::Elongation(_) => Action::Elongation(vector),
                Effect::Wrench(_) => Action::Wrench(vector),
            });
        }
    }

    fn fault(&self, machine: &Machine, at: &Condition) -> Option<String> {
        let shapes = if self.grid.is_empty() { vec![1.0] } else { self.grid.clone() };
        for (k, shape) in (0..self.info.parameters.len()).flat_map(|k| shapes.iter().map(move |s| (k, *s))) {
            let vector = self.vector(machine, at, k, shape);
            if let Some(bad) = (0..6).find(|&i| !vector[i].is_finite()) {
                let (formula, story) = (self.info.equation, self.story(machine, at, bad));
                return Some(format!("`{formula}` gives {} at {story}", vector[bad]));
            }
        }
        None
    }

    fn definition(&self) -> Option<&str> {
        Some(&self.definition)
    }

    fn shape_grid(&self, _: &[Condition]) -> Vec<f64> {
        self.grid.clone()
    }
}
