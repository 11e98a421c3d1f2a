//! The tasks of a trial, one file each.

pub mod diagnose;
pub mod open;
pub mod springs;

use crate::sweep::bench::BlockSetup;
use crate::sweep::cells::GridCell;
use crate::sweep::columns::Status;
use crate::sweep::runner::Runner;
use crate::sweep::shard::Shard;

/// Runs the trials of a shard: `prepare` once for a block, `trial` for each with its cell and number within it.
fn blocks<P>(
    runner: &Runner,
    shard: &mut Shard,
    prepare: impl Fn(BlockSetup, &GridCell<'_>) -> Result<P, Status>,
    trial: impl Fn(&P, &GridCell<'_>, u64, &mut Shard),
) {
    let study = runner.study();
    let mut ready: Option<((usize, u64), Result<P, Status>)> = None;
    for number in shard.trials.clone() {
        let (index, within) = study.place(number);
        let cell = study.axes.cell(index);
        let block = within / study.redraw;
        if ready.as_ref().is_none_or(|(at, _)| *at != (index, block)) {
            let prepared = BlockSetup::draw(runner, &cell, block).and_then(|bench| prepare(bench, &cell));
            ready = Some(((index, block), prepared));
        }
        match ready.as_ref().map(|(_, prepared)| prepared) {
            Some(Ok(prepared)) => trial(prepared, &cell, within, shard),
            Some(Err(status)) => shard.push_failed(*status),
            None => shard.push_failed(Status::NoFit),
        }
    }
}
