//! A term that a user defines in a small file instead of Rust.
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
//! reference and load (N, N m, mobile origin, fixed axes; "" for zero), `base_motion` (m, rad, fixed origin and axes) or
//! `platform_motion` (of what is measured against the platform joints; mobile origin and axes). `legs = [1, 4]` confines an
//! elongation to some legs. Several laws in one file stand in `[[laws]]`, each with one of these keys; the term is their sum.
//! A parameter with `per_leg = true` has a size of its own in every leg. Everything in formulas is SI; [`variables()`] lists
//! what they may mention. A formula must be linear in its parameters; what is not goes into `[shape]` (one number, profiled):
//! name, unit, bounds, grid. `prior` (0 to 1; 1 when absent) is how probable the effect is before any reading, beside one of the
//! catalogue: a law that was chosen out of many states it, so that it has to do better than an effect that nobody searched for.

mod file;
mod function;
mod help;
mod linearity;
mod part;
mod variables;

use std::sync::Arc;

use hexbench_core::Vector6;
use thiserror::Error;

use crate::effects::chain::Action;
use crate::effects::formula::{Formula, FormulaError, UnitPowers, dimension_of};
use crate::effects::intern;
use crate::effects::term::{Chapter, Need, ParameterInfo, Rich, Shape, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

use file::File;
pub(crate) use file::MOST_SHAPES;
pub use function::{Law, LawOfProgram, LawQuestion, of_function};
pub use help::{EXAMPLE, FormulaVariable, functions, units, variables};
use part::Part;
pub(crate) use part::PartKind;
pub(crate) use variables::LegVariables;
use variables::{OF_LEG, OF_READING};

/// Why a text does not describe a term.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum UserTermError {
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

/// Parameters of a term at most, those of every leg counted: the cost of a fit goes with the square of their number.
const MOST_PARAMETERS: usize = 36;

/// Which parameter of the file, of which leg, a parameter of the term is.
#[derive(Debug, Clone, Copy)]
struct Owner {
    parameter: usize,
    /// The only leg it acts on.
    leg: Option<usize>,
}

/// A term from a file.
struct UserTerm {
    info: TermInfo,
    definition: String,
    parts: Vec<Part>,
    /// Parts in which each parameter of the file stands.
    acting: Vec<Vec<usize>>,
    /// Of every parameter of the term.
    owners: Vec<Owner>,
    /// Parameters of the file.
    parameters: usize,
    grid: Vec<f64>,
    log_prior: f64,
}

/// Bytes that all distinct term files read so far have left in memory until the program ends: ids, names, units, needs.
pub fn kept_bytes() -> usize {
    intern::kept_bytes()
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
    // A size may have any unit: it is what makes the formula right.
    let sizes = parameters.iter().map(|p| (p.name, None));
    let own: Vec<_> = sizes.chain(shape.as_ref().map(|s| (s.0.name, dimension_of(s.0.unit)))).collect();
    let parts = Part::all(&file, &own)?;
    refuse_idle_parameters(&parts, &own)?;
    refuse_mixed_parameters(&parts, &parameters)?;
    check_linearity(&parts, &parameters, &grid)?;
    let (expanded, owners) = expanded(&file, &parameters)?;
    refuse_legs_of_others(&parts, &parameters, &owners)?;
    let formulas = parts.iter().flat_map(Part::formulas);
    let equation = formulas.map(Formula::text).collect::<Vec<_>>().join("; ");
    let uses = |name: &str| parts.iter().any(|part| part.uses(name));
    let info = described(&file, &expanded, shape.map(|s| s.0), &equation, uses);
    let parameters = parameters.len();
    let acting = |k: usize| (0..parts.len()).filter(|&part| parts[part].uses_own(k)).collect();
    let acting = (0..parameters).map(acting).collect();
    let log_prior = file.log_prior()?;
    Ok(Arc::new(UserTerm {
        info,
        definition: text.to_owned(),
        parts,
        acting,
        owners,
        parameters,
        grid,
        log_prior,
    }))
}

fn refuse_same_name(parameters: &[ParameterInfo], shape: Option<&Shape>) -> Result<(), UserTermError> {
    let same = shape.filter(|s| parameters.iter().any(|p| p.name == s.name));
    same.map_or(Ok(()), |s| Err(UserTermError::rule("shape", format!("`{}` is also a parameter", s.name))))
}

fn refuse_idle_parameters(parts: &[Part], own: &[(&str, Option<UnitPowers>)]) -> Result<(), UserTermError> {
    let idle = (0..own.len()).find(|&k| !parts.iter().any(|part| part.uses_own(k)));
    idle.map_or(Ok(()), |k| {
        Err(UserTermError::rule("parameters", format!("`{}` appears in no formula", own[k].0)))
    })
}

/// One parameter acts in one way.
fn refuse_mixed_parameters(parts: &[Part], parameters: &[ParameterInfo]) -> Result<(), UserTermError> {
    for (k, p) in parameters.iter().enumerate() {
        let mut kinds = parts.iter().filter(|part| part.uses_own(k)).map(|part| part.kind);
        let first = kinds.next();
        if let Some(other) = kinds.find(|kind| Some(*kind) != first) {
            let one = first.map_or("", PartKind::key);
            let why =
                format!("`{}` stands in {one} and in {}; give each its own parameter", p.name, other.key());
            return Err(UserTermError::rule("laws", why));
        }
    }
    Ok(())
}

/// Only an elongation has a size in every leg.
fn refuse_legs_of_others(
    parts: &[Part],
    parameters: &[ParameterInfo],
    owners: &[Owner],
) -> Result<(), UserTermError> {
    let is_other = |k: usize| parts.iter().any(|p| p.uses_own(k) && p.kind != PartKind::Elongation);
    let wrong = owners.iter().find(|owner| owner.leg.is_some() && is_other(owner.parameter));
    wrong.map_or(Ok(()), |owner| {
        let why = format!("`{}` stands in what does not belong to legs", parameters[owner.parameter].name);
        Err(UserTermError::rule("per_leg", why))
    })
}

fn check_linearity(parts: &[Part], parameters: &[ParameterInfo], grid: &[f64]) -> Result<(), UserTermError> {
    for part in parts {
        let variables = part.kind.variables();
        part.formulas().try_for_each(|f| linearity::check(f, &variables, parameters, grid))?;
    }
    Ok(())
}

/// Parameters of the term: those of the file, of each leg where they differ.
fn expanded(
    file: &File,
    parameters: &[ParameterInfo],
) -> Result<(Vec<ParameterInfo>, Vec<Owner>), UserTermError> {
    let (all, owners) = file.expanded(parameters);
    if all.len() > MOST_PARAMETERS {
        let why = format!("{} of them, those of every leg counted; at most {MOST_PARAMETERS}", all.len());
        return Err(UserTermError::rule("parameters", why));
    }
    Ok((all, owners))
}

/// What is known of a term; `uses` tells whether its laws take a variable.
fn described(
    file: &File,
    parameters: &[ParameterInfo],
    shape: Option<Shape>,
    equation: &str,
    uses: impl Fn(&str) -> bool,
) -> TermInfo {
    let covariates = [("elapsed", Need::Elapsed), ("approach", Need::Approach), ("delta_T", Need::DeltaT)];
    let needs: Vec<Need> = covariates.into_iter().filter(|(name, _)| uses(name)).map(|c| c.1).collect();
    TermInfo {
        id: intern::text(&file.id),
        title: intern::text(&file.title),
        chapter: Chapter::Own,
        physics: intern::text(&file.physics),
        equation: intern::text(equation),
        source: "a term file of the user",
        shows: "the variables of its formula vary",
        how_to_isolate: "vary the variables of the formula of the user's term, one at a time",
        parameters: intern::parameters(parameters),
        shape,
        needs: intern::needs(&needs),
        rich: Rich::None,
    }
}

/// One action of every parameter; `vector` gives the kind and the six numbers of a parameter as the laws have it.
fn push_by_owner(
    owners: &[Owner],
    at: &Condition,
    out: &mut Vec<Action>,
    mut vector: impl FnMut(usize) -> (PartKind, Vector6),
) {
    for legs in owners.chunk_by(|a, b| a.parameter == b.parameter) {
        let (kind, sum) = vector(legs[0].parameter);
        let of_leg = |leg| Vector6::from_fn(|k, _| if k == leg { sum[k] } else { 0.0 });
        out.extend(legs.iter().map(|owner| kind.action(at, &owner.leg.map_or(sum, of_leg))));
    }
}

impl UserTerm {
    /// Memory for the values of one evaluation.
    fn memory(&self) -> Vec<f64> {
        Vec::with_capacity(OF_LEG.len() + OF_READING.len() + self.parameters + 1)
    }

    /// Parameter `k` of the file at one and the others at zero, then the shape.
    fn unit(&self, k: usize, shape: f64) -> Vec<f64> {
        (0..self.parameters).map(|j| f64::from(u8::from(j == k))).chain([shape]).collect()
    }

    /// Parts in which a parameter of the file stands.
    fn parts_of(&self, k: usize) -> impl Iterator<Item = &Part> {
        self.acting[k].iter().map(|&part| &self.parts[part])
    }
}

impl Term for UserTerm {
    fn info(&self) -> &TermInfo {
        &self.info
    }

    fn actions(&self, machine: &Machine, at: &Condition, shape: f64, out: &mut Vec<Action>) {
        let mut memory = self.memory();
        push_by_owner(&self.owners, at, out, |parameter| {
            let own = self.unit(parameter, shape);
            let (mut sum, mut kind) = (Vector6::zeros(), PartKind::Elongation);
            for part in self.parts_of(parameter) {
                sum += part.vector(machine, at, &own, &mut memory);
                kind = part.kind;
            }
            (kind, sum)
        });
    }

    fn fault(&self, machine: &Machine, at: &Condition) -> Option<String> {
        let shapes = if self.grid.is_empty() { vec![1.0] } else { self.grid.clone() };
        let mut memory = self.memory();
        for (k, shape) in (0..self.parameters).flat_map(|k| shapes.iter().map(move |s| (k, *s))) {
            let own = self.unit(k, shape);
            for part in self.parts_of(k) {
                let vector = part.vector(machine, at, &own, &mut memory);
                if let Some(bad) = (0..6).find(|&i| !vector[i].is_finite()) {
                    let (formula, story) = (self.info.equation, part.story(machine, at, bad));
                    return Some(format!("`{formula}` gives {} at {story}", vector[bad]));
                }
            }
        }
        None
    }

    fn log_prior(&self) -> f64 {
        self.log_prior
    }

    fn definition(&self) -> Option<&str> {
        Some(&self.definition)
    }

    fn shape_grid(&self, _: &[Condition]) -> Vec<f64> {
        self.grid.clone()
    }
}
