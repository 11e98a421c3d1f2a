//! The protocol: every misstatement meets machines of every family, clean and with one effect; beside them sound campaigns.

use hexbench_truth::misstatements;

use super::{MisreadFate, MisreadJob, MisreadRecord, MisreadScene};
use crate::harness::{self, Field, Study};
use crate::journal::Identity;
use crate::trial::TrialError;

/// Seed of the committed figures.
pub const SEED: u64 = 4_407;
/// Campaigns of each misstatement: every family, clean and with one effect.
pub const TRIALS: u32 = 14;
/// Sound campaigns.
pub const SOUND: u32 = 1_000;

/// What is run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MisreadProtocol {
    /// Decides everything that is drawn.
    pub seed: u64,
    /// Campaigns of each misstatement.
    pub trials: usize,
    /// Campaigns in which nothing is misstated.
    pub sound: usize,
    /// Ids of the misstatements, in their order; unknown ones are left out.
    pub misstatements: Vec<&'static str>,
    /// Scenes in which some of the sound campaigns are measured.
    pub scenes: Vec<MisreadScene>,
}

impl Default for MisreadProtocol {
    fn default() -> Self {
        let misstatements = misstatements::registry().map(|entry| entry.id).collect();
        Self { seed: SEED, trials: TRIALS as usize, sound: SOUND as usize, misstatements, scenes: Vec::new() }
    }
}

impl MisreadProtocol {
    /// These misstatements only.
    #[must_use]
    pub fn with_misstatements(self, ids: &[&str]) -> Self {
        let misstatements = self.misstatements.into_iter().filter(|id| ids.contains(id)).collect();
        Self { misstatements, ..self }
    }
}

/// All trials of a protocol.
pub type Misread = Study<MisreadProtocol>;

/// A column of the table of trials.
type Column = Field<MisreadRecord>;

impl harness::Protocol for MisreadProtocol {
    type Job = MisreadJob;
    type Record = MisreadRecord;
    type Error = TrialError;

    fn identity(&self) -> Identity {
        let scenes: Vec<String> = self.scenes.iter().map(|s| format!("{} {}", s.name, s.digest)).collect();
        let settings = [
            ("misstatements", self.misstatements.join(", ")),
            ("trials", self.trials.to_string()),
            ("sound", self.sound.to_string()),
            ("scenes", scenes.join(", ")),
            ("seed", self.seed.to_string()),
        ];
        Identity::new("misread", "misread-trials/1", settings)
    }

    /// Campaign after campaign, each written in all ways; then the sound ones.
    fn jobs(&self) -> Vec<MisreadJob> {
        let entries: Vec<_> = self.misstatements.iter().filter_map(|id| misstatements::entry(id)).collect();
        let written = |campaign| entries.iter().map(move |entry| MisreadJob::misread(entry, campaign));
        let sound = (0..self.sound).map(|number| MisreadJob::sound(number, &self.scenes));
        (0..self.trials).flat_map(written).chain(sound).collect()
    }

    fn trial(&self, job: &MisreadJob) -> Result<MisreadRecord, TrialError> {
        MisreadRecord::of(job, self.seed)
    }

    fn name(&self, job: &MisreadJob) -> String {
        job.name()
    }

    fn fields(&self) -> Vec<Column> {
        words().into_iter().chain(numbers()).collect()
    }
}

fn words() -> Vec<Column> {
    vec![
        Column::text("misstatement", "what is misstated, or sound", |r| {
            r.misstatement.clone().unwrap_or_else(|| "sound".to_owned())
        }),
        Column::text("kind", "kind of the campaign", |r| r.campaign.kind.clone()),
        Column::text("family", "family of the machine", |r| r.campaign.family.clone()),
        Column::text("plan", "plan of the measurements", |r| r.campaign.plan.clone()),
        Column::text("hidden", "hidden effects", |r| r.campaign.hidden.clone()),
        Column::text("verdict", "the verdict, or refused", MisreadRecord::verdict_word),
        Column::text("added", "effects named", |r| r.added.join("+")),
        Column::text("findings", "kinds of the findings", |r| r.findings.join("+")),
        Column::text("fate", "what became of the misstatement", |r| r.fate().map_or("", MisreadFate::words)),
        Column::text("refusal", "why there is no answer", |r| r.refusal.clone()),
    ]
}

fn numbers() -> Vec<Column> {
    let chi2 = |place: usize, is_written: bool| {
        move |r: &MisreadRecord| {
            r.change.as_ref().map(|c| if is_written { c.written[place] } else { c.meant[place] })
        }
    };
    vec![
        Column::number("size", "effects over their usual size", |r| r.campaign.size),
        Column::flag("matters", "the plain answer is another one", MisreadRecord::matters),
        Column::flag("looks_right", "it is, and no misfit shows it", MisreadRecord::looks_right),
        Column::number(
            "springs_meant",
            "chi-square per degree of freedom, springs, as meant",
            chi2(0, false),
        ),
        Column::number("springs_written", "the same as written", chi2(0, true)),
        Column::number("holdout_meant", "held-out chi-square per number, springs, as meant", chi2(1, false)),
        Column::number("holdout_written", "the same as written", chi2(1, true)),
    ]
}
