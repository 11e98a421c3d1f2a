//! One run shared among processes: every n-th case each, then all answers in one folder.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::{Entrant, PART, Prepared, Summary, is_answered};
use crate::challenge::run::cases_folder;
use crate::challenge::{Challenge, ChallengeError};
use crate::error::ExperimentError;
use crate::harness::ExperimentPart;

/// True for the cases of a part: every n-th in the order of the challenge.
pub fn of_part(challenge: &Challenge, part: ExperimentPart) -> impl Fn(&str) -> bool {
    let cases = (0..).zip(&challenge.manifest().cases);
    let own: Vec<String> = cases.filter(|(n, _)| part.holds(*n)).map(|(_, id)| id.clone()).collect();
    move |id| own.iter().any(|own| own == id)
}

/// Takes over the answers to wanted cases in other folders of the same run; nothing is run. Of a case that several have answered, the
/// first counts; `again` replaces the answers that are there.
///
/// # Errors
/// [`ChallengeError::OtherProgram`], [`ChallengeError::OtherChallenge`] for the answers of another run;
/// [`ChallengeError::Unanswered`] when a case is in none of the folders.
pub fn take_over(
    challenge: &Challenge,
    entrant: &Entrant,
    answers: &Path,
    parts: &[PathBuf],
    again: bool,
    is_wanted: &dyn Fn(&str) -> bool,
) -> Result<Summary, ChallengeError> {
    let Prepared { begun, _lock, cases, earlier, mut pending } =
        Prepared::of(challenge, entrant, answers, again, is_wanted)?;
    let all = earlier.len() + pending.len();
    let mut fresh = Vec::new();
    for part in parts {
        begun.refuse_others(part)?;
        let theirs = cases_folder(part);
        for id in std::mem::take(&mut pending) {
            let from = theirs.join(id);
            if is_answered(&from, &challenge.case_sha256(id)) {
                copy(&from, &cases, id).map_err(ExperimentError::writing(&cases))?;
                fresh.push(super::RunRecord::read(&cases.join(id))?);
            } else {
                pending.push(id);
            }
        }
    }
    match pending.first() {
        None => Ok(Summary { earlier, fresh }),
        Some(first) => {
            Err(ChallengeError::Unanswered { missing: pending.len(), first: (*first).clone(), all })
        }
    }
}

/// Copies an answer whole or not at all.
fn copy(from: &Path, cases: &Path, id: &str) -> io::Result<()> {
    let place = cases.join(id);
    let part = tempfile::Builder::new().prefix(PART).tempdir_in(cases)?;
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        if entry.file_type()?.is_file() {
            fs::copy(entry.path(), part.path().join(entry.file_name()))?;
        }
    }
    super::one::put(part, &place)
}
