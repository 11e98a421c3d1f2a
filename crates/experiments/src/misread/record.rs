//! One trial: what was written, what it changes, what was said.

use hexbench_model::error::ModelError;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::{Diagnosis, diagnose};
use hexbench_model::terms::catalogue;
use hexbench_truth::campaign::SimulatedCase;
use hexbench_truth::misstatements::{self, MisstatementEntry};
use serde::{Deserialize, Serialize};

use super::files::ReadFiles;
use super::plain::PlainFit;
use super::{MisreadCampaign, MisreadFate, MisreadJob, PlainChange, WHOLE_FILE};
use crate::trial::{TrialError, kinds};

/// What was done to the files of a campaign, and what was said about them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MisreadRecord {
    /// Name of the trial.
    pub name: String,
    /// Id of the misstatement; none of a sound campaign.
    pub misstatement: Option<String>,
    /// What was measured.
    pub campaign: MeasuredCampaign,
    /// What the misstatement changes of the plain answer; none of a sound campaign, and where no springs can be fitted.
    pub change: Option<PlainChange>,
    /// The verdict; none where the files are refused or nothing can be computed.
    pub verdict: Option<Verdict>,
    /// Why not.
    pub refusal: String,
    /// Effects named.
    pub added: Vec<String>,
    /// Kinds of the findings, the first first.
    pub findings: Vec<String>,
}

/// What was measured in a trial.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MeasuredCampaign {
    /// Kind of the campaign, or `scene`.
    pub kind: String,
    /// Family of the machine, or name of the scene.
    pub family: String,
    /// Plan of the measurements, or `scene`.
    pub plan: String,
    /// Ids of the hidden effects as the catalogue calls them; `out:` in front of those it lacks.
    pub hidden: String,
    /// Size of the effects over the usual one; none without effects.
    pub size: Option<f64>,
}

/// Kind and plan of campaigns in scenes.
pub(super) const SCENE: &str = "scene";

impl MeasuredCampaign {
    fn of(campaign: &MisreadCampaign) -> Self {
        match campaign {
            MisreadCampaign::Case(case) => Self {
                kind: case.spec.kind.name().to_owned(),
                family: case.spec.family.to_owned(),
                plan: case.spec.plan.name().to_owned(),
                hidden: case.spec.hidden_effects().join("+"),
                size: size(case),
            },
            MisreadCampaign::Scene { scene, size, .. } => Self {
                kind: SCENE.to_owned(),
                family: scene.name.clone(),
                plan: SCENE.to_owned(),
                hidden: scene.hidden_effects().join("+"),
                size: (!scene.mechanisms.is_empty()).then_some(*size),
            },
        }
    }
}

impl MisreadRecord {
    /// Draws the campaign, writes its files, diagnoses them.
    pub(crate) fn of(job: &MisreadJob, seed: u64) -> Result<Self, TrialError> {
        let mut campaign = job.meant(seed)?;
        let meant = ReadFiles::of(&campaign);
        job.write(&mut campaign)?;
        let written = ReadFiles::of(&campaign);
        let answer = written.as_ref().map_err(|why| Refusal::of_reader(why)).and_then(answer);
        let (verdict, added, findings, refusal) = match answer {
            Ok(d) => (Some(d.verdict), d.added.clone(), kinds(&d), String::new()),
            Err(refusal) => (None, Vec::new(), refusal.findings, refusal.why),
        };
        let misstatement = match job {
            MisreadJob::Misread { entry, .. } => Some(entry.id.to_owned()),
            MisreadJob::Sound { .. } | MisreadJob::Scene { .. } => None,
        };
        let change = match (&misstatement, meant, written) {
            (Some(_), Ok(meant), Ok(written)) => change(&meant, &written)?,
            _ => None,
        };
        let campaign = MeasuredCampaign::of(&campaign);
        Ok(Self { name: job.name(), misstatement, campaign, change, verdict, refusal, added, findings })
    }

    /// The entry of the misstatement; none of a sound campaign.
    pub fn entry(&self) -> Option<&'static MisstatementEntry> {
        misstatements::entry(self.misstatement.as_deref()?)
    }

    /// True when the misstatement changes the answer, or makes one impossible.
    pub fn matters(&self) -> bool {
        self.misstatement.is_some() && self.change.as_ref().is_none_or(PlainChange::matters)
    }

    /// True when it matters and leaves no trace in the misfit of the springs, in signs or in copies.
    pub fn looks_right(&self) -> bool {
        self.change.as_ref().is_some_and(PlainChange::looks_right)
    }

    /// What became of the misstatement; none of a sound campaign.
    pub fn fate(&self) -> Option<MisreadFate> {
        self.entry().map(|entry| MisreadFate::of(entry, self))
    }

    /// Findings that speak of the file as a whole.
    pub fn about_file(&self) -> impl Iterator<Item = &str> {
        self.findings.iter().map(String::as_str).filter(|kind| WHOLE_FILE.contains(kind))
    }

    /// The verdict in one word.
    pub fn verdict_word(&self) -> &'static str {
        self.verdict.map_or("refused", Verdict::word)
    }
}

/// Why nothing is computed, and what is said of the files all the same.
struct Refusal {
    why: String,
    findings: Vec<String>,
}

impl Refusal {
    fn of_reader(why: &str) -> Self {
        Self { why: why.to_owned(), findings: Vec::new() }
    }

    fn of_model(why: &ModelError) -> Self {
        let findings = match why {
            ModelError::Misread { kind, .. } => vec![kind.word().to_owned()],
            _ => Vec::new(),
        };
        Self { why: why.to_string(), findings }
    }
}

/// What the bench says of files; why it says nothing.
fn answer(files: &ReadFiles) -> Result<Diagnosis, Refusal> {
    let study = diagnose(&files.hexapod, &files.measurements, Some(&files.holdout), &catalogue());
    study.map(|study| study.diagnosis).map_err(|why| Refusal::of_model(&why))
}

/// What a misstatement changes of the springs; none where they cannot be fitted to the files as written.
fn change(meant: &ReadFiles, written: &ReadFiles) -> Result<Option<PlainChange>, TrialError> {
    let meant = PlainFit::of(meant)?;
    Ok(PlainFit::of(written).ok().map(|written| PlainChange::between(&meant, &written)))
}

/// Effects over the usual size; one where they are not scaled.
fn size(case: &SimulatedCase) -> Option<f64> {
    let usual = case.spec.kind.usual_distance();
    (!case.spec.effects.is_empty()).then(|| case.spec.distance.map_or(1.0, |distance| distance / usual))
}
