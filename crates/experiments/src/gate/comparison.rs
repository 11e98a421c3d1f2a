//! A program now, beside its baseline.

use serde::{Deserialize, Serialize};

use super::figure::{FIGURES, GateFigure};
use super::notice::{Noticed, noticed};
use super::values::GateValues;
use super::work::{CONFIRMED, Checked};
use super::{GateBaseline, GateEntrant};
use crate::alarm::same_cases::{FigureKind, RunValues, judge};
use crate::alarm::{FALSE_ALARM, LimitVerdict, Update, share_of_level};
use crate::challenge::score::CaseScore;

/// Name and version of the format.
const FORMAT: &str = "gate/1";

/// A program now, beside its baseline, figure by figure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GateComparison {
    /// `gate/1`.
    pub format: String,
    /// Suite, version and seed.
    pub suite: String,
    /// Version of hexbench that ran.
    pub hexbench: String,
    /// Number of cases.
    pub cases: usize,
    /// Runs of the baseline, and runs now.
    pub runs: [usize; 2],
    /// True when the runs of the baseline did not differ.
    pub steady: bool,
    /// The last update of the baseline.
    pub baseline: Option<Update>,
    /// True for a function in the process that asked.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub inside: bool,
    /// Files of the program that are other ones than those of the baseline.
    pub changed_files: Vec<String>,
    /// Probability that an unchanged program fails, at most.
    pub false_alarm: f64,
    /// Share of it that each figure has; none where runs of the baseline did not differ.
    pub level: Option<f64>,
    /// True when every case has the figures of the baseline.
    pub same: bool,
    /// Cases that gave other figures in each run, though those of the baseline did not.
    pub scattered: Vec<String>,
    /// One for each figure that the program states.
    pub findings: Vec<GateOutcome>,
    /// Cases that changed, the worst first.
    pub changes: Vec<GateChange>,
}

/// What became of one figure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GateOutcome {
    /// As in the baseline.
    pub id: String,
    /// Name of the test case.
    pub title: String,
    /// The verdict.
    pub verdict: LimitVerdict,
    /// Hits over the cases, or geometric mean: of the baseline, and now; averaged over runs.
    pub figures: [f64; 2],
    /// Cases that have it.
    pub cases: usize,
    /// Cases that are worse, and cases that are better.
    pub moved: [usize; 2],
    /// Probability of a change for the worse this large in runs of an unchanged program; none where these do not differ.
    pub chance: Option<f64>,
    /// Probability that so many more cases get worse than better when each way is as probable: what this says of other cases.
    pub elsewhere: f64,
    /// What would be noticed.
    pub noticed: Noticed,
}

/// A figure of a case that changed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GateChange {
    /// Id of the case.
    pub case: String,
    /// Its group.
    pub group: String,
    /// Hidden effects.
    pub effects: Vec<String>,
    /// The figure.
    pub figure: String,
    /// Mean over the runs of the baseline.
    pub before: f64,
    /// Mean over the runs now.
    pub now: f64,
    /// What was said, where it is about what was said.
    pub told: Option<String>,
}

/// Compares what a check found with its baseline.
pub fn compare(baseline: &GateBaseline, entrant: &GateEntrant, found: &Checked) -> GateComparison {
    let now_runs = found.values.count();
    let stated: Vec<&GateFigure> = FIGURES.iter().filter(|f| baseline.figures.runs(f.id).is_some()).collect();
    let level = (!baseline.steady).then(|| share_of_level(stated.len()));
    GateComparison {
        format: FORMAT.to_owned(),
        suite: baseline.suite.in_words(),
        hexbench: env!("CARGO_PKG_VERSION").to_owned(),
        cases: baseline.cases.len(),
        runs: [baseline.repeats, now_runs],
        steady: baseline.steady,
        baseline: baseline.history.last().cloned(),
        inside: entrant.inside,
        changed_files: baseline.entrant.changed_files(entrant),
        false_alarm: if baseline.steady { rare(baseline) } else { FALSE_ALARM },
        level,
        same: baseline.steady && found.values.differing(&baseline.figures).is_empty(),
        scattered: found.scattered.clone(),
        findings: stated.iter().map(|f| outcome(f, baseline, &found.values, level)).collect(),
        changes: changes(&stated, baseline, found),
    }
}

fn outcome(f: &GateFigure, baseline: &GateBaseline, now: &GateValues, level: Option<f64>) -> GateOutcome {
    let before = baseline.figures.runs(f.id).unwrap_or_default();
    // A figure that is stated no more has no values: the cases without an answer tell why, or nothing does.
    let now_values = now.runs(f.id).unwrap_or_default();
    let judged = judge(f.kind, &before, &now_values, level);
    let shown = |figure: f64| if f.kind == FigureKind::Hit { figure } else { figure.exp() };
    GateOutcome {
        id: f.id.to_owned(),
        title: f.title.to_owned(),
        verdict: judged.verdict,
        figures: judged.figures.map(shown),
        cases: judged.cases,
        moved: judged.moved,
        chance: judged.chance,
        elsewhere: judged.elsewhere,
        noticed: noticed(f.kind, &before, now.count(), level),
    }
}

/// Probability at most that a program whose runs were all alike fails unchanged: a case differs in a run with the probability `q` at
/// most (95 %, from the repeats), and counts only when it is worse in [`CONFIRMED`] runs.
fn rare(baseline: &GateBaseline) -> f64 {
    let cases = baseline.cases.len() as f64;
    let alike = cases * (baseline.repeats as f64 - 1.0);
    let q = 1.0 - 0.05_f64.powf(alike.recip());
    (cases * q.powi(i32::try_from(CONFIRMED).unwrap_or(i32::MAX))).min(1.0)
}

fn changes(stated: &[&GateFigure], baseline: &GateBaseline, found: &Checked) -> Vec<GateChange> {
    let mut all: Vec<(f64, GateChange)> = Vec::new();
    for f in stated {
        let [before, now] =
            [&baseline.figures, &found.values].map(|values| values.runs(f.id).unwrap_or_default());
        for (k, case) in found.cases.iter().enumerate() {
            let (Some(before), Some(now)) = (mean(&before, k), mean(&now, k)) else { continue };
            let growth = match f.kind {
                FigureKind::Hit => HIT * (now - before),
                FigureKind::Size { .. } => f.kind.scaled(now) - f.kind.scaled(before),
            };
            if growth > LEAST {
                all.push((growth, change(f, case, [before, now])));
            }
        }
    }
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    all.into_iter().map(|(_, change)| change).collect()
}

/// A case that became bad comes before every error that grew.
const HIT: f64 = 1e3;
/// Growth of a logarithm that is worth a row: a tenth.
const LEAST: f64 = 0.1;

fn mean(runs: &RunValues, case: usize) -> Option<f64> {
    let values: Option<Vec<f64>> = runs.iter().map(|run| run.get(case).copied().flatten()).collect();
    let values = values.filter(|v| !v.is_empty())?;
    Some(values.iter().sum::<f64>() / values.len() as f64)
}

fn change(f: &GateFigure, case: &CaseScore, [before, now]: [f64; 2]) -> GateChange {
    let stated = case.confidence.map(|p| format!(", stated with {:.0} %", 100.0 * p)).unwrap_or_default();
    let told = match (f.id, &case.failure, case.outcome) {
        ("unanswered", Some(failure), _) => Some(failure.clone()),
        ("wrong" | "confidently-wrong", None, Some(outcome)) => Some(format!("diagnosis {outcome}{stated}")),
        _ => None,
    };
    GateChange {
        case: case.id.clone(),
        group: case.group.clone(),
        effects: case.effects.clone(),
        figure: f.id.to_owned(),
        before,
        now,
        told,
    }
}

impl GateComparison {
    /// Figures with a verdict.
    pub fn of(&self, verdict: LimitVerdict) -> impl Iterator<Item = &GateOutcome> {
        self.findings.iter().filter(move |f| f.verdict == verdict)
    }

    /// True when a figure is worse than its baseline allows.
    pub fn fails(&self) -> bool {
        self.of(LimitVerdict::Worse).next().is_some()
    }
}

impl GateOutcome {
    /// True where an answer has the figure now.
    pub fn is_stated_now(&self) -> bool {
        self.figures[1].is_finite()
    }

    /// What there is to say about the figure, whatever its values.
    pub fn figure(&self) -> &'static GateFigure {
        FIGURES.iter().find(|f| f.id == self.id).unwrap_or(&FIGURES[0])
    }
}
