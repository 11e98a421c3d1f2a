//! Figures that say how far an answer can be trusted.

use hexbench_core::statistics::{Proportion, quantile};
use hexbench_model::inference::verdict::Verdict;

use super::{CalibrationRecord, Fate};

/// Share of trials with an effect named that is not there which must not be exceeded.
pub const MOST_FALSE_NAMES: f64 = 0.01;
/// Probability a credible set claims to hold.
pub const CREDIBLE: f64 = 0.95;
/// Standard deviations that hold 95 % of a normal law.
pub(crate) const COVERED: f64 = 1.96;

/// Trials in which an effect is named that is not there.
pub fn false_names<'a>(records: impl IntoIterator<Item = &'a CalibrationRecord>) -> Proportion {
    Proportion::count(records, |r| r.fate == Fate::FalseName)
}

/// The same among the answers that name anything.
pub fn false_names_among_named<'a>(records: impl IntoIterator<Item = &'a CalibrationRecord>) -> Proportion {
    false_names(records.into_iter().filter(|r| r.verdict == Verdict::Named))
}

/// "Outside" said where all that is hidden is in the catalogue, or nothing is.
pub fn false_outside<'a>(records: impl IntoIterator<Item = &'a CalibrationRecord>) -> Proportion {
    let inside = records.into_iter().filter(|r| !r.is_outside());
    Proportion::count(inside, |r| r.verdict == Verdict::Outside)
}

/// Credible sets that hold the whole truth.
pub fn credible_coverage<'a>(records: impl IntoIterator<Item = &'a CalibrationRecord>) -> Proportion {
    Proportion::count(records, |r| r.is_covered())
}

/// Leg stiffnesses within 1.96 of their stated standard deviations.
pub fn stiffness_coverage<'a>(records: impl IntoIterator<Item = &'a CalibrationRecord>) -> Proportion {
    let all = records.into_iter().flat_map(|r| r.stiffness_z.iter().flatten());
    Proportion::count(all, |z| z.abs() <= COVERED)
}

/// Held-out numbers within 1.96 of the standard deviation of prediction and noise together.
pub fn prediction_coverage<'a>(records: impl IntoIterator<Item = &'a CalibrationRecord>) -> Proportion {
    records.into_iter().map(|r| r.predicted).sum()
}

/// Chi-square by which the hidden effects may fit better than effects that were named without being a search that failed: five
/// standard deviations.
pub(super) const MOST_BEHIND: f64 = 25.0;

/// Answers that name effects, or say "outside", although the two or more that are hidden fit the same readings far better.
pub(super) fn overlooked<'a>(records: impl IntoIterator<Item = &'a CalibrationRecord>) -> Proportion {
    let claims = records.into_iter().filter(|r| matches!(r.verdict, Verdict::Named | Verdict::Outside));
    Proportion::count(claims.filter_map(|r| r.behind_truth), |behind| *behind > MOST_BEHIND)
}

/// Quantiles of the reduced chi-square on held-out poses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeldOutQuantiles {
    /// Trials behind it.
    pub trials: usize,
    /// Median with the springs alone.
    pub springs_median: f64,
    /// Median with the final model.
    pub median: f64,
    /// 95 % of the trials are below.
    pub high: f64,
}

impl HeldOutQuantiles {
    /// Quantiles over trials; `None` of nothing.
    pub fn of<'a>(records: impl IntoIterator<Item = &'a CalibrationRecord>) -> Option<Self> {
        let pairs: Vec<[f64; 2]> =
            records.into_iter().filter_map(|r| Some([r.holdout[0]?, r.holdout[1]?])).collect();
        let value = |step: usize, share: f64| quantile(pairs.iter().map(|p| p[step]), share);
        Some(Self {
            trials: pairs.len(),
            springs_median: value(0, 0.5)?,
            median: value(1, 0.5)?,
            high: value(1, 0.95)?,
        })
    }
}
