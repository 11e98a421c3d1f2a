//! The diagnosis as people and programs receive it; field by field the contract of `diagnosis.json`.

use hexbench_core::Approach;
use std::collections::BTreeMap;

use serde::Serialize;

use super::alternative::Alternative;
use super::nested::NestedReport;
use super::other_reading::OtherReading;
use super::remainder::RemainderReport;
use crate::effects::untestable::Untestable;
use crate::estimation::campaign::Campaign;
use crate::estimation::estimate::{Estimate, stiffness_of};
use crate::estimation::noise::NoiseSource;
use crate::estimation::residuals::ErrorSummary;
use crate::inference::examination::{Finding, is_misread};
use crate::inference::explanation::Explanation;
use crate::inference::gain::{HeldOutGain, Worth};
use crate::inference::importance::GaussianCheck;
use crate::inference::power::Detectable;
use crate::inference::selection::{HeldOut, is_at_the_noise};
use crate::inference::verdict::Verdict;
use crate::results::compare::coordinates::Coordinate;
use crate::results::discover::LawReport;
use crate::results::outliers::SuspiciousReading;

/// Result of `diagnose`.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct Diagnosis {
    /// `diagnosis/1`.
    pub format: &'static str,
    /// The verdict.
    pub verdict: Verdict,
    /// Effects named, in the order in which they were added.
    pub added: Vec<String>,
    /// Terms of the fitted model the numbers below belong to; for a named verdict `added` and `small` together.
    pub model: Vec<String>,
    /// Effects that are sure and take too little off the held-out error to be named, in the order in which they were added.
    pub small: Vec<String>,
    /// Terms of the model that needed their richer form.
    pub richer: Vec<String>,
    /// What a fit is asked to add for this model: `model`, with `:richer` behind the terms that need that form.
    pub add: Vec<String>,
    /// Probability of every first addition, of `outside` and of `none`.
    pub candidates: Vec<CandidateReport>,
    /// Probability that an effect is present at all, alone or beside others.
    pub present: BTreeMap<String, f64>,
    /// How good the Gaussian behind these probabilities is, for the leading sets of effects; empty with more than 300 conditions and for absolute poses.
    pub gaussian_checks: Vec<GaussianCheck>,
    /// Smallest set of effects that holds 95 % of the probability.
    #[cfg_attr(feature = "typescript", ts(as = "Vec<String>"))]
    pub credible_set: Vec<Explanation>,
    /// Error per step of the model, springs alone first.
    pub steps: Vec<StepReport>,
    /// Error on poses left out in turn, of the fit and of the choice of terms; absent with a holdout file and where none can be left out.
    pub nested: Option<NestedReport>,
    /// How the held-out error was obtained.
    #[cfg_attr(feature = "typescript", ts(as = "String"))]
    pub holdout: HeldOut,
    /// The noise level used.
    pub noise: NoiseReport,
    /// Numbers of the fitted model.
    pub parameters: Vec<Estimate>,
    /// Names of parameters that the data do not determine.
    pub not_determined: Vec<String>,
    /// Terms that the file cannot test.
    pub untestable: Vec<Untestable>,
    /// Smallest sizes this campaign would show.
    pub detectable: Vec<Detectable>,
    /// Readings that would separate the rivals.
    pub next: Vec<NextReport>,
    /// What those readings promise, pair by pair.
    pub separation: Vec<SeparationReport>,
    /// What an effect does to the leg stiffnesses when it is left out.
    pub absorbed: Vec<AbsorbedReport>,
    /// What the fitted model leaves of every sensor; empty where full poses were read.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub sensors: Vec<Coordinate>,
    /// Readings far from every prediction.
    pub suspects: Vec<SuspiciousReading>,
    /// The unexplained pattern.
    pub outside: Option<OutsideReport>,
    /// The law behind it, where one was searched for and convinces.
    #[cfg_attr(feature = "typescript", ts(skip))]
    pub law: Option<LawReport>,
    /// What the fitted model leaves of the legs beyond the noise; absent where noise explains it, and where full poses were not read.
    pub remainder: Option<RemainderReport>,
    /// Things to know before trusting the numbers.
    pub warnings: Vec<String>,
    /// Faults of the data, in the order in which they were found.
    pub findings: Vec<Finding>,
    /// Lines that were left out because somebody asked for it.
    pub excluded: Vec<u64>,
    /// Readings that were found wrong took part in the fit because somebody asked for it.
    pub keep_all: bool,
    /// What the file was read as meaning otherwise than it says because somebody asked for it, as `KIND=VALUE`.
    pub read_as: Vec<String>,
    /// The answer the other way, where findings leave readings out or would do so.
    pub alternative: Option<Alternative>,
    /// The answer to misread files, read as they seem to be meant; `added` holds its effects.
    #[cfg_attr(feature = "typescript", ts(skip))]
    pub other_reading: Option<OtherReading>,
}

impl Diagnosis {
    /// True when the files do not seem to mean what they say.
    pub fn is_misread(&self) -> bool {
        is_misread(&self.findings)
    }

    /// Stiffness of a leg, from 0, where the data determine it.
    pub fn stiffness(&self, leg: usize) -> Option<&Estimate> {
        stiffness_of(&self.parameters, leg)
    }
}

/// One candidate.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct CandidateReport {
    /// Id of the term, `outside` or `none`.
    #[cfg_attr(feature = "typescript", ts(as = "String"))]
    pub term: Explanation,
    /// Probability as the first addition.
    pub probability: f64,
    /// Terms whose signature is the same in these data.
    pub indistinguishable: Vec<String>,
}

/// One step of the model.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct StepReport {
    /// Terms beside the springs.
    pub terms: Vec<String>,
    /// Error on the readings fitted.
    #[serde(flatten)]
    pub fitted: ErrorSummary,
    /// Error on held-out poses.
    pub holdout: Option<ErrorSummary>,
    /// Chance of an error on held-out poses as large as this if the model is right, with all that is known of noise, tolerances and
    /// parameters; absent where nothing could be held out or the noise is not known apart from the residuals.
    pub chance: Option<f64>,
    /// What held-out poses say of the effect added last; absent where nothing was added, or nothing could be held out.
    pub gain: Option<HeldOutGain>,
    /// Share of the held-out error which that effect takes off; absent likewise.
    pub worth: Option<Worth>,
}

impl StepReport {
    /// Error on held-out poses, else on the readings fitted.
    pub fn error(&self) -> ErrorSummary {
        self.holdout.unwrap_or(self.fitted)
    }

    /// True when that error is what the noise gives: by its chance where that is known, else by its size.
    pub fn is_at_the_noise(&self) -> bool {
        is_at_the_noise(&self.error(), self.chance)
    }
}

/// Noise of one reading.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct NoiseReport {
    /// Of a length, um; none where none is read.
    pub translation_um: Option<f64>,
    /// Of an angle, urad; none where none is read.
    pub rotation_urad: Option<f64>,
    /// Where it comes from.
    #[cfg_attr(feature = "typescript", ts(as = "String"))]
    pub source: NoiseSource,
    /// Degrees of freedom from which the readings tell it; absent where it is that of the files.
    pub dof: Option<f64>,
}

impl NoiseReport {
    /// That of what a campaign reads, in um and urad.
    pub fn of(campaign: &Campaign) -> Self {
        let [translation_um, rotation_urad] = campaign.noise_read().map(|sigma| sigma.map(|s| s * 1e6));
        let is_as_stated = campaign.noise.is_stated() && !campaign.has_adjusted_noise();
        let dof = campaign.noise.dof_beside(campaign.averaged_numbers()).min(campaign.numbers as f64);
        let dof = (!is_as_stated).then_some(dof);
        Self { translation_um, rotation_urad, source: campaign.noise.source, dof }
    }

    /// Of lengths, um, and of angles, urad.
    pub fn both(&self) -> [Option<f64>; 2] {
        [self.translation_um, self.rotation_urad]
    }
}

/// A proposed reading.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct NextReport {
    /// `[a, b, c]` in mm, `[alpha, beta, gamma]` in deg.
    pub pose: [f64; 6],
    /// `[fx, fy, fz]` in N, `[mx, my, mz]` in N m.
    pub wrench: [f64; 6],
    /// Reference wrench, same units.
    pub reference: [f64; 6],
    /// +1 or -1.
    #[cfg_attr(feature = "typescript", ts(as = "f64"))]
    pub approach: Approach,
    /// Wait before the loaded reading, s.
    pub elapsed_s: f64,
    /// Temperature of the structure against the reference reading, K.
    #[serde(rename = "delta_T_K")]
    pub delta_t_k: f64,
    /// How often to read it.
    pub repeats: usize,
    /// The rivals it separates most.
    pub separates: [String; 2],
    /// What it adds to the expected logarithm of the Bayes factor between them, under the one of the two for which that is less;
    /// nats.
    pub gain: f64,
    /// What sort of reading it is, in words.
    pub text: String,
}

/// What the proposed readings promise for two rivals.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct SeparationReport {
    /// The rivals.
    pub between: [String; 2],
    /// Expected decimal logarithm of the Bayes factor for the truth, when the first is true and when the second is.
    pub log10_bayes_factor: [f64; 2],
    /// Chance that the readings favor the truth.
    pub right: f64,
    /// Readings after which the wrong one is on average excluded at 20:1; absent when more are needed.
    pub readings_needed: Option<usize>,
}

/// Bias of the leg stiffnesses without a term.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct AbsorbedReport {
    /// The term.
    pub term: String,
    /// Stiffness without it over stiffness with it, minus one, percent; absent where not determined.
    pub bias_of_leg_stiffness_percent: [Option<f64>; 6],
}

/// An unexplained pattern.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct OutsideReport {
    /// Leg from 1; absent when all legs follow it.
    pub leg: Option<usize>,
    /// What it follows.
    pub variable: Option<&'static str>,
    /// `linear`, `quadratic`, `step`, `periodic`; `stiffness-beside-the-legs`, `unstated-load`,
    /// `other-leg`, `moving-frame`.
    pub pattern: Option<&'static str>,
    /// Period in mm.
    pub period: Option<f64>,
    /// A sentence.
    pub text: String,
}
