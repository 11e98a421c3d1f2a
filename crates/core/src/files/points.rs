//! Tables of named points: balls of records, joints of sides.

use std::collections::HashMap;
use std::io::BufRead;
use std::path::Path;

use super::column_names::ColumnNames;
use super::dialect::{Dialect, LineKind};
use super::error::Fault;
use super::layouts;
use super::line::Line;
use super::lines::{Lines, RawLine};
use super::number::usable;
use super::point_header::{PointHeader, Spot};
use super::source::{Noticed, read_source};
use super::unit_row::is_row_of_units;
use super::units::Unit;
use super::{FileError, FilePlace, FileProblem, Warning};
use crate::{BallPlace, BallRecord, Vector3};

/// Ball centers as read, and what the reader noticed on the way.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BallTable {
    /// Records in file order.
    pub records: Vec<BallRecord>,
    /// The program whose layout the file has; none: the columns of `balls.csv`.
    pub layout: Option<&'static str>,
    /// What was accepted but should be looked at.
    pub warnings: Vec<Warning>,
}

/// How a table of named points is read.
#[derive(Clone, Copy)]
pub(super) struct PointTable<'a> {
    /// Columns: the group of a point, its name, its coordinates.
    pub(super) names: [&'static str; 5],
    pub(super) usual: [&'static str; 5],
    /// What a sheet of a workbook with them is called.
    sheet: &'static str,
    /// True where files of other programs are read too.
    of_others: bool,
    /// What columns are called in the table.
    pub(super) called: Option<&'a ColumnNames>,
    /// Unit of coordinates that state none.
    pub(super) unit: Option<&'static Unit>,
}

impl<'a> PointTable<'a> {
    pub(super) fn of_balls(called: &'a ColumnNames, unit: Option<&'static Unit>) -> Self {
        Self { called: Some(called), unit, of_others: true, ..Self::of("record", "ball", "balls") }
    }

    pub(super) const fn of_joints() -> Self {
        Self::of("side", "leg", "joints")
    }

    const fn of(group: &'static str, name: &'static str, sheet: &'static str) -> Self {
        Self {
            names: [group, name, "x", "y", "z"],
            usual: [group, name, "x_mm", "y_mm", "z_mm"],
            sheet,
            of_others: false,
            called: None,
            unit: None,
        }
    }

    /// Reads the table of a file.
    pub(super) fn read(self, path: &Path) -> Result<BallTable, FileError> {
        read_source(path, self.sheet, |input| self.table(input)).map_err(|fault| fault.in_file(path))
    }

    pub(super) fn table(self, mut input: impl BufRead) -> Result<BallTable, Fault> {
        if !self.of_others {
            return self.rows(input);
        }
        let mut bytes = Vec::new();
        input.read_to_end(&mut bytes)?;
        match layouts::recognized(&bytes) {
            Some(layout) => layouts::read(layout, &bytes, self.unit),
            None => self.rows(bytes.as_slice()),
        }
    }

    fn rows(self, input: impl BufRead) -> Result<BallTable, Fault> {
        let mut lines = Lines::new(input);
        let mut points = Dialect::start(&mut lines, |line, dialect| {
            Ok(Points {
                header: PointHeader::of(line, self)?,
                dialect,
                units_may_follow: true,
                gathered: Gathered::default(),
            })
        })?;
        let mut cells = Vec::new();
        while let Some(raw) = lines.next_line()? {
            match points.dialect.kind(&raw) {
                LineKind::Row => points.add(raw, &mut cells)?,
                LineKind::Names => points.units_may_follow = true,
                LineKind::Nothing => {}
            }
        }
        let warnings = points.dialect.warnings(lines.encoding);
        Ok(BallTable { records: points.gathered.finish()?, layout: None, warnings })
    }
}

/// A table of points while it is read.
struct Points {
    header: PointHeader,
    dialect: Dialect,
    units_may_follow: bool,
    gathered: Gathered,
}

impl Points {
    fn add(&mut self, raw: RawLine<'_>, cells: &mut Vec<std::ops::Range<usize>>) -> Result<(), Fault> {
        let line =
            Line::cut(raw, self.dialect.separator, cells)?.without_empty_beyond(self.header.names.len());
        if std::mem::take(&mut self.units_may_follow)
            && is_row_of_units(&line, &self.header.names, |cell| self.header.unit(cell))?
        {
            return Ok(());
        }
        self.add_row(&line).map_err(|fault| Dialect::explained(&line, fault))
    }

    fn add_row(&mut self, line: &Line<'_>) -> Result<(), Fault> {
        let (found, expected) = (line.len(), self.header.names.len());
        if found != expected {
            return Err(Fault::new(line.whole_place(), FileProblem::CellCount { found, expected }));
        }
        let group = self.name(line, self.header.group)?;
        for k in 0..self.header.spots.len() {
            let spot = &self.header.spots[k];
            if spot.may_be_empty && spot.cells.iter().all(|cell| line.text(*cell).is_empty()) {
                continue;
            }
            let point = match &spot.ball {
                Some(name) => name.clone(),
                None => self.name(line, self.header.name)?,
            };
            let centre = self.centre(line, k)?;
            let place = || {
                let cell = if self.header.spots[k].ball.is_some() {
                    self.header.spots[k].cells[0]
                } else {
                    self.header.name
                };
                line.place(cell).with_name(self.header.words[1]).with_value(&point)
            };
            let touch = Touch {
                group: group.clone(),
                ball: BallPlace { ball: point.clone(), centre },
                line: line.number(),
            };
            let [group_word, name_word, ..] = self.header.words;
            if !self.gathered.add(touch) {
                return Err(Fault::new(
                    place(),
                    twice_in(name_word, &format!("{group_word} {group}"), &point),
                ));
            }
        }
        Ok(())
    }

    fn name(&self, line: &Line<'_>, cell: usize) -> Result<String, Fault> {
        let text = line.text(cell);
        if text.is_empty() {
            let place = line.place(cell).with_name(&self.header.names[cell]);
            return Err(Fault::new(place, FileProblem::EmptyCell));
        }
        Ok(text.to_owned())
    }

    fn centre(&mut self, line: &Line<'_>, spot: usize) -> Result<Vector3, Fault> {
        let mut centre = Vector3::zeros();
        let Spot { cells, units, .. } = self.header.spots[spot].clone();
        for axis in 0..3 {
            let text = line.text(cells[axis]);
            let read = self.dialect.number(text, line.number()).map(|number| units[axis].to_si(number));
            centre[axis] = read.and_then(usable).map_err(|problem| {
                let place = line.place(cells[axis]).with_name(&self.header.names[cells[axis]]);
                Fault::new(place.with_value(text), problem)
            })?;
        }
        Ok(centre)
    }
}

/// A point that was touched.
pub(super) struct Touch {
    pub(super) group: String,
    pub(super) ball: BallPlace,
    pub(super) line: u64,
}

/// Points by their groups, in file order.
#[derive(Default)]
pub(super) struct Gathered {
    records: Vec<BallRecord>,
    numbers: HashMap<String, usize>,
}

impl Gathered {
    /// Adds a point; false: its group has one of that name.
    pub(super) fn add(&mut self, touch: Touch) -> bool {
        let Touch { group, ball, line } = touch;
        let number = *self.numbers.entry(group.clone()).or_insert(self.records.len());
        if number == self.records.len() {
            self.records.push(BallRecord { id: group, line, balls: Vec::new() });
        }
        let is_new = self.records[number].centre(&ball.ball).is_none();
        if is_new {
            self.records[number].balls.push(ball);
        }
        is_new
    }

    /// The groups.
    ///
    /// # Errors
    /// No point.
    pub(super) fn finish(self) -> Result<Vec<BallRecord>, Fault> {
        if self.records.is_empty() {
            return Err(Fault::new(FilePlace::file(), FileProblem::NoRows));
        }
        Ok(self.records)
    }
}

pub(super) fn twice_in(name: &str, whole: &str, point: &str) -> FileProblem {
    let others = if name == "ball" { "; give repeated measurements separate records" } else { "" };
    FileProblem::Rule {
        rule: format!("{name} {point} is twice in {whole}"),
        next: format!("Name each {name} once{others}."),
    }
}

impl Noticed for BallTable {
    fn warnings(&mut self) -> Option<&mut Vec<Warning>> {
        Some(&mut self.warnings)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<BallRecord>, String> {
        read_with(text, None)
    }

    fn read_with(text: &str, unit: Option<&'static Unit>) -> Result<Vec<BallRecord>, String> {
        PointTable::of_balls(&ColumnNames::default(), unit)
            .table(text.as_bytes())
            .map(|table| table.records)
            .map_err(|fault| {
                let error = fault.in_file("balls.csv".as_ref());
                format!("{error} next: {}", error.next_step())
            })
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
        assert!(read("record;ball;x_mm;y_mm;z_mm\n1;A;1,5;1.234;3\n").unwrap_err().contains("are mixed"));
    }

    #[test]
    fn one_row_may_hold_all_balls_of_a_record() {
        let wide = "record;P1 x [mm];P1 y [mm];P1 z [mm];P_2 x [mm];P_2 y [mm];P_2 z [mm]\n\
                    R1;1;2;3;4;5;6\nR2;1;2;3,5;;;\n";
        let long = "record;ball;x_mm;y_mm;z_mm\nR1;P1;1;2;3\nR1;P_2;4;5;6\nR2;P1;1;2;3,5\n";
        let balls = |text: &str| {
            let records = read(text).unwrap();
            records.into_iter().map(|record| (record.id, record.balls)).collect::<Vec<_>>()
        };
        assert_eq!(balls(wide), balls(long));
        assert_eq!(
            balls(&wide.replace(" x [mm]", "_x_mm").replace("R2;1;2;3,5;;;\n", "R2;1;2;3,5;;;;\n")),
            balls(long)
        );
        assert!(read("record,P1_x_mm,P1_y_mm\nR1,1,2\n").unwrap_err().contains("missing: P1_z_mm"));
        assert!(read(&wide.replace("3,5;;;", "3,5;7;;")).unwrap_err().contains("the cell is empty"));
    }

    #[test]
    fn a_unit_may_be_given_for_coordinates_that_state_none() {
        let text = "record,ball,x,y,z\n1,A,1,2,3\n";
        assert!(read(text).unwrap_err().contains("the name has no unit"));
        let inch = super::super::units::unit_named("in", super::super::Dimension::Length);
        assert!((read_with(text, inch).unwrap()[0].balls[0].centre.x - 0.0254).abs() < 1e-15);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        let head = "record,ball,x_mm,y_mm,z_mm\n";
        let table = [
            ("", "the file is empty"),
            (head, "no row of measurements"),
            ("record,ball,x_mm,y_mm\n", "required columns are missing: z_mm"),
            ("record,ball,x,y_mm,z_mm\n", "column 3 (x): the name has no unit"),
            ("record,ball,x_N,y_mm,z_mm\n", "x is a length"),
            ("record,ball,x_mm,x_um,y_mm,z_mm\n", "x is given twice"),
            (&format!("{head}1,A,1,2\n"), "line 2: the row has 4 cells, the header has 5"),
            (&format!("{head}1,A,1,2,nan\n"), "line 2, column 5 (z_mm): \"nan\""),
            (&format!("{head}1,A,1,two,3\n"), "column 4 (y_mm): \"two\": this is not a number"),
            (&format!("{head}1,,1,2,3\n"), "column 2 (ball)"),
            (&format!("{head}-,-,mm,um,mm\n"), "contradicts"),
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
