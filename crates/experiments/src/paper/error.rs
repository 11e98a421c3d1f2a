//! Why the study gives no answer.

use hexbench_model::error::ModelError;
use hexbench_truth::TruthError;
use thiserror::Error;

/// Why the study gives no answer.
#[derive(Debug, Error)]
pub enum PaperError {
    /// The experiment could not be simulated.
    #[error("the experiment could not be simulated: {0}")]
    Truth(#[from] TruthError),
    /// The readings could not be explained.
    #[error("the readings could not be explained: {0}")]
    Model(#[from] ModelError),
    /// A repetition under other noise has no answer.
    #[error("{0}")]
    Campaign(String),
    /// No search for poses ended where every leg is within its stroke.
    #[error("none of {starts} searches found three poses within a stroke of {stroke_mm:.1} mm")]
    NoPoses {
        /// Number of searches.
        starts: u32,
        /// Stroke allowed, mm.
        stroke_mm: f64,
    },
    /// A number of the study cannot be drawn.
    #[error("a chart cannot be drawn: {0}")]
    Plot(#[from] hexbench_report::plot::PlotError),
    /// The readings cannot be written as a table.
    #[error("the readings cannot be written: {0}")]
    Table(#[from] std::io::Error),
}
