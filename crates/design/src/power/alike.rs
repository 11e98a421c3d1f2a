//! What looks like what, and what is taken for what.

use hexbench_core::parallel;
use hexbench_core::streams::{Purpose, stream};
use hexbench_model::inference::candidates::{Candidate, CandidateKind, Collector};
use hexbench_model::inference::evidence::Gram;
use hexbench_model::inference::search::TermSearch;
use nalgebra::{DMatrix, DVector};
use rand_distr::{Distribution, StandardNormal};
use serde::Serialize;

use super::{EffectPower, EffectSizes, Planned, PowerSettings, subject::shapes};

/// Shape grids longer than this are represented by the shape of the example.
const LONG_GRID: usize = 24;
/// Word for readings that springs alone explain best.
pub const NOTHING: &str = "nothing";

/// Likeness and confusion of the effects of a plan.
#[derive(Debug, Clone, Serialize)]
pub struct Alike {
    /// Ids of the effects.
    pub terms: Vec<&'static str>,
    /// Cosine between the signatures of the middle examples after the springs have taken their share; 0 without signature.
    pub cosine: Vec<Vec<f64>>,
    /// The same before the springs have taken their share.
    pub cosine_with_springs: Vec<Vec<f64>>,
    /// Share of campaigns in which the effect of the row, at the size that is seen, is best explained by the effect of the
    /// column; the last column is [`NOTHING`]. Rows of effects that never show are empty.
    pub taken_for: Vec<Vec<f64>>,
}

impl Alike {
    /// Effects that the effect of a row is taken for, with the share, largest first; the effect itself is left out.
    pub fn mistaken(&self, row: usize) -> Vec<(&'static str, f64)> {
        let names = self.terms.iter().copied().chain([NOTHING]);
        let mut all: Vec<(&'static str, f64)> = names
            .zip(self.taken_for[row].iter().copied())
            .enumerate()
            .filter(|(k, _)| *k != row)
            .map(|(_, x)| x)
            .collect();
        all.retain(|(_, share)| *share > 0.0);
        all.sort_by(|a, b| b.1.total_cmp(&a.1));
        all
    }
}

/// Likeness of all subjects; confusion of those in `effects` that show.
pub(super) fn alike(
    planned: &Planned,
    subjects: &[EffectSizes],
    effects: &[EffectPower],
    settings: &PowerSettings,
) -> Alike {
    let of = |(s, e): (&EffectSizes, &EffectPower)| s.signature(planned, &e.example, signature_scale(e));
    let whole: Vec<DVector<f64>> = subjects.iter().zip(effects).map(of).collect();
    let rests: Vec<DVector<f64>> = whole.iter().map(|s| planned.absorption.rest(s)).collect();
    let evidence = Evidence::new(planned, subjects, effects);
    let row = |k: usize| {
        if effects[k].shows() { evidence.shares(&rests[k], k, settings) } else { Vec::new() }
    };
    Alike {
        terms: effects.iter().map(|e| e.term).collect(),
        cosine: cosines(&rests),
        cosine_with_springs: cosines(&whole),
        taken_for: (0..effects.len()).map(row).collect(),
    }
}

fn signature_scale(effect: &EffectPower) -> f64 {
    if effect.shows() { effect.seen_at.middle } else { 1.0 }
}

fn cosines(signatures: &[DVector<f64>]) -> Vec<Vec<f64>> {
    let cosine = |a: &DVector<f64>, b: &DVector<f64>| {
        let lengths = a.norm() * b.norm();
        if lengths > 0.0 { (a.dot(b).abs() / lengths).min(1.0) } else { 0.0 }
    };
    signatures.iter().map(|a| signatures.iter().map(|b| cosine(a, b)).collect()).collect()
}

/// The evidence of the diagnosis, with at most one effect.
struct Evidence {
    gram: Gram,
    candidates: Vec<Candidate>,
    /// Columns of all blocks in units of their priors; equations x columns.
    columns: DMatrix<f64>,
    rank_of_springs: f64,
}

impl Evidence {
    fn new(planned: &Planned, subjects: &[EffectSizes], effects: &[EffectPower]) -> Self {
        let mut collector = Collector::new(&planned.lin, planned.natural);
        for (subject, effect) in subjects.iter().zip(effects) {
            let grid = shapes(subject.term.as_ref(), planned);
            let tried = if grid.len() > LONG_GRID { vec![effect.example.shape] } else { grid.clone() };
            collector.add_term(&subject.term, &tried, grid.len(), None);
        }
        let (gram, candidates) = collector.finish(&planned.campaign, &planned.point);
        let columns = columns(planned, &gram, &candidates);
        let rank_of_springs = planned.lin.equations() as f64 - gram.likelihood.equations;
        Self { gram, candidates, columns, rank_of_springs }
    }

    /// Share of campaigns with a signature in which each candidate, and nothing, explains best.
    fn shares(&self, rest: &DVector<f64>, row: usize, settings: &PowerSettings) -> Vec<f64> {
        let nothing = self.candidates.len();
        let winners: Vec<usize> = parallel::map_range(settings.draws, &|draw| {
            self.winner(rest, settings.seed, [row, draw]).unwrap_or(nothing)
        });
        let share =
            |k: usize| winners.iter().filter(|w| **w == k).count() as f64 / settings.draws.max(1) as f64;
        (0..=nothing).map(share).collect()
    }

    /// The candidate that explains best, if any.
    fn winner(&self, rest: &DVector<f64>, seed: u64, [row, draw]: [usize; 2]) -> Option<usize> {
        let mut rng = stream(seed, Purpose::PowerConfusion, [row as u64, draw as u64]);
        let y = rest.map(|x| -> f64 { x + Distribution::<f64>::sample(&StandardNormal, &mut rng) });
        let mut gram = self.gram.clone();
        gram.b = self.columns.tr_mul(&y);
        gram.likelihood.yy = (y.norm_squared() - self.rank_of_springs).max(0.0);
        let sets = TermSearch::new(&gram, &self.candidates, false).run(1);
        sets.sets.first().and_then(|best| best.members.first().copied())
    }
}

/// Columns of all blocks, less what springs absorb, in units of their priors.
fn columns(planned: &Planned, gram: &Gram, candidates: &[Candidate]) -> DMatrix<f64> {
    let width = gram.g.ncols();
    let mut all = DMatrix::zeros(planned.lin.equations(), width);
    for candidate in candidates {
        let CandidateKind::Term(term) = &candidate.kind else { continue };
        for &index in &candidate.blocks {
            let block = &gram.blocks[index];
            let columns = planned.lin.term_block(term.as_ref(), block.rich, block.shape) * &block.transform;
            for (k, column) in columns.column_iter().enumerate() {
                all.set_column(block.first + k, &planned.absorption.rest(&column.into_owned()));
            }
        }
    }
    all
}
