//! What the gate compares of every case.

use crate::alarm::same_cases::FigureKind;
use crate::challenge::score::CaseScore;

/// Stated probability from which a false diagnosis is a confident one.
pub const SURE: f64 = 0.9;
/// Root mean square error in stated standard uncertainties beyond which numbers are confidently wrong.
pub const FAR_OFF: f64 = 3.0;

/// One figure of a case; the smaller the better.
#[derive(Debug, Clone, Copy)]
pub struct GateFigure {
    /// Short name without blanks, in the baseline.
    pub id: &'static str,
    /// Name of the test case.
    pub title: &'static str,
    /// Why it exists.
    pub why: &'static str,
    /// Where to look when it gets worse.
    pub next: &'static str,
    /// How it is compared.
    pub kind: FigureKind,
    /// Its value; none where the program does not state what it needs.
    pub value: fn(&CaseScore) -> Option<f64>,
}

/// Relative errors: from rounding to nonsense.
const RELATIVE: FigureKind = FigureKind::Size { range: [1e-9, 10.0] };
/// Errors in noise.
const IN_NOISE: FigureKind = FigureKind::Size { range: [1e-6, 1e6] };
/// Nats, from 99.9 % to the floor of the logarithmic score.
const NATS: FigureKind = FigureKind::Size { range: [1e-3, 14.0] };

/// What to do about cases that changed.
const LOOK: &str = "The cases below are those to look at.";

/// All of them, in the order of the pages.
pub const FIGURES: [GateFigure; 10] = [
    GateFigure {
        id: "unanswered",
        title: "cases without an answer",
        why: "A program that fails on a case, or writes what cannot be read, helps nobody.",
        next: "--work DIR keeps what the program wrote and printed; `hexbench challenge lint` says what is wrong with an answer.",
        kind: FigureKind::Hit,
        value: |c| Some(hit(c.failure.is_some())),
    },
    GateFigure {
        id: "confidently-wrong",
        title: "diagnoses that are wrong and stated as sure",
        why: "A false diagnosis stated with 90 % or more, or without a probability: people act on it.",
        next: LOOK,
        kind: FigureKind::Hit,
        value: |c| c.outcome.map(|outcome| hit(outcome == "wrong" && c.confidence.is_none_or(|p| p >= SURE))),
    },
    GateFigure {
        id: "stiffness-far-off",
        title: "leg stiffnesses far outside their uncertainty",
        why: "Three stated standard uncertainties off, in the root mean square of the legs: confidently wrong.",
        next: LOOK,
        kind: FigureKind::Hit,
        value: |c| c.stiffness_z().map(|z| hit(z > FAR_OFF)),
    },
    GateFigure {
        id: "prediction-far-off",
        title: "predictions far outside their uncertainty",
        why: "Three stated standard uncertainties off, in the root mean square: confidently wrong.",
        next: LOOK,
        kind: FigureKind::Hit,
        value: |c| c.prediction.and_then(|p| p.z).map(|z| hit(z > FAR_OFF)),
    },
    GateFigure {
        id: "wrong",
        title: "diagnoses that are wrong",
        why: "Ambiguous is honest, wrong is not.",
        next: LOOK,
        kind: FigureKind::Hit,
        value: |c| c.outcome.map(|outcome| hit(outcome == "wrong")),
    },
    GateFigure {
        id: "stiffness-error",
        title: "leg stiffness: error",
        why: "How far off the numbers are, whatever is said of their uncertainty.",
        next: LOOK,
        kind: RELATIVE,
        value: |c| c.stiffness_error(),
    },
    GateFigure {
        id: "stiffness-crps",
        title: "leg stiffness: CRPS",
        why: "Errors and stated uncertainties together: too wide costs as too narrow does.",
        next: "Compare stated uncertainties with errors: `hexbench challenge score` shows z and how many intervals hold.",
        kind: RELATIVE,
        value: |c| c.stiffness.map(|s| s.crps),
    },
    GateFigure {
        id: "prediction-error",
        title: "predictions: error against the truth, in noise",
        why: "How far off predictions of poses are that nobody has measured.",
        next: LOOK,
        kind: IN_NOISE,
        value: |c| c.prediction.map(|p| p.error_in_noise),
    },
    GateFigure {
        id: "prediction-crps",
        title: "predictions: CRPS, in noise",
        why: "Errors and stated uncertainties together: too wide costs as too narrow does.",
        next: "Compare stated uncertainties with errors: `hexbench challenge score` shows how many intervals hold.",
        kind: IN_NOISE,
        value: |c| c.prediction.map(|p| p.proper.crps),
    },
    GateFigure {
        id: "log-score",
        title: "probabilities: log score, nats",
        why: "Both wrong certainty and needless doubt cost.",
        next: "The leaderboard of `hexbench challenge score --html` shows stated probabilities beside what came true.",
        kind: NATS,
        value: |c| c.forecast.map(|f| f.log),
    },
];

fn hit(bad: bool) -> f64 {
    f64::from(u8::from(bad))
}
