//! `hexbench design --sensors`: which sensors to place, and where.

mod json;
mod page;

use std::path::Path;
use std::sync::Arc;

use hexbench_core::{Dataset, Hexapod, Sensor, StatedTolerances};
use hexbench_design::determined::undetermined;
use hexbench_design::power::{EffectSizes, Planned, PowerSettings};
use hexbench_design::sensors::{
    CandidateSensor, Found, Goal, Limits, Offer, SensorSearch, SensorSelection, Sought, read_candidates,
};
use hexbench_design::{Criterion, DesignError, nominal};
use hexbench_experiments::power::{Power, PowerPlan, computed, usual};
use hexbench_model::effects::term::Term;
use hexbench_model::effects::untestable::why_untestable;
use hexbench_model::terms::catalogue;

use super::{Quantity, StartedSearch, sized, springs, wanted};
use crate::Failure;

/// Starts of a search by exchange.
const STARTS: u16 = 32;

/// What somebody wants of sensors.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SensorWish {
    /// Number of sensors; with a budget at most so many.
    pub choose: Option<u16>,
    /// What they may cost together.
    pub budget: Option<f64>,
    /// An effect that is to be seen beside springs, instead of a criterion.
    pub see: Option<String>,
    /// What makes a set good; D unless said.
    pub criterion: Option<Criterion>,
    /// Terms of the catalogue that they have to determine too.
    pub terms: Vec<String>,
    /// Starts of searches by exchange.
    pub starts: Option<u16>,
    /// Seed of the starts.
    pub seed: u32,
}

/// Sensors chosen.
pub struct ChosenSensors {
    /// Name of the goal.
    pub goal: &'static str,
    /// The effect that is to be seen, where one is.
    pub see: Option<String>,
    /// The machine with the sensors it had, then those chosen.
    pub hexapod: Hexapod,
    /// How many sensors it had.
    pub had: usize,
    /// The chosen candidates.
    pub chosen: Vec<CandidateSensor>,
    /// Candidates there were.
    pub candidates: usize,
    /// What was allowed.
    pub limits: Limits,
    /// How they were found.
    pub found: Found,
    /// What one less, so many, one and two more would buy.
    pub numbers: Vec<SensorNumber>,
    /// The parameters.
    pub parameters: Vec<Quantity>,
    /// Rows of the plan, and its poses.
    pub plan: [usize; 2],
    /// How well joints, loads and axes are assumed to be known.
    pub tolerances: StatedTolerances,
    /// The plan as the chosen sensors read it, and its power.
    pub power: (PowerPlan, Power),
    /// Seed of the starts.
    pub seed: u32,
}

/// What some number of sensors would buy.
pub struct SensorNumber {
    /// Limits of it.
    pub limits: Limits,
    /// None where they determine no fit.
    pub set: Option<ValuedSet>,
}

/// A set with what it determines.
pub struct ValuedSet {
    /// Indices of the candidates.
    pub members: Vec<usize>,
    /// Names of its sensors.
    pub names: Vec<String>,
    /// Value of the goal.
    pub value: f64,
    /// Standard uncertainty of each parameter, as a share of its size.
    pub shares: Vec<f64>,
}

/// Chooses sensors of a file for the rows of a plan.
///
/// # Errors
/// [`Failure::File`], [`Failure::Usage`], [`Failure::Model`] for a term that does not exist, [`Failure::Cause`].
pub fn choose_sensors(
    hexapod: &Hexapod,
    plan: &Dataset,
    candidates: &Path,
    wish: &SensorWish,
    begun: &StartedSearch<'_>,
) -> Result<ChosenSensors, Failure> {
    let all = read_candidates(candidates)?;
    refuse_names(hexapod, &all)?;
    let limits = limits(wish, &all, candidates)?;
    let springs_si = nominal::compliance(hexapod);
    let sought = wish.see.as_ref().map(|id| sought(hexapod, plan, &all, id, wish.seed)).transpose()?;
    let terms = match &sought {
        Some(effect) => vec![Sought::term(effect)],
        None => wanted(&wish.terms)?.into_iter().map(|t| (t, None)).collect(),
    };
    let offer = Offer::of(hexapod, plan, springs_si, &terms, &all).map_err(|cause| of_plan(cause, plan))?;
    let goal = match &sought {
        Some(effect) => Goal::See(Sought::of(effect, &offer)),
        None => Goal::Fit(offer.objective(wish.criterion.unwrap_or(Criterion::D))),
    };
    let search = SensorSearch::new(&offer, &goal)?;
    let starts = usize::from(wish.starts.unwrap_or(STARTS));
    let (numbers, found) = alternatives(&search, &goal, &offer, &all, (limits, starts, wish.seed), begun)?;
    let members =
        numbers.iter().find(|n| n.limits == limits).and_then(|n| Some(n.set.as_ref()?.members.clone()));
    let chosen: Vec<CandidateSensor> =
        members.unwrap_or_default().into_iter().map(|k| all[k].clone()).collect();
    let machine = with_sensors(hexapod, chosen.iter().map(|c| &c.sensor));
    let power = power(&machine, plan, wish.seed)?;
    let stated: Vec<Arc<dyn Term>> =
        if sought.is_some() { Vec::new() } else { terms.into_iter().map(|t| t.0).collect() };
    let natural = offer.sizes.iter().flatten().copied();
    Ok(ChosenSensors {
        goal: goal.name(),
        see: wish.see.clone(),
        hexapod: machine,
        had: hexapod.sensors.len(),
        chosen,
        candidates: all.len(),
        limits,
        found,
        numbers,
        parameters: springs(hexapod).into_iter().chain(sized(&stated, natural)).collect(),
        plan: [plan.observations.len(), poses(plan)],
        tolerances: offer.tolerances,
        power,
        seed: wish.seed,
    })
}

/// What is wrong with the rows of a plan, by its file.
fn of_plan(cause: DesignError, plan: &Dataset) -> Failure {
    match cause {
        DesignError::Model(cause) => Failure::of_model(&plan.source)(cause),
        cause => cause.into(),
    }
}

fn poses(plan: &Dataset) -> usize {
    plan.observations.iter().map(|o| o.pose_id).collect::<std::collections::BTreeSet<_>>().len()
}

fn with_sensors<'a>(hexapod: &'a Hexapod, more: impl Iterator<Item = &'a Sensor>) -> Hexapod {
    let sensors = hexapod.sensors.iter().chain(more).cloned().collect();
    Hexapod { sensors, ..hexapod.clone() }
}

/// No candidate has the name of a sensor that the machine has.
fn refuse_names(hexapod: &Hexapod, all: &[CandidateSensor]) -> Result<(), Failure> {
    let twice = all.iter().find(|c| hexapod.sensors.iter().any(|s| s.name == c.sensor.name));
    twice.map_or(Ok(()), |c| {
        Err(Failure::usage(
            format!("the machine has a sensor \"{}\" already", c.sensor.name),
            "Rename the candidate; sensors of the hexapod file are kept.",
        ))
    })
}

fn limits(wish: &SensorWish, all: &[CandidateSensor], file: &Path) -> Result<Limits, Failure> {
    let usage = |message: String, next: &str| Err(Failure::usage(message, next.to_owned()));
    if let Some(budget) = wish.budget {
        let cheapest = all.iter().map(|c| c.cost).fold(f64::INFINITY, f64::min);
        // Also what is not a number.
        if !(budget.is_finite() && budget >= cheapest) {
            let message = format!("--budget {budget}: the cheapest sensor costs {cheapest}");
            return usage(
                message,
                "Enter the highest total cost, in the unit of cost in the file of candidates.",
            );
        }
    }
    match wish.choose {
        Some(n) if usize::from(n) > all.len() => {
            let message =
                format!("--choose {n}: {} has {} sensors to choose from", file.display(), all.len());
            usage(message, "Use a smaller number, or add [[sensor]], [[ring]] or [[face]] tables.")
        }
        None if wish.budget.is_none() => {
            usage("how many sensors?".into(), "Add --choose N, --budget COST, or both.")
        }
        number => Ok(Limits { number: number.map_or(all.len(), usize::from), budget: wish.budget }),
    }
}

/// An effect of usual size, of natural size where there is no usual one.
fn sought(
    hexapod: &Hexapod,
    plan: &Dataset,
    all: &[CandidateSensor],
    id: &str,
    seed: u32,
) -> Result<EffectSizes, Failure> {
    let term = wanted(std::slice::from_ref(&id.to_owned()))?.remove(0);
    if let Some(known) = usual(&term, hexapod, seed.into()) {
        return Ok(known.subject);
    }
    let machine = with_sensors(hexapod, all.iter().take(1).map(|c| &c.sensor));
    let plan = power_plan(&machine, plan)?;
    let planned = Planned::new(&machine, &plan.rows, plan.springs(), plan.noise)?;
    match why_untestable(term.as_ref(), &planned.campaign, &planned.lin) {
        None => Ok(EffectSizes::natural(&term, &planned)),
        Some(why) => Err(DesignError::CannotShow { term: term.info().id, why: why.to_string() }.into()),
    }
}

type Searched = (Vec<SensorNumber>, Found);

/// One less, so many, one and two more; where a budget alone limits them, so many.
fn alternatives(
    search: &SensorSearch<'_>,
    goal: &Goal,
    offer: &Offer,
    all: &[CandidateSensor],
    (limits, starts, seed): (Limits, usize, u32),
    begun: &StartedSearch<'_>,
) -> Result<Searched, Failure> {
    let n = limits.number;
    let numbers: Vec<usize> = (n.saturating_sub(1).max(1)..=(n + 2).min(offer.candidates())).collect();
    let ended = begun(numbers.len() as u64);
    let (mut rows, mut how) = (Vec::new(), None);
    for number in numbers {
        let limits_here = Limits { number, ..limits };
        let best = search.best(limits_here, starts, seed.into());
        if number == n {
            how = best.as_ref().map(|b| b.1);
        }
        let set = best.map(|(set, _)| valued(goal, offer, all, set));
        rows.push(SensorNumber { limits: limits_here, set });
        ended();
    }
    let Some(found) = how else {
        let parameters = goal.names(offer).len();
        let from = if limits.budget.is_some() { offer.candidates() } else { n + 1 };
        let enough = search.enough(limits, from, starts, seed.into());
        return Err(DesignError::TooFewSensors { number: n, parameters, enough }.into());
    };
    Ok((rows, found))
}

fn valued(goal: &Goal, offer: &Offer, all: &[CandidateSensor], set: SensorSelection) -> ValuedSet {
    let known = goal.of_parameters(offer, &offer.sum(&set.members));
    let covariance =
        Some(known).filter(|k| undetermined(k).is_empty()).and_then(|k| Some(k.cholesky()?.inverse()));
    ValuedSet {
        names: set.members.iter().map(|&k| all[k].sensor.name.clone()).collect(),
        shares: covariance.map_or(Vec::new(), |c| c.diagonal().iter().map(|v| v.sqrt()).collect()),
        members: set.members,
        value: set.value,
    }
}

/// What the sensors of a machine read of a plan.
fn power_plan(machine: &Hexapod, plan: &Dataset) -> Result<PowerPlan, Failure> {
    let rows = plan.to_be_read_by(&machine.sensors);
    let known = PowerPlan::new(machine.clone(), rows, nominal::stiffness(machine));
    known.ok_or_else(|| DesignError::Bad("the sensors state no noise".to_owned()).into())
}

fn power(machine: &Hexapod, plan: &Dataset, seed: u32) -> Result<(PowerPlan, Power), Failure> {
    let plan = power_plan(machine, plan)?;
    let settings = PowerSettings { seed: seed.into(), ..PowerSettings::default() };
    let power = computed(&plan, &catalogue(), settings)?;
    Ok((plan, power))
}
