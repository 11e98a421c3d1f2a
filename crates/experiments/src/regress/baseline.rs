//! The committed baseline: samples of every limit, and why it is what it is.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::cases::UPDATE;
use super::gathered::LimitSample;
use super::limit::RegressLimit;
use super::sample::CondensedValues;
use super::suite::RegressSuite;
use crate::alarm::{BaselineFileError, Update, file};

/// Name and version of the file format.
pub const FORMAT: &str = "regress-baseline/1";

/// Values of a run from which its mean is compared with that of the same campaigns.
const MANY: u64 = 60;

/// What runs are compared with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Baseline {
    /// [`FORMAT`].
    pub format: String,
    /// Name of the suite.
    pub suite: String,
    /// Version of the suite.
    pub suite_version: u32,
    /// Version of hexbench.
    pub hexbench: String,
    /// Seed of the first run behind it; the others follow.
    pub seed: u64,
    /// Runs behind it.
    pub runs: usize,
    /// Updates, the latest last.
    pub history: Vec<Update>,
    /// Samples by limit.
    pub limits: BTreeMap<String, BaselineEntry>,
}

/// One limit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BaselineEntry {
    /// Of all runs behind the baseline.
    #[serde(flatten)]
    pub sample: CondensedValues,
    /// Fingerprint of the values of the first run.
    pub first: String,
    /// The first run alone: of shares, and of means with many campaigns behind them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub first_run: Option<FirstRun>,
}

/// What a run with the same seed, which has the same campaigns, is compared with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FirstRun {
    /// Values.
    pub n: u64,
    /// Their mean; of errors and counts that of their logarithms, of shares the share.
    pub mean: f64,
}

impl FirstRun {
    fn of(sample: &CondensedValues) -> Option<Self> {
        let least = match sample {
            CondensedValues::Size { .. } | CondensedValues::Spread { .. } => MANY,
            CondensedValues::Share { .. } => 1,
            CondensedValues::Exact { .. } => return None,
        };
        (sample.count() >= least).then(|| Self { n: sample.count(), mean: sample.moments().0 })
    }
}

/// Why a baseline cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum BaselineError {
    /// It cannot be read or written.
    #[error(transparent)]
    File(#[from] BaselineFileError),
    /// Made for something else.
    #[error("{path}: was made with suite `{found}`, but this is suite `{wanted}`")]
    OtherSuite {
        /// The file.
        path: String,
        /// Suite and version in it.
        found: String,
        /// Suite and version that run.
        wanted: String,
    },
    /// A limit that is missing or left over.
    #[error("{path}: {what} the limit `{id}`")]
    Limits {
        /// The file.
        path: String,
        /// `lacks` or `has, and the suite has not,`.
        what: &'static str,
        /// Of the limit.
        id: String,
    },
    /// Numbers that contradict each other.
    #[error("{path}: limit `{id}`: {fault}")]
    Impossible {
        /// The file.
        path: String,
        /// Of the limit.
        id: String,
        /// What is wrong.
        fault: String,
    },
}

impl BaselineError {
    /// What to do about it.
    pub fn next_step(&self) -> String {
        match self {
            Self::File(error) => error.next_step(UPDATE),
            Self::Impossible { .. } => {
                format!(
                    "Restore the file from version control, or move it away and make a new one with `{UPDATE}`."
                )
            }
            Self::OtherSuite { .. } | Self::Limits { .. } => {
                format!("Make a baseline for this suite: `{UPDATE}` (with --quick for the quick suite).")
            }
        }
    }
}

/// A new baseline; `kept` is the history of the one before.
///
/// # Errors
/// [`BaselineFileError::NoReason`].
pub fn made(
    suite: &RegressSuite,
    limits: &[RegressLimit],
    gathered: &[LimitSample],
    update: Update,
    kept: Vec<Update>,
) -> Result<Baseline, BaselineError> {
    if update.reason.trim().is_empty() {
        return Err(BaselineFileError::NoReason.into());
    }
    let entry = |(limit, g): (&RegressLimit, &LimitSample)| {
        let first_run = FirstRun::of(&g.first);
        (
            limit.id.clone(),
            BaselineEntry { sample: g.sample.clone(), first: g.fingerprint.clone(), first_run },
        )
    };
    Ok(Baseline {
        format: FORMAT.to_owned(),
        suite: suite.name.to_owned(),
        suite_version: suite.version,
        hexbench: update.hexbench.clone(),
        seed: update.seed,
        runs: update.runs,
        limits: limits.iter().zip(gathered).map(entry).collect(),
        history: kept.into_iter().chain([update]).collect(),
    })
}

impl Baseline {
    /// Reads a baseline of any suite.
    ///
    /// # Errors
    /// [`BaselineError::File`], [`BaselineError::Impossible`].
    pub fn read(path: &Path) -> Result<Self, BaselineError> {
        let name = || path.display().to_string();
        let read: Self = file::read(path, FORMAT)?;
        for (id, entry) in &read.limits {
            if let Some(fault) = entry.sample.fault() {
                return Err(BaselineError::Impossible { path: name(), id: id.clone(), fault });
            }
        }
        Ok(read)
    }

    /// The same, and it must be one of this suite with these limits.
    ///
    /// # Errors
    /// As [`Baseline::read`]; [`BaselineError::OtherSuite`], [`BaselineError::Limits`].
    pub fn read_for(
        path: &Path,
        suite: &RegressSuite,
        limits: &[RegressLimit],
    ) -> Result<Self, BaselineError> {
        let read = Self::read(path)?;
        let name = || path.display().to_string();
        if (read.suite.as_str(), read.suite_version) != (suite.name, suite.version) {
            let found = format!("{}/{}", read.suite, read.suite_version);
            let wanted = format!("{}/{}", suite.name, suite.version);
            return Err(BaselineError::OtherSuite { path: name(), found, wanted });
        }
        let empty = |limit: &&RegressLimit| CondensedValues::of(limit.test, &[]);
        let fits = |limit: &&RegressLimit| {
            read.limits.get(&limit.id).is_some_and(|entry| entry.sample.is_like(&empty(limit)))
        };
        if let Some(limit) = limits.iter().find(|limit| !fits(limit)) {
            return Err(BaselineError::Limits { path: name(), what: "lacks", id: limit.id.clone() });
        }
        let known = |id: &&String| limits.iter().any(|limit| limit.id == **id);
        if let Some(id) = read.limits.keys().find(|id| !known(id)) {
            let what = "has, and the suite has not,";
            return Err(BaselineError::Limits { path: name(), what, id: id.clone() });
        }
        Ok(read)
    }

    /// Writes it whole or not at all.
    ///
    /// # Errors
    /// [`BaselineError::File`].
    pub fn write(&self, path: &Path) -> Result<(), BaselineError> {
        Ok(file::write(path, self)?)
    }
}
