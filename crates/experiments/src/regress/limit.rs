//! One limit: what is measured, why, and by which test it is compared.

use super::trials::SuiteTrials;

/// What a limit is about: groups of test cases.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LimitGroup {
    /// Errors of what is found.
    Accuracy,
    /// Uncertainties against errors.
    Honesty,
    /// Answers of the diagnosis.
    Diagnosis,
    /// Probabilities against what came true.
    Probabilities,
    /// Answers on campaigns with faults of the laboratory.
    Laboratories,
    /// Answers on files that do not say what is meant, and on sound ones.
    Files,
    /// Fits of readings without noise.
    NoiseFree,
    /// Deterministic counts of work.
    Effort,
}

hexbench_core::worded! {
    /// A word for names of test cases.
    LimitGroup::word {
        Accuracy => "accuracy",
        Honesty => "honesty",
        Diagnosis => "diagnosis",
        Probabilities => "probabilities",
        Laboratories => "laboratories",
        Files => "files",
        NoiseFree => "noise-free",
        Effort => "effort",
    }
}

impl LimitGroup {
    /// Where to look when a limit of this group fails.
    pub fn next_step(self) -> &'static str {
        match self {
            Self::Accuracy | Self::Honesty => {
                "`hexbench validate recovery` shows errors and coverage of every effect on thousands of campaigns."
            }
            Self::Diagnosis | Self::Probabilities => {
                "`hexbench validate calibration -o DIR` shows which truths are now told wrongly; `--case` writes one of them as \
                 files."
            }
            Self::Laboratories => {
                "`hexbench validate robustness -o DIR` shows what each fault of the laboratory is told as now; `--case` writes a \
                 campaign as files."
            }
            Self::Files => {
                "`hexbench validate misread -o DIR` shows what each misstatement is told as now; `--case` writes a campaign as files."
            }
            Self::NoiseFree => {
                "Compare the equation of the term with the mechanism of the same name: without noise nothing else is at work."
            }
            Self::Effort => "`cargo bench -p hexbench-model` shows what it costs in time.",
        }
    }
}

/// How a limit is compared with its baseline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LimitTest {
    /// Share of campaigns with something bad: Fisher's exact test.
    Share,
    /// Geometric mean of positive values, clipped to a range: Student's test of their logarithms.
    Size {
        /// Values outside count as its ends.
        range: [f64; 2],
        /// Least standard deviation of the logarithms.
        least: f64,
        /// How a figure is written.
        unit: LimitUnit,
    },
    /// Mean squared pull: F test, both ways.
    Spread,
    /// Values without chance: a ratio to the baseline's.
    Exact,
    /// Values without chance that may not exceed 1, whatever the baseline has.
    Bound,
}

/// How a geometric mean is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LimitUnit {
    /// In percent.
    Percent,
    /// As it is.
    Plain,
}

impl LimitTest {
    /// True when chance takes part: these share the probability of a false alarm.
    pub fn is_random(self) -> bool {
        matches!(self, Self::Share | Self::Size { .. } | Self::Spread)
    }
}

/// Values of a limit in the trials of a run.
pub type LimitValues = Box<dyn Fn(&SuiteTrials) -> Vec<f64> + Send + Sync>;

/// One limit.
pub struct RegressLimit {
    /// Short name without blanks, in the baseline.
    pub id: String,
    /// What it is about.
    pub group: LimitGroup,
    /// Name of the test case.
    pub title: String,
    /// Why it exists.
    pub why: String,
    /// How it is compared.
    pub test: LimitTest,
    /// What is compared.
    pub values: LimitValues,
}

impl RegressLimit {
    /// A limit.
    pub fn new(
        (id, group): (impl Into<String>, LimitGroup),
        title: impl Into<String>,
        why: impl Into<String>,
        test: LimitTest,
        values: impl Fn(&SuiteTrials) -> Vec<f64> + Send + Sync + 'static,
    ) -> Self {
        Self { id: id.into(), group, title: title.into(), why: why.into(), test, values: Box::new(values) }
    }
}
