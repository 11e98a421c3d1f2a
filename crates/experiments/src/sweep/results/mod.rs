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
use crate::sweep::precision;
use crate::sweep::runner::Runner;
use crate::sweep::shard::Shard;
pub use outcomes::{AnswerStatistics, Counted, SHARES};
pub use spread::BlockSquares;
pub use statistics::add as add_shard;
pub use statistics::{CellStatistics, PlanAccuracy, StiffnessStatistics};
pub use table::cells_csv;

/// Name of the table of trials.
pub const TRIALS: &str = "trials.parquet";
/// Name of the table of cells.
pub const CELLS: &str = "cells.csv";

/// A shard out of a journal.
///
/// # Errors
/// [`ExperimentError::Missing`], [`ExperimentError::Read`].
pub fn filled(runner: &Runner, journal: &Journal, number: u64) -> Result<Shard, ExperimentError> {
    let bytes = journal.content(number)?;
    runner.empty(number).filled(&bytes).ok_or_else(|| journal.missing(number))
}

/// Shards whose trials count: all, unless cells stop when they are decided.
fn counted(runner: &Runner, journal: &Journal) -> Result<Vec<u64>, ExperimentError> {
    match runner.study().until {
        None => Ok((0..runner.shards().count()).collect()),
        Some(until) => Ok(precision::progressed(runner, journal, until)?.counted),
    }
}

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
    let counted = counted(runner, journal)?;
    let written = atomic_write(&path, |out| {
        let mut table = trials::Table::begin(runner, out)?;
        for &number in &counted {
            let shard = match filled(runner, journal, number) {
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
