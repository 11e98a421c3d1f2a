//! Everything about one plan: reckoned, and simulated where asked for.

use std::sync::Arc;

use hexbench_design::DesignError;
use hexbench_design::power::{Effect, Planned, Settings, Study, Subject, Test, study};
use hexbench_model::error::ModelError;
use hexbench_model::term::Term;
use hexbench_truth::TruthError;
use hexbench_truth::scene::RowError;
use serde::Serialize;

use super::PowerPlan;
use super::simulate::{Bench, Simulated};
use super::usual::{Usual, usual};
use crate::Proportion;

/// Seeds of what belongs to one effect.
const STREAMS_PER_EFFECT: u128 = 1 << 40;
/// Campaigns without effects.
const CLEAN: u128 = 0;
/// Noise at the usual size, apart from that at the size that is seen.
const USUAL: u128 = 1 << 39;

/// How much is simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Simulation {
    /// Campaigns of every effect and size, and without effects.
    pub campaigns: usize,
    /// True when the whole diagnosis is asked too.
    pub diagnoses: bool,
}

/// Power of one plan.
#[derive(Debug, Serialize)]
pub struct Power {
    /// `power/1`.
    pub format: &'static str,
    /// As reckoned.
    #[serde(flatten)]
    pub study: Study,
    /// How much was simulated.
    pub simulation: Simulation,
    /// What was simulated, for every effect.
    pub checks: Vec<Check>,
}

/// Simulation of one effect.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Check {
    /// Campaigns without effects in which its test saw something.
    pub false_alarms: Option<Proportion>,
    /// At the usual size.
    pub usual: Option<Simulated>,
    /// At the size that is seen with the wanted power.
    pub when_seen: Option<Simulated>,
    /// Why it was not simulated.
    pub why_not: Option<String>,
}

/// Why a plan could not be studied.
#[derive(Debug, thiserror::Error)]
pub enum PowerError {
    /// By the model.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// In the simulated world.
    #[error("the plan cannot be simulated: {0}")]
    Truth(#[from] TruthError),
    /// A row of a scene.
    #[error(transparent)]
    Row(#[from] RowError),
    /// Nothing states the noise.
    #[error("neither the rows nor the machine of the plan state how well readings are taken")]
    NoNoise,
    /// A simulated campaign.
    #[error("a simulated campaign cannot be fitted: {0}")]
    Model(#[from] ModelError),
}

/// Studies a plan; simulates the effects in `only`, all when it is empty. `done` is called after each campaign.
///
/// # Errors
/// [`PowerError`].
pub fn run(
    plan: &PowerPlan,
    terms: &[Arc<dyn Term>],
    settings: Settings,
    simulation: Simulation,
    only: &[String],
    done: &(dyn Fn() + Sync),
) -> Result<Power, PowerError> {
    let planned = Planned::new(&plan.hexapod, &plan.rows, plan.springs(), plan.noise)?;
    let known: Vec<Option<Usual>> = terms.iter().map(|t| usual(t, &plan.hexapod, settings.seed)).collect();
    let subject = |(term, known): (&Arc<dyn Term>, &Option<Usual>)| {
        known.as_ref().map_or_else(|| Subject::natural(term, &planned), |u| u.subject.clone())
    };
    let study = study(&planned, terms.iter().zip(&known).map(subject).collect(), settings);
    let mut power =
        Power { format: "power/1", checks: vec![Check::default(); study.effects.len()], study, simulation };
    if simulation.campaigns > 0 {
        power.checks = checks(plan, terms, &known, &power, only, done)?;
    }
    Ok(power)
}

/// Campaigns that [`run`] will simulate at most, for a progress bar.
pub fn most_campaigns(terms: usize, simulation: Simulation) -> usize {
    let per_effect = if simulation.diagnoses { 3 } else { 2 };
    simulation.campaigns * (1 + per_effect * terms)
}

fn checks(
    plan: &PowerPlan,
    terms: &[Arc<dyn Term>],
    known: &[Option<Usual>],
    power: &Power,
    only: &[String],
    done: &(dyn Fn() + Sync),
) -> Result<Vec<Check>, PowerError> {
    let bench = Bench::new(plan, power.study.settings.seed);
    let campaigns = power.simulation.campaigns;
    let tests: Vec<_> = power.study.tests.iter().map(Option::as_ref).collect();
    let clean = bench.seen(&bench.ideal(Vec::new())?, &tests, CLEAN, campaigns, done)?;
    let effects = power.study.effects.iter().enumerate();
    let check = |(k, effect): (usize, &Effect)| -> Result<Check, PowerError> {
        let alarms = Check { false_alarms: tests[k].map(|_| clean[k]), ..Check::default() };
        if !only.is_empty() && !only.iter().any(|id| id == effect.term) {
            return Ok(alarms);
        }
        let place = terms.iter().position(|t| t.info().id == effect.term);
        let Some(usual) = place.and_then(|p| known[p].as_ref()) else {
            let why = "the simulated world has no such effect".to_owned();
            return Ok(Check { why_not: Some(why), ..alarms });
        };
        let one = One { bench: &bench, usual, effect, index: k, power, terms, done };
        match one.check(tests[k]) {
            Ok((usual, when_seen)) => Ok(Check { usual, when_seen, ..alarms }),
            Err(PowerError::Truth(why)) => Ok(Check { why_not: Some(why.to_string()), ..alarms }),
            Err(other) => Err(other),
        }
    };
    effects.map(check).collect()
}

/// One effect to be simulated.
struct One<'a> {
    bench: &'a Bench<'a>,
    usual: &'a Usual,
    effect: &'a Effect,
    index: usize,
    power: &'a Power,
    terms: &'a [Arc<dyn Term>],
    done: &'a (dyn Fn() + Sync),
}

impl One<'_> {
    fn check(&self, test: Option<&Test>) -> Result<(Option<Simulated>, Option<Simulated>), PowerError> {
        let Some(test) = test else { return Ok((None, None)) };
        let usual = self.at(test, 1.0, USUAL, false)?;
        let seen_at = self.effect.shows().then_some(self.effect.seen_at.middle);
        let diagnoses = self.power.simulation.diagnoses;
        let when_seen = seen_at.map(|scale| self.at(test, scale, 0, diagnoses)).transpose()?;
        Ok((Some(usual), when_seen))
    }

    fn at(&self, test: &Test, scale: f64, stream: u128, diagnoses: bool) -> Result<Simulated, PowerError> {
        let mechanism = self.usual.mechanisms[self.effect.example_index].scaled(scale);
        let ideal = self.bench.ideal(vec![mechanism])?;
        let stream = stream + STREAMS_PER_EFFECT * (1 + self.index as u128);
        let campaigns = self.power.simulation.campaigns;
        let seen = self.bench.seen(&ideal, &[Some(test)], stream, campaigns, self.done)?[0];
        let answers = diagnoses
            .then(|| self.bench.answers(self.effect.term, &ideal, self.terms, stream, campaigns, self.done));
        let (left, bias_percent) = self.bench.without_noise(&ideal)?;
        Ok(Simulated { scale, seen, chance_by_the_world: test.chance(&left), bias_percent, answers })
    }
}
