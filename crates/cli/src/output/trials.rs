//! The trials of an experiment: watched, kept in a journal, written as a table.

use std::path::{Path, PathBuf};

use clap::Args;
use hexbench_experiments::harness::{self, ExperimentPart, Gathered, Protocol, Study};
use hexbench_report::table::Frame;

use super::{Progress, TableFile};
use crate::failure::Failure;

/// What becomes of the trials.
#[derive(Debug, Clone, Args)]
pub(crate) struct TrialFiles {
    /// Save every finished trial in DIR; after an interruption, the same command resumes the run and gives the same bytes
    #[arg(long, value_name = "DIR")]
    journal: Option<PathBuf>,
    /// Write one row per trial to FILE (.parquet or .csv)
    #[arg(long, value_name = "FILE")]
    table: Option<TableFile>,
    /// Compute only one part (2/8 is the second of eight) and save it in the folder of --journal; nothing else is written
    #[arg(long, value_name = "I/N", requires = "journal", conflicts_with = "table")]
    shard: Option<ExperimentPart>,
    /// Folders with the saved parts: if all are there, nothing is computed again, and the results are those of a single
    /// run
    #[arg(long, value_name = "DIR", num_args = 1.., requires = "journal", conflicts_with = "shard")]
    parts: Vec<PathBuf>,
}

impl TrialFiles {
    /// Run the trials that are missing, and write the table.
    pub(crate) fn run<P: Protocol>(&self, protocol: &P) -> Result<Gathered<P::Record>, Failure> {
        let gathered = self.gathered(protocol)?;
        if let Some(table) = &self.table {
            table.write_as_it_is(&harness::table(protocol, &gathered))?;
        }
        Ok(gathered)
    }

    /// The same as a study, with the table of its trials.
    pub(crate) fn study_and_table<P: Protocol>(&self, protocol: P) -> Result<(Study<P>, Frame), Failure> {
        let gathered = self.gathered(&protocol)?;
        let trials = harness::table(&protocol, &gathered);
        if let Some(table) = &self.table {
            table.write_as_it_is(&trials)?;
        }
        Ok((Study::of(protocol, gathered), trials))
    }

    fn gathered<P: Protocol>(&self, protocol: &P) -> Result<Gathered<P::Record>, Failure> {
        let progress = Progress::of(0, "trials");
        let gathered = harness::run(protocol, self.journal.as_deref(), &progress)?;
        progress.done();
        Ok(gathered)
    }

    /// The same for one of several experiments of a command: its journal and its table have its name.
    pub(crate) fn of_one(&self, name: &str) -> Self {
        Self {
            journal: self.journal.as_ref().map(|folder| folder.join(name)),
            table: self.table.as_ref().map(|table| table.of_one(name)),
            shard: self.shard,
            parts: self.parts.iter().map(|folder| folder.join(name)).collect(),
        }
    }

    /// Folder in which the trials are kept.
    pub(crate) fn journal(&self) -> Option<&Path> {
        self.journal.as_deref()
    }

    /// The part that alone is wanted.
    pub(crate) fn shard(&self) -> Option<ExperimentPart> {
        self.shard
    }

    /// Folders of parts to be taken over.
    pub(crate) fn parts(&self) -> &[PathBuf] {
        &self.parts
    }
}
