//! One trial: diagnosed, measured further, diagnosed again.

use hexbench_core::{Dataset, Observation, Pose, Wrench};
use hexbench_model::diagnose::{Diagnosis, NextReport, Study, diagnose};
use hexbench_model::error::ModelError;
use hexbench_model::next::{Effort, Programme, menu, propose, suspects};
use hexbench_model::term::Term;
use hexbench_model::terms::catalogue;
use hexbench_truth::campaign::machines::FAMILIES;
use rand::RngExt;
use rand_pcg::Pcg64;
use std::sync::Arc;

use super::{Bench, Confusion};
use crate::trial::{Outcome, TrialError, outcome};

/// Further readings that are taken.
pub const READINGS: usize = 3;
/// Distances of the hidden effect under the confusing plan: from well visible to obvious.
const DISTANCES: [f64; 2] = [8.0, 20.0];

/// What was said before and after further readings.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// The hidden effect.
    pub hidden: &'static str,
    /// Family of the machine.
    pub family: &'static str,
    /// By the confusing plan alone.
    pub before: Outcome,
    /// With the readings that the diagnosis proposes; as before where it proposes none.
    pub proposed: Outcome,
    /// Readings it proposes.
    pub readings: usize,
    /// With as many readings drawn from the menu.
    pub proposed_random: Outcome,
    /// With readings chosen to separate the two effects of the pair.
    pub asked: Outcome,
    /// With as many readings drawn from the menu.
    pub asked_random: Outcome,
    /// Promised chance that the readings chosen for the pair favour the truth.
    pub promised: f64,
}

impl Record {
    /// The trial of a number; everything that is drawn comes from the seed.
    ///
    /// # Errors
    /// [`TrialError`].
    pub fn of(confusion: &Confusion, index: usize, seed: u64) -> Result<Self, TrialError> {
        let mut rng = Pcg64::new(u128::from(seed), index as u128);
        let hidden = confusion.between[rng.random_range(0..2)];
        let family = FAMILIES[rng.random_range(0..FAMILIES.len())];
        let [low, high] = DISTANCES;
        let distance = rng.random_range(low.ln()..high.ln()).exp();
        let bench = Bench::draw(confusion, hidden, family, distance, rng.random())?;
        let terms = catalogue();
        let judge = |data: &Dataset| diagnose(&bench.hexapod, data, None, &terms);
        let first = judge(&bench.measurements)?;
        let said = |study: &Study| {
            if std::env::var("V").is_ok() {
                let d = &study.diagnosis;
                let c: Vec<String> = d.candidates.iter().take(4).map(|c| format!("{} {:.2}", c.term, c.probability)).collect();
                let ch: Vec<String> = d.steps.iter().map(|s| format!("{:.2}/{:.2}", s.fitted.chi2_reduced, s.holdout.map_or(0.0, |h| h.chi2_reduced))).collect();
                eprintln!("{index} {hidden} {family} {distance:.1}: {:?} added {:?} cred {:?} cand {c:?} present {:?} steps {ch:?} model {:?}", d.verdict, d.added, d.credible_set, d.present.iter().filter(|p| *p.1>0.3).collect::<Vec<_>>(), d.model);
            }
            outcome(&[hidden], &study.diagnosis)
        };
        let after = |further: &[Observation]| -> Result<Outcome, TrialError> {
            // The same noise whatever is measured.
            let mut noise = Pcg64::new(u128::from(seed), (1 << 64) + index as u128);
            Ok(said(&judge(&bench.with(further, &mut noise)?)?))
        };
        let next = listed(&first.diagnosis);
        let before = said(&first);
        let proposed = if next.is_empty() { before } else { after(&next)? };
        let (programme, menu) = asked(&first, confusion, &terms)?;
        let mut drawn = |n: usize| -> Vec<Observation> {
            (0..n).map(|_| menu[rng.random_range(0..menu.len())]).collect()
        };
        let (as_many_as_proposed, as_many_as_asked) = (drawn(next.len()), drawn(READINGS));
        Ok(Self {
            hidden,
            family,
            before,
            proposed,
            proposed_random: if next.is_empty() { before } else { after(&as_many_as_proposed)? },
            readings: next.len(),
            asked: after(&repeated(&programme))?,
            asked_random: after(&as_many_as_asked)?,
            promised: programme.outlook.first().map_or(f64::NAN, |o| o.separation.right),
        })
    }
}

/// Readings for the pair itself, and the menu they come from.
fn asked(
    study: &Study,
    confusion: &Confusion,
    terms: &[Arc<dyn Term>],
) -> Result<(Programme, Vec<Observation>), ModelError> {
    let is_meant = |t: &&Arc<dyn Term>| confusion.between.contains(&t.info().id);
    let pair: Vec<Arc<dyn Term>> = terms.iter().filter(is_meant).map(Arc::clone).collect();
    let suspects = suspects(&study.campaign, &pair)?;
    let menu = menu(&study.campaign, &suspects.rivals)?;
    let programme = propose(&study.campaign, &suspects.rivals, &menu, Effort::Exactly(READINGS))?;
    Ok((programme, menu))
}

fn repeated(programme: &Programme) -> Vec<Observation> {
    programme.proposals.iter().flat_map(|p| std::iter::repeat_n(p.observation, p.repeats)).collect()
}

/// The readings as a user would take them from the report.
fn listed(d: &Diagnosis) -> Vec<Observation> {
    d.next.iter().flat_map(|r| std::iter::repeat_n(observation(r), r.repeats)).collect()
}

fn observation(r: &NextReport) -> Observation {
    let si = |k: usize| if k < 3 { r.pose[k] * 1e-3 } else { r.pose[k].to_radians() };
    Observation {
        pose_id: 1,
        repeat: 1,
        line: 0,
        pose: Pose::from_array(std::array::from_fn(si)),
        wrench: Wrench::from_array(r.wrench),
        reference: Wrench::from_array(r.reference),
        approach: r.approach,
        delta_t: r.delta_t_k,
        elapsed: r.elapsed_s,
        measured: [0.0; 6],
        sigma: None,
    }
}
