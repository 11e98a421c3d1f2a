//! The main results of a task.

use hexbench_core::words::upper_first;

use crate::sweep::results::{CellStatistics, Counted, SHARES};
use crate::sweep::study::{SweepStudy, SweepTask};

/// A value of a cell, and its 95 % bounds where there are any (else NaN).
type BoundedValue = Box<dyn Fn(&CellStatistics) -> [f64; 3]>;

/// One main result of a cell.
pub(super) struct Response {
    /// For file names.
    pub key: String,
    /// As a title.
    pub title: String,
    /// As the head of a column.
    pub short: String,
    /// Unit.
    pub unit: &'static str,
    /// What it is.
    pub of: BoundedValue,
    /// True for shares, which lie between 0 and 100 %.
    pub is_share: bool,
}

/// The main results of a task, the most important first; of outcomes those that occur, and whether a hidden effect was seen where
/// any is hidden.
pub(super) fn responses(study: &SweepStudy, cells: &[CellStatistics]) -> Vec<Response> {
    let occurs = |r: &Response| cells.iter().any(|cell| (r.of)(cell)[0] > 0.0);
    let hides = study.axes.effect.iter().any(|set| !set.is_empty());
    match study.task {
        SweepTask::Springs => springs(),
        SweepTask::Diagnose => {
            let counted = SHARES.into_iter().filter(|of| hides || *of != Counted::Seen);
            counted.map(outcome).filter(occurs).collect()
        }
    }
}

fn springs() -> Vec<Response> {
    vec![
        of_springs(("stiffness-error", "Stiffness error, rms", "stiffness error, %"), "%", |c| {
            alone(c.springs.errors.rms())
        }),
        of_springs(("holdout-error", "Held-out error over noise", "held-out error / noise"), "", |c| {
            alone(c.springs.holdout[2].rms())
        }),
        Response {
            is_share: true,
            ..of_springs(("coverage", "Coverage of 95 % intervals", "coverage, %"), "%", |c| {
                in_percent(c.coverage())
            })
        },
    ]
}

fn of_springs(
    (key, title, short): (&str, &str, &str),
    unit: &'static str,
    of: fn(&CellStatistics) -> [f64; 3],
) -> Response {
    let [key, title, short] = [key, title, short].map(str::to_owned);
    Response { key, title, short, unit, of: Box::new(of), is_share: false }
}

fn outcome(counted: Counted) -> Response {
    let word = counted.word();
    Response {
        key: word.replace(' ', "-"),
        title: upper_first(word),
        short: format!("{word}, %"),
        unit: "%",
        of: Box::new(move |c| in_percent(c.share(counted))),
        is_share: true,
    }
}

fn alone(x: f64) -> [f64; 3] {
    [x, f64::NAN, f64::NAN]
}

fn in_percent(share: [f64; 3]) -> [f64; 3] {
    share.map(|x| 100.0 * x)
}
