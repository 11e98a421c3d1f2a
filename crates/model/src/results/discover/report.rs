//! A discovery as files and pages receive it: `discovery/1`.

use serde::Serialize;

use super::DiscoveryReason;
use crate::estimation::estimate::Estimate;
use crate::inference::verdict::Verdict;
use crate::results::diagnose::{NextReport, SeparationReport, StepReport};

/// What a search for laws came to.
#[derive(Debug, Clone, Serialize)]
pub struct Discovery {
    /// `discovery/1`.
    pub format: &'static str,
    /// True when the first law is convincing.
    pub found: bool,
    /// What it came to, in one word.
    pub reason: DiscoveryReason,
    /// The same in a sentence.
    pub text: String,
    /// Verdict of the diagnosis with the catalogue alone.
    pub verdict: Verdict,
    /// Catalogue effects that stand beside the law, or that explain the readings without one; with `:richer` behind the id where the
    /// readings need that form.
    pub beside: Vec<String>,
    /// Laws, best first: with a law found those that look like it too, else the best ideas.
    pub laws: Vec<LawReport>,
    /// Springs alone, the effects beside, the law: how the error falls.
    pub steps: Vec<StepReport>,
    /// Probability that one of the laws weighed is at work.
    pub probability: f64,
    /// Readings that separate the first law from those that look like it, in the order in which they are worth taking.
    pub next: Vec<NextReport>,
    /// What they promise.
    pub separation: Vec<SeparationReport>,
    /// Laws weighed.
    pub searched: usize,
    /// Things to know.
    pub warnings: Vec<String>,
}

/// A law.
#[derive(Debug, Clone, Serialize)]
pub struct LawReport {
    /// `law-1`, `law-2`, ...
    pub id: String,
    /// Id of the term its file describes.
    pub term: String,
    /// Elongation of a leg (m), or what `kind` says; everything SI.
    pub formula: String,
    /// What the formula gives: `elongation`, `wrench`, `base-motion`, `platform-motion`.
    pub kind: String,
    /// Legs it concerns.
    pub legs: LawLegs,
    /// Probability.
    pub probability: f64,
    /// Words in its description.
    pub complexity: usize,
    /// Sizes and the constant inside, as fitted.
    pub parameters: Vec<Estimate>,
    /// Error on held-out poses, times the noise.
    pub held_out: Option<HeldOutFall>,
    /// One sentence.
    pub text: String,
    /// What an engineer would look at.
    pub look_at: [&'static str; 3],
    /// Laws that these readings do not tell from it.
    pub alike: Vec<String>,
}

/// Legs of a law: `"all"`, or their numbers.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(untagged)]
pub enum LawLegs {
    /// All of them.
    All(AllLegs),
    /// Some, from 1.
    Some(Vec<usize>),
}

/// The word for all legs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum AllLegs {
    /// All of them.
    All,
}

impl From<Option<Vec<usize>>> for LawLegs {
    fn from(numbers: Option<Vec<usize>>) -> Self {
        numbers.map_or(Self::All(AllLegs::All), Self::Some)
    }
}

/// Fall of the held-out error, times the noise.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct HeldOutFall {
    /// Without the law.
    pub before: f64,
    /// With it.
    pub after: f64,
}
