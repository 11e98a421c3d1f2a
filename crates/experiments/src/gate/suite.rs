//! Which cases a program is judged by.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::GateError;
use crate::challenge::{Challenge, ChallengeSuite, MANIFEST, make};
use crate::harness::Progress;

/// Folder of the cases within that of the work.
const CHALLENGE: &str = "challenge";
/// Digits of a digest that a message shows.
const SHOWN: usize = 12;

/// The cases of a gate: a suite and its seed, or a challenge that was made before.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GateSuite {
    /// Name of the suite.
    pub name: String,
    /// Its version.
    pub version: u64,
    /// Seed of the cases; none where an organiser keeps it.
    pub seed: Option<u64>,
    /// Text of the suite, from which the cases are made again; none of a challenge that was made before.
    pub text: Option<String>,
    /// The suite's file as it was typed, or its name: scenes are found from its folder.
    pub file: String,
    /// One digest of all cases.
    pub cases_sha256: String,
}

impl GateSuite {
    /// A bundled suite, a suite file, or the folder of a challenge with its sealed part; cases are made in the folder of the work.
    ///
    /// # Errors
    /// [`GateError::Challenge`], [`GateError::SeedOfMadeCases`].
    pub fn open(
        source: &str,
        seed: Option<u64>,
        work: &Path,
        progress: &dyn Progress,
    ) -> Result<(Self, Challenge), GateError> {
        let folder = Path::new(source);
        if folder.join(MANIFEST).is_file() {
            if seed.is_some() {
                return Err(GateError::SeedOfMadeCases(folder.to_owned()));
            }
            let challenge = Challenge::open(folder)?;
            return Ok((Self::of(&challenge, None, source), challenge));
        }
        let text = ChallengeSuite::text(source)?;
        let suite = ChallengeSuite::from_text(&text, folder)?;
        let seed = seed.unwrap_or(suite.seed);
        let challenge = made(&suite.with_seed(seed), work, progress)?;
        Ok((Self::of(&challenge, Some(text), source), challenge))
    }

    /// The cases of a baseline again: from the text of the suite, or in the folder of the challenge.
    ///
    /// # Errors
    /// [`GateError::NeedsFolder`], [`GateError::OtherCases`], [`GateError::Challenge`].
    pub fn again(
        &self,
        folder: Option<&Path>,
        work: &Path,
        progress: &dyn Progress,
    ) -> Result<Challenge, GateError> {
        let challenge = match (&self.text, folder) {
            (_, Some(folder)) => Challenge::open(folder)?,
            (Some(text), None) => {
                let suite = ChallengeSuite::from_text(text, Path::new(&self.file))?;
                let seed = self.seed.unwrap_or(suite.seed);
                made(&suite.with_seed(seed), work, progress)?
            }
            (None, None) => return Err(GateError::NeedsFolder),
        };
        let ours = challenge.cases_sha256();
        if ours == self.cases_sha256 {
            return Ok(challenge);
        }
        let short = |digest: &str| digest.chars().take(SHOWN).collect();
        Err(GateError::OtherCases { theirs: short(&self.cases_sha256), ours: short(&ours) })
    }

    fn of(challenge: &Challenge, text: Option<String>, file: &str) -> Self {
        let manifest = challenge.manifest();
        Self {
            name: manifest.suite.clone(),
            version: manifest.version,
            seed: manifest.seed,
            text,
            file: file.to_owned(),
            cases_sha256: challenge.cases_sha256(),
        }
    }

    /// Suite, version and seed in words.
    pub fn in_words(&self) -> String {
        let seed =
            self.seed.map_or("a seed that the organiser keeps".to_owned(), |seed| format!("seed {seed}"));
        format!("{} version {}, {seed}", self.name, self.version)
    }
}

/// Makes the cases, unless an earlier work in the folder has made the same.
fn made(suite: &ChallengeSuite, work: &Path, progress: &dyn Progress) -> Result<Challenge, GateError> {
    let folder = work.join(CHALLENGE);
    if let Ok(challenge) = Challenge::open(&folder) {
        let there = challenge.manifest();
        let is_same = there.suite_sha256 == suite.sha256 && there.seed == Some(suite.seed);
        if is_same && there.hexbench == env!("CARGO_PKG_VERSION") && challenge.verify().is_ok() {
            return Ok(challenge);
        }
    }
    make(suite, &folder, progress)?;
    Ok(Challenge::open(&folder)?)
}
