//! Reading balls touched by a measuring machine, and the places where they should be.

use super::column_name::without_brackets;
use super::error::Fault;
use super::line::Line;
use super::lines::{Lines, RawLine};
use super::number::{parse_number, usable};
use super::source::{Noticed, read_source};
use super::stated_unit::stated_unit;
use super::toml_file::{Format, read_toml};
use super::toml_value::{Item, KeyUnit, TomlSection};
use super::units::Unit;
use super::{Dimension, FileError, FilePlace, FileProblem, Warning};
use crate::{BallPlace, BallPlaces, BallRecord, Vector3};
use std::collections::HashMap;
use std::io::BufRead;
use std::path::Path;

/// Columns of a table of named points: the group of a point, its name, its coordinates.
#[derive(Clone, Copy)]
pub(super) struct PointColumns {
    names: [&'static str; 5],
    usual: [&'static str; 5],
    /// What a sheet of a workbook with them is called.
    sheet: &'static str,
}

impl Noticed for Vec<BallRecord> {
    fn warnings(&mut self) -> Option<&mut Vec<Warning>> {
        None
    }
}

impl PointColumns {
    pub(super) const BALLS: Self = Self::of("record", "ball", "balls");
    pub(super) const JOINTS: Self = Self::of("side", "leg", "joints");

    const fn of(group: &'static str, name: &'static str, sheet: &'static str) -> Self {
        Self { names: [group, name, "x", "y", "z"], usual: [group, name, "x_mm", "y_mm", "z_mm"], sheet }
    }
}

const BALLS: Format = Format {
    name: "balls/1",
    keys: &[
        KeyUnit::plain("format"),
        KeyUnit::with_unit("sigma", Dimension::Length, "um"),
        KeyUnit::plain("platform"),
        KeyUnit::plain("base"),
    ],
};
const BALL: &[KeyUnit] = &[KeyUnit::plain("ball"), KeyUnit::with_unit("center", Dimension::Length, "mm")];

/// Reads `balls.csv`: columns `record`, `ball`, `x_mm`, `y_mm`, `z_mm`, others are passed over.
///
/// # Errors
/// The first thing that is wrong, with line, column, value and next step; a ball that is twice in a record, too.
pub fn read_balls(path: &Path) -> Result<Vec<BallRecord>, FileError> {
    read_points(path, PointColumns::BALLS)
}

/// Reads a table of named points, such as balls of records.
pub(super) fn read_points(path: &Path, columns: PointColumns) -> Result<Vec<BallRecord>, FileError> {
    read_source(path, columns.sheet, |input| table(input, columns)).map_err(|fault| fault.in_file(path))
}

/// Reads places of balls, format `balls/1`.
///
/// # Errors
/// The first thing that is wrong, with line, column, value and next step.
pub fn read_ball_places(path: &Path) -> Result<BallPlaces, FileError> {
    read_toml(path, BALLS, |top| {
        let side = |name| top.get(name).map_or(Ok(Vec::new()), places);
        top.require("platform")?;
        let sigma = top.get("sigma").map(|item| item.positive("a standard deviation")).transpose()?;
        Ok(BallPlaces { sigma, platform: side("platform")?, base: side("base")? })
    })
}

fn places(item: &Item<'_>) -> Result<Vec<BallPlace>, Fault> {
    let balls = item.list()?;
    let places = balls.iter().map(|ball| ball.section("[[ball]]", BALL).and_then(|s| place(&s)));
    let places = places.collect::<Result<Vec<_>, _>>()?;
    match (0..places.len()).find(|&k| places[..k].iter().any(|other| other.ball == places[k].ball)) {
        None => Ok(places),
        Some(twice) => Err(balls[twice].fault(twice_in("ball", "this list", &places[twice].ball))),
    }
}

fn place(section: &TomlSection<'_>) -> Result<BallPlace, Fault> {
    let ball = section.require("ball")?.string()?.to_owned();
    let centre = section.require("center")?.numbers::<3>("three coordinates [x, y, z]")?;
    Ok(BallPlace { ball, centre: centre.into() })
}

fn twice_in(name: &str, whole: &str, point: &str) -> FileProblem {
    let others = if name == "ball" { "; give repeated touches records of their own" } else { "" };
    FileProblem::Rule {
        rule: format!("{name} {point} is twice in {whole}"),
        next: format!("Name each {name} once{others}."),
    }
}

/// Which cell holds which column, and the units of the coordinates.
struct Header {
    columns: PointColumns,
    separator: u8,
    count: usize,
    cells: [usize; 5],
    units: [&'static Unit; 3],
}

fn table(input: impl BufRead, columns: PointColumns) -> Result<Vec<BallRecord>, Fault> {
    let (mut lines, mut header) = (Lines::new(input), None);
    let (mut records, mut numbers): (Vec<BallRecord>, HashMap<String, usize>) = Default::default();
    let mut cells = Vec::new();
    while let Some(raw) = lines.next_line()? {
        if raw.text.trim().is_empty() || raw.text.starts_with('#') {
            continue;
        }
        let Some(header) = &header else {
            header = Some(header_of(raw, columns)?);
            continue;
        };
        let line = Line::cut(raw, header.separator, &mut cells)?;
        let (id, place) = row(header, &line)?;
        let number = *numbers.entry(id.clone()).or_insert(records.len());
        if number == records.len() {
            records.push(BallRecord { id, line: line.number(), balls: Vec::new() });
        }
        add(&mut records[number], place, &line, header)?;
    }
    match (header, records.is_empty()) {
        (None, _) => Err(Fault::new(FilePlace::file(), FileProblem::Empty)),
        (_, true) => Err(Fault::new(FilePlace::file(), FileProblem::NoRows)),
        _ => Ok(records),
    }
}

fn add(record: &mut BallRecord, place: BallPlace, line: &Line<'_>, header: &Header) -> Result<(), Fault> {
    if record.centre(&place.ball).is_some() {
        let [group, name, ..] = header.columns.names;
        let problem = twice_in(name, &format!("{group} {}", record.id), &place.ball);
        return Err(Fault::new(line.place(header.cells[1]).with_name(name).with_value(&place.ball), problem));
    }
    record.balls.push(place);
    Ok(())
}

fn header_of(raw: RawLine<'_>, columns: PointColumns) -> Result<Header, Fault> {
    let count = |separator: u8| memchr::memchr_iter(separator, raw.text.as_bytes()).count();
    let separator = [b',', b';', b'\t'].into_iter().rev().max_by_key(|s| count(*s)).unwrap_or(b',');
    let mut cells = Vec::new();
    let line = Line::cut(raw, separator, &mut cells)?;
    let mut found = [None; 5];
    for cell in 0..line.len() {
        let Some((column, unit)) = column(&line, cell, columns)? else { continue };
        if found[column].replace((cell, unit)).is_some() {
            let rule = format!("{} is given twice", columns.names[column]);
            return Err(Fault::rule(
                line.place(cell).with_name(line.text(cell)),
                rule,
                "Keep one of the two columns.",
            ));
        }
    }
    let missing: Vec<String> =
        found.iter().zip(columns.usual).filter(|(f, _)| f.is_none()).map(|(_, name)| name.into()).collect();
    let [Some(record), Some(ball), Some(x), Some(y), Some(z)] = found else {
        return Err(Fault::new(line.whole_place(), FileProblem::MissingColumns { names: missing }));
    };
    Ok(Header {
        columns,
        separator,
        count: line.len(),
        cells: [record, ball, x, y, z].map(|(cell, _)| cell),
        units: [x, y, z].map(|(_, unit)| unit),
    })
}

/// Which column a header cell names, and its unit; none for a column that is not read.
fn column(
    line: &Line<'_>,
    cell: usize,
    columns: PointColumns,
) -> Result<Option<(usize, &'static Unit)>, Fault> {
    let text = line.text(cell);
    let (base, bracketed) = without_brackets(text);
    let base = base.trim().replace([' ', '-'], "_").to_lowercase();
    let (name, unit) = match base.split_once('_') {
        Some((name, unit)) if bracketed.is_none() => (name.to_owned(), Some(unit.to_owned())),
        _ => (base, bracketed.map(str::to_owned)),
    };
    let Some(column) = columns.names.iter().position(|known| *known == name) else { return Ok(None) };
    let kind = if column < 2 { Dimension::Number } else { Dimension::Length };
    stated_unit(columns.names[column], kind, columns.usual[column].into(), unit.as_deref())
        .map(|unit| Some((column, unit)))
        .map_err(|problem| Fault::new(line.place(cell).with_name(text), problem))
}

fn row(header: &Header, line: &Line<'_>) -> Result<(String, BallPlace), Fault> {
    if line.len() != header.count {
        let problem = FileProblem::CellCount { found: line.len(), expected: header.count };
        return Err(Fault::new(line.whole_place(), problem));
    }
    let name = |column: usize| match line.text(header.cells[column]) {
        "" => Err(Fault::new(
            line.place(header.cells[column]).with_name(header.columns.names[column]),
            FileProblem::EmptyCell,
        )),
        text => Ok(text.to_owned()),
    };
    let mut centre = Vector3::zeros();
    for axis in 0..3 {
        centre[axis] = coordinate(header, line, axis)?;
    }
    Ok((name(0)?, BallPlace { ball: name(1)?, centre }))
}

fn coordinate(header: &Header, line: &Line<'_>, axis: usize) -> Result<f64, Fault> {
    let cell = header.cells[axis + 2];
    let comma_allowed = header.separator != b',';
    let parsed = parse_number(line.text(cell)).and_then(|number| {
        if number.comma && !comma_allowed {
            return Err(FileProblem::DecimalComma);
        }
        Ok(header.units[axis].to_si(number.value))
    });
    let value = parsed.and_then(usable);
    let place = || line.place(cell).with_name(header.columns.usual[axis + 2]).with_value(line.text(cell));
    value.map_err(|problem| Fault::new(place(), problem))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<BallRecord>, String> {
        table(text.as_bytes(), PointColumns::BALLS)
            .map_err(|fault| fault.in_file("balls.csv".as_ref()).to_string())
    }

    #[test]
    fn records_are_gathered_by_name_in_any_order_of_lines() {
        let records =
            read("# cmm\nrecord,x [mm],ball,note,y_um,z_m\n1,10,A,,5,1\nlast,0,A,,0,0\n1,0,B,x,0,0\n")
                .unwrap();
        assert_eq!((records.len(), records[0].balls.len(), records[1].id.as_str()), (2, 2, "last"));
        let centre = records[0].centre("A").unwrap();
        assert!((centre - Vector3::new(0.01, 5e-6, 1.0)).norm() < 1e-15);
    }

    #[test]
    fn semicolons_may_go_with_decimal_commas() {
        let records = read("record;ball;x_mm;y_mm;z_mm\n1;A;1,5;2;3\n").unwrap();
        assert!((records[0].balls[0].centre.x - 1.5e-3).abs() < 1e-18);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        let head = "record,ball,x_mm,y_mm,z_mm\n";
        let table = [
            ("", "the file is empty"),
            (head, "no row of measurements"),
            ("record,ball,x_mm,y_mm\n", "required columns are missing: z_mm"),
            ("record,ball,x,y_mm,z_mm\n", "column 3 (x): the name states no unit"),
            ("record,ball,x_N,y_mm,z_mm\n", "x is a length"),
            ("record,ball,x_mm,x_um,y_mm,z_mm\n", "x is given twice"),
            (&format!("{head}1,A,1,2\n"), "line 2: the row has 4 cells, the header has 5"),
            (&format!("{head}1,A,1,2,nan\n"), "line 2, column 5 (z_mm): \"nan\""),
            (&format!("{head}1,A,1,two,3\n"), "column 4 (y_mm): \"two\": this is not a number"),
            (&format!("{head}1,,1,2,3\n"), "column 2 (ball)"),
            (
                &format!("{head}1,A,1,2,3\n1,A,1,2,3\n"),
                "line 3, column 2 (ball): \"A\": ball A is twice in record 1",
            ),
        ];
        for (text, message) in table {
            let complaint = read(text).unwrap_err();
            assert!(complaint.contains(message), "{complaint}");
        }
    }
}
