//! The main results of a task.

use crate::sweep::results::CellStatistics;
use crate::sweep::study::SweepTask;

/// One main result of a cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct Response {
    /// For file names.
    pub key: &'static str,
    /// As a title.
    pub title: &'static str,
    /// As the head of a column.
    pub short: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Value, and its 95 % bounds where there are any (else NaN).
    pub of: fn(&CellStatistics) -> [f64; 3],
    /// True for shares, which lie between 0 and 100 %.
    pub is_share: bool,
}

/// The main results of a task, the most important first.
pub(super) fn responses(task: SweepTask) -> &'static [Response; 3] {
    match task {
        SweepTask::Springs => &SPRINGS,
        SweepTask::Diagnose => &DIAGNOSE,
    }
}

fn alone(x: f64) -> [f64; 3] {
    [x, f64::NAN, f64::NAN]
}

fn in_percent(share: [f64; 3]) -> [f64; 3] {
    share.map(|x| 100.0 * x)
}

static SPRINGS: [Response; 3] = [
    Response {
        key: "stiffness-error",
        title: "Stiffness error, rms",
        short: "stiffness error, %",
        unit: "%",
        of: |c| alone(c.springs.errors.rms()),
        is_share: false,
    },
    Response {
        key: "holdout-error",
        title: "Held-out error over noise",
        short: "held-out error / noise",
        unit: "",
        of: |c| alone(c.springs.holdout[2].rms()),
        is_share: false,
    },
    Response {
        key: "coverage",
        title: "Coverage of 95 % intervals",
        short: "coverage, %",
        unit: "%",
        of: |c| in_percent(c.coverage()),
        is_share: true,
    },
];

static DIAGNOSE: [Response; 3] = [
    Response {
        key: "right",
        title: "Right",
        short: "right, %",
        unit: "%",
        of: |c| in_percent(c.share(0)),
        is_share: true,
    },
    Response {
        key: "honest",
        title: "Honest",
        short: "honest, %",
        unit: "%",
        of: |c| in_percent(c.share(1)),
        is_share: true,
    },
    Response {
        key: "wrong",
        title: "Wrong",
        short: "wrong, %",
        unit: "%",
        of: |c| in_percent(c.share(2)),
        is_share: true,
    },
];
