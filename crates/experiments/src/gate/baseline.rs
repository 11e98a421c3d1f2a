//! The committed baseline of a program: its scores by case, and what they were made of.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::values::GateValues;
use super::{GateError, GateSuite};
use crate::alarm::{BaselineFileError, Update, file};
use crate::challenge::Challenge;
use crate::challenge::run::{Entrant, ProgramFiles, RunLimits};
use crate::challenge::score::CaseScore;

/// Name and version of the file format.
const FORMAT: &str = "gate-baseline/1";

/// What a program is compared with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GateBaseline {
    /// `gate-baseline/1`.
    pub format: String,
    /// The program.
    pub entrant: GateEntrant,
    /// Times it ran over the cases.
    pub repeats: usize,
    /// True when all of these gave the same figures; one of them is then kept.
    pub steady: bool,
    /// Updates, the latest last.
    pub history: Vec<Update>,
    /// Ids of the cases, in order.
    pub cases: Vec<String>,
    /// Figures of every case.
    pub figures: GateValues,
    /// The cases.
    pub suite: GateSuite,
}

/// A program as it was recorded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GateEntrant {
    /// Program and arguments, as they were typed.
    pub program: Vec<String>,
    /// True for a function in the process that asked.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub inside: bool,
    /// Files and folders it depends on besides, as they were typed.
    pub depends: Vec<String>,
    /// Limits of each case.
    pub limits: RunLimits,
    /// SHA-256 of its files, by their path from the folder where it was recorded, others by their name.
    pub files: BTreeMap<String, String>,
}

impl GateEntrant {
    /// What is kept of a program.
    ///
    /// # Errors
    /// [`GateError::Challenge`] when one of its files cannot be read.
    pub fn of(program: &[String], depends: &[String], entrant: &Entrant) -> Result<Self, GateError> {
        let files =
            ProgramFiles::of(&entrant.program)?.named_from(&std::env::current_dir().unwrap_or_default());
        let inside = entrant.program.is_inside();
        Ok(Self {
            program: program.to_vec(),
            inside,
            depends: depends.to_vec(),
            limits: entrant.limits,
            files,
        })
    }

    /// Files that are other ones now, by name.
    pub fn changed_files(&self, now: &Self) -> Vec<String> {
        let all = self.files.keys().chain(now.files.keys());
        let mut changed: Vec<String> =
            all.filter(|name| self.files.get(*name) != now.files.get(*name)).cloned().collect();
        changed.sort_unstable();
        changed.dedup();
        changed
    }
}

impl GateBaseline {
    /// A baseline of runs over the cases of a challenge; `kept` is the history of the one before.
    ///
    /// # Errors
    /// [`BaselineFileError::NoReason`].
    pub fn of(
        (suite, challenge): (GateSuite, &Challenge),
        entrant: GateEntrant,
        runs: &[Vec<CaseScore>],
        (reason, kept): (&str, Vec<Update>),
    ) -> Result<Self, GateError> {
        if reason.trim().is_empty() {
            return Err(BaselineFileError::NoReason.into());
        }
        let all = GateValues::of(runs);
        let steady = runs.len() > 1 && all.is_steady();
        let update = Update::now(suite.seed.unwrap_or_default(), runs.len(), reason);
        Ok(Self {
            format: FORMAT.to_owned(),
            entrant,
            repeats: runs.len(),
            steady,
            history: kept.into_iter().chain([update]).collect(),
            cases: challenge.manifest().cases.clone(),
            figures: if steady { all.first() } else { all },
            suite,
        })
    }

    /// Reads a baseline.
    ///
    /// # Errors
    /// [`GateError::File`], [`GateError::Impossible`].
    pub fn read(path: &Path) -> Result<Self, GateError> {
        let read: Self = file::read(path, FORMAT)?;
        let runs = if read.steady { 1 } else { read.repeats };
        let of_values = || read.figures.fault(read.cases.len(), runs);
        let fault = match () {
            () if read.cases.is_empty() || read.repeats == 0 => Some("it has no cases or no runs".to_owned()),
            () if read.entrant.program.is_empty() => Some("it has no program".to_owned()),
            () => of_values(),
        };
        match fault {
            Some(fault) => Err(GateError::Impossible { path: path.to_owned(), fault }),
            None => Ok(read),
        }
    }

    /// Writes it whole or not at all.
    ///
    /// # Errors
    /// [`GateError::File`].
    pub fn write(&self, path: &Path) -> Result<(), GateError> {
        Ok(file::write(path, self)?)
    }
}
