//! The experiments of a command line, without the command: for those who compute the trials elsewhere.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use super::{NamedWork, experiments_of};
use crate::args::Cli;
use crate::failure::Failure;

/// The experiments of a command line.
pub struct SharedExperiment {
    cli: Cli,
}

impl SharedExperiment {
    /// Of the command with these words, the name of the program not among them.
    ///
    /// # Errors
    /// [`Failure::Usage`] for words that are no command, or one that runs no experiment.
    pub fn of(words: impl IntoIterator<Item = OsString>) -> Result<Self, Failure> {
        let (_, cli) = crate::understood(words)?;
        let mut all = Self { cli };
        match experiments_of(&mut all.cli.command) {
            Some(_) => Ok(all),
            None => Err(Failure::usage(
                "this command runs no experiment".to_owned(),
                "Name one with the option --journal, such as `validate robustness`.",
            )),
        }
    }

    /// Files and folders that the trials depend on, as they were typed.
    pub fn files(&mut self) -> Vec<PathBuf> {
        let command = experiments_of(&mut self.cli.command);
        command
            .map(|command| command.files().into_iter().map(|path| path.clone()).collect())
            .unwrap_or_default()
    }

    /// The same with these files in place of the typed ones, in their order.
    #[must_use]
    pub fn with_files(mut self, places: Vec<PathBuf>) -> Self {
        if let Some(command) = experiments_of(&mut self.cli.command) {
            command.files().into_iter().zip(places).for_each(|(path, place)| *path = place);
        }
        self
    }

    /// The experiments.
    ///
    /// # Errors
    /// A file that cannot be used, a plan that cannot be computed.
    pub fn works(&mut self) -> Result<Vec<NamedWork>, Failure> {
        experiments_of(&mut self.cli.command).map_or_else(|| Ok(Vec::new()), |command| command.works())
    }

    /// Folder of the journal of one of them; none without `--journal`.
    pub fn journal(&mut self, of: &NamedWork) -> Option<PathBuf> {
        let command = experiments_of(&mut self.cli.command)?;
        of.kept(command.kept()).journal().map(Path::to_owned)
    }
}
