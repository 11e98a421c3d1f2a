//! Running statistics of a cell, in the order of its trials.

use hexbench_core::statistics::{Proportion, Welford};

use super::outcomes::{AnswerStatistics, Counted};
use super::spread::BlockSquares;
use crate::sweep::columns::Status;
use crate::sweep::cost::PlanCost;
use crate::sweep::indices::INDICES;
use crate::sweep::runner::Runner;
use crate::sweep::shard::Shard;
use crate::sweep::study::SweepTask;

/// What the trials of a cell say.
#[derive(Debug, Clone, PartialEq)]
pub struct CellStatistics {
    /// Number of the cell.
    pub cell: usize,
    /// Trials by status, in the order of [`Status::NAMES`].
    pub by_status: [u64; Status::NAMES.len()],
    /// Fits of stiffness.
    pub springs: StiffnessStatistics,
    /// Answers of the diagnosis.
    pub answers: AnswerStatistics,
    /// What its plan costs, where a plan is asked for.
    pub cost: Option<PlanCost>,
    /// Plans with their indices, one for each block, where the study asks for them.
    pub plans: Vec<PlanAccuracy>,
}

/// A plan and how well stiffnesses come out of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanAccuracy {
    /// Number of the block of trials.
    pub block: u64,
    /// Indices, in the order of `Criterion::ALL`.
    pub indices: [f64; INDICES],
    /// Stiffness errors of its trials, percent.
    pub errors: Welford,
}

/// Fits of stiffness.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StiffnessStatistics {
    /// Errors of all legs, percent.
    pub errors: Welford,
    /// The same by blocks.
    pub blocks: BlockSquares,
    /// Legs covered.
    pub covered: u64,
    /// Root mean square error of predictions: um, urad, over the noise.
    pub holdout: [Welford; 3],
}

impl CellStatistics {
    /// A cell without trials.
    pub fn empty(cell: usize) -> Self {
        let (springs, answers) = (StiffnessStatistics::default(), AnswerStatistics::default());
        Self { cell, by_status: [0; 6], springs, answers, cost: None, plans: Vec::new() }
    }

    /// Trials of both cells taken together; the number is that of the first.
    #[must_use]
    pub fn and(mut self, other: &Self) -> Self {
        self.by_status.iter_mut().zip(other.by_status).for_each(|(a, b)| *a += b);
        self.springs.errors = self.springs.errors.and(other.springs.errors);
        self.springs.blocks = self.springs.blocks.and(other.springs.blocks);
        self.springs.covered += other.springs.covered;
        for k in 0..3 {
            self.springs.holdout[k] = self.springs.holdout[k].and(other.springs.holdout[k]);
        }
        self.answers = self.answers.and(&other.answers);
        self.plans.extend(&other.plans);
        self
    }

    /// Trials.
    pub fn trials(&self) -> u64 {
        self.by_status.iter().sum()
    }

    /// Trials with an answer.
    pub fn done(&self) -> u64 {
        self.by_status[Status::Done as usize]
    }

    /// Share of 95 % intervals that hold the truth, with its bounds. Intervals of one trial share its noise: each trial counts
    /// once in the bounds.
    pub fn coverage(&self) -> [f64; 3] {
        let done = self.done();
        let share = self.springs.covered as f64 / (6 * done) as f64;
        // Rounding to whole trials moves a bound by less than half a trial.
        let [low, high] = proportion((self.springs.covered + 3) / 6, done).interval();
        if done == 0 { [f64::NAN; 3] } else { [share, low.min(share), high.max(share)] }
    }

    /// Share of an outcome with 95 % bounds that count trials with the same machine as far as they tell something new.
    pub fn share(&self, of: Counted) -> [f64; 3] {
        const ERROR: f64 = 0.05;
        let found = self.answers.share(of);
        let [low, high] = found.interval(ERROR);
        [found.rate(), low, high]
    }
}

fn proportion(hits: u64, of: u64) -> Proportion {
    let whole = |n: u64| usize::try_from(n).unwrap_or(usize::MAX);
    Proportion { hits: whole(hits), of: whole(of) }
}

/// Takes a shard in; shards come in order.
pub fn add(runner: &Runner, shard: &Shard, cells: &mut Vec<CellStatistics>) {
    for (row, trial) in shard.trials.clone().enumerate() {
        let (cell, within) = runner.study().place(trial);
        if cells.last().is_none_or(|last| last.cell != cell) {
            let asked = runner.study().question.is_some();
            let cost = asked.then(|| PlanCost::of(runner, &runner.study().axes.cell(cell))).flatten();
            cells.push(CellStatistics { cost, ..CellStatistics::empty(cell) });
        }
        let Some(now) = cells.last_mut() else { continue };
        let status = usize::from(shard.columns[0].codes()[row]);
        now.by_status[status] += 1;
        if status == Status::Done as usize {
            let block = within / runner.study().redraw;
            match runner.study().task {
                SweepTask::Springs => now.springs.add(block, shard, row),
                SweepTask::Diagnose => now.answers.add(block, shard, row),
            }
            if runner.study().indices {
                now.add_plan(runner.study().task, block, shard, row);
            }
        }
    }
}

/// Stiffness errors of a trial, percent.
fn errors(shard: &Shard, row: usize) -> impl Iterator<Item = f64> {
    (1..=6).map(move |leg| shard.columns[leg].numbers()[row])
}

impl CellStatistics {
    /// Notes the indices of a plan with the first trial on it, and what every trial finds.
    fn add_plan(&mut self, task: SweepTask, block: u64, shard: &Shard, row: usize) {
        if self.plans.last().is_none_or(|last| last.block != block) {
            let first = shard.columns.len() - INDICES;
            let indices = std::array::from_fn(|k| shard.columns[first + k].numbers()[row]);
            self.plans.push(PlanAccuracy { block, indices, errors: Welford::default() });
        }
        if let (SweepTask::Springs, Some(plan)) = (task, self.plans.last_mut()) {
            errors(shard, row).for_each(|error| plan.errors.add(error));
        }
    }
}

impl StiffnessStatistics {
    fn add(&mut self, block: u64, shard: &Shard, row: usize) {
        errors(shard, row).for_each(|error| self.errors.add(error));
        self.blocks.add(block, errors(shard, row));
        self.covered += u64::from(shard.columns[7].codes()[row]);
        for (k, holdout) in self.holdout.iter_mut().enumerate() {
            holdout.add(shard.columns[8 + k].numbers()[row]);
        }
    }
}
