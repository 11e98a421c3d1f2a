//! A suite: the frozen protocol that defines the cases of a challenge.

mod read;
mod sizes;

use std::path::{Path, PathBuf};

use hexbench_core::files::text_hash;
use hexbench_truth::campaign::{CaseKind, PlanKind, SensorSet};

use crate::challenge::ChallengeError;
use crate::error::ExperimentError;
use crate::keys::{EffectSet, ReadingNoise, SizeRange};

/// A suite that comes with the program.
#[derive(Debug, Clone, Copy)]
pub struct Bundled {
    /// Name on the command line and in the file.
    pub name: &'static str,
    /// The file.
    pub text: &'static str,
}

/// The suites that come with the program.
pub const BUNDLED: [Bundled; 1] = [Bundled {
    name: "springs-and-effects",
    text: include_str!("../../../../../data/challenges/springs-and-effects.toml"),
}];

/// Characters of a hidden seed at least: what fewer of them hold can be tried out.
const SHORTEST_SEED: usize = 32;

/// Which cases a challenge has.
#[derive(Debug, Clone, PartialEq)]
pub struct ChallengeSuite {
    /// Its name.
    pub name: String,
    /// Its version: a changed protocol has another.
    pub version: u64,
    /// What it asks, one line.
    pub title: String,
    /// Decides everything that is drawn.
    pub seed: u64,
    /// SHA-256 of the text of a seed that is kept hidden.
    pub seed_sha256: Option<String>,
    /// SHA-256 of the file.
    pub sha256: String,
    /// Groups of cases, in the order of the file.
    pub portions: Vec<CasePortion>,
}

/// Some cases of one make.
#[derive(Debug, Clone, PartialEq)]
pub struct CasePortion {
    /// Name of the group, told in the scores and never to the entrants.
    pub group: String,
    /// Kind of campaign that is drawn; none of scenes.
    pub kind: Option<CaseKind>,
    /// Folders of scenes that take turns; none where campaigns are drawn.
    pub scenes: Vec<PathBuf>,
    /// How many.
    pub count: usize,
    /// Distance of each effect, drawn log-uniformly; the usual one of the kind without.
    pub distance: Option<[f64; 2]>,
    /// Size of each effect instead of a distance.
    pub sizes: Option<SizeRange>,
    /// What laboratories do to the data, in turn; nothing when empty.
    pub laboratory: Vec<&'static str>,
    /// Noise of the instrument; the usual one without.
    pub noise: Option<ReadingNoise>,
    /// Effects to choose from in turn, one or several each; drawn without.
    pub effects: Vec<EffectSet>,
    /// Make of the plan; drawn without.
    pub plan: Option<PlanKind>,
    /// Family of the machine; drawn without.
    pub machine: Option<&'static str>,
    /// What reads the measurements; full poses without.
    pub read_by: Option<SensorSet>,
    /// Most readings of one condition that are handed out.
    pub repeats: Option<u64>,
}

impl ChallengeSuite {
    /// The bundled suite of a name, else that of a file.
    ///
    /// # Errors
    /// [`ChallengeError::NoSuite`], [`ChallengeError::File`] with the first thing that is wrong.
    pub fn named(name: &str) -> Result<Self, ChallengeError> {
        Self::from_text(&Self::text(name)?, Path::new(name))
    }

    /// Text of the bundled suite of a name, else of a file.
    ///
    /// # Errors
    /// [`ChallengeError::NoSuite`], [`ExperimentError::Read`].
    pub fn text(name: &str) -> Result<String, ChallengeError> {
        if let Some(bundled) = BUNDLED.iter().find(|b| b.name == name) {
            return Ok(bundled.text.to_owned());
        }
        let path = Path::new(name);
        if path.exists() {
            return Ok(std::fs::read_to_string(path).map_err(ExperimentError::reading(path))?);
        }
        let known = BUNDLED.iter().map(|b| b.name).collect();
        Err(ChallengeError::NoSuite { name: name.to_owned(), known })
    }

    /// The same with another seed.
    #[must_use]
    pub fn with_seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// The same with a seed that nobody can try out: cases follow the text, and what is handed out has its digest alone.
    ///
    /// # Errors
    /// [`ChallengeError::ShortSeed`].
    pub fn with_hidden_seed(self, text: &str) -> Result<Self, ChallengeError> {
        const DIGITS: usize = 16;
        let text = text.trim();
        if text.len() < SHORTEST_SEED {
            return Err(ChallengeError::ShortSeed { found: text.len(), least: SHORTEST_SEED });
        }
        // Not a part of the digest that is handed out.
        let drawn = text_hash(&format!("the seed of a challenge\n{text}"));
        let seed = u64::from_str_radix(&drawn[..DIGITS], 16).unwrap_or_default();
        Ok(Self { seed, seed_sha256: Some(text_hash(text)), ..self })
    }

    /// Number of cases.
    pub fn cases(&self) -> usize {
        self.portions.iter().map(|p| p.count).sum()
    }

    /// A suite from its text; `file` stands for it in messages.
    ///
    /// # Errors
    /// [`ChallengeError::File`] with the first thing that is wrong.
    pub fn from_text(text: &str, file: &Path) -> Result<Self, ChallengeError> {
        Ok(Self { sha256: text_hash(text), ..read::suite(text, file)? })
    }
}

#[cfg(test)]
mod tests;
