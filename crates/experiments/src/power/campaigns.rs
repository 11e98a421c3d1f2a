//! All simulated campaigns of a plan, as one experiment.

use std::sync::Arc;

use hexbench_core::Vector6;
use hexbench_core::files::text_hash;
use hexbench_core::statistics::Proportion;
use hexbench_core::streams::Purpose;
use hexbench_design::power::{EffectSizes, Planned, PowerSettings, PowerStudy, PreparedTest, study};
use hexbench_model::effects::term::Term;
use hexbench_truth::{Mechanism, TruthError};
use serde::{Deserialize, Serialize};

use super::PowerPlan;
use super::simulate::{AnswerAndFate, Bench, Inputs, NoiseOf, Simulated, SimulatedAnswers};
use super::study::{Power, PowerCheck, PowerError, Simulation};
use super::usual::{Usual, usual};
use crate::harness::{Field, Gathered, Protocol, TrialResult};
use crate::journal::Identity;

/// The format of the figures.
const FORMAT: &str = "power/1";

/// A plan as computed, and the campaigns that check it.
pub struct Campaigns {
    bench: Bench,
    terms: Vec<Arc<dyn Term>>,
    study: PowerStudy,
    simulation: Simulation,
    /// One for each effect.
    checks: Vec<PowerCheck>,
    parts: Vec<Part>,
}

/// Equal campaigns but for the noise and the errors of the inputs.
struct Part {
    /// What is simulated: number of the effect and multiple of its usual size; `None`: nothing is hidden.
    effect: Option<(usize, f64)>,
    mechanism: Option<Box<dyn Mechanism>>,
    /// What is read when inputs and instrument are exact.
    ideal: Vec<Vector6>,
    noise: NoiseOf,
    is_diagnosed: bool,
}

impl Part {
    fn effects(&self) -> Vec<Box<dyn Mechanism>> {
        self.mechanism.iter().map(|m| m.scaled(1.0)).collect()
    }

    /// True at the usual size of an effect.
    fn is_usual(&self) -> bool {
        self.noise.0 == Purpose::PowerUsualNoise
    }
}

/// What one campaign showed.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct PowerRecord {
    /// Whether the tests of the effects saw something, each where nothing is hidden, else that of the hidden one.
    pub seen: Vec<bool>,
    /// Answer of the diagnosis, where it was asked.
    pub said: Option<AnswerAndFate>,
}

/// The power of a plan as computed; nothing is simulated.
///
/// # Errors
/// [`PowerError`].
pub fn computed(
    plan: &PowerPlan,
    terms: &[Arc<dyn Term>],
    settings: PowerSettings,
) -> Result<Power, PowerError> {
    let Campaigns { study, simulation, checks, .. } =
        Campaigns::new(plan, terms, settings, Simulation::default(), &[])?;
    Ok(Power { format: FORMAT, study, simulation, checks })
}

impl Campaigns {
    /// Computes the power of a plan, and lists the campaigns for the effects in `only`, for all when it is empty.
    ///
    /// # Errors
    /// [`PowerError`].
    pub fn new(
        plan: &PowerPlan,
        terms: &[Arc<dyn Term>],
        settings: PowerSettings,
        simulation: Simulation,
        only: &[String],
    ) -> Result<Self, PowerError> {
        let planned = Planned::new(&plan.hexapod, &plan.rows, plan.springs(), plan.noise)?;
        let known: Vec<Option<Usual>> =
            terms.iter().map(|t| usual(t, &plan.hexapod, settings.seed)).collect();
        let subject = |(term, known): (&Arc<dyn Term>, &Option<Usual>)| {
            known.as_ref().map_or_else(|| EffectSizes::natural(term, &planned), |u| u.subject.clone())
        };
        let study = study(&planned, terms.iter().zip(&known).map(subject).collect(), settings)?;
        let checks = vec![PowerCheck::default(); study.effects.len()];
        let bench = Bench::new(plan, settings.seed);
        let mut all = Self { bench, terms: terms.to_vec(), study, simulation, checks, parts: Vec::new() };
        if simulation.campaigns > 0 {
            let ideal = all.bench.ideal(Vec::new())?;
            all.parts.push(Part {
                effect: None,
                mechanism: None,
                ideal,
                noise: (Purpose::PowerCleanNoise, 0),
                is_diagnosed: false,
            });
            (0..all.checks.len()).for_each(|k| all.add(k, &known, only));
        }
        Ok(all)
    }

    /// Adds the campaigns of an effect, or why there are none.
    fn add(&mut self, k: usize, known: &[Option<Usual>], only: &[String]) {
        let term = self.study.effects[k].term;
        if !only.is_empty() && !only.iter().any(|id| id == term) {
            return;
        }
        let place = self.terms.iter().position(|t| t.info().id == term);
        let parts = match place.and_then(|p| known[p].as_ref()) {
            Some(usual) => self.parts_of(k, usual).map_err(|why| why.to_string()),
            None => Err("the simulated world has no such effect".to_owned()),
        };
        match parts {
            Ok(parts) => self.parts.extend(parts),
            Err(why) => self.checks[k].why_not = Some(why),
        }
    }

    /// At the usual size, and at the size that is seen where there is one.
    fn parts_of(&self, k: usize, usual: &Usual) -> Result<Vec<Part>, TruthError> {
        let effect = &self.study.effects[k];
        if self.study.tests[k].is_none() {
            return Ok(Vec::new());
        }
        let seen_at = effect.shows().then_some(effect.seen_at.middle);
        let part = |(scale, noise, is_diagnosed): (f64, Purpose, bool)| {
            let mechanism = usual.mechanisms[effect.example_index].scaled(scale);
            let ideal = self.bench.ideal(vec![mechanism.scaled(1.0)])?;
            let (effect, mechanism) = (Some((k, scale)), Some(mechanism));
            Ok(Part { effect, mechanism, ideal, noise: (noise, k as u64), is_diagnosed })
        };
        let seen = seen_at.map(|scale| (scale, Purpose::PowerSeenNoise, self.simulation.diagnoses));
        std::iter::once((1.0, Purpose::PowerUsualNoise, false)).chain(seen).map(part).collect()
    }

    /// The power of the plan with what the campaigns showed.
    ///
    /// # Errors
    /// [`PowerError::Campaign`], [`PowerError::Model`].
    pub fn power(mut self, gathered: &Gathered<PowerRecord>) -> Result<Power, PowerError> {
        if let Some(why) = gathered.failures().next() {
            return Err(PowerError::Campaign(why.clone()));
        }
        let parts = std::mem::take(&mut self.parts);
        for (part, answers) in parts.iter().zip(gathered.answers.chunks(self.simulation.campaigns.max(1))) {
            self.tell(part, answers)?;
        }
        let Self { study, simulation, checks, .. } = self;
        Ok(Power { format: FORMAT, study, simulation, checks })
    }

    fn tell(&mut self, part: &Part, answers: &[TrialResult<PowerRecord>]) -> Result<(), PowerError> {
        let records = || answers.iter().flatten();
        let seen = |k: usize| Proportion::count(records(), |r| r.seen[k]);
        let Some((k, scale)) = part.effect else {
            for (k, check) in self.checks.iter_mut().enumerate() {
                check.false_alarms = self.study.tests[k].is_some().then(|| seen(k));
            }
            return Ok(());
        };
        let (left, bias_percent) = self.bench.without_noise(&part.ideal, Inputs::WithinTolerances)?;
        let chance = self.study.tests[k].as_ref().map_or(f64::NAN, |test| test.chance(&left));
        let simulated = Simulated {
            scale,
            seen: seen(0),
            chance_by_the_world: chance,
            bias_percent,
            answers: part
                .is_diagnosed
                .then(|| SimulatedAnswers::of_all(records().filter_map(|r| r.said.as_ref()))),
        };
        let check = &mut self.checks[k];
        *(if part.is_usual() { &mut check.usual } else { &mut check.when_seen }) = Some(simulated);
        Ok(())
    }

    fn tests(&self, part: &Part) -> &[Option<PreparedTest>] {
        part.effect.map_or(&self.study.tests[..], |(k, _)| &self.study.tests[k..=k])
    }
}

/// A column of the table of trials.
type Column = Field<PowerRecord>;

impl Protocol for Campaigns {
    /// Number of the part, and of the campaign within it.
    type Job = (usize, u64);
    type Record = PowerRecord;
    type Error = PowerError;

    fn identity(&self) -> Identity {
        let Simulation { campaigns, diagnoses } = self.simulation;
        let parts: Vec<String> = (0..self.parts.len()).map(|k| self.part_name(&self.parts[k])).collect();
        let terms: Vec<String> = self.terms.iter().map(|t| format!("{:?}", t.info())).collect();
        let settings = [
            ("campaigns", campaigns.to_string()),
            ("diagnoses", diagnoses.to_string()),
            ("settings", format!("{:?}", self.study.settings)),
            ("effects", text_hash(&parts.join(", "))),
            ("plan", text_hash(&format!("{:?}", self.bench.plan()))),
            ("terms", text_hash(&terms.join(", "))),
        ];
        Identity::new("power", "power-trials/3", settings)
    }

    fn jobs(&self) -> Vec<(usize, u64)> {
        let campaigns = 0..self.simulation.campaigns as u64;
        (0..self.parts.len()).flat_map(|part| campaigns.clone().map(move |k| (part, k))).collect()
    }

    fn trial(&self, &(part, k): &(usize, u64)) -> Result<PowerRecord, PowerError> {
        let part = &self.parts[part];
        let data = self.bench.measured(part.effects(), (part.noise, k))?;
        let residuals = self.bench.residuals(&data)?;
        let seen = self.tests(part).iter().map(|t| t.as_ref().is_some_and(|t| t.sees(&residuals))).collect();
        let asked = part.effect.filter(|_| part.is_diagnosed);
        let said = asked.map(|(k, _)| self.bench.answer(self.study.effects[k].term, &data, &self.terms));
        Ok(PowerRecord { seen, said })
    }

    fn name(&self, (part, k): &(usize, u64)) -> String {
        format!("{}-{k}", self.part_name(&self.parts[*part]))
    }

    fn fields(&self) -> Vec<Column> {
        vec![
            Column::number("seen", "tests that saw something", |r| {
                r.seen.iter().filter(|seen| **seen).count() as f64
            }),
            Column::text("answer", "what the diagnosis said, where it was asked", |r| {
                r.said.as_ref().map_or(String::new(), |said| said.0.clone())
            }),
        ]
    }
}

impl Campaigns {
    fn part_name(&self, part: &Part) -> String {
        match part.effect {
            None => "no effect".to_owned(),
            Some((k, scale)) => format!("{} x {scale}", self.study.effects[k].term),
        }
    }
}
