//! Sampling the cases of a suite.

use hexbench_core::streams::{Purpose, derived_seed, stream};
use hexbench_core::{Dataset, Hexapod};
use hexbench_truth::campaign::{CaseKind, CaseSpec, SensorReadings, SensorSet, SimulatedCase};
use hexbench_truth::laboratory::{self, FaultEntry};
use hexbench_truth::{Mechanism, TruthError};
use rand::RngExt;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64;
use rayon::prelude::*;

use crate::challenge::{CasePortion, ChallengeError, ChallengeSuite, Truth, in_scene};
use crate::harness::{Progress, each};
use crate::keys::{EffectSet, HiddenEffect};

/// A case of a challenge, ready to be written.
#[derive(Debug)]
pub struct SampledCase {
    /// A name that tells nothing.
    pub id: String,
    /// The machine as its drawings describe it.
    pub hexapod: Hexapod,
    /// Readings to learn from.
    pub measurements: Dataset,
    /// Held-out readings as the instrument gave them.
    pub measured: Dataset,
    /// The same without noise.
    pub true_readings: Dataset,
    /// What was hidden.
    pub truth: Truth,
}

/// All cases of a suite, shuffled so that their order tells nothing. The same suite gives the same cases on any number of threads.
///
/// # Errors
/// [`ChallengeError::Case`] for a case whose effects show in no plan and machine tried.
pub fn draw(suite: &ChallengeSuite, progress: &dyn Progress) -> Result<Vec<SampledCase>, ChallengeError> {
    let mut jobs: Vec<(usize, usize)> = Vec::new();
    for (k, portion) in suite.portions.iter().enumerate() {
        jobs.extend((0..portion.count).map(|index| (k, index)));
    }
    jobs.shuffle(&mut stream(suite.seed, Purpose::ChallengeOrder, []));
    let digits = if jobs.len() < 1000 { 3 } else { 4 };
    let one = |(number, &(k, index)): (usize, &(usize, usize))| {
        let portion = &suite.portions[k];
        let (id, seed) = (format!("case-{:0digits$}", number + 1), seed_of(suite.seed, k));
        let case = match portion.kind {
            None => in_scene::sampled(id, portion, index, seed)?,
            Some(kind) => {
                let case = built(kind, portion, index, seed).map_err(|cause| ChallengeError::Case {
                    group: portion.group.clone(),
                    number: index + 1,
                    cause,
                })?;
                sampled(id, portion, index, case)?
            }
        };
        progress.advance(1);
        Ok(case)
    };
    progress.begin(jobs.len() as u64, 0);
    each(jobs.par_iter().enumerate(), progress, one)
}

/// Every group has cases of its own, also where two ask for the same kind.
fn seed_of(seed: u64, portion: usize) -> u64 {
    derived_seed(seed, Purpose::ChallengeGroup, [portion as u64])
}

/// The `index`-th case of a portion: some effects do not show in some plans or machines, then others are tried.
fn built(
    kind: CaseKind,
    portion: &CasePortion,
    index: usize,
    seed: u64,
) -> Result<SimulatedCase, TruthError> {
    const ATTEMPTS: u64 = 12;
    let attempt = |n| {
        let spec = spec(kind, portion, index, seed, n);
        let set = match chosen(portion, index) {
            Some(set) => set.clone(),
            None => spec.effects.iter().map(|id| HiddenEffect::usual(id)).collect(),
        };
        let effects = CaseEffects { portion, set, seed, index };
        let made = |place, hexapod: &Hexapod, rng: &mut Pcg64| effects.made(place, hexapod, rng);
        let case = spec.build_with(laboratory_of(portion, index), &made)?;
        match portion.read_by {
            Some(set) => read_by(set, case),
            None => Ok(case),
        }
    };
    (1..ATTEMPTS).fold(attempt(0), |made, n| made.or_else(|_| attempt(n)))
}

/// The same with measurements that sensors read; what is held out stays full poses.
fn read_by(set: SensorSet, mut case: SimulatedCase) -> Result<SimulatedCase, TruthError> {
    let holdout = case.holdout.clone();
    case.read_with(SensorReadings { set, fault: None, is_noisy: true })?;
    Ok(SimulatedCase { holdout, ..case })
}

/// What the laboratory of a case does to its data.
pub(super) fn laboratory_of(portion: &CasePortion, index: usize) -> &'static FaultEntry {
    let id = portion.laboratory.get(index % portion.laboratory.len().max(1));
    id.and_then(|id| laboratory::entry(id)).unwrap_or(&laboratory::CAREFUL)
}

/// The effects of a case, if the suite names some.
pub(super) fn chosen(portion: &CasePortion, index: usize) -> Option<&EffectSet> {
    portion.effects.get(index % portion.effects.len().max(1))
}

/// The effects of a case on their way to their sizes.
pub(super) struct CaseEffects<'a> {
    pub(super) portion: &'a CasePortion,
    pub(super) set: EffectSet,
    pub(super) seed: u64,
    pub(super) index: usize,
}

impl CaseEffects<'_> {
    /// The effect at a place of the set on a machine, and by how much it is scaled; none: to the distance of the case.
    pub(super) fn made(
        &self,
        place: usize,
        hexapod: &Hexapod,
        rng: &mut Pcg64,
    ) -> Result<(Box<dyn Mechanism>, Option<f64>), TruthError> {
        let effect = &self.set[place];
        let made = effect.sampled(hexapod, rng)?;
        let factor = match (self.portion.sizes, self.portion.distance) {
            (Some(sizes), _) => {
                let share: f64 = stream(self.seed, Purpose::ChallengeSize, [self.index as u64]).random();
                let factor = sizes.factor(sizes.at(share), &*made, hexapod);
                Some(factor.ok_or_else(|| TruthError::TooLarge { id: made.id().to_owned() })?)
            }
            (None, None) if effect.has_size() => Some(1.0),
            (None, _) => None,
        };
        Ok((made, factor))
    }
}

fn spec(kind: CaseKind, portion: &CasePortion, index: usize, seed: u64, attempt: u64) -> CaseSpec {
    let sampled = CaseSpec::draw(kind, index, seed, attempt, portion.distance);
    let ids = |set: &EffectSet| set.iter().map(|effect| effect.id).collect();
    CaseSpec {
        effects: chosen(portion, index).map_or(sampled.effects, ids),
        plan: portion.plan.unwrap_or(sampled.plan),
        family: portion.machine.unwrap_or(sampled.family),
        noise: portion.noise.map_or(sampled.noise, |noise| noise.of(sampled.noise)),
        ..sampled
    }
}

fn sampled(
    id: String,
    portion: &CasePortion,
    index: usize,
    mut case: SimulatedCase,
) -> Result<SampledCase, ChallengeError> {
    if let Some(most) = portion.repeats {
        case.measurements.observations.retain(|o| u64::try_from(o.repeat).is_ok_and(|n| n <= most));
    }
    let failed = |cause| ChallengeError::Case { group: portion.group.clone(), number: index + 1, cause };
    let true_readings = case.ideal_holdout().map_err(failed)?;
    let truth = Truth::of(&id, portion, &case, laboratory_of(portion, index));
    let hexapod = Hexapod { name: id.clone(), ..case.hexapod };
    Ok(SampledCase {
        id,
        hexapod,
        measurements: case.measurements,
        measured: case.holdout,
        true_readings,
        truth,
    })
}
