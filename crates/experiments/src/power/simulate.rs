//! Campaigns of a plan in the simulated world.

use std::collections::BTreeMap;
use std::sync::Arc;

use hexbench_core::statistics::Proportion;
use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Dataset, Observation, Vector6};
use hexbench_model::effects::term::Term;
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::fit_baseline;
use hexbench_model::estimation::linearization::Linearization;
use hexbench_model::estimation::tolerances::within_tolerances;
use hexbench_model::results::diagnose::{diagnose, prepare};
use hexbench_truth::campaign::{InputErrors, PlanRow, SimulatedCampaign};
use hexbench_truth::metrology::{InstrumentFrames, InstrumentNoise};
use hexbench_truth::{Mechanism, TruthError, World};
use nalgebra::DVector;
use rand_distr::{Distribution, StandardNormal};
use serde::Serialize;

use super::PowerPlan;
use crate::calibration::Fate;
use crate::trial::{Trial, in_a_word};

/// What the diagnosis said in campaigns with one effect.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct SimulatedAnswers {
    /// Campaigns by answer: names of effects joined by `+`, `outside`, `ambiguous`, `adequate`.
    pub said: BTreeMap<String, usize>,
    /// Exactly the effect is named.
    pub right: usize,
    /// Ambiguous, the effect among what is kept.
    pub honest: usize,
    /// The springs are called adequate.
    pub adequate: usize,
    /// An effect is named that is not there, or "outside" is said.
    pub wrong: usize,
    /// Ambiguous without the effect among what is kept, or no answer at all.
    pub other: usize,
}

/// An answer in one word, and what became of the truth; no fate when there is no answer.
pub type AnswerAndFate = (String, Option<Fate>);

impl SimulatedAnswers {
    pub(super) fn of_all<'a>(all: impl Iterator<Item = &'a AnswerAndFate>) -> Self {
        let mut answers = Self::default();
        all.for_each(|said| answers.add(said));
        answers
    }

    /// Campaigns.
    pub fn of(&self) -> usize {
        self.right + self.honest + self.adequate + self.wrong + self.other
    }

    fn add(&mut self, (word, fate): &AnswerAndFate) {
        *self.said.entry(word.clone()).or_default() += 1;
        let place = match fate {
            Some(Fate::Right) => &mut self.right,
            Some(Fate::Honest) => &mut self.honest,
            Some(Fate::Missed) => &mut self.adequate,
            Some(Fate::FalseName | Fate::FalseOutside | Fate::Incomplete) => &mut self.wrong,
            Some(Fate::Undecided) | None => &mut self.other,
        };
        *place += 1;
    }
}

/// What campaigns with an effect of one size gave.
#[derive(Debug, Clone, Serialize)]
pub struct Simulated {
    /// Multiple of the usual size.
    pub scale: f64,
    /// Campaigns in which the test saw the effect.
    pub seen: Proportion,
    /// Chance to see what the effect leaves in the world without noise: it differs from what the model expects where the
    /// effect does not grow in proportion or has another form.
    pub chance_by_the_world: f64,
    /// Change of the leg stiffnesses without noise when the effect is left out, percent.
    pub bias_percent: [f64; 6],
    /// Answers of the whole diagnosis, where asked for.
    pub answers: Option<SimulatedAnswers>,
}

/// Which noise campaigns get: what they are for, the number of their effect.
pub(super) type NoiseOf = (Purpose, u64);

/// What a fit takes the inputs for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Inputs {
    /// As exact.
    Exact,
    /// As good as the tolerances of the machine.
    WithinTolerances,
}

/// The machine of a plan in the simulated world.
pub(super) struct Bench {
    plan: PowerPlan,
    rows: Vec<PlanRow>,
    seed: u64,
}

impl Bench {
    pub(super) fn new(plan: &PowerPlan, seed: u64) -> Self {
        Self { plan: plan.clone(), rows: plan.rows.observations.iter().map(PlanRow::from).collect(), seed }
    }

    /// What an ideal instrument reads of a machine with these effects when every input is exact, m and rad.
    pub(super) fn ideal(&self, effects: Vec<Box<dyn Mechanism>>) -> Result<Vec<Vector6>, TruthError> {
        self.campaign(effects).ideal(&self.rows, self.plan.rows.measurand)
    }

    fn campaign(&self, effects: Vec<Box<dyn Mechanism>>) -> SimulatedCampaign {
        let mut world = World::new(self.plan.hexapod.clone(), &self.plan.stiffness);
        world.mechanisms = effects;
        SimulatedCampaign { world, frames: InstrumentFrames::default(), noise: InstrumentNoise::default() }
    }

    /// Readings of a campaign with these effects: inputs off by their tolerances, where the plan weighs them, and noise.
    pub(super) fn measured(
        &self,
        effects: Vec<Box<dyn Mechanism>>,
        (of, k): (NoiseOf, u64),
    ) -> Result<Dataset, TruthError> {
        let PowerPlan { hexapod, rows, .. } = &self.plan;
        let ideal = if rows.is_absolute() {
            self.ideal(effects)?
        } else {
            let numbers = [of.0 as u64, of.1, k];
            let rng = &mut stream(self.seed, Purpose::PowerInputErrors, numbers);
            let errors = InputErrors::sampled(hexapod, &hexapod.tolerances, rng);
            errors.ideal(self.campaign(effects), &self.rows, rows.measurand)?
        };
        Ok(self.data(&ideal, Some((of, k))))
    }

    /// Readings with the noise of a campaign; without noise as they are.
    fn data(&self, ideal: &[Vector6], noise: Option<(NoiseOf, u64)>) -> Dataset {
        let mut rng = noise.map(|((purpose, effect), k)| stream(self.seed, purpose, [effect, k]));
        let mut noise = |row: usize| match &mut rng {
            Some(rng) => {
                Vector6::from_fn(|_, _| StandardNormal.sample(rng)).component_mul(&self.plan.sigma(row))
            }
            None => Vector6::zeros(),
        };
        let read = |(row, (o, value)): (usize, (&Observation, &Vector6))| Observation {
            measured: (value + noise(row)).into(),
            ..*o
        };
        let observations = self.plan.rows.observations.iter().zip(ideal).enumerate().map(read).collect();
        Dataset { observations, ..self.plan.rows.clone() }
    }

    /// Whitened residuals of springs fitted to readings.
    pub(super) fn residuals(&self, data: &Dataset) -> Result<DVector<f64>, ModelError> {
        let campaign = prepare(&self.plan.machine(), data)?;
        let fit = fit_baseline(&campaign)?;
        Ok(Linearization::at(&campaign, &fit.point)?.residuals())
    }

    /// Length of what ideal readings have beyond those of the plain machine, in units of the noise.
    pub(super) fn length_of_change(&self, ideal: &[Vector6]) -> Result<f64, TruthError> {
        let plain = self.ideal(Vec::new())?;
        let whitened =
            |(row, (a, b)): (usize, (&Vector6, &Vector6))| (a - b).component_div(&self.plan.sigma(row));
        Ok(ideal.iter().zip(&plain).enumerate().map(|x| whitened(x).norm_squared()).sum::<f64>().sqrt())
    }

    /// What springs fitted to ideal readings leave (whitened residuals), and how their stiffness changes, percent.
    pub(super) fn without_noise(
        &self,
        ideal: &[Vector6],
        inputs: Inputs,
    ) -> Result<(DVector<f64>, [f64; 6]), ModelError> {
        let data = self.data(ideal, None);
        let exact = Campaign::with_noise(&self.plan.machine(), &data, self.plan.noise)?;
        let campaign = match inputs {
            Inputs::Exact => exact,
            Inputs::WithinTolerances => within_tolerances(exact),
        };
        let fit = fit_baseline(&campaign)?;
        let fitted = |leg: usize| 1.0 / fit.point.compliances[leg];
        let bias = std::array::from_fn(|leg| 100.0 * (fitted(leg) / self.plan.stiffness[leg] - 1.0));
        Ok((Linearization::at(&campaign, &fit.point)?.residuals(), bias))
    }

    /// What the diagnosis says of readings in which an effect is hidden.
    pub(super) fn answer(&self, id: &'static str, data: &Dataset, terms: &[Arc<dyn Term>]) -> AnswerAndFate {
        let study = diagnose(&self.plan.machine(), data, None, terms);
        study.map_or((NO_ANSWER.to_owned(), None), |study| said(&Trial { hidden: vec![id], study }))
    }

    pub(super) fn plan(&self) -> &PowerPlan {
        &self.plan
    }
}

/// Word for a diagnosis that could not be made.
const NO_ANSWER: &str = "no answer";

fn said(trial: &Trial) -> AnswerAndFate {
    let d = &trial.study.diagnosis;
    (in_a_word(d.verdict, &d.added), Some(Fate::of(trial)))
}
