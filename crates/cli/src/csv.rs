//! Tables the command writes: the columns of a conditions file, then results.

use hexbench_core::files::{CsvText, MeasurementsWriter};
use hexbench_core::{Dataset, Hexapod, Matrix6, Observation, pairs_of_six};
use hexbench_report::number::fixed;

/// Unit of a result column.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Unit {
    Mm,
    Um,
    Deg,
    Urad,
}

impl Unit {
    fn name(self) -> &'static str {
        match self {
            Self::Mm => "mm",
            Self::Um => "um",
            Self::Deg => "deg",
            Self::Urad => "urad",
        }
    }

    fn named(name: &str) -> Option<Self> {
        [Self::Mm, Self::Um, Self::Deg, Self::Urad].into_iter().find(|unit| unit.name() == name)
    }

    fn text(self, si: f64) -> String {
        self.decimals(match self {
            Self::Mm => si * 1e3,
            Self::Deg => si.to_degrees(),
            Self::Um | Self::Urad => si * 1e6,
        })
    }

    /// Decimals reach a picometer and a picoradian, so that rounding never shows.
    fn decimals(self, value: f64) -> String {
        match self {
            Self::Mm => fixed(value, 9),
            Self::Deg => fixed(value, 11),
            Self::Um | Self::Urad => fixed(value, 6),
        }
    }
}

/// A conditions file of a machine.
pub(crate) fn conditions(rows: &Dataset, machine: &Hexapod) -> String {
    let rows = &*machine.angles.as_stated(rows);
    let columns = condition_columns(rows);
    let mut text = CsvText::new(columns.names());
    rows.observations.iter().for_each(|row| text.row(condition(&columns, row)));
    text.into_text()
}

/// Columns that say what a row is about.
pub(crate) fn condition_columns(rows: &Dataset) -> MeasurementsWriter {
    MeasurementsWriter::conditions(rows.columns)
}

/// One row of them, whose angles are [stated](hexbench_core::AngleConvention::as_stated).
pub(crate) fn condition(columns: &MeasurementsWriter, row: &Observation) -> Vec<String> {
    let cells = columns.values(row);
    cells
        .map(|(value, unit)| Unit::named(unit).map_or_else(|| value.to_string(), |unit| unit.decimals(value)))
        .collect()
}

/// Names of six results: three translations, three rotations.
pub(crate) fn names(prefix: &str, names: &[&str; 6], units: [Unit; 2]) -> Vec<String> {
    names.iter().enumerate().map(|(k, name)| format!("{prefix}{name}_{}", units[k / 3].name())).collect()
}

/// Six results: three translations (m), three rotations (rad).
pub(crate) fn values(si: &[f64; 6], units: [Unit; 2]) -> Vec<String> {
    si.iter().enumerate().map(|(k, value)| units[k / 3].text(*value)).collect()
}

/// Any results in um (m) or urad (rad).
pub(crate) fn micro(si: impl IntoIterator<Item = f64>) -> impl Iterator<Item = String> {
    si.into_iter().map(|value| Unit::Um.text(value))
}

/// Columns of the correlations of six numbers, `x_corr_FIRST_SECOND`.
pub(crate) fn correlation_names(numbers: &[&str; 6]) -> Vec<String> {
    pairs_of_six().map(|(i, j)| format!("x_corr_{}_{}", numbers[i], numbers[j])).collect()
}

/// The correlations of six numbers; zero where one of them has no variance.
pub(crate) fn correlations(covariance: &Matrix6) -> Vec<String> {
    let correlation = |(i, j): (usize, usize)| {
        let scale = (covariance[(i, i)] * covariance[(j, j)]).sqrt();
        format!("{:.6}", if scale > 0.0 { covariance[(i, j)] / scale } else { 0.0 })
    };
    pairs_of_six().map(correlation).collect()
}
