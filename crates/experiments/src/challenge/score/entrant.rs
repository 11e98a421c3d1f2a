//! All cases of one program.

use std::path::Path;

use rayon::prelude::*;
use serde::Serialize;

use super::CaseGroup;
use super::case::CaseScore;
use super::figures::Figures;
use super::key::AnswerKey;
use crate::challenge::answer::CaseAnswer;
use crate::challenge::run::{RunHeader, RunLimits, RunRecord, cases_folder};
use crate::challenge::{Challenge, ChallengeError};

/// Scores of one program.
#[derive(Debug, Clone, Serialize)]
pub struct EntrantScore {
    /// Its name.
    pub name: String,
    /// How it was called.
    pub program: Vec<String>,
    /// Limits it had.
    pub limits: RunLimits,
    /// System it ran on.
    pub system: String,
    /// Figures over all cases.
    pub all: Figures,
    /// Figures over each group, in the order of the groups.
    pub groups: Vec<GroupScore>,
    /// Every case.
    pub cases: Vec<CaseScore>,
}

/// Figures over a group of cases.
#[derive(Debug, Clone, Serialize)]
pub struct GroupScore {
    /// Its name in the suite.
    pub name: String,
    /// The figures.
    pub figures: Figures,
}

impl EntrantScore {
    pub(super) fn of(
        challenge: &Challenge,
        keys: &[AnswerKey],
        folder: &Path,
    ) -> Result<Self, ChallengeError> {
        let begun = RunHeader::read(folder)?;
        begun.check(folder, challenge)?;
        let cases: Vec<CaseScore> = keys.par_iter().map(|key| case(key, &cases_folder(folder))).collect();
        let of_group = |CaseGroup { name, .. }: CaseGroup| {
            let figures = Figures::of(cases.iter().filter(|c| c.group == name));
            GroupScore { name, figures }
        };
        Ok(Self {
            name: begun.name,
            program: begun.program,
            limits: begun.limits,
            system: begun.system,
            all: Figures::of(&cases),
            groups: super::groups(challenge, keys).into_iter().map(of_group).collect(),
            cases,
        })
    }

    /// Cases without answer, and why.
    pub fn failures(&self) -> impl Iterator<Item = (&str, &str)> {
        self.cases.iter().filter_map(|c| Some((c.id.as_str(), c.failure.as_deref()?)))
    }
}

/// What the program wrote to a folder, compared with the truth.
fn case(key: &AnswerKey, cases: &Path) -> CaseScore {
    let folder = cases.join(&key.truth.id);
    let record = match RunRecord::read(&folder) {
        Ok(record) => record,
        Err(error) => return CaseScore::failed(key, format!("not answered: {error}")),
    };
    let score = match &record.failure {
        Some(why) => CaseScore::failed(key, why.clone()),
        None if record.case_sha256 != key.case_sha256 => {
            CaseScore::failed(key, "it was answered from other files than those of the challenge".to_owned())
        }
        None => match CaseAnswer::read(&folder, key.measured.len(), key.measurand) {
            Ok(answer) => CaseScore::of(key, &answer),
            Err(fault) => CaseScore::failed(key, fault.to_string()),
        },
    };
    CaseScore { wall_s: Some(record.wall_s), peak_memory_mb: record.peak_memory_mb, ..score }
}
