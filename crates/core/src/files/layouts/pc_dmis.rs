//! The text of a PC-DMIS report: a block for each dimension LOCATION, whose lines X, Y and Z have the measured coordinate in the column MEAS.
//! The feature is named `RECORD_BALL`.
//!
//! Source: Hexagon, PC-DMIS help, "Dimension Command Format",
//! <https://docs.hexagonmi.com/pcdmis/2019.1/en/helpcenter/mergedProjects/core/19_dimen_topics/Dimension_Command_Format.htm>; built from this
//! description, no report of a machine was at hand.

use super::super::error::Fault;
use super::super::lines::RawLine;
use super::super::number::{Decimals, parse_number, usable_si};
use super::super::units::{Unit, unit_named};
use super::super::{Dimension, FilePlace, FileProblem};
use super::{Layout, LayoutReader, OpenBall, Touched, record_and_ball};

pub(super) const LAYOUT: Layout = Layout {
    name: "PC-DMIS, text of a report",
    recognizes,
    reader: |unit| Box::new(Report { given: unit, decimals: Decimals::default(), block: None }),
};

/// A block and a line of columns with MEAS: words that no other layout has together.
fn recognizes(first: &[String]) -> bool {
    first.iter().any(|line| feature_of(line).is_some())
        && first.iter().any(|line| measured_column(line).is_some())
}

/// The feature of `DIM LOC1= LOCATION OF SPHERE R01_P1 UNITS=MM ,$` or `LOC1 = LOCATION,R01_P1 UNITS=MM,$`.
fn feature_of(line: &str) -> Option<&str> {
    let (_, kind) = line.split_once('=')?;
    let rest = kind.trim_start().strip_prefix("LOCATION")?;
    let words = || rest.split([' ', '\t', ',']).filter(|word| !word.is_empty());
    let before_units = words().take_while(|word| !word.contains('=') && *word != "$");
    match words().next() {
        Some("OF") => before_units.skip(2).last(),
        _ => before_units.last(),
    }
}

/// The unit in `UNITS=MM`.
fn unit_of(line: &str) -> Option<&str> {
    let (_, rest) = line.split_once("UNITS=")?;
    rest.split([' ', ',', '$', '\t']).next().filter(|unit| !unit.is_empty())
}

/// Which number of a line of an axis is measured.
fn measured_column(line: &str) -> Option<usize> {
    let mut words = line.split_whitespace();
    words.next().filter(|word| *word == "AX")?;
    words.position(|word| word == "MEAS")
}

struct Report {
    given: Option<&'static Unit>,
    decimals: Decimals,
    block: Option<LocationBlock>,
}

struct LocationBlock {
    open: OpenBall,
    unit: &'static Unit,
    measured: Option<usize>,
}

impl LayoutReader for Report {
    fn line(&mut self, raw: &RawLine<'_>) -> Result<Vec<Touched>, Fault> {
        let place = || FilePlace { line: Some(raw.number), ..FilePlace::file() };
        if let Some(feature) = feature_of(raw.text) {
            self.end()?;
            let (record, ball) = record_and_ball(feature, place())?;
            let unit = self.unit(raw.text).map_err(|problem| Fault::new(place(), problem))?;
            let open = OpenBall::new(&record, &ball, raw.number);
            self.block = Some(LocationBlock { open, unit, measured: None });
            return Ok(Vec::new());
        }
        let Some(block) = &mut self.block else { return Ok(Vec::new()) };
        if let Some(column) = measured_column(raw.text) {
            block.measured = Some(column);
            return Ok(Vec::new());
        }
        let mut words = raw.text.split_whitespace();
        let axis = words
            .next()
            .and_then(|axis| ["X", "Y", "Z"].iter().position(|own| own.eq_ignore_ascii_case(axis)));
        let Some(axis) = axis else { return Ok(Vec::new()) };
        let Some(column) = block.measured else {
            return Err(Fault::rule(
                place(),
                "no line AX ... MEAS names the columns",
                "Report with headings and with the column MEAS.",
            ));
        };
        let text = words.nth(column).unwrap_or_default();
        let parsed = parse_number(text).and_then(|parsed| {
            self.decimals.note(text, parsed, raw.number)?;
            usable_si(block.unit.to_si(parsed.value))
        });
        block.open.centre[axis] =
            Some(parsed.map_err(|problem| Fault::new(place().with_name("MEAS").with_value(text), problem))?);
        let touched = block.open.touched();
        if touched.is_some() {
            self.block = None;
        }
        Ok(touched.into_iter().collect())
    }

    fn end(&mut self) -> Result<(), Fault> {
        let Some(LocationBlock { open, .. }) = self.block.take() else { return Ok(()) };
        let axis = ["X", "Y", "Z"][open.missing()];
        Err(Fault::rule(
            open.place(),
            format!("the location of {}_{} has no line {axis}", open.record, open.ball),
            "Report the axes X, Y and Z of every ball.",
        ))
    }
}

impl Report {
    fn unit(&self, line: &str) -> Result<&'static Unit, FileProblem> {
        let problem = |unit: &str| FileProblem::UnknownUnit {
            unit: unit.to_owned(),
            quantity: "a location".into(),
            kind: Dimension::Length,
            usual: "UNITS=MM".into(),
        };
        match unit_of(line) {
            Some(text) => {
                let unit = unit_named(text, Dimension::Length).filter(|unit| unit.kind == Dimension::Length);
                unit.ok_or_else(|| problem(text))
            }
            None => self.given.ok_or_else(super::no_unit),
        }
    }
}
