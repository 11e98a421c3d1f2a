//! The rule for the same cases before and after a change.
//!
//! A figure is worse when two things hold: over the cases it grew by more than its tolerance, and chance does not explain it. Hits (something
//! bad in a case) have no tolerance; values compare by the mean of their logarithms, and may grow by the factor [`SAME_CASES`]. Chance
//! takes part only where runs of an unchanged program differ; how much they do is taken from the repeats of each case
//! ([`super::exchange`]). Without any scatter every hit more is a fact.

use statrs::distribution::{Binomial, DiscreteCDF};

use super::LimitVerdict;
use super::exchange::{self, CaseHits};

/// Factor by which a mean over the same cases may grow: another rounding moves it by a hundredth at most.
pub const SAME_CASES: f64 = 1.05;

/// What a figure counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FigureKind {
    /// Something bad happened in a case, 1, or it did not, 0.
    Hit,
    /// A positive number, the smaller the better; values outside the range count as its ends.
    Size {
        /// Smallest and largest.
        range: [f64; 2],
    },
}

impl FigureKind {
    /// A value as it is summed: hits as they are, sizes as logarithms.
    pub fn scaled(self, value: f64) -> f64 {
        match self {
            Self::Hit => value,
            Self::Size { range } => value.clamp(range[0], range[1]).ln(),
        }
    }

    /// True when so large a growth over the cases is beyond the tolerance: hits, or the mean of logarithms.
    pub fn is_beyond(self, growth: f64) -> bool {
        const ROUNDING: f64 = 1e-9;
        growth > ROUNDING + if self == Self::Hit { 0.0 } else { SAME_CASES.ln() }
    }
}

/// Values of one figure, run by run and case by case; a case that lacks it has none.
pub type RunValues = Vec<Vec<Option<f64>>>;

/// How a figure compares on the same cases.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SameCasesJudgement {
    /// The verdict.
    pub verdict: LimitVerdict,
    /// Probability of a change for the worse this large in runs of an unchanged program; `None` where such runs do not differ.
    pub chance: Option<f64>,
    /// Cases compared.
    pub cases: usize,
    /// Sum of hits, or mean of logarithms: before and now, averaged over the runs.
    pub figures: [f64; 2],
    /// Cases that are worse, and cases that are better.
    pub moved: [usize; 2],
    /// Probability that as many more cases are worse than better when each way is as probable: what this says of other cases.
    pub elsewhere: f64,
}

/// Compares a figure; `level` is its share of the false alarms, none where runs of an unchanged program do not differ.
pub fn judge(
    kind: FigureKind,
    before: &RunValues,
    now: &RunValues,
    level: Option<f64>,
) -> SameCasesJudgement {
    let [before, now] = paired(kind, before, now);
    let cases = before.len();
    let means = [&before, &now].map(|all| all.iter().map(|case| mean(case)).collect::<Vec<f64>>());
    let total = |means: &Vec<f64>| {
        let sum: f64 = means.iter().sum();
        if kind == FigureKind::Hit { sum } else { sum / cases.max(1) as f64 }
    };
    let figures = [total(&means[0]), total(&means[1])];
    let growth = figures[1] - figures[0];
    let chances = level.map(|level| by_chance(kind, &before, &now, level));
    let within = |chance: Option<f64>| chance.is_none_or(|p| level.is_some_and(|level| p <= level));
    let worse = kind.is_beyond(growth) && within(chances.map(|c| c[0]));
    let better = kind.is_beyond(-growth) && within(chances.map(|c| c[1]));
    let moved = moved(&means);
    SameCasesJudgement {
        verdict: LimitVerdict::of(worse, better),
        chance: chances.map(|c| c[0]),
        cases,
        figures,
        moved,
        elsewhere: signs(moved),
    }
}

/// Scaled values by case, of the cases that have one in every run.
fn paired(kind: FigureKind, before: &RunValues, now: &RunValues) -> [Vec<Vec<f64>>; 2] {
    let cases = before.first().map_or(0, Vec::len);
    let of = |runs: &RunValues, k: usize| -> Option<Vec<f64>> {
        runs.iter().map(|run| run.get(k).copied().flatten().map(|v| kind.scaled(v))).collect()
    };
    let both = (0..cases).filter_map(|k| Some((of(before, k)?, of(now, k)?)));
    let (before, now) = both.unzip();
    [before, now]
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn by_chance(kind: FigureKind, before: &[Vec<f64>], now: &[Vec<f64>], level: f64) -> [f64; 2] {
    match kind {
        FigureKind::Hit => {
            let count = |runs: &[f64]| [runs.iter().filter(|v| **v > 0.5).count() as u64, runs.len() as u64];
            let cases = before.iter().zip(now).map(|(b, n)| CaseHits { before: count(b), now: count(n) });
            exchange::hits(&cases.collect::<Vec<_>>())
        }
        FigureKind::Size { .. } => exchange::sizes(before, now, level),
    }
}

/// Cases that are worse and better by more than rounding.
fn moved(means: &[Vec<f64>; 2]) -> [usize; 2] {
    const ROUNDING: f64 = 1e-5;
    let count =
        |sign: f64| means[0].iter().zip(&means[1]).filter(|(b, n)| sign * (*n - *b) > ROUNDING).count();
    [count(1.0), count(-1.0)]
}

/// Sign test, one-sided.
fn signs([worse, better]: [usize; 2]) -> f64 {
    let law = Binomial::new(0.5, (worse + better) as u64);
    if worse == 0 { 1.0 } else { law.map_or(1.0, |law| law.sf(worse as u64 - 1)) }
}

#[cfg(test)]
mod tests {
    use hexbench_core::streams::{Purpose, stream};
    use rand::RngExt;
    use rand_distr::StandardNormal;

    use super::*;

    const SIZE: FigureKind = FigureKind::Size { range: [1e-9, 10.0] };

    fn run(values: &[f64]) -> RunValues {
        vec![values.iter().map(|v| Some(*v)).collect()]
    }

    #[test]
    fn without_scatter_one_hit_more_is_worse_and_an_exchange_of_cases_is_not() {
        let verdict =
            |now: &[f64]| judge(FigureKind::Hit, &run(&[0.0, 1.0, 0.0, 0.0]), &run(now), None).verdict;
        assert_eq!(verdict(&[0.0, 1.0, 0.0, 0.0]), LimitVerdict::Same);
        assert_eq!(verdict(&[0.0, 1.0, 1.0, 0.0]), LimitVerdict::Worse);
        assert_eq!(verdict(&[0.0, 0.0, 1.0, 0.0]), LimitVerdict::Same);
        assert_eq!(verdict(&[0.0, 0.0, 0.0, 0.0]), LimitVerdict::Better);
    }

    #[test]
    fn without_scatter_sizes_may_grow_by_the_tolerance() {
        let verdict = |growth: f64| {
            let now: Vec<f64> = [0.1, 0.2, 0.3].iter().map(|v| v * growth).collect();
            judge(SIZE, &run(&[0.1, 0.2, 0.3]), &run(&now), None).verdict
        };
        let found = [0.9, 1.0, 1.04, 1.06].map(verdict);
        let [same, worse] = [LimitVerdict::Same, LimitVerdict::Worse];
        assert_eq!(found, [LimitVerdict::Better, same, same, worse]);
    }

    #[test]
    fn a_case_that_lacks_the_figure_in_a_run_is_left_out() {
        let now = vec![vec![Some(0.0), None, Some(1.0)]];
        let found = judge(FigureKind::Hit, &run(&[0.0, 0.0, 0.0]), &now, None);
        assert_eq!((found.cases, found.moved, found.figures), (2, [1, 0], [0.0, 1.0]));
    }

    /// Runs of a random program: cases of all sorts, some sure, some that chance decides; values of equal scatter.
    fn random(kind: FigureKind, runs: usize, trial: u64, worse: f64) -> RunValues {
        const CASES: usize = 84;
        let mut rng = stream(trial, Purpose::Test, [u64::from(kind == SIZE), runs as u64]);
        let one = |case: usize, rng: &mut rand_pcg::Pcg64| match kind {
            FigureKind::Hit => {
                let chance = [0.0_f64, 0.02, 0.0, 0.5, 0.0, 0.9, 1.0][case % 7].max(worse);
                f64::from(u8::from(rng.random::<f64>() < chance))
            }
            FigureKind::Size { .. } => {
                let scatter = if case.is_multiple_of(5) { 1.0 } else { 0.02 };
                0.1 * (1.0 + worse) * f64::exp(scatter * rng.sample::<f64, _>(StandardNormal))
            }
        };
        (0..runs).map(|_| (0..CASES).map(|case| Some(one(case, &mut rng))).collect()).collect()
    }

    /// Trials in which runs like those of the baseline are called worse.
    fn alarms(kind: FigureKind, level: f64, trials: u64, worse: f64) -> usize {
        let is_alarm = |trial: &u64| {
            let before = random(kind, 5, 2 * trial, 0.0);
            let now = random(kind, 4, 2 * trial + 1, worse);
            judge(kind, &before, &now, Some(level)).verdict == LimitVerdict::Worse
        };
        (0..trials).filter(is_alarm).count()
    }

    #[test]
    fn an_unchanged_random_program_is_called_worse_as_seldom_as_stated() {
        const LEVEL: f64 = 0.05;
        const TRIALS: u64 = 1000;
        for kind in [FigureKind::Hit, SIZE] {
            let found = alarms(kind, LEVEL, TRIALS, 0.0) as f64;
            let expected = LEVEL * TRIALS as f64;
            assert!(found < expected + 3.5 * expected.sqrt(), "{kind:?}: {found} of {TRIALS} trials");
            assert!(found > 0.0, "{kind:?}: a test that never fails says nothing");
        }
    }

    #[test]
    fn a_random_program_that_gets_worse_in_every_case_is_noticed() {
        assert_eq!(alarms(FigureKind::Hit, 1e-4, 20, 0.6), 20);
        assert_eq!(alarms(SIZE, 1e-4, 20, 1.0), 20);
    }
}
