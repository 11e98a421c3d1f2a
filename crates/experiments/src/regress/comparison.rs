//! A run beside its baseline.

use serde::{Deserialize, Serialize};

use super::baseline::{Baseline, BaselineEntry};
use super::figure::{figure, notice, of_first};
use super::gathered::{LimitSample, pool};
use super::limit::{LimitGroup, LimitTest, RegressLimit};
use super::notice::noticed;
use super::rule::{growth, judge};
use super::sample::CondensedValues;
use super::suite::RegressSuite;
use super::trials::SuiteTrials;
use crate::alarm::table::LimitRow;
use crate::alarm::{FALSE_ALARM, LimitVerdict, Update, probability, share_of_level};
use crate::shares::or_dash;

/// What became of one limit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LimitOutcome {
    /// As in the baseline.
    pub id: String,
    /// What it is about.
    pub group: LimitGroup,
    /// Name of the test case.
    pub title: String,
    /// Why it exists.
    pub why: String,
    /// The figure now.
    pub now: String,
    /// The figure of the baseline.
    pub before: String,
    /// The figure from which a run fails in nine cases of ten.
    pub notices: String,
    /// The verdict.
    pub verdict: LimitVerdict,
    /// Probability of a change for the worse this large by chance; `None` where chance takes no part.
    pub chance: Option<f64>,
    /// True when every value is that of the baseline's first run, to the last bit; `None` with another seed.
    pub same_values: Option<bool>,
    /// What is known of the run.
    pub sample: CondensedValues,
}

/// A run beside its baseline, limit by limit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunComparison {
    /// `regress/1`.
    pub format: String,
    /// Name of the suite.
    pub suite: String,
    /// Its version.
    pub suite_version: u32,
    /// Version of hexbench that ran.
    pub hexbench: String,
    /// Seed of the run.
    pub seed: u64,
    /// Campaigns of the run.
    pub campaigns: usize,
    /// The last update of the baseline.
    pub baseline: Option<Update>,
    /// Probability that an unchanged program fails.
    pub false_alarm: f64,
    /// Share of it that each limit in which chance takes part has.
    pub level: f64,
    /// One for each limit.
    pub findings: Vec<LimitOutcome>,
    /// Campaigns without an answer, and why.
    pub without_answer: Vec<String>,
}

/// Share of the probability of a false alarm that each limit has in which chance takes part.
pub fn level(limits: &[RegressLimit]) -> f64 {
    share_of_level(limits.iter().filter(|l| l.test.is_random()).count())
}

/// Compares the trials of a run with a baseline that was read for the same suite and limits.
pub fn compare(
    suite: &RegressSuite,
    limits: &[RegressLimit],
    (trials, seed): (&SuiteTrials, u64),
    baseline: &Baseline,
    hexbench: &str,
) -> RunComparison {
    let gathered = pool(limits, std::slice::from_ref(trials));
    let without_answer = trials.failures.clone();
    RunComparison { without_answer, ..of_samples(suite, limits, (&gathered, seed), baseline, hexbench) }
}

/// The same from what is kept of the trials.
pub fn of_samples(
    suite: &RegressSuite,
    limits: &[RegressLimit],
    (gathered, seed): (&[LimitSample], u64),
    baseline: &Baseline,
    hexbench: &str,
) -> RunComparison {
    let level = level(limits);
    let same_seed = seed == baseline.seed;
    let runs = baseline.history.last().map_or(1, |update| update.runs);
    let find = |(limit, now): (&RegressLimit, &LimitSample)| {
        let before = &baseline.limits.get(&limit.id)?;
        let mut found = finding(limit, &now.sample, &before.sample, runs, level);
        if same_seed {
            found.same_values = Some(now.fingerprint == before.first);
            found.compare_campaigns(limit.test, before);
        }
        Some(found)
    };
    RunComparison {
        format: "regress/1".to_owned(),
        suite: suite.name.to_owned(),
        suite_version: suite.version,
        hexbench: hexbench.to_owned(),
        seed,
        campaigns: suite.campaigns(),
        baseline: baseline.history.last().cloned(),
        false_alarm: FALSE_ALARM,
        level,
        findings: limits.iter().zip(gathered).filter_map(find).collect(),
        without_answer: Vec::new(),
    }
}

fn finding(
    limit: &RegressLimit,
    now: &CondensedValues,
    before: &CondensedValues,
    runs: usize,
    level: f64,
) -> LimitOutcome {
    let judged = judge(limit.test, now, before, runs, level);
    let least = noticed(limit.test, now.count(), before, level);
    LimitOutcome {
        id: limit.id.clone(),
        group: limit.group,
        title: limit.title.clone(),
        why: limit.why.clone(),
        now: figure(limit.test, now),
        before: figure(limit.test, before),
        notices: notice(limit.test, least, before),
        verdict: judged.verdict,
        chance: judged.chance,
        same_values: None,
        sample: now.clone(),
    }
}

impl LimitOutcome {
    /// Beside the very campaigns of the baseline's first run, where what is drawn plays no part.
    fn compare_campaigns(&mut self, test: LimitTest, before: &BaselineEntry) {
        let Some(first) = before.first_run.as_ref().filter(|_| self.verdict == LimitVerdict::Same) else {
            return;
        };
        let (kind, growth) = growth(test, &self.sample, first);
        if kind.is_beyond(growth) {
            self.verdict = LimitVerdict::Worse;
            self.chance = None;
            self.before = format!("on the same campaigns {}", of_first(test, first));
        }
    }

    /// Why it failed, in figures.
    pub fn complaint(&self) -> String {
        let chance = self.chance.map(|p| format!("; by chance {}", probability(p))).unwrap_or_default();
        format!("now {}, baseline {}{chance}", self.now, self.before)
    }
}

impl LimitRow for LimitOutcome {
    fn cells(&self) -> [String; 5] {
        let chance = or_dash(self.chance, probability);
        [self.title.clone(), self.now.clone(), self.before.clone(), chance, self.notices.clone()]
    }
}

impl RunComparison {
    /// Limits with a verdict.
    pub fn of(&self, verdict: LimitVerdict) -> impl Iterator<Item = &LimitOutcome> {
        self.findings.iter().filter(move |f| f.verdict == verdict)
    }

    /// True when a limit is worse than chance explains.
    pub fn fails(&self) -> bool {
        self.of(LimitVerdict::Worse).next().is_some()
    }

    /// Limits whose values are those of the baseline's first run to the last bit; `None` with another seed.
    pub fn same_values(&self) -> Option<usize> {
        let all: Option<Vec<bool>> = self.findings.iter().map(|f| f.same_values).collect();
        Some(all?.into_iter().filter(|same| *same).count())
    }

    /// Findings, the least probable first; those without chance that fail come before all.
    pub fn by_chance(&self) -> Vec<&LimitOutcome> {
        let key = |f: &LimitOutcome| match (f.verdict, f.chance) {
            (LimitVerdict::Worse, None) => -1.0,
            (LimitVerdict::Worse, Some(p)) => p - 0.5,
            (_, Some(p)) => p,
            (_, None) => 2.0,
        };
        let mut all: Vec<&LimitOutcome> = self.findings.iter().collect();
        all.sort_by(|a, b| key(a).total_cmp(&key(b)));
        all
    }

    /// Smallest probability among the limits in which chance takes part, and its limit.
    pub fn least_probable(&self) -> Option<(f64, &LimitOutcome)> {
        let all = self.findings.iter().filter_map(|f| Some((f.chance?, f)));
        all.min_by(|a, b| a.0.total_cmp(&b.0))
    }
}
