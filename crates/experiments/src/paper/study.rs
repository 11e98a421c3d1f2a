//! The whole study.

use super::again::{Again, NamedVerdict};
use super::bench::{PaperMachine, identification, validation};
use super::chances::{Repetitions, repetitions};
use super::curves::{IndexOverLoad, Linearity, ValidationPose, figure_7, figure_8, figures_9_and_10};
use super::error::PaperError;
use super::experiment::Experiment;
use super::missing::{DiagnosisSummary, on_the_papers_plan, on_the_richer_plan};
use super::published::{BEST_POSES, PREDICTION_ERROR};
use super::search::{IndexedPoses, best_poses, stroke};
use super::suspects::{SuspectedEffect, bias, skew_support, suspects};
use crate::harness::Gathered;

/// Searches for poses, each from its own start.
const STARTS: u32 = 24;
/// Repetitions of the experiment with fresh noise.
const REPETITIONS: usize = 2000;
/// Three poses along X without rotation, for comparison.
const UNTURNED: [[f64; 4]; 3] = [[-30.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0], [30.0, 0.0, 0.0, 0.0]];

/// Everything the study finds.
#[derive(Debug)]
pub struct Reproduction {
    /// Seed of all noise.
    pub seed: u64,
    /// The machine and its instrument.
    pub bench: PaperMachine,
    /// The pose set of Table 1.
    pub published_set: IndexedPoses,
    /// Best sets found, with the stroke allowed in m: of all poses of the paper, and of its validation poses.
    pub best_sets: [(f64, IndexedPoses); 2],
    /// Springs are all there is.
    pub springs: Experiment,
    /// The same with fresh noise, over and over.
    pub repetitions: Repetitions,
    /// Fig. 7.
    pub index_over_load: Vec<IndexOverLoad>,
    /// Fig. 8.
    pub linearity: Linearity,
    /// Figs. 9 and 10 with springs alone.
    pub compared: [Vec<ValidationPose>; 2],
    /// What could be missing.
    pub suspects: Vec<SuspectedEffect>,
    /// How far the chosen support gives, m.
    pub support_motion: [f64; 3],
    /// Error that the paper's estimator then makes on average, um and urad.
    pub hidden_expected: [f64; 6],
    /// The support gives, and the model does not know.
    pub hidden: Experiment,
    /// Figs. 9 and 10 with the hidden effect.
    pub hidden_compared: [Vec<ValidationPose>; 2],
    /// Diagnosis by the paper's plan.
    pub poor: DiagnosisSummary,
    /// Diagnosis by the richer plan.
    pub rich: DiagnosisSummary,
    /// Verdicts of the richer plan under other noise, and what was named.
    pub again: Vec<NamedVerdict>,
}

impl Reproduction {
    /// Runs the study; equal seeds give equal results. `trials` runs those of the richer plan under other noise.
    ///
    /// # Errors
    /// [`PaperError`], and what `trials` says.
    pub fn run<E: From<PaperError>>(
        seed: u64,
        trials: impl FnOnce(&Again) -> Result<Gathered<NamedVerdict>, E>,
    ) -> Result<Self, E> {
        let bench = PaperMachine::new(seed);
        let springs = Experiment::run(&bench, &bench.world(Vec::new()))?;
        let of_the_richer_plan = Again::after(&bench, &springs)?;
        let support_motion = of_the_richer_plan.support_motion;
        let again = trials(&of_the_richer_plan)?;
        if let Some(why) = again.failures().next() {
            return Err(PaperError::Campaign(why.clone()).into());
        }
        Ok(Self::of(bench, springs, support_motion, again.answers.into_iter().flatten().collect())?)
    }

    fn of(
        bench: PaperMachine,
        springs: Experiment,
        support_motion: [f64; 3],
        again: Vec<NamedVerdict>,
    ) -> Result<Self, PaperError> {
        let [published_set, unturned] =
            [IndexedPoses::of(&bench.hexapod, BEST_POSES)?, IndexedPoses::of(&bench.hexapod, UNTURNED)?];
        let best_sets = best_sets(&bench)?;
        let world = bench.world(Vec::new());
        let data = [&springs.identification, &springs.validation];
        let noise = springs.paper.expected;
        let yielding = bench.world(vec![skew_support(support_motion)]);
        let hidden_bias = bias(&bench, skew_support(support_motion))?;
        let hidden = Experiment::run(&bench, &yielding)?;
        let sets = [("Table 1", &published_set), ("best found", &best_sets[0].1), ("no rotation", &unturned)];
        Ok(Self {
            seed: bench.seed,
            repetitions: repetitions(&bench, data, REPETITIONS, &PREDICTION_ERROR, bench.seed)?,
            index_over_load: figure_7(&bench.hexapod, sets)?,
            linearity: figure_8(&bench, &world)?,
            compared: figures_9_and_10(&bench, &springs.paper.identified, &springs.validation)?,
            suspects: suspects(&bench, &noise)?,
            hidden_expected: std::array::from_fn(|k| hidden_bias[k].hypot(noise[k])),
            support_motion,
            hidden_compared: figures_9_and_10(&bench, &hidden.paper.identified, &hidden.validation)?,
            poor: on_the_papers_plan(&bench, &hidden)?,
            rich: on_the_richer_plan(&bench, &yielding)?,
            again,
            published_set,
            best_sets,
            springs,
            hidden,
            bench,
        })
    }
}

fn best_sets(bench: &PaperMachine) -> Result<[(f64, IndexedPoses); 2], PaperError> {
    let poses = |rows: Vec<hexbench_truth::campaign::PlanRow>| -> Vec<_> {
        rows.iter().map(|r| r.situation.pose).collect()
    };
    let validation = stroke(&bench.hexapod, &poses(validation()));
    let all = validation.max(stroke(&bench.hexapod, &poses(identification())));
    let best = |stroke| Ok::<_, PaperError>((stroke, best_poses(&bench.hexapod, stroke, STARTS, 1)?));
    Ok([best(all)?, best(validation)?])
}
