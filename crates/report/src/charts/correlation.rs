//! Which estimates of the final model depend on each other.

use hexbench_model::estimation::parameters::{Parameter, ParameterPlace};

use super::ReportError;
use crate::page::{Block, Figure, Section};
use crate::plot::HeatMap;
use crate::words::ReportSubject;

/// Columns of a correlation map that can be read.
const MOST_COLUMNS: usize = 24;

/// Correlation of the estimates of the final model.
pub(super) fn section(subject: &ReportSubject<'_>) -> Result<Option<Section>, ReportError> {
    let Some(fit) = subject.study.fits.last() else { return Ok(None) };
    let shown = |(k, p): &(usize, &Parameter)| {
        matches!(p.place, ParameterPlace::Spring(_) | ParameterPlace::Value { .. }) && fit.is_determined(*k)
    };
    let columns: Vec<(String, usize)> =
        fit.parameters.iter().enumerate().filter(shown).map(|(k, p)| (p.name.clone(), k)).collect();
    if columns.len() < 2 || columns.len() > MOST_COLUMNS {
        return Ok(None);
    }
    let names: Vec<String> = columns.iter().map(|c| c.0.clone()).collect();
    let cell = |a: usize, b: usize| fit.covariance[(a, b)] / (fit.std(a) * fit.std(b)).max(f64::MIN_POSITIVE);
    let rows = columns.iter().map(|a| columns.iter().map(|b| cell(a.1, b.1).abs()).collect()).collect();
    let map =
        HeatMap::new("", names.clone(), names, rows).with_decimals(2).with_full_shade_at(1.0).as_triangle();
    let caption =
        "Absolute correlation of the estimates; near 1, the data determine only a combination of the two.";
    let figure = Figure::laid_out(map.laid_out()?, caption);
    Ok(Some(Section::new("Correlation").id("correlation").with(Block::Figure(figure))))
}
