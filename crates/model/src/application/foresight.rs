//! What readings were foreseen to tell before they came, as a session keeps it.

use serde::{Deserialize, Serialize};

use crate::inference::verdict::Verdict;

/// The diagnosis before readings were brought back, as far as it is compared with the one after.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(deny_unknown_fields)]
pub struct SessionForesight {
    /// What was said.
    pub before: DiagnosisBefore,
    /// Readings that came since.
    pub readings: usize,
}

/// What a diagnosis said, and what it foresaw.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(deny_unknown_fields)]
pub struct DiagnosisBefore {
    /// Its verdict.
    pub verdict: Verdict,
    /// Terms it named.
    pub added: Vec<String>,
    /// Explanations it did not exclude.
    pub credible_set: Vec<String>,
    /// Explanations with their probability.
    pub candidates: Vec<CandidateBefore>,
    /// Pairs of rivals, and what the readings it asked for were to tell of them.
    pub separation: Vec<SeparationBefore>,
}

/// An explanation of then.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(deny_unknown_fields)]
pub struct CandidateBefore {
    /// Its id, `outside` or `none`.
    pub term: String,
    /// Its probability.
    pub probability: f64,
}

/// Two rivals of then.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(deny_unknown_fields)]
pub struct SeparationBefore {
    /// The rivals.
    pub between: [String; 2],
    /// Expected decimal logarithm of the Bayes factor for the truth, when the first is true and when the second is.
    pub log10_bayes_factor: [f64; 2],
    /// Chance that the readings favor the truth.
    pub right: f64,
}
