//! A study as read from its file.

use std::collections::BTreeMap;

use hexbench_design::Budget;

use crate::sweep::axes::Axes;
use crate::sweep::question::Question;

/// What happens in a trial.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SweepTask {
    /// Six stiffnesses are fitted and compared with the truth.
    Springs,
    /// The diagnosis is asked what is hidden.
    Diagnose,
}

hexbench_core::worded! {
    /// Name in the study file.
    SweepTask::name {
        Springs => "springs",
        Diagnose => "diagnose",
    }
}

impl SweepTask {
    /// Trials of a shard: some tenths of a second of work, so that little is lost when a run is killed.
    pub fn trials_of_a_shard(self) -> u64 {
        match self {
            Self::Springs => 1024,
            Self::Diagnose => 16,
        }
    }
}

/// A study, checked.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepStudy {
    /// One line.
    pub title: String,
    /// Decides everything that is drawn.
    pub seed: u64,
    /// Trials of each cell.
    pub trials: u64,
    /// What happens in a trial.
    pub task: SweepTask,
    /// Trials with the same machine, random poses, surroundings and effect.
    pub redraw: u64,
    /// Starts of the search for designed poses.
    pub starts: u64,
    /// Indices of every plan are computed.
    pub indices: bool,
    /// What is to be answered.
    pub question: Option<Question>,
    /// Half width of the bounds at which a cell stops before all its trials.
    pub until: Option<f64>,
    /// What the parts of a plan cost.
    pub cost: Option<Budget>,
    /// What is varied.
    pub axes: Axes,
    /// SHA-256 of the study file and of every file it names, under their names in the study.
    pub inputs: BTreeMap<String, String>,
    /// Every file it was read from beside the study file itself, relative to its folder.
    pub files: Vec<String>,
}

/// Name of the study file itself among the inputs.
pub const STUDY_FILE: &str = "study";

impl SweepStudy {
    /// Trials of all cells.
    pub fn all_trials(&self) -> u64 {
        self.trials * self.axes.cells() as u64
    }

    /// True when the question is about a share of trials.
    pub fn asks_share(&self) -> bool {
        matches!(self.question, Some(Question::Share(..)))
    }

    /// SHA-256 of the study file.
    pub fn hash(&self) -> &str {
        self.inputs.get(STUDY_FILE).map_or("", String::as_str)
    }

    /// Cell and number within it of a trial of the whole study.
    pub fn place(&self, trial: u64) -> (usize, u64) {
        // At most the number of cells, which is a usize.
        let cell = usize::try_from(trial / self.trials).unwrap_or(usize::MAX);
        (cell, trial % self.trials)
    }
}
