//! Why a chart cannot be drawn.

use thiserror::Error;

/// Why a chart cannot be drawn.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PlotError {
    /// A number that has no place on an axis.
    #[error("chart \"{chart}\": {what} is {value}; only finite numbers can be drawn")]
    NotFinite {
        /// Title of the chart.
        chart: String,
        /// Which number.
        what: String,
        /// The number.
        value: f64,
    },
    /// A number that has no place on a logarithmic axis.
    #[error("chart \"{chart}\": {what} is {value}; a logarithmic axis shows positive numbers only")]
    NotPositive {
        /// Title of the chart.
        chart: String,
        /// Which number.
        what: String,
        /// The number.
        value: f64,
    },
    /// Nothing to draw.
    #[error("chart \"{chart}\" has nothing to draw")]
    Empty {
        /// Title of the chart.
        chart: String,
    },
    /// Lists that belong together differ in length.
    #[error("chart \"{chart}\": {what} has {found} entries instead of {expected}")]
    Length {
        /// Title of the chart.
        chart: String,
        /// Which list.
        what: String,
        /// Its length.
        found: usize,
        /// The length it should have.
        expected: usize,
    },
    /// The drawing itself failed.
    #[error("the drawing failed: {0}")]
    Drawing(#[from] std::fmt::Error),
}

/// First number of a list that is not finite, as an error.
pub(super) fn finite<'a>(
    chart: &str,
    what: &str,
    values: impl IntoIterator<Item = &'a f64>,
) -> Result<(), PlotError> {
    match values.into_iter().enumerate().find(|(_, x)| !x.is_finite()) {
        None => Ok(()),
        Some((i, &value)) => Err(PlotError::NotFinite {
            chart: chart.to_owned(),
            what: format!("number {} of {what}", i + 1),
            value,
        }),
    }
}

/// First number of a list that is not above zero, as an error.
pub(super) fn positive<'a>(
    chart: &str,
    what: &str,
    values: impl IntoIterator<Item = &'a f64>,
) -> Result<(), PlotError> {
    match values.into_iter().enumerate().find(|(_, x)| **x <= 0.0) {
        None => Ok(()),
        Some((i, &value)) => Err(PlotError::NotPositive {
            chart: chart.to_owned(),
            what: format!("number {} of {what}", i + 1),
            value,
        }),
    }
}

/// A list of another length than expected, as an error.
pub(super) fn length(chart: &str, what: &str, found: usize, expected: usize) -> Result<(), PlotError> {
    if found == expected {
        return Ok(());
    }
    Err(PlotError::Length { chart: chart.to_owned(), what: what.to_owned(), found, expected })
}

/// A chart without content, as an error.
pub(super) fn not_empty(chart: &str, entries: usize) -> Result<(), PlotError> {
    if entries == 0 { Err(PlotError::Empty { chart: chart.to_owned() }) } else { Ok(()) }
}
