//! The names of the columns of a table of points: one point in a row, or all points of a group.

use super::column_name::without_brackets;
use super::error::Fault;
use super::line::Line;
use super::points::PointTable;
use super::stated_unit::stated_unit;
use super::units::Unit;
use super::{Dimension, FileProblem};

/// Which cells hold what.
pub(super) struct PointHeader {
    /// What groups, points and axes are called here.
    pub(super) words: [&'static str; 5],
    /// Names as the file spells them.
    pub(super) names: Vec<String>,
    pub(super) group: usize,
    /// The cell with the name of the point, where a row holds one.
    pub(super) name: usize,
    /// The points of a row.
    pub(super) spots: Vec<Spot>,
}

/// The coordinates of one point in a row.
#[derive(Clone)]
pub(super) struct Spot {
    /// Its name, where the names of the columns say it.
    pub(super) ball: Option<String>,
    pub(super) cells: [usize; 3],
    pub(super) units: [&'static Unit; 3],
    /// True where a point may not have been touched.
    pub(super) may_be_empty: bool,
}

impl PointHeader {
    /// Reads the names of the columns.
    ///
    /// # Errors
    /// A column that is missing, given twice, or states no unit of length.
    pub(super) fn of(line: &Line<'_>, table: PointTable<'_>) -> Result<Self, Fault> {
        let names = (0..line.len()).map(|cell| line.text(cell).to_owned()).collect();
        let words = table.names;
        let found = columns(line, table)?;
        if found[1].is_none() {
            let spots = spots_by_name(line, table)?;
            if let (false, Some((group, _))) = (spots.is_empty(), found[0]) {
                return Ok(Self { words, names, group, name: group, spots });
            }
        }
        let missing: Vec<String> =
            found.iter().zip(table.usual).filter(|(f, _)| f.is_none()).map(|(_, name)| name.into()).collect();
        let [Some((group, _)), Some((name, _)), Some(x), Some(y), Some(z)] = found else {
            return Err(Fault::new(line.whole_place(), FileProblem::MissingColumns { names: missing }));
        };
        let spot = Spot {
            ball: None,
            cells: [x, y, z].map(|(cell, _)| cell),
            units: [x, y, z].map(|(_, unit)| unit),
            may_be_empty: false,
        };
        Ok(Self { words, names, group, name, spots: vec![spot] })
    }

    /// The unit of a cell with a coordinate.
    pub(super) fn unit(&self, cell: usize) -> Option<&'static Unit> {
        let of = |spot: &Spot| spot.cells.iter().position(|own| *own == cell).map(|axis| spot.units[axis]);
        self.spots.iter().find_map(of)
    }
}

/// Cell and unit of each of the five columns, and of three axes.
type Found = [Option<(usize, &'static Unit)>; 5];
type Axes = [Option<(usize, &'static Unit)>; 3];

/// The cells of the five columns, as far as they are there.
fn columns(line: &Line<'_>, table: PointTable<'_>) -> Result<Found, Fault> {
    let mut found: Found = [None; 5];
    for cell in 0..line.len() {
        let Some((column, unit)) = column(line, cell, table)? else { continue };
        if found[column].replace((cell, unit)).is_some() {
            let rule = format!("{} is given twice", table.names[column]);
            let place = line.place(cell).with_name(line.text(cell));
            return Err(Fault::rule(place, rule, "Keep one of the two columns."));
        }
    }
    Ok(found)
}

/// Which column a header cell names, and its unit; none for a column that is not read.
fn column(
    line: &Line<'_>,
    cell: usize,
    table: PointTable<'_>,
) -> Result<Option<(usize, &'static Unit)>, Fault> {
    let text = table.called.map_or(line.text(cell), |names| names.here(line.text(cell)));
    let (base, bracketed) = without_brackets(text);
    let base = base.trim().replace([' ', '-', '\u{a0}'], "_").to_lowercase();
    let (name, unit) = match base.split_once('_') {
        Some((name, unit)) if bracketed.is_none() => (name.to_owned(), Some(unit.to_owned())),
        _ => (base, bracketed.map(str::to_owned)),
    };
    let Some(column) = table.names.iter().position(|known| *known == name) else { return Ok(None) };
    let kind = if column < 2 { Dimension::Number } else { Dimension::Length };
    let unit = unit_or_given(table, table.names[column], kind, table.usual[column], unit.as_deref());
    unit.map(|unit| Some((column, unit)))
        .map_err(|problem| Fault::new(line.place(cell).with_name(text), problem))
}

fn unit_or_given(
    table: PointTable<'_>,
    quantity: &str,
    kind: Dimension,
    usual: &str,
    stated: Option<&str>,
) -> Result<&'static Unit, FileProblem> {
    match table.unit {
        Some(given) if kind == Dimension::Length && stated.is_none_or(|text| text.trim().is_empty()) => {
            Ok(given)
        }
        _ => stated_unit(quantity, kind, usual.into(), stated),
    }
}

/// Points whose names stand before the axis: `P1_x_mm`, `P1 X [mm]`.
fn spots_by_name(line: &Line<'_>, table: PointTable<'_>) -> Result<Vec<Spot>, Fault> {
    let mut found: Vec<(String, Axes)> = Vec::new();
    for cell in 0..line.len() {
        let text = line.text(cell);
        let Some((ball, axis, stated)) = named_axis(text) else { continue };
        let usual = format!("{ball}_{}_mm", table.names[2 + axis]);
        let unit = unit_or_given(table, text, Dimension::Length, &usual, stated)
            .map_err(|problem| Fault::new(line.place(cell).with_name(text), problem))?;
        let number = found.iter().position(|(other, _)| *other == ball).unwrap_or_else(|| {
            found.push((ball.clone(), [None; 3]));
            found.len() - 1
        });
        if found[number].1[axis].replace((cell, unit)).is_some() {
            let place = line.place(cell).with_name(text);
            return Err(Fault::rule(place, format!("{text} is given twice"), "Keep one of the two columns."));
        }
    }
    let spot = |(ball, axes): (String, Axes)| {
        let missing = (0..3).filter(|axis| axes[*axis].is_none());
        let names: Vec<String> = missing.map(|axis| format!("{ball}_{}_mm", table.names[2 + axis])).collect();
        let [Some(x), Some(y), Some(z)] = axes else {
            return Err(Fault::new(line.whole_place(), FileProblem::MissingColumns { names }));
        };
        let cells = [x, y, z].map(|(cell, _)| cell);
        Ok(Spot { ball: Some(ball), cells, units: [x, y, z].map(|(_, unit)| unit), may_be_empty: true })
    };
    found.into_iter().map(spot).collect()
}

/// The point, the axis and the unit of `P1_x_mm`.
fn named_axis(text: &str) -> Option<(String, usize, Option<&str>)> {
    const PARTS: [char; 5] = ['_', ' ', '-', '.', '\u{a0}'];
    let axis_of = |word: &str| ["x", "y", "z"].iter().position(|axis| word.eq_ignore_ascii_case(axis));
    let (base, bracketed) = without_brackets(text);
    let (before, last) = base.trim().rsplit_once(PARTS)?;
    if let Some(axis) = axis_of(last) {
        return Some((before.trim_end_matches(PARTS).to_owned(), axis, bracketed));
    }
    let (ball, axis) = before.rsplit_once(PARTS)?;
    let axis = axis_of(axis).filter(|_| bracketed.is_none() && !ball.is_empty())?;
    Some((ball.trim_end_matches(PARTS).to_owned(), axis, Some(last)))
}
