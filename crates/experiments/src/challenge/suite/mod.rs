//! A suite: the frozen protocol that says which cases a challenge has.

mod read;

use std::path::Path;

use hexbench_core::files::text_hash;
use hexbench_truth::campaign::{CaseKind, PlanKind, SensorSet};

use crate::challenge::ChallengeError;
use crate::error::ExperimentError;

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
    /// Kind of campaign.
    pub kind: CaseKind,
    /// How many.
    pub count: usize,
    /// Distance of each effect, drawn log-uniformly; the usual one of the kind without.
    pub distance: Option<[f64; 2]>,
    /// Effects to choose from in turn, one or several each; drawn without.
    pub effects: Vec<Vec<&'static str>>,
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
        if let Some(bundled) = BUNDLED.iter().find(|b| b.name == name) {
            return Self::from_text(bundled.text, Path::new(bundled.name));
        }
        let path = Path::new(name);
        if path.exists() {
            let text = std::fs::read_to_string(path).map_err(ExperimentError::reading(path))?;
            return Self::from_text(&text, path);
        }
        let known = BUNDLED.iter().map(|b| b.name).collect();
        Err(ChallengeError::NoSuite { name: name.to_owned(), known })
    }

    /// The same with another seed.
    #[must_use]
    pub fn with_seed(self, seed: u64) -> Self {
        Self { seed, ..self }
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
