//! Cells that stop when they are decided: trials go where the question is open.
//!
//! A cell is looked at after one shard, two, four and so on, up to all its trials. It stops at the first look at which its bounds
//! answer the question or are as narrow as wanted. Bounds hold at all looks of all cells together: each has its share of the
//! chance of error. Whether a cell stops depends on its own shards in order, so that results depend neither on threads nor on
//! interruptions; shards beyond a stop do not count.

use crate::error::ExperimentError;
use crate::journal::Journal;
use crate::sweep::page::{Meets, judged};
use crate::sweep::results::{CellStatistics, add_shard, filled};
use crate::sweep::runner::Runner;
use crate::sweep::study::SweepStudy;

/// Shards of a cell at which it is looked at.
pub fn looks(shards_of_a_cell: u64) -> impl Iterator<Item = u64> {
    let doubled = std::iter::successors(Some(1_u64), |n| n.checked_mul(2));
    doubled.take_while(move |n| *n < shards_of_a_cell).chain([shards_of_a_cell])
}

/// Looks of a study: one where cells do not stop.
pub fn looks_of(study: &SweepStudy) -> usize {
    study.until.map_or(1, |_| looks(shards_of_a_cell(study)).count())
}

fn shards_of_a_cell(study: &SweepStudy) -> u64 {
    study.trials.div_ceil(study.task.trials_of_a_shard())
}

/// What of a study counts, and what is still to be computed.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Progressed {
    /// Shards whose trials count, in order.
    pub counted: Vec<u64>,
    /// Shards that are wanted next, in order; empty when every cell has come to an end.
    pub pending: Vec<u64>,
}

/// How far the cells of a study are that stop when they are decided.
///
/// # Errors
/// [`ExperimentError::Read`].
pub fn progressed(runner: &Runner, journal: &Journal, until: f64) -> Result<Progressed, ExperimentError> {
    let missing = journal.state()?.pending;
    let mut all = Progressed::default();
    for cell in 0..runner.study().axes.cells() {
        of_cell(runner, journal, (cell, until), &missing, &mut all)?;
    }
    Ok(all)
}

fn of_cell(
    runner: &Runner,
    journal: &Journal,
    (cell, until): (usize, f64),
    missing: &[u64],
    all: &mut Progressed,
) -> Result<(), ExperimentError> {
    let shards = shards_of_a_cell(runner.study());
    let first = cell as u64 * shards;
    let (mut done, mut found) = (0, Vec::new());
    for look in looks(shards) {
        let next = first + done..first + look;
        let open: Vec<u64> = next.clone().filter(|n| missing.binary_search(n).is_ok()).collect();
        all.counted.extend(next.clone());
        if !open.is_empty() {
            all.pending.extend(open);
            return Ok(());
        }
        for number in next {
            add_shard(runner, &filled(runner, journal, number)?, &mut found);
        }
        done = look;
        if found.first().is_some_and(|found| is_decided(runner.study(), found, until)) {
            return Ok(());
        }
    }
    Ok(())
}

/// True when bounds answer the question, or are as narrow as wanted: of a share half their width, of an error that over the error.
fn is_decided(study: &SweepStudy, found: &CellStatistics, until: f64) -> bool {
    let Some(plan) = judged(study, found) else { return true };
    let [value, low, high] = plan.found;
    let scale = if study.asks_share() { 1.0 } else { value };
    plan.meets != Meets::Maybe || 0.5 * (high - low) <= until * scale
}

#[cfg(test)]
mod tests {
    use super::looks;

    #[test]
    fn looks_double_and_end_with_all_shards() {
        assert_eq!(looks(10).collect::<Vec<_>>(), [1, 2, 4, 8, 10]);
        assert_eq!(looks(8).collect::<Vec<_>>(), [1, 2, 4, 8]);
        assert_eq!(looks(1).collect::<Vec<_>>(), [1]);
    }
}
