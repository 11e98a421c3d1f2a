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

/// Figures, four lines each: id and title, why, what to do, what is counted and its value.
macro_rules! figures {
    ($($id:literal $title:literal [$why:literal] [$next:expr] $kind:expr => $value:expr;)+) => {
        &[$(GateFigure { id: $id, title: $title, why: $why, next: $next, kind: $kind, value: $value }),+]
    };
}

/// All of them, in the order of the pages.
pub const FIGURES: &[GateFigure] = figures![
    "unanswered" "cases without an answer"
        ["A program that fails on a case, or writes what cannot be read, helps nobody."]
        ["--work DIR keeps what the program wrote and printed; `hexbench challenge lint` says what is wrong with an answer."]
        FigureKind::Hit => |c| Some(hit(c.failure.is_some()));
    "confidently-wrong" "diagnoses that are wrong and stated as sure"
        ["A false diagnosis stated with 90 % or more, or without a probability: people act on it."]
        [LOOK]
        FigureKind::Hit => |c| c.outcome.map(|outcome| hit(outcome == "wrong" && c.confidence.is_none_or(|p| p >= SURE)));
    "stiffness-far-off" "leg stiffnesses far outside their uncertainty"
        ["Three stated standard uncertainties off, in the root mean square of the legs: confidently wrong."]
        [LOOK]
        FigureKind::Hit => |c| c.stiffness_z().map(|z| hit(z > FAR_OFF));
    "prediction-far-off" "predictions far outside their uncertainty"
        ["Three stated standard uncertainties off, in the root mean square: confidently wrong."]
        [LOOK]
        FigureKind::Hit => |c| c.prediction.and_then(|p| p.z).map(|z| hit(z > FAR_OFF));
    "wrong" "diagnoses that are wrong"
        ["Ambiguous is honest, wrong is not."]
        [LOOK]
        FigureKind::Hit => |c| c.outcome.map(|outcome| hit(outcome == "wrong"));
    "stiffness-error" "leg stiffness: error"
        ["How far off the numbers are, whatever is said of their uncertainty."]
        [LOOK]
        RELATIVE => |c| c.stiffness_error();
    "stiffness-crps" "leg stiffness: CRPS"
        ["Errors and stated uncertainties together: too wide costs as too narrow does."]
        ["Compare stated uncertainties with errors: `hexbench challenge score` shows z and how many intervals hold."]
        RELATIVE => |c| c.stiffness.map(|s| s.crps);
    "prediction-error" "predictions: error against the truth, in noise"
        ["How far off predictions of poses are that nobody has measured."]
        [LOOK]
        IN_NOISE => |c| c.prediction.map(|p| p.error_in_noise);
    "prediction-crps" "predictions: CRPS, in noise"
        ["Errors and stated uncertainties together: too wide costs as too narrow does."]
        ["Compare stated uncertainties with errors: `hexbench challenge score` shows how many intervals hold."]
        IN_NOISE => |c| c.prediction.map(|p| p.proper.crps);
    "log-score" "probabilities: log score, nats"
        ["Both wrong certainty and needless doubt cost."]
        ["The leaderboard of `hexbench challenge score --html` shows stated probabilities beside what came true."]
        NATS => |c| c.forecast.map(|f| f.log);
];

fn hit(bad: bool) -> f64 {
    f64::from(u8::from(bad))
}
