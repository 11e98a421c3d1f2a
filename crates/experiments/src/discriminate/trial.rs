//! One trial: diagnosed, measured further, diagnosed again.

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Dataset, Observation, Pose, Wrench};
use hexbench_model::effects::term::Term;
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::results::diagnose::{Diagnosis, DiagnosisStudy, NextReport, diagnose, prepare};
use hexbench_model::results::next::{Effort, ProposedReadings, candidate_readings, propose, suspects};
use hexbench_model::terms::catalogue;
use hexbench_truth::campaign::machines::FAMILIES;
use rand::RngExt;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

use super::{ConfusedPair, MeasuredMachine};
use crate::harness::words::{self, Word};
use crate::trial::{Outcome, TrialError, outcome};

/// Further readings that are taken.
pub const READINGS: usize = 3;
/// Distances of the hidden effect under the confusing plan: from well visible to obvious.
const DISTANCES: [f64; 2] = [8.0, 20.0];

/// What was said before and after further readings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DiscriminateRecord {
    /// The hidden effect.
    #[serde(with = "words")]
    pub hidden: Word,
    /// Family of the machine.
    #[serde(with = "words")]
    pub family: Word,
    /// By the confusing plan alone.
    pub before: Outcome,
    /// With the readings that the diagnosis proposes; as before where it proposes none.
    pub proposed: Outcome,
    /// Readings it proposes.
    pub readings: usize,
    /// With as many readings drawn from the candidate readings.
    pub proposed_random: Outcome,
    /// With readings chosen to separate the two effects of the pair.
    pub asked: Outcome,
    /// With as many readings drawn from the candidate readings.
    pub asked_random: Outcome,
    /// Readings chosen for the pair.
    pub asked_readings: usize,
    /// Promised chance that the readings chosen for the pair favor the truth over the other; no number where none can be computed.
    pub promised: f64,
    /// Whether all readings then do.
    pub favoured: bool,
}

impl DiscriminateRecord {
    /// The trial of a number; everything that is drawn comes from the seed.
    pub(crate) fn of(confusion: &ConfusedPair, index: usize, seed: u64) -> Result<Self, TrialError> {
        let mut rng = stream(seed, Purpose::ConfusionTrial, [index as u64]);
        let hidden = confusion.between[rng.random_range(0..2)];
        let family = FAMILIES[rng.random_range(0..FAMILIES.len())];
        let [low, high] = DISTANCES;
        let distance = rng.random_range(low.ln()..high.ln()).exp();
        let bench = MeasuredMachine::draw(confusion, hidden, family, distance, rng.random())?;
        let terms = catalogue();
        let judge = |data: &Dataset| diagnose(&bench.hexapod, data, None, &terms);
        let first = judge(&bench.measurements)?;
        let said = |study: &DiagnosisStudy| outcome(&[hidden], &study.diagnosis);
        let measured = |further: &[Observation]| -> Result<Dataset, TrialError> {
            // The same noise whatever is measured.
            let mut noise = stream(seed, Purpose::ConfusionFurtherNoise, [index as u64]);
            Ok(bench.with(further, &mut noise)?)
        };
        let after = |further: &[Observation]| -> Result<Outcome, TrialError> {
            Ok(said(&judge(&measured(further)?)?))
        };
        let next = listed(&first.diagnosis);
        let before = said(&first);
        let proposed = if next.is_empty() { before } else { after(&next)? };
        let pair = pair(confusion, &terms);
        let (for_pair, candidate_readings) = asked(&first, &pair)?;
        let chosen = measured(&for_pair.one_by_one())?;
        let mut drawn = |n: usize| -> Vec<Observation> {
            (0..n).map(|_| candidate_readings[rng.random_range(0..candidate_readings.len())]).collect()
        };
        let (as_many_as_proposed, as_many_as_asked) = (drawn(next.len()), drawn(for_pair.readings()));
        Ok(Self {
            hidden,
            family,
            before,
            proposed,
            proposed_random: if next.is_empty() { before } else { after(&as_many_as_proposed)? },
            readings: next.len(),
            asked: said(&judge(&chosen)?),
            asked_readings: for_pair.readings(),
            asked_random: after(&as_many_as_asked)?,
            favoured: favours(&prepare(&bench.hexapod, &chosen)?, &pair, hidden)?,
            promised: for_pair.forecasts.first().map_or(f64::NAN, |o| o.separation.right),
        })
    }
}

fn pair(confusion: &ConfusedPair, terms: &[Arc<dyn Term>]) -> Vec<Arc<dyn Term>> {
    terms.iter().filter(|t| confusion.between.contains(&t.info().id)).map(Arc::clone).collect()
}

/// Readings for the pair itself, and the candidate readings they come from.
fn asked(
    study: &DiagnosisStudy,
    pair: &[Arc<dyn Term>],
) -> Result<(ProposedReadings, Vec<Observation>), ModelError> {
    let suspects = suspects(&study.campaign, pair)?;
    let candidate_readings = candidate_readings(&study.campaign, &suspects.rivals)?;
    let proposed =
        propose(&study.campaign, &suspects.rivals, &candidate_readings, Effort::Exactly(READINGS))?;
    Ok((proposed, candidate_readings))
}

/// True when the evidence is for the hidden one of a pair.
fn favours(campaign: &Campaign, pair: &[Arc<dyn Term>], hidden: &str) -> Result<bool, ModelError> {
    let suspects = suspects(campaign, pair)?;
    let evidence = |of_hidden: bool| {
        let own = pair.iter().zip(&suspects.log_evidence).find(|(t, _)| (t.info().id == hidden) == of_hidden);
        own.and_then(|(_, e)| *e).unwrap_or(f64::NEG_INFINITY)
    };
    Ok(evidence(true) > evidence(false))
}

/// The readings as a user would take them from the report.
fn listed(d: &Diagnosis) -> Vec<Observation> {
    d.next.iter().flat_map(|r| std::iter::repeat_n(observation(r), r.repeats)).collect()
}

fn observation(r: &NextReport) -> Observation {
    let si = |k: usize| if k < 3 { r.pose[k] * 1e-3 } else { r.pose[k].to_radians() };
    let pose = Pose::from_array(std::array::from_fn(si));
    let [wrench, reference] = [r.wrench, r.reference].map(Wrench::from_array);
    Observation {
        approach: r.approach,
        delta_t: r.delta_t_k,
        elapsed: r.elapsed_s,
        ..Observation::unread(pose, wrench, reference)
    }
}
