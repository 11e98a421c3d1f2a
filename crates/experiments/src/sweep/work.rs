//! Work on a study in a folder: how it divides, what is still to do, what other folders have done, the results.
//!
//! One `Work` holds the folder's lock. Whoever drives it decides which shards are computed when, and may stop between them.

use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::error::ExperimentError;
use crate::harness::{self, ExperimentPart, Progress, Sharded};
use crate::journal::{Journal, Shards};
use crate::sweep::error::StudyError;

use crate::sweep::page;
use crate::sweep::precision;
use crate::sweep::results::{self, CellStatistics};
use crate::sweep::runner::Runner;
use crate::sweep::study::SweepStudy;

/// How a study divides into parts.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Division {
    /// One line about the study.
    pub title: String,
    /// Shards of the whole.
    pub shards: u64,
    /// Trials of the whole.
    pub trials: u64,
    /// SHA-256 of the study file and of every file it names.
    pub inputs: std::collections::BTreeMap<String, String>,
    /// Every file it was read from beside the study file itself, relative to its folder.
    pub files: Vec<String>,
    /// The parts in order.
    pub parts: Vec<Share>,
}

/// How much a part is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Share {
    /// `i/n`.
    pub part: String,
    /// Its shards.
    pub shards: u64,
    /// Their trials.
    pub trials: u64,
}

/// Tells how a study divides into so many parts.
///
/// # Errors
/// The study file cannot be used, or a designed plan has no answer.
pub fn divide(study: &Path, parts: u64) -> Result<Division, StudyError> {
    let runner = Runner::new(SweepStudy::read(study)?)?;
    let shards = runner.shards();
    let share = |part: ExperimentPart| {
        let own: Vec<u64> = (0..shards.count()).filter(|&n| part.holds(runner.place_of_shard(n))).collect();
        Share { part: part.to_string(), shards: own.len() as u64, trials: shards.trials_in(&own) }
    };
    Ok(Division {
        title: runner.study().title.clone(),
        shards: shards.count(),
        trials: runner.study().all_trials(),
        inputs: runner.study().inputs.clone(),
        files: runner.study().files.clone(),
        parts: ExperimentPart::all(parts).map(share).collect(),
    })
}

/// A study and its folder, in use by this run alone.
pub struct Work {
    runner: Runner,
    journal: Journal,
}

/// What is still to do.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Todo {
    /// Shards to be computed, in order.
    pub pending: Vec<u64>,
    /// Trials that are wanted, those done before among them.
    pub trials: u64,
    /// Trials of the pending shards.
    pub pending_trials: u64,
    /// Records of the whole journal that were cut or changed.
    pub damaged: u64,
}

impl Work {
    /// Reads the study and opens its folder, which is made.
    ///
    /// # Errors
    /// As [`SweepStudy::read`], [`Runner::new`], [`Journal::open`].
    pub fn open(study: &Path, folder: &Path) -> Result<Self, StudyError> {
        let runner = Runner::new(SweepStudy::read(study)?)?;
        let journal = Journal::open(folder, runner.identity(), runner.shards())?;
        Ok(Self { runner, journal })
    }

    /// What of a part, or of the whole, is still to do now; where cells stop when they are decided, more may follow from it.
    ///
    /// # Errors
    /// [`ExperimentError::Read`].
    pub fn todo(&self, part: Option<ExperimentPart>) -> Result<Todo, ExperimentError> {
        let wanted = |n: &u64| part.is_none_or(|part| part.holds(self.runner.place_of_shard(*n)));
        let state = self.journal.state()?;
        let (all, open) = match self.study().until {
            None => ((0..self.shards().count()).collect(), state.pending),
            Some(until) => {
                let now = precision::progressed(&self.runner, &self.journal, until)?;
                (now.counted, now.pending)
            }
        };
        let own: Vec<u64> = all.into_iter().filter(wanted).collect();
        let pending: Vec<u64> = open.into_iter().filter(wanted).collect();
        let [all, left] = [&own, &pending].map(|shards| self.shards().trials_in(shards));
        Ok(Todo { pending, trials: all, pending_trials: left, damaged: state.damaged })
    }

    /// Computes everything of a part, or of the whole; `next` hears of every round.
    ///
    /// # Errors
    /// As [`harness::compute`].
    pub fn finish(
        &self,
        part: Option<ExperimentPart>,
        progress: &dyn Progress,
        next: &dyn Fn(&Todo),
    ) -> Result<(), ExperimentError> {
        loop {
            let todo = self.todo(part)?;
            next(&todo);
            if todo.pending.is_empty() {
                return Ok(());
            }
            self.compute(&todo.pending, progress)?;
        }
    }

    /// Computes shards and keeps each.
    ///
    /// # Errors
    /// As [`harness::compute`].
    pub fn compute(&self, shards: &[u64], progress: &dyn Progress) -> Result<(), ExperimentError> {
        harness::compute(&self.journal, &self.runner, shards, progress)
    }

    /// Refuses a journal in which shards are missing.
    ///
    /// # Errors
    /// [`ExperimentError::Incomplete`], [`ExperimentError::Read`].
    pub fn require_complete(&self) -> Result<(), ExperimentError> {
        harness::refuse_pending(&self.todo(None)?.pending, self.shards())
    }

    /// Writes both tables; `done` hears of each shard.
    ///
    /// # Errors
    /// As [`results::write`].
    pub fn write_tables(&self, done: &dyn Fn()) -> Result<Vec<CellStatistics>, ExperimentError> {
        results::write(&self.runner, &self.journal, done)
    }

    /// The study.
    pub fn study(&self) -> &SweepStudy {
        self.runner.study()
    }

    /// How the whole is divided.
    pub fn shards(&self) -> Shards {
        self.runner.shards()
    }

    /// What is done, for records and folders from elsewhere.
    pub fn journal(&self) -> &Journal {
        &self.journal
    }

    /// Folder of the results.
    pub fn folder(&self) -> &Path {
        self.journal.folder()
    }

    /// Files and folders of the results.
    pub fn written(&self) -> Vec<PathBuf> {
        ["study.md", page::HTML, results::CELLS, results::TRIALS, "charts"]
            .map(|name| self.folder().join(name))
            .into()
    }
}
