//! Why a study stopped.

use hexbench_core::files::FileError;
use hexbench_design::DesignError;
use hexbench_report::plot::PlotError;
use hexbench_report::render::PageError;

use crate::error::ExperimentError;

/// A study that cannot go on. What is in the journal stays there.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The study file, or a file it names, cannot be used.
    #[error(transparent)]
    File(#[from] FileError),
    /// A designed plan without an answer.
    #[error("plan \"{plan}\" with {poses} poses on geometry \"{geometry}\": {cause}")]
    Design {
        /// Name of the plan.
        plan: String,
        /// Poses asked for.
        poses: u64,
        /// Name of the geometry.
        geometry: String,
        /// What stands in the way.
        cause: DesignError,
    },
    /// The folder or its journal is of no use.
    #[error(transparent)]
    Experiment(#[from] ExperimentError),
    /// A chart cannot be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// The page for a browser cannot be laid out.
    #[error(transparent)]
    Page(#[from] PageError),
}

impl StudyError {
    /// What to do next, one sentence.
    pub fn next_step(&self) -> String {
        match self {
            Self::File(error) => error.next_step(),
            Self::Design { .. } => "Widen the space, or change the numbers of poses.".into(),
            Self::Experiment(error) => error.next_step(),
            Self::Plot(_) => "Use more trials.".into(),
            Self::Page(_) => "Please report this error of hexbench. All other files were written.".into(),
        }
    }
}
