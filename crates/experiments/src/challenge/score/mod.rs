//! Answers compared with the truth, for several programs side by side.

mod better;
mod case;
mod cells;
mod effects;
mod entrant;
mod figures;
mod forecast;
mod key;
mod leaderboard;
mod page;
mod paired;
mod pictures;
mod places;
mod proper;

use std::collections::BTreeSet;
use std::path::PathBuf;

use rayon::prelude::*;
use serde::Serialize;

use crate::challenge::{Challenge, ChallengeError};
pub use case::{CaseScore, LegScore, PredictionScore};
pub use entrant::{EntrantScore, GroupScore};
pub use figures::{Figures, Interval, Mean};
pub use forecast::Forecast;
pub use key::AnswerKey;
pub use leaderboard::leaderboard;
pub use page::page;
pub use paired::{Differences, Exchanges, Ratio, Ratios};
pub use places::{MeanPlaces, places};
pub use proper::ProperScore;

/// Name and version of the format.
const FORMAT: &str = "challenge-scores/1";

/// Scores of several programs in one challenge.
#[derive(Debug, Serialize)]
pub struct ChallengeScores {
    /// `challenge-scores/1`.
    pub format: &'static str,
    /// Name of the suite.
    pub suite: String,
    /// Its version.
    pub version: u64,
    /// What it asks.
    pub title: String,
    /// Seed of the cases; none where the organiser keeps it.
    pub seed: Option<u64>,
    /// SHA-256 of `challenge.toml`.
    pub challenge_sha256: String,
    /// Version of the program that made the challenge.
    pub made_by: String,
    /// Version of the program that scored.
    pub hexbench: &'static str,
    /// Groups of cases, in the order in which they are shown, with their sizes.
    pub groups: Vec<CaseGroup>,
    /// One for each program, in the order given.
    pub entrants: Vec<EntrantScore>,
}

/// Scores answers, after comparing every file of the challenge with its digest.
///
/// # Errors
/// [`ChallengeError`] when the challenge changed, answers were made for another one, or two have the same name. An answer that is
/// missing or cannot be read is a failed case.
pub fn score(challenge: &Challenge, answers: &[PathBuf]) -> Result<ChallengeScores, ChallengeError> {
    challenge.verify()?;
    let ids = &challenge.manifest().cases;
    let keys = ids.par_iter().map(|id| AnswerKey::read(challenge, id)).collect::<Result<Vec<_>, _>>()?;
    let entrants = answers
        .iter()
        .map(|folder| EntrantScore::of(challenge, &keys, folder))
        .collect::<Result<Vec<_>, _>>()?;
    refuse_same_names(&entrants)?;
    let manifest = challenge.manifest();
    Ok(ChallengeScores {
        format: FORMAT,
        suite: manifest.suite.clone(),
        version: manifest.version,
        title: manifest.title.clone(),
        seed: manifest.seed,
        challenge_sha256: challenge.sha256().to_owned(),
        made_by: manifest.hexbench.clone(),
        hexbench: env!("CARGO_PKG_VERSION"),
        groups: groups(challenge, &keys),
        entrants,
    })
}

/// A group of cases.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct CaseGroup {
    /// Its name in the suite.
    pub name: String,
    /// Its size.
    pub cases: usize,
}

impl ChallengeScores {
    /// Cases that are no answer, of all programs.
    pub fn failed(&self) -> usize {
        self.entrants.iter().map(|e| e.all.cases - e.all.answered).sum()
    }
}

fn refuse_same_names(entrants: &[EntrantScore]) -> Result<(), ChallengeError> {
    let mut names = BTreeSet::new();
    match entrants.iter().find(|e| !names.insert(e.name.as_str())) {
        Some(twin) => Err(ChallengeError::SameName(twin.name.clone())),
        None => Ok(()),
    }
}

/// Groups in the order of the suite, with the number of cases.
fn groups(challenge: &Challenge, keys: &[AnswerKey]) -> Vec<CaseGroup> {
    let size = |name: &String| keys.iter().filter(|k| k.truth.group == *name).count();
    let group = |name: &String| CaseGroup { name: name.clone(), cases: size(name) };
    challenge.manifest().groups.iter().map(group).collect()
}
