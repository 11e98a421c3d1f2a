//! A term whose law is a function of the calling program instead of a formula.
//!
//! Such a function is dear to ask, so it is asked for all conditions at once ([`Term::noting`]), for the variables it names alone, and
//! never twice for the same numbers.

mod trials;

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use hexbench_core::files::nearest;
use hexbench_core::{Remembered, Vector6};

use super::file::File;
use super::variables::{OF_LEG, OF_READING, of_leg, push_of_reading};
use super::{Owner, PartKind, UserTermError, described, expanded, push_by_owner, refuse_same_name};
use crate::effects::chain::Action;
use crate::effects::term::{Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

/// What a law is asked. SI.
#[derive(Debug, Clone, PartialEq)]
pub struct LawQuestion {
    /// Number of conditions.
    pub conditions: usize,
    /// Values of each variable, in the order in which they were named: six per condition for one of a leg, else one.
    pub variables: Vec<Vec<f64>>,
    /// Sizes of the parameters, then the shape where there is one.
    pub sizes: Vec<f64>,
}

/// Six numbers of each condition: of the legs for an elongation, else as the key of a term file says.
pub type Law = Box<dyn Fn(&LawQuestion) -> Vec<[f64; 6]> + Send + Sync>;

/// What stands in the place of the formulas of a term file.
pub struct LawOfProgram {
    /// `elongation`, `wrench`, `base_motion` or `platform_motion`.
    pub acts: String,
    /// Names of the variables it takes.
    pub variables: Vec<String>,
    /// How it is called in texts.
    pub name: String,
    /// The law.
    pub law: Law,
}

/// Bits of the variables, number of the parameter, bits of the shape.
type Key = Box<[u64]>;

/// What is asked: values of the variables at a condition, number of the parameter, shape.
type Question = (Vec<f64>, usize, f64);

/// A term with a law of the calling program.
struct FunctionTerm {
    known: Arc<Known>,
    /// What was asked in vain, where the term only notes it.
    noted: Option<Mutex<Vec<Question>>>,
}

/// The law and its answers.
struct Known {
    info: TermInfo,
    kind: PartKind,
    /// Places of the variables among those of formulas.
    places: Vec<usize>,
    law: Law,
    owners: Vec<Owner>,
    /// Parameters as the law takes them.
    parameters: usize,
    grid: Vec<f64>,
    log_prior: f64,
    answers: Remembered<Key, [f64; 6]>,
}

/// The term of a term file without formulas, and of a law that stands in their place.
///
/// The law is asked for made-up conditions first: it has to be linear in its parameters, and to treat every condition by itself.
///
/// # Errors
/// [`UserTermError`].
pub fn of_function(header: &str, given: LawOfProgram) -> Result<Arc<dyn Term>, UserTermError> {
    let file = File::parse(header)?;
    file.refuse_formulas()?;
    let parameters = file.parameters()?;
    let shape = file.shape()?;
    refuse_same_name(&parameters, shape.as_ref().map(|s| &s.0))?;
    let kind = PartKind::named(&given.acts)
        .ok_or_else(|| UserTermError::rule("acts", format!("`{}` is none of {}", given.acts, kinds())))?;
    let places = given.variables.iter().map(|name| place(kind, name)).collect::<Result<Vec<_>, _>>()?;
    let (info, grid) = shape.map_or_else(|| (None, Vec::new()), |(shape, grid)| (Some(shape), grid));
    trials::check(&given, kind, &places, &parameters, &grid)?;
    let (all, owners) = expanded(&file, &parameters)?;
    if kind != PartKind::Elongation && owners.iter().any(|owner| owner.leg.is_some()) {
        return Err(UserTermError::rule("per_leg", "only an elongation has a size in every leg".to_owned()));
    }
    let uses = |name: &str| given.variables.iter().any(|v| v == name);
    let known = Known {
        info: TermInfo {
            source: "a function of the user",
            ..described(&file, &all, info, &given.name, uses)
        },
        kind,
        places,
        law: given.law,
        owners,
        parameters: parameters.len(),
        grid,
        log_prior: file.log_prior()?,
        answers: Remembered::default(),
    };
    Ok(Arc::new(FunctionTerm { known: Arc::new(known), noted: None }))
}

fn kinds() -> String {
    let all = [PartKind::Elongation].into_iter().chain(PartKind::BODIES);
    all.map(PartKind::key).collect::<Vec<_>>().join(", ")
}

/// Where a variable stands among those of its kind.
fn place(kind: PartKind, name: &str) -> Result<usize, UserTermError> {
    let known = kind.variables();
    known.iter().position(|known| *known == name).ok_or_else(|| {
        let near = nearest(name, known.iter().copied());
        let next = near.map_or_else(String::new, |near| format!(", `{near}` perhaps"));
        let why = format!("`{name}` is neither a parameter nor a variable of {}{next}", kind.key());
        UserTermError::rule("variables", why)
    })
}

/// True for a variable that has a value in every leg.
fn is_of_leg(kind: PartKind, place: usize) -> bool {
    kind == PartKind::Elongation && place < OF_LEG.len()
}

impl Known {
    /// Values of its variables at a condition: six for each of a leg, then one for each other, in the order of `places`.
    fn values(&self, machine: &Machine, at: &Condition) -> Vec<f64> {
        let is_elongation = self.kind == PartKind::Elongation;
        let before = if is_elongation { OF_LEG.len() } else { 0 };
        let mut of_reading = Vec::with_capacity(OF_READING.len());
        push_of_reading(at, &mut of_reading);
        let legs = if is_elongation { 6 } else { 0 };
        let of_legs: Vec<_> = (0..legs).map(|leg| of_leg(machine, at, leg)).collect();
        let mut all = Vec::with_capacity(6 * self.places.len());
        for &place in &self.places {
            if is_of_leg(self.kind, place) {
                all.extend(of_legs.iter().map(|leg| leg[place]));
            } else {
                all.push(of_reading[place - before]);
            }
        }
        all
    }

    fn key(&self, values: &[f64], parameter: usize, shape: f64) -> Key {
        let shape = if self.grid.is_empty() { 0 } else { shape.to_bits() };
        values.iter().map(|x| x.to_bits()).chain([parameter as u64, shape]).collect()
    }

    /// Parameter `k` at one and the others at zero, then the shape.
    fn unit(&self, k: usize, shape: f64) -> Vec<f64> {
        let shape = (!self.grid.is_empty()).then_some(shape);
        (0..self.parameters).map(|j| f64::from(u8::from(j == k))).chain(shape).collect()
    }

    /// Asks the law for one parameter at rows of values, and keeps the answers.
    fn ask(&self, rows: &[Vec<f64>], parameter: usize, shape: f64) -> Vec<[f64; 6]> {
        let mut first = 0;
        let mut variables = Vec::with_capacity(self.places.len());
        for &place in &self.places {
            let next = first + if is_of_leg(self.kind, place) { 6 } else { 1 };
            variables.push(rows.iter().flat_map(|row| row[first..next].iter().copied()).collect());
            first = next;
        }
        // Nothing is locked meanwhile: the law may wait for what another thread holds.
        let sizes = self.unit(parameter, shape);
        let found = (self.law)(&LawQuestion { conditions: rows.len(), variables, sizes });
        self.answers.keep(rows.iter().map(|row| self.key(row, parameter, shape)).zip(found.iter().copied()));
        found
    }
}

impl FunctionTerm {
    /// Six numbers of one parameter at a condition whose variables have these values.
    fn vector(&self, values: &[f64], parameter: usize, shape: f64) -> Vector6 {
        let known = self.known.answers.get(&self.known.key(values, parameter, shape));
        if let (None, Some(noted)) = (known, &self.noted) {
            // What follows from an answer that was none is not asked.
            if values.iter().all(|x| x.is_finite()) {
                let mut noted = noted.lock().unwrap_or_else(PoisonError::into_inner);
                noted.push((values.to_vec(), parameter, shape));
            }
            return Vector6::repeat(f64::NAN);
        }
        Vector6::from(known.unwrap_or_else(|| self.known.ask(&[values.to_vec()], parameter, shape)[0]))
    }
}

impl Term for FunctionTerm {
    fn info(&self) -> &TermInfo {
        &self.known.info
    }

    fn actions(&self, machine: &Machine, at: &Condition, shape: f64, out: &mut Vec<Action>) {
        let values = self.known.values(machine, at);
        let vector = |parameter| (self.known.kind, self.vector(&values, parameter, shape));
        push_by_owner(&self.known.owners, at, out, vector);
    }

    fn noting(&self) -> Option<Arc<dyn Term>> {
        Some(Arc::new(Self { known: Arc::clone(&self.known), noted: Some(Mutex::default()) }))
    }

    fn answer(&self) -> bool {
        let Some(noted) = &self.noted else { return false };
        let noted = std::mem::take(&mut *noted.lock().unwrap_or_else(PoisonError::into_inner));
        // In an order that does not depend on threads, each once; those of one parameter and shape together.
        let keyed = noted.into_iter().map(|(values, parameter, shape)| {
            let key = self.known.key(&values, parameter, shape);
            ((parameter, shape.to_bits()), (key, values))
        });
        let mut all: BTreeMap<(usize, u64), BTreeMap<Key, Vec<f64>>> = BTreeMap::new();
        for (of, (key, values)) in keyed {
            all.entry(of).or_default().insert(key, values);
        }
        for ((parameter, shape), rows) in &all {
            let rows: Vec<Vec<f64>> = rows.values().cloned().collect();
            self.known.ask(&rows, *parameter, f64::from_bits(*shape));
        }
        !all.is_empty()
    }

    fn fault(&self, machine: &Machine, at: &Condition) -> Option<String> {
        let known = &self.known;
        let shapes = if known.grid.is_empty() { &[1.0][..] } else { &known.grid };
        let values = known.values(machine, at);
        let mut all = (0..known.parameters).flat_map(|k| shapes.iter().map(move |s| (k, *s)));
        all.find_map(|(k, shape)| {
            let six = self.vector(&values, k, shape);
            let bad = six.iter().find(|x| !x.is_finite())?;
            Some(format!("`{}` gives {bad}", known.info.equation))
        })
    }

    fn log_prior(&self) -> f64 {
        self.known.log_prior
    }

    fn shape_grid(&self, _: &[Condition]) -> Vec<f64> {
        self.known.grid.clone()
    }
}
