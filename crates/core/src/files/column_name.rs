//! Reading one name of a table's header: which quantity, in which unit.

use super::columns::{COLUMNS, Column};
use super::nearest::nearest;
use super::other_names::stands_for;
use super::stated_unit::stated_unit;
use super::units::{Unit, unit_named};
use super::{Dimension, FileProblem};

/// What a header cell turns out to be.
#[derive(Debug)]
pub(crate) enum Named {
    /// A known quantity in a known unit.
    Known(&'static Column, &'static Unit),
    /// Named so as to be ignored (`x_...`, `note...`, `comment...`).
    Private,
    /// Far from every known name.
    Unknown,
}

/// Reads `fz_N`, `fz [N]`, `fz (N)`, `Fz N`.
pub(crate) fn read_column_name(text: &str) -> Result<Named, FileProblem> {
    let (base, bracketed) = without_brackets(text.trim());
    let base = base.trim().replace([' ', '-', '\u{a0}'], "_");
    let lower = base.to_lowercase();
    if base.is_empty() {
        return Err(FileProblem::NamelessColumn);
    }
    if is_private(&lower) {
        return Ok(Named::Private);
    }
    if let Some(column) = column_named(&lower) {
        return with_unit(column, bracketed);
    }
    match split_at_unit(&base) {
        Some((column, unit)) if bracketed.is_none() => with_unit(column, Some(unit)),
        _ if stands_for(text, |_| true).is_some() => Ok(Named::Unknown),
        _ => misspelled(&base, bracketed),
    }
}

/// `x_um` names a coordinate: what follows an x that marks a column has a name of its own.
fn is_private(lower: &str) -> bool {
    let is_length =
        |text| unit_named(text, Dimension::Length).is_some_and(|unit| unit.kind == Dimension::Length);
    lower.strip_prefix("x_").is_some_and(|rest| !is_length(rest))
        || ["note", "comment"].iter().any(|beginning| lower.starts_with(beginning))
}

/// `da [um]`, `da / um` and `da in um` into `da ` and `um`.
pub(crate) fn without_brackets(text: &str) -> (&str, Option<&str>) {
    let inside = |open: char, close: char| {
        let (base, rest) = text.split_once(open)?;
        Some((base, rest.strip_suffix(close)?))
    };
    // ISO 80000-1 heads a column with quantity / unit.
    let quotient =
        || text.split_once('/').filter(|(base, unit)| !base.trim().is_empty() && !unit.trim().is_empty());
    let found = inside('[', ']').or_else(|| inside('(', ')'));
    match found.or_else(|| text.split_once(" in ")).or_else(quotient) {
        Some((base, unit)) => (base, Some(unit)),
        None => (text, None),
    }
}

fn column_named(lower: &str) -> Option<&'static Column> {
    COLUMNS.iter().find(|column| column.name.eq_ignore_ascii_case(lower))
}

/// The longest known name that `base` continues with `_unit`.
fn split_at_unit(base: &str) -> Option<(&'static Column, &str)> {
    let cuts = base.char_indices().filter(|(_, symbol)| *symbol == '_').map(|(at, _)| at);
    cuts.filter_map(|at| Some((column_named(&base[..at].to_lowercase())?, &base[at + 1..]))).next_back()
}

fn with_unit(column: &'static Column, unit: Option<&str>) -> Result<Named, FileProblem> {
    let unit = stated_unit(column.name, column.kind, column.usual_name(), unit)?;
    Ok(Named::Known(column, unit))
}

/// A slip of the pen is an error: a silently ignored column would be believed to be in use.
fn misspelled(base: &str, bracketed: Option<&str>) -> Result<Named, FileProblem> {
    let names = || COLUMNS.iter().map(|column| column.name);
    let (stem, suffix) = base.rsplit_once('_').map_or((base, None), |(stem, unit)| (stem, Some(unit)));
    let unit = bracketed.or(suffix);
    let near = nearest(stem, names()).or_else(|| nearest(base, names()));
    let Some(column) = near.and_then(|name| column_named(&name.to_lowercase())) else {
        return Ok(Named::Unknown);
    };
    let unit = unit.and_then(|text| unit_named(text, column.kind)).filter(|unit| unit.kind == column.kind);
    let suggestion =
        unit.map_or_else(|| column.usual_name(), |unit| format!("{}_{}", column.name, unit.name));
    Err(FileProblem::MisspeltColumn { suggestion })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn known(text: &str) -> String {
        match read_column_name(text) {
            Ok(Named::Known(column, unit)) => format!("{} {}", column.name, unit.name).trim().to_owned(),
            other => panic!("{text}: {other:?}"),
        }
    }

    #[test]
    fn a_unit_stands_after_an_underscore_a_blank_or_in_brackets() {
        for text in [
            "da_um", "da [um]", "da[um]", "da (µm)", "da um", "DA_UM", "da-um", "da_μm", "da / µm", "da/um",
            "da in um",
        ] {
            assert_eq!(known(text), "da um", "{text}");
        }
    }

    #[test]
    fn names_with_underscores_keep_them() {
        assert_eq!(known("delta_T_K"), "delta_T K");
        assert_eq!(known("delta T [°C]"), "delta_T degC");
        assert_eq!(known("sigma_a_um"), "sigma_a um");
        assert_eq!(known("ref_mx [N·m]"), "ref_mx Nm");
        assert_eq!(known("measured_alpha_deg"), "measured_alpha deg");
        assert_eq!(known("Pose"), "pose");
    }

    #[test]
    fn a_suggestion_keeps_the_unit_of_the_file() {
        let Err(FileProblem::MisspeltColumn { suggestion }) = read_column_name("dapha_mrad") else {
            panic!("a slip of the pen is an error")
        };
        assert_eq!(suggestion, "dalpha_mrad");
    }

    #[test]
    fn other_columns_are_ignored() {
        assert!(matches!(read_column_name("note_1"), Ok(Named::Private)));
        assert!(matches!(read_column_name("x_fz_N"), Ok(Named::Private)));
        assert!(matches!(read_column_name("humidity_%"), Ok(Named::Unknown)));
    }

    #[test]
    fn a_coordinate_called_x_is_no_column_to_be_ignored() {
        for text in ["x_um", "X_mm", "x [um]", "delta_x_um"] {
            assert!(matches!(read_column_name(text), Ok(Named::Unknown)), "{text}");
        }
        assert!(matches!(read_column_name("x_x_um"), Ok(Named::Private)));
    }
}
