//! Which index predicts the error of stiffness.

use hexbench_design::Criterion;
use hexbench_report::Table;

use super::rank::{rank_advantage, rank_correlation};
use super::sentence::{chosen, given};
use crate::sweep::indices::INDICES;
use crate::sweep::question::ERROR;
use crate::sweep::results::CellStatistics;
use crate::sweep::study::SweepStudy;

/// What the numbers mean.
pub(super) const READING: &str = "Rank correlation of an index, which is known before any reading, with the stiffness error that its \
     plan turns out to have (root mean square over trials and legs): 1 where a larger index always means a smaller error, 0 \
     where it says nothing. 95 % bounds by resampling the plans, each correlation by itself; an index is best \
     beyond chance where the difference to another is, on the same resampled plans. The machine is drawn with every plan, and its error depends on its \
     stiffness too; an error counted from a few trials \
     is itself uncertain: both keep all correlations below 1.";

/// Plans below which a correlation tells nothing.
const FEWEST: usize = 8;

/// How well each index predicts, for the plans of a cell.
#[derive(Debug, Clone, PartialEq)]
pub struct IndexRank {
    /// Number of the cell.
    pub cell: usize,
    /// Plans.
    pub plans: usize,
    /// Rank correlation with its bounds, in the order of `Criterion::ALL`.
    pub found: [[f64; 3]; INDICES],
    /// True for indices that do not predict worse than the best beyond chance.
    pub as_good: [bool; INDICES],
}

impl IndexRank {
    /// Indices, the best first.
    fn order(&self) -> [usize; INDICES] {
        let mut order: [usize; INDICES] = std::array::from_fn(|k| k);
        order.sort_by(|&a, &b| self.found[b][0].total_cmp(&self.found[a][0]));
        order
    }
}

/// One entry for each cell whose plans differ.
pub fn ranks(study: &SweepStudy, cells: &[CellStatistics]) -> Vec<IndexRank> {
    let enough = |cell: &&CellStatistics| cell.plans.len() >= FEWEST && study.indices;
    let varies = |found: &IndexRank| found.found.iter().any(|[rho, ..]| rho.is_finite());
    cells.iter().filter(enough).map(rank).filter(varies).collect()
}

fn rank(cell: &CellStatistics) -> IndexRank {
    let pairs = |k: usize| cell.plans.iter().map(move |plan| [plan.indices[k], -plan.errors.rms()]);
    let pairs: [Vec<[f64; 2]>; INDICES] = std::array::from_fn(|k| pairs(k).collect());
    let found: [[f64; 3]; INDICES] = std::array::from_fn(|k| rank_correlation(&pairs[k], ERROR));
    let mut ranked = IndexRank { cell: cell.cell, plans: cell.plans.len(), found, as_good: [true; INDICES] };
    let best = ranked.order()[0];
    for (k, as_good) in ranked.as_good.iter_mut().enumerate().filter(|(k, _)| *k != best) {
        *as_good = rank_advantage(&pairs[best], &pairs[k], ERROR)[1] <= 0.0;
    }
    ranked
}

/// The best index, those that are as good, and the last.
pub(super) fn sentence(study: &SweepStudy, found: &IndexRank) -> String {
    let order = found.order();
    let name = |k: usize| Criterion::ALL[k].name();
    let in_words = |k: usize| {
        let [rho, low, high] = found.found[k];
        format!("{rho:.2} ({low:.2} to {high:.2})")
    };
    let others = order[1..].iter().filter(|k| found.as_good[**k]);
    let others: Vec<&str> = others.map(|&k| name(k)).collect();
    let others = match others.as_slice() {
        [] => "significantly".to_owned(),
        all => format!("not significantly better than {}", all.join(", ")),
    };
    let last = order[INDICES - 1];
    format!(
        "{}: {} predicts the stiffness error best ({others}): rank correlation {} over {} plans; {} says least, {}.",
        head(study, found),
        name(order[0]),
        in_words(order[0]),
        found.plans,
        name(last),
        in_words(last),
    )
}

/// What the plans have in common, in few words.
fn head(study: &SweepStudy, found: &IndexRank) -> String {
    let cell = study.axes.cell(found.cell);
    given(study, &cell).into_iter().chain([chosen(study, &cell)]).collect::<Vec<_>>().join(", ")
}

/// Every index and every cell.
pub(super) fn table(study: &SweepStudy, cells: &[CellStatistics]) -> Table {
    let ranks = ranks(study, cells);
    let heads: Vec<String> = ranks.iter().map(|found| head(study, found)).collect();
    let row = |k: usize| {
        let in_words = |found: &IndexRank| {
            let [rho, low, high] = found.found[k];
            if rho.is_nan() { "-".to_owned() } else { format!("{rho:.2} ({low:.2} to {high:.2})") }
        };
        std::iter::once(Criterion::ALL[k].name().to_owned())
            .chain(ranks.iter().map(in_words))
            .collect::<Vec<_>>()
    };
    let mut table = Table::named(std::iter::once("index").chain(heads.iter().map(String::as_str)));
    (0..INDICES).for_each(|k| table.row(row(k)));
    table
}
