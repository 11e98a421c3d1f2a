//! Lists of points without names of columns: `GROUP POINT X Y Z` or `COLLECTION GROUP POINT X Y Z` as `SpatialAnalyzer` exports them, the
//! group being the record; or `NAME X Y Z` with names `RECORD_BALL`. Blanks, tabs, commas or semicolons between, `//` before comments. No
//! unit is stated: it has to be given.
//!
//! Source: New River Kinematics, `SpatialAnalyzer` user manual, "Exporting ASCII Formatted Points" and "Importing Predefined ASCII Formatted
//! Files", <https://kinematics.com/ftp/SA/Install/Driver%20Downloads/Misc/Testing/SAUsersManual.zip>; built from this description, no export
//! was at hand.

use super::super::error::Fault;
use super::super::lines::RawLine;
use super::super::number::{parse_number, usable_si};
use super::super::units::Unit;
use super::super::{FilePlace, FileProblem};
use super::{Layout, LayoutReader, Touched, record_and_ball};
use crate::Vector3;

pub(super) const LAYOUT: Layout = Layout {
    name: "a list of points without names of columns, as SpatialAnalyzer exports",
    recognizes,
    reader: |unit| Box::new(PointList { given: unit, fields: None }),
};

const COMMENT: &str = "//";

/// Every line is names and three numbers, some of the names are no numbers, and all lines are of one length.
fn recognizes(first: &[String]) -> bool {
    let rows: Vec<Vec<&str>> =
        first.iter().filter(|line| !line.starts_with(COMMENT)).map(|line| fields(line)).collect();
    let Some(count) = rows.first().map(Vec::len) else { return false };
    let is_number = |text: &&str| parse_number(text).is_ok();
    let is_point = |row: &Vec<&str>| row.len() >= 3 && row[row.len() - 3..].iter().all(is_number);
    let is_named = |row: &Vec<&str>| !row[..row.len().saturating_sub(3)].iter().all(is_number);
    (4..=6).contains(&count)
        && rows.iter().all(|row| row.len() == count && is_point(row))
        && rows.iter().any(is_named)
}

/// Cells between commas, semicolons, tabs or blanks, whichever comes first in this order.
fn fields(line: &str) -> Vec<&str> {
    let bare = |text: &'_ str| -> std::ops::Range<usize> {
        let start = text.len() - text.trim_start_matches([' ', '"']).len();
        start..start + text[start..].trim_end_matches([' ', '"']).len()
    };
    let separator = [';', '\t', ','].into_iter().find(|separator| line.contains(*separator));
    match separator {
        Some(separator) => line.split(separator).map(|text| &text[bare(text)]).collect(),
        None => line.split_whitespace().collect(),
    }
}

struct PointList {
    given: Option<&'static Unit>,
    /// Fields of the first line.
    fields: Option<usize>,
}

impl LayoutReader for PointList {
    fn line(&mut self, raw: &RawLine<'_>) -> Result<Vec<Touched>, Fault> {
        if raw.text.starts_with(COMMENT) || raw.text.starts_with('#') {
            return Ok(Vec::new());
        }
        let place = || FilePlace { line: Some(raw.number), ..FilePlace::file() };
        let unit = self.given.ok_or_else(|| Fault::new(FilePlace::file(), super::no_unit()))?;
        let fields = fields(raw.text);
        let expected = *self.fields.get_or_insert(fields.len());
        if fields.len() != expected {
            return Err(Fault::rule(
                place(),
                format!("this line has {} fields, the first has {expected}", fields.len()),
                "Export with commas between the fields; names must hold none.",
            ));
        }
        let (names, numbers) = fields.split_at(expected - 3);
        let mut centre = Vector3::zeros();
        for (axis, text) in numbers.iter().enumerate() {
            let read = parse_number(text).and_then(|parsed| {
                if parsed.comma {
                    Err(FileProblem::DecimalComma)
                } else {
                    usable_si(unit.to_si(parsed.value))
                }
            });
            centre[axis] = read.map_err(|problem| Fault::new(place().with_value(text), problem))?;
        }
        let (record, ball) = match names {
            [name] => record_and_ball(name, place())?,
            [group, point] => ((*group).to_owned(), (*point).to_owned()),
            [collection, group, point] => (format!("{collection}::{group}"), (*point).to_owned()),
            _ => return Err(Fault::rule(place(), "this is no point", "Export group, point, x, y and z.")),
        };
        Ok(vec![Touched { record, ball, centre, line: raw.number }])
    }

    fn end(&mut self) -> Result<(), Fault> {
        Ok(())
    }
}
