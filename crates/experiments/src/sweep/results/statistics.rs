//! Running statistics of a cell, in the order of its trials.

use crate::Proportion;

use crate::sweep::columns::Status;
use crate::sweep::runner::Runner;
use crate::sweep::shard::Shard;
use crate::sweep::study::Task;

/// Mean and spread of numbers as they come. Source: Welford, Technometrics 4 (1962) 419.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Welford {
    count: u64,
    mean: f64,
    squares: f64,
}

impl Welford {
    /// Takes a number in.
    pub fn add(&mut self, x: f64) {
        self.count += 1;
        let before = x - self.mean;
        self.mean += before / self.count as f64;
        self.squares += before * (x - self.mean);
    }

    /// Both sets of numbers. Source: Chan, Golub and `LeVeque`, The American Statistician 37 (1983) 242.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        let count = self.count + other.count;
        if other.count == 0 || count == 0 {
            return self;
        }
        let (n, m, apart) = (self.count as f64, other.count as f64, other.mean - self.mean);
        let all = count as f64;
        Self {
            count,
            mean: self.mean + apart * m / all,
            squares: self.squares + other.squares + apart * apart * n * m / all,
        }
    }

    /// How many numbers it has seen.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Mean; NaN of nothing.
    pub fn mean(&self) -> f64 {
        if self.count == 0 { f64::NAN } else { self.mean }
    }

    /// Standard deviation of the sample; NaN of fewer than two.
    pub fn std(&self) -> f64 {
        if self.count < 2 { f64::NAN } else { (self.squares / (self.count - 1) as f64).sqrt() }
    }

    /// Root mean square; NaN of nothing.
    pub fn rms(&self) -> f64 {
        (self.squares / self.count as f64 + self.mean() * self.mean()).sqrt()
    }
}

/// What the trials of a cell say.
#[derive(Debug, Clone, PartialEq)]
pub struct CellStatistics {
    /// Number of the cell.
    pub cell: usize,
    /// Trials by status, in the order of [`Status::NAMES`].
    pub by_status: [u64; Status::NAMES.len()],
    /// Fits of stiffness.
    pub springs: Springs,
    /// Answers of the diagnosis.
    pub answers: Answers,
}

/// Fits of stiffness.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Springs {
    /// Errors of all legs, percent.
    pub errors: Welford,
    /// Legs covered.
    pub covered: u64,
    /// Root mean square error of predictions: um, urad, over the noise.
    pub holdout: [Welford; 3],
}

/// Answers of the diagnosis.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Answers {
    /// Right, honest, wrong.
    pub outcomes: [u64; 3],
    /// Held-out chi-square: springs alone, final model.
    pub holdout: [Welford; 2],
}

impl CellStatistics {
    /// A cell without trials.
    pub fn empty(cell: usize) -> Self {
        let (springs, answers) = (Springs::default(), Answers::default());
        Self { cell, by_status: [0; 6], springs, answers }
    }

    /// Trials of both cells taken together; the number is that of the first.
    #[must_use]
    pub fn and(mut self, other: &Self) -> Self {
        self.by_status.iter_mut().zip(other.by_status).for_each(|(a, b)| *a += b);
        self.springs.errors = self.springs.errors.and(other.springs.errors);
        self.springs.covered += other.springs.covered;
        for k in 0..3 {
            self.springs.holdout[k] = self.springs.holdout[k].and(other.springs.holdout[k]);
            self.answers.outcomes[k] += other.answers.outcomes[k];
        }
        for k in 0..2 {
            self.answers.holdout[k] = self.answers.holdout[k].and(other.answers.holdout[k]);
        }
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

    /// Share of an outcome (0 right, 1 honest, 2 wrong) with its bounds.
    pub fn share(&self, outcome: usize) -> [f64; 3] {
        let found = proportion(self.answers.outcomes[outcome], self.done());
        let [low, high] = found.interval();
        if found.of == 0 { [f64::NAN; 3] } else { [found.rate(), low, high] }
    }
}

fn proportion(hits: u64, of: u64) -> Proportion {
    let whole = |n: u64| usize::try_from(n).unwrap_or(usize::MAX);
    Proportion { hits: whole(hits), of: whole(of) }
}

/// Takes a shard in; shards come in order.
pub(super) fn add(runner: &Runner, shard: &Shard, cells: &mut Vec<CellStatistics>) {
    for (row, trial) in shard.trials.clone().enumerate() {
        let (cell, _) = runner.study().place(trial);
        if cells.last().is_none_or(|last| last.cell != cell) {
            cells.push(CellStatistics::empty(cell));
        }
        let Some(now) = cells.last_mut() else { continue };
        let status = usize::from(shard.columns[0].codes()[row]);
        now.by_status[status] += 1;
        if status == Status::Done as usize {
            match runner.study().task {
                Task::Springs => now.springs.add(shard, row),
                Task::Diagnose => now.answers.add(shard, row),
            }
        }
    }
}

impl Springs {
    fn add(&mut self, shard: &Shard, row: usize) {
        for leg in 1..=6 {
            self.errors.add(shard.columns[leg].numbers()[row]);
        }
        self.covered += u64::from(shard.columns[7].codes()[row]);
        for (k, holdout) in self.holdout.iter_mut().enumerate() {
            holdout.add(shard.columns[8 + k].numbers()[row]);
        }
    }
}

impl Answers {
    fn add(&mut self, shard: &Shard, row: usize) {
        self.outcomes[usize::from(shard.columns[1].codes()[row])] += 1;
        for (k, holdout) in self.holdout.iter_mut().enumerate() {
            let chi2 = shard.columns[6 + k].numbers()[row];
            if chi2.is_finite() {
                holdout.add(chi2);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Welford;

    #[test]
    fn running_statistics_are_those_of_the_textbook() {
        // Ten numbers far from zero: the naive sum of squares loses eight digits here.
        const BASE: f64 = 1e8;
        let mut all = Welford::default();
        (1..=10).for_each(|k| all.add(BASE + f64::from(k)));
        assert!((all.mean() - (BASE + 5.5)).abs() < 1e-7, "{}", all.mean());
        let std = (82.5_f64 / 9.0).sqrt();
        assert!((all.std() - std).abs() < 1e-7 * std, "{}", all.std());
        let mut small = Welford::default();
        small.add(3.0);
        small.add(-4.0);
        assert!((small.rms() - 12.5_f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn statistics_of_parts_together_are_those_of_the_whole() {
        let of = |range: std::ops::Range<i32>| {
            let mut all = Welford::default();
            range.for_each(|k| all.add(f64::from(k * k)));
            all
        };
        let (whole, parts) = (of(0..9), of(0..0).and(of(0..4)).and(of(4..9)).and(of(0..0)));
        assert_eq!(whole.count(), parts.count());
        assert!((whole.mean() - parts.mean()).abs() < 1e-13, "{} {}", whole.mean(), parts.mean());
        assert!((whole.std() - parts.std()).abs() < 1e-13, "{} {}", whole.std(), parts.std());
    }

    #[test]
    fn nothing_has_no_mean() {
        assert!(Welford::default().mean().is_nan() && Welford::default().rms().is_nan());
    }
}
