//! Results: a pure function of the shards in order.
//!
//! | file | holds |
//! |---|---|
//! | `trials.parquet` | one row per trial: the cell, its value on every axis, the results |
//! | `cells.csv` | one row per cell: mean, spread, coverage, shares with their bounds |

mod outcomes;
mod spread;
mod statistics;
mod table;
mod trials;

use hexbench_core::files::atomic_write;

use crate::error::ExperimentError;
use crate::harness::Sharded;
use crate::journal::Journal;
use crate::sweep::runner::Runner;
pub use outcomes::{AnswerStatistics, Counted, SHARES};
pub use spread::BlockSquares;
pub use statistics::{CellStatistics, PlanAccuracy, StiffnessStatistics};
pub use table::cells_csv;

/// Name of the table of trials.
pub const TRIALS: &str = "trials.parquet";
/// Name of the table of cells.
pub const CELLS: &str = "cells.csv";

/// Writes both tables from the shards of a journal, one shard in memory at a time; `done` hears of each.
///
/// # Errors
/// [`ExperimentError::Write`], [`ExperimentError::Missing`], [`ExperimentError::Read`].
pub fn write(
    runner: &Runner,
    journal: &Journal,
    done: &dyn Fn(),
) -> Result<Vec<CellStatistics>, ExperimentError> {
    let path = journal.folder().join(TRIALS);
    let mut cells: Vec<CellStatistics> = Vec::new();
    let mut failed = None;
    let written = atomic_write(&path, |out| {
        let mut table = trials::Table::begin(runner, out)?;
        for number in 0..runner.shards().count() {
            let content = journal.content(number);
            let filled = content
                .and_then(|bytes| runner.empty(number).filled(&bytes).ok_or_else(|| journal.missing(number)));
            let shard = match filled {
                Ok(shard) => shard,
                Err(cause) => {
                    failed = Some(cause);
                    return Err(std::io::Error::other("a shard is missing"));
                }
            };
            statistics::add(runner, &shard, &mut cells);
            table.add(&shard)?;
            done();
        }
        table.end()
    });
    match (written, failed) {
        (_, Some(missing)) => return Err(missing),
        (Err(cause), None) => return Err(ExperimentError::Write { path, cause }),
        (Ok(()), None) => {}
    }
    let path = journal.folder().join(CELLS);
    let text = cells_csv(runner.study(), &cells);
    let written = atomic_write(&path, |out| out.write_all(text.as_bytes()));
    written.map_err(ExperimentError::writing(&path))?;
    Ok(cells)
}
