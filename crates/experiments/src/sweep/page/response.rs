//! The main results of a task.

use crate::calibration::Fate;
use crate::sweep::results::{CellStatistics, Counted};
use crate::sweep::study::{SweepStudy, SweepTask};

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

/// The main results of a task, the most important first; of outcomes those that occur, and whether a hidden effect was seen where
/// any is hidden.
pub(super) fn responses(study: &SweepStudy, cells: &[CellStatistics]) -> Vec<Response> {
    let occurs = |r: &&Response| cells.iter().any(|cell| (r.of)(cell)[0] > 0.0);
    let hides = study.axes.effect.iter().any(|set| !set.is_empty());
    match study.task {
        SweepTask::Springs => SPRINGS.to_vec(),
        SweepTask::Diagnose => {
            DIAGNOSE.iter().filter(occurs).filter(|r| hides || r.key != "seen").copied().collect()
        }
    }
}

const fn share(
    key: &'static str,
    title: &'static str,
    short: &'static str,
    of: fn(&CellStatistics) -> [f64; 3],
) -> Response {
    Response { key, title, short, unit: "%", of, is_share: true }
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

static DIAGNOSE: [Response; 8] = [
    share("seen", "Seen", "seen, %", |c| in_percent(c.share(Counted::Seen))),
    share("right", "Right", "right, %", |c| in_percent(c.share(Counted::Of(Fate::Right)))),
    share("honest", "Honest", "honest, %", |c| in_percent(c.share(Counted::Of(Fate::Honest)))),
    share("undecided", "Undecided", "undecided, %", |c| in_percent(c.share(Counted::Of(Fate::Undecided)))),
    share("missed", "Missed", "missed, %", |c| in_percent(c.share(Counted::Of(Fate::Missed)))),
    share("incomplete", "Incomplete", "incomplete, %", |c| {
        in_percent(c.share(Counted::Of(Fate::Incomplete)))
    }),
    share("false-outside", "False outside", "false outside, %", |c| {
        in_percent(c.share(Counted::Of(Fate::FalseOutside)))
    }),
    share("false-name", "False name", "false name, %", |c| in_percent(c.share(Counted::Of(Fate::FalseName)))),
];
