//! Experiments shared among processes and machines: single parts, merged parts, and single shards for a cluster.
//!
//! The arguments of a command determine its trials, so every process with the same arguments knows all of them. `--shard I/N`
//! computes a part into the folder of `--journal`; `--parts` merges such folders; [`SharedExperiment`] gives access to single
//! shards.

mod experiment;

use std::path::{Path, PathBuf};

pub use experiment::SharedExperiment;
use hexbench_experiments::harness::{Protocol, Sharded, compute_part, sharded, take_over};
use hexbench_experiments::journal::Adopted;

use crate::commands::Command;
use crate::commands::validate::Study;
use crate::failure::Failure;
use crate::output::{Progress, Screen, TrialFiles, report};

/// A command that runs experiments.
pub(crate) trait TrialCommand {
    /// What becomes of the trials.
    fn kept(&self) -> &TrialFiles;

    /// Files and folders that the trials depend on.
    fn files(&mut self) -> Vec<&mut PathBuf> {
        Vec::new()
    }

    /// Its experiments.
    fn works(&self) -> Result<Vec<NamedWork>, Failure>;
}

/// What a command shares of its one experiment: the trials that its arguments determine, and what becomes of them, `kept`.
macro_rules! sole_experiment {
    ($protocol:expr) => {
        impl $crate::shared::TrialCommand for Arguments {
            fn kept(&self) -> &TrialFiles {
                &self.kept
            }

            fn works(&self) -> Result<Vec<$crate::shared::NamedWork>, Failure> {
                Ok($crate::shared::NamedWork::only($protocol(self)))
            }
        }
    };
}
pub(crate) use sole_experiment;

/// An experiment of a command.
pub struct NamedWork {
    /// Name of its journal within the folder of the command's journals; none where the command has one experiment.
    pub name: Option<String>,
    /// Its trials.
    pub work: Box<dyn Sharded + Send>,
}

impl NamedWork {
    /// The experiment of a command that has one.
    pub(crate) fn only<P: Protocol + Send + 'static>(protocol: P) -> Vec<Self> {
        vec![Self { name: None, work: sharded(protocol) }]
    }

    /// One of several.
    pub(crate) fn named<P: Protocol + Send + 'static>(name: &str, protocol: P) -> Self {
        Self { name: Some(name.to_owned()), work: sharded(protocol) }
    }

    /// What becomes of its trials, of what becomes of those of the command.
    fn kept(&self, all: &TrialFiles) -> TrialFiles {
        self.name.as_ref().map_or_else(|| all.clone(), |name| all.of_one(name))
    }
}

/// The experiments of a command; none for a command that runs none.
pub(crate) fn experiments_of(command: &mut Command) -> Option<&mut dyn TrialCommand> {
    match command {
        Command::Power(arguments) => Some(arguments),
        Command::Regress(arguments) => Some(arguments),
        Command::Validate(arguments) => Some(match &mut arguments.study {
            Study::Recovery(arguments) => arguments,
            Study::Paper(arguments) => arguments,
            Study::Interactions(arguments) => arguments,
            Study::Calibration(arguments) => arguments,
            Study::Robustness(arguments) => arguments,
            Study::Misread(arguments) => arguments,
            Study::Sensors(arguments) => arguments,
            Study::Discover(arguments) => arguments,
            Study::Discriminate(arguments) => arguments,
            Study::Power(arguments) => arguments,
            Study::Regress(arguments) => arguments,
        }),
        _ => None,
    }
}

/// Does what a command that shares its trials asks for before it runs; true when that is all.
pub(crate) fn begin(command: &mut Command, screen: &Screen) -> Result<bool, Failure> {
    let Some(command) = experiments_of(command) else { return Ok(false) };
    let kept = command.kept();
    if kept.shard().is_none() && kept.parts().is_empty() {
        return Ok(false);
    }
    for one in command.works()? {
        let own = one.kept(kept);
        let Some(folder) = own.journal() else { continue };
        match own.shard() {
            Some(part) => {
                let progress = Progress::of(0, "trials");
                compute_part(&*one.work, folder, Some(part), &progress)?;
                progress.done();
            }
            None => adopt(&*one.work, folder, own.parts())?,
        }
    }
    let (Some(part), Some(folder)) = (kept.shard(), kept.journal()) else { return Ok(false) };
    screen.tell(&format!(
        "Part {part} is done, in {}. The same command with --parts in place of --shard puts the parts together.\n",
        folder.display()
    ))?;
    Ok(true)
}

fn adopt(work: &dyn Sharded, folder: &Path, parts: &[PathBuf]) -> Result<(), Failure> {
    let took =
        |part: &Path, from| warn_of_damaged(part, from, "The command of this part computes them again.");
    Ok(take_over(work, folder, parts, &took)?)
}

/// Says on standard error that records of a part are damaged, and what computes them.
pub(crate) fn warn_of_damaged(part: &Path, from: Adopted, next: &str) {
    if from.damaged > 0 {
        let what = format!("{}: {} records are damaged and were left out", part.display(), from.damaged);
        report::warn(&what, next);
    }
}
