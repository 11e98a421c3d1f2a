//! A result as it stands in its file.

use std::collections::BTreeMap;

use hexbench_core::{Dataset, Hexapod};
use serde::{Deserialize, Serialize};

use crate::estimation::estimate::Estimate;
use crate::estimation::noise::NoiseSource;
use crate::estimation::residuals::ErrorSummary;
use crate::inference::explanation::Explanation;
use crate::inference::verdict::Verdict;

/// The results that can be compared.
pub const FORMATS: [&str; 3] = ["diagnosis/1", "comparison/1", "fit/1"];

/// What a result was made by and from: key `run` of its file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Origin {
    /// Program and version.
    pub program: String,
    /// Name of the machine.
    pub machine: String,
    /// `deflections` or `absolute poses`.
    pub measurand: String,
    /// SHA-256 of the hexapod file.
    pub hexapod_sha256: String,
    /// SHA-256 of the measurements.
    pub data_sha256: String,
    /// SHA-256 of the holdout file, when there was one.
    pub holdout_sha256: Option<String>,
    /// Readings of the file from which those used were drawn; none where all were used.
    pub drawn_from: Option<usize>,
}

impl Origin {
    /// Of a machine and its measurements, each with the digest of its file.
    pub fn new(
        program: &str,
        hexapod: (&Hexapod, String),
        data: (&Dataset, String),
        holdout_sha256: Option<String>,
    ) -> Self {
        Self {
            program: program.to_owned(),
            machine: hexapod.0.name.clone(),
            measurand: data.0.measurand.readings().to_owned(),
            hexapod_sha256: hexapod.1,
            data_sha256: data.1,
            holdout_sha256,
            drawn_from: data.0.drawn_from,
        }
    }
}

/// A result with where it comes from, as it is written.
#[derive(Debug, Clone, Serialize)]
pub struct WithOrigin<'a, T> {
    /// The result: its keys stand first.
    #[serde(flatten)]
    pub result: &'a T,
    /// Where it comes from.
    pub run: Origin,
}

/// What every result says of itself.
#[derive(Debug, Clone, Deserialize)]
pub struct Head {
    /// `diagnosis/1`, `comparison/1`, `fit/1`.
    pub format: String,
}

/// A diagnosis, as far as it is compared.
#[derive(Debug, Clone, Deserialize)]
pub struct SavedDiagnosis {
    verdict: Verdict,
    added: Vec<String>,
    candidates: Vec<SavedCandidate>,
    #[serde(default)]
    present: BTreeMap<String, f64>,
    steps: Vec<SavedStep>,
    noise: SavedNoise,
    parameters: Vec<Estimate>,
    #[serde(default)]
    excluded: Vec<u64>,
    #[serde(default)]
    keep_all: bool,
    #[serde(default)]
    read_as: Vec<String>,
    run: Option<Origin>,
}

#[derive(Debug, Clone, Deserialize)]
struct SavedCandidate {
    term: Explanation,
    probability: f64,
}

#[derive(Debug, Clone, Deserialize)]
struct SavedStep {
    terms: Vec<String>,
    #[serde(flatten)]
    fitted: ErrorSummary,
    holdout: Option<ErrorSummary>,
}

#[derive(Debug, Clone, Deserialize)]
struct SavedNoise {
    translation_um: Option<f64>,
    rotation_urad: Option<f64>,
    source: NoiseSource,
    #[serde(default)]
    dof: Option<f64>,
}

/// A comparison, as far as it is compared with another one.
#[derive(Debug, Clone, Deserialize)]
pub struct SavedComparison {
    terms: Vec<String>,
    noise_source: NoiseSource,
    error: ErrorSummary,
    holdout: Option<ErrorSummary>,
    coordinates: Vec<SavedCoordinate>,
    #[serde(default)]
    read_as: Vec<String>,
    run: Option<Origin>,
}

#[derive(Debug, Clone, Deserialize)]
struct SavedCoordinate {
    unit: String,
    noise: f64,
}

/// A fit of named terms, as far as it is compared with another one.
#[derive(Debug, Clone, Deserialize)]
pub struct SavedFit {
    terms: Vec<String>,
    #[serde(default)]
    excluded: Vec<u64>,
    noise: SavedNoise,
    parameters: Vec<Estimate>,
    fitted: ErrorSummary,
    held_out: Option<ErrorSummary>,
    run: Option<Origin>,
}

/// Error of one model.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RunStep {
    /// Terms beside the springs.
    pub terms: Vec<String>,
    /// On the readings of the data.
    pub fitted: ErrorSummary,
    /// On held-out readings.
    pub holdout: Option<ErrorSummary>,
}

impl RunStep {
    /// The held-out error where there is one.
    pub fn error(&self) -> &ErrorSummary {
        self.holdout.as_ref().unwrap_or(&self.fitted)
    }
}

/// A result to be compared.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Run {
    /// The file it comes from.
    pub file: String,
    /// `diagnosis/1`, `comparison/1`, `fit/1`.
    pub format: String,
    /// Of a diagnosis.
    pub verdict: Option<Verdict>,
    /// Terms named, or terms of the model compared.
    pub added: Vec<String>,
    /// Probability that an effect is at work, of `outside` and of `none`.
    pub probabilities: BTreeMap<Explanation, f64>,
    /// Errors, the springs alone first.
    pub steps: Vec<RunStep>,
    /// Noise of one length, um; none where none is read.
    pub noise_translation_um: Option<f64>,
    /// Noise of one angle, urad; none where none is read.
    pub noise_rotation_urad: Option<f64>,
    /// Where the noise comes from.
    pub noise_source: NoiseSource,
    /// Degrees of freedom from which the readings tell it; none where it is stated, or where the file does not say.
    pub noise_dof: Option<f64>,
    /// Numbers of the final model.
    pub parameters: Vec<Estimate>,
    /// Lines of the measurements left out by name.
    pub excluded: Vec<u64>,
    /// Readings that seem wrong took part in the fit.
    pub keep_all: bool,
    /// What the files were read as meaning otherwise than they say.
    pub read_as: Vec<String>,
    /// Absent in files of versions that did not write it.
    pub origin: Option<Origin>,
}

impl Run {
    /// Of a diagnosis.
    pub fn of_diagnosis(file: &str, d: SavedDiagnosis) -> Self {
        // They are candidates, not effects.
        let special = d.candidates.into_iter().filter(|c| c.term.term().is_none());
        let special = special.map(|c| (c.term, c.probability));
        let present = d.present.into_iter().map(|(id, p)| (Explanation::Term(id), p));
        let step = |s: SavedStep| RunStep { terms: s.terms, fitted: s.fitted, holdout: s.holdout };
        Self {
            file: file.to_owned(),
            format: FORMATS[0].to_owned(),
            verdict: Some(d.verdict),
            added: d.added,
            probabilities: present.chain(special).collect(),
            steps: d.steps.into_iter().map(step).collect(),
            noise_translation_um: d.noise.translation_um,
            noise_rotation_urad: d.noise.rotation_urad,
            noise_source: d.noise.source,
            noise_dof: d.noise.dof,
            parameters: d.parameters,
            excluded: d.excluded,
            keep_all: d.keep_all,
            read_as: d.read_as,
            origin: d.run,
        }
    }

    /// Of a fit.
    pub fn of_fit(file: &str, f: SavedFit) -> Self {
        Self {
            file: file.to_owned(),
            format: FORMATS[2].to_owned(),
            verdict: None,
            added: f.terms.clone(),
            probabilities: BTreeMap::new(),
            steps: vec![RunStep { terms: f.terms, fitted: f.fitted, holdout: f.held_out }],
            noise_translation_um: f.noise.translation_um,
            noise_rotation_urad: f.noise.rotation_urad,
            noise_source: f.noise.source,
            noise_dof: f.noise.dof,
            parameters: f.parameters,
            excluded: f.excluded,
            keep_all: false,
            read_as: Vec::new(),
            origin: f.run,
        }
    }

    /// Of a comparison.
    pub fn of_comparison(file: &str, c: SavedComparison) -> Self {
        let noise = |unit: &str| c.coordinates.iter().find(|x| x.unit == unit).map(|x| x.noise);
        Self {
            file: file.to_owned(),
            format: FORMATS[1].to_owned(),
            verdict: None,
            added: c.terms.clone(),
            probabilities: BTreeMap::new(),
            noise_translation_um: noise("um"),
            noise_rotation_urad: noise("urad"),
            steps: vec![RunStep { terms: c.terms, fitted: c.error, holdout: c.holdout }],
            noise_source: c.noise_source,
            noise_dof: None,
            parameters: Vec::new(),
            excluded: Vec::new(),
            keep_all: false,
            read_as: c.read_as,
            origin: c.run,
        }
    }
}
