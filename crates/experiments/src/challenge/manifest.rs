//! `challenge.toml`: what a challenge is made of, with the digest of every file.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::challenge::ChallengeSuite;
use crate::challenge::stored::Stored;

/// Name of the file.
pub const MANIFEST: &str = "challenge.toml";

/// What a challenge is made of.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// `challenge/1`.
    pub format: String,
    /// Name of the suite.
    pub suite: String,
    /// Its version.
    pub version: u64,
    /// What it asks.
    pub title: String,
    /// Seed of everything that was drawn; none where the organiser keeps it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
    /// SHA-256 of the text of a seed that the organiser keeps: shown later, it proves that the cases were not chosen.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seed_sha256: Option<String>,
    /// SHA-256 of the suite's file.
    pub suite_sha256: String,
    /// Version of the program that made it.
    pub hexbench: String,
    /// Groups of the suite, in its order.
    pub groups: Vec<String>,
    /// Ids of the cases, in order.
    pub cases: Vec<String>,
    /// SHA-256 of every public and sealed file, by its path in the folder.
    pub files: BTreeMap<String, String>,
}

impl Stored for Manifest {
    const FORMAT: &'static str = "challenge/1";

    fn format(&self) -> &str {
        &self.format
    }
}

impl Manifest {
    pub(crate) fn new(suite: &ChallengeSuite, cases: Vec<String>, files: BTreeMap<String, String>) -> Self {
        Self {
            format: Self::FORMAT.to_owned(),
            suite: suite.name.clone(),
            version: suite.version,
            title: suite.title.clone(),
            seed: suite.seed_sha256.is_none().then_some(suite.seed),
            seed_sha256: suite.seed_sha256.clone(),
            suite_sha256: suite.sha256.clone(),
            hexbench: env!("CARGO_PKG_VERSION").to_owned(),
            groups: suite.portions.iter().map(|p| p.group.clone()).collect(),
            cases,
            files,
        }
    }
}
