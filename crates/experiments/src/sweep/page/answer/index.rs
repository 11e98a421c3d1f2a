//! Which index predicts the error of stiffness.

use hexbench_design::Criterion;
use hexbench_report::Table;

use super::rank::rank_correlation;
use super::sentence::{chosen, given};
use crate::sweep::indices::INDICES;
use crate::sweep::question::ERROR;
use crate::sweep::results::CellStatistics;
use crate::sweep::study::SweepStudy;

/// What the numbers mean.
pub(super) const READING: &str = "Rank correlation of an index, which is known before any reading, with the stiffness error that its \
     plan turns out to have (root mean square over trials and legs): 1 where a larger index always means a smaller error, 0 \
     where it says nothing. 95 % bounds by resampling the plans, each correlation by itself. An error counted from a few trials \
     is itself uncertain, which keeps all correlations below 1.";

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
    let of = |cell: &CellStatistics| IndexRank {
        cell: cell.cell,
        plans: cell.plans.len(),
        found: std::array::from_fn(|k| {
            let pairs: Vec<[f64; 2]> =
                cell.plans.iter().map(|plan| [plan.indices[k], -plan.errors.rms()]).collect();
            rank_correlation(&pairs, ERROR)
        }),
    };
    let varies = |found: &IndexRank| found.found.iter().any(|[rho, ..]| rho.is_finite());
    cells.iter().filter(enough).map(of).filter(varies).collect()
}

/// The best index, the next, and the last.
pub(super) fn sentence(study: &SweepStudy, found: &IndexRank) -> String {
    let cell = study.axes.cell(found.cell);
    let order = found.order();
    let name = |place: usize| Criterion::ALL[order[place]].name();
    let told = |place: usize| {
        let [rho, low, high] = found.found[order[place]];
        format!("{rho:.2} ({low:.2} to {high:.2})")
    };
    format!(
        "{}, {}: {} predicts the stiffness error best: rank correlation {} over {} plans; then {} {}; {} says least, {}.",
        given(study, &cell),
        chosen(study, &cell),
        name(0),
        told(0),
        found.plans,
        name(1),
        told(1),
        name(INDICES - 1),
        told(INDICES - 1),
    )
}

/// Every index and every cell.
pub(super) fn table(study: &SweepStudy, cells: &[CellStatistics]) -> Table {
    let ranks = ranks(study, cells);
    let head = |found: &IndexRank| {
        let cell = study.axes.cell(found.cell);
        format!("{}, {}", given(study, &cell), chosen(study, &cell))
    };
    let heads: Vec<String> = ranks.iter().map(head).collect();
    let row = |k: usize| {
        let told = |found: &IndexRank| {
            let [rho, low, high] = found.found[k];
            if rho.is_nan() { "-".to_owned() } else { format!("{rho:.2} ({low:.2} to {high:.2})") }
        };
        std::iter::once(Criterion::ALL[k].name().to_owned()).chain(ranks.iter().map(told)).collect::<Vec<_>>()
    };
    let mut table = Table::named(std::iter::once("index").chain(heads.iter().map(String::as_str)));
    (0..INDICES).for_each(|k| table.row(row(k)));
    table
}
