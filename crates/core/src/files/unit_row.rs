//! The row of units that some programs write below the names of the columns.

use super::error::Fault;
use super::line::Line;
use super::units::{Unit, unit_named};
use super::{Dimension, FileProblem};

/// True for a line of units below the names of the columns, which state the same ones; `stated`: the unit of a cell that has one.
///
/// # Errors
/// A unit that is not that of the name.
pub(crate) fn is_row_of_units(
    line: &Line<'_>,
    names: &[String],
    stated: impl Fn(usize) -> Option<&'static Unit>,
) -> Result<bool, Fault> {
    let bare = |cell: usize| line.text(cell).trim_matches(['[', ']', '(', ')']);
    let is_unit = |cell: usize| {
        let text = bare(cell);
        text.is_empty() || text == "-" || unit_named(text, Dimension::Number).is_some()
    };
    let filled = (0..line.len()).filter(|cell| !bare(*cell).is_empty()).count();
    if filled == 0 || !(0..line.len()).all(is_unit) {
        return Ok(false);
    }
    for (cell, name) in names.iter().enumerate().take(line.len()) {
        let Some(unit) = stated(cell) else { continue };
        if unit_named(bare(cell), unit.kind).is_some_and(|other| other != unit) {
            let place = line.place(cell).with_name(name).with_value(line.text(cell));
            return Err(Fault::new(place, FileProblem::OtherUnit { named: unit.name }));
        }
    }
    Ok(true)
}
