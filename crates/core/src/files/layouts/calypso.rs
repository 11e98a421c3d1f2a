//! The table of characteristics of Zeiss Calypso (`..._chr.txt`): a row for each characteristic, tabs between cells. The characteristics
//! `xValue`, `yValue` and `zValue` of a feature are the center of a ball; `partnb` counts the runs of the measurement plan, and is the record.
//!
//! Source: the example of a file in the README of <https://github.com/benrit/zeissConverter2>; no file of a machine was at hand.

use super::super::column_name::without_brackets;
use super::super::error::Fault;
use super::super::lines::RawLine;
use super::super::number::{Decimals, parse_number, usable_si};
use super::super::units::{Unit, unit_named};
use super::super::{Dimension, FilePlace, FileProblem};
use super::{Layout, LayoutReader, OpenBall, Touched};

pub(super) const LAYOUT: Layout = Layout {
    name: "Zeiss Calypso, table of characteristics",
    recognizes,
    reader: |unit| {
        Box::new(Characteristics { given: unit, cells: None, decimals: Decimals::default(), open: None })
    },
};

const COLUMNS: [&str; 5] = ["partnb", "idsymbol", "actual", "featureid", "unit"];
const AXES: [&str; 3] = ["xvalue", "yvalue", "zvalue"];

fn recognizes(first: &[String]) -> bool {
    first.first().is_some_and(|line| cells_of(line).is_some())
}

/// Where the columns are, in a line that names them.
fn cells_of(line: &str) -> Option<[usize; 5]> {
    let names: Vec<String> =
        line.split('\t').map(|cell| without_brackets(cell.trim()).0.to_lowercase()).collect();
    let cells = COLUMNS.map(|column| names.iter().position(|name| name == column));
    cells.iter().all(Option::is_some).then(|| cells.map(Option::unwrap_or_default))
}

struct Characteristics {
    given: Option<&'static Unit>,
    cells: Option<[usize; 5]>,
    decimals: Decimals,
    /// The feature whose coordinates are being read.
    open: Option<OpenBall>,
}

impl LayoutReader for Characteristics {
    fn line(&mut self, raw: &RawLine<'_>) -> Result<Vec<Touched>, Fault> {
        // Files of several runs, one below the other.
        if let Some(cells) = cells_of(raw.text) {
            self.cells = Some(cells);
            return Ok(Vec::new());
        }
        let texts: Vec<&str> = raw.text.split('\t').map(str::trim).collect();
        let Some(cells) = self.cells else { return Ok(Vec::new()) };
        let [record, symbol, actual, feature, unit] =
            cells.map(|cell| texts.get(cell).copied().unwrap_or_default());
        // A closing line such as END.
        let Some(axis) = AXES.iter().position(|axis| symbol.eq_ignore_ascii_case(axis)) else {
            return Ok(Vec::new());
        };
        let place = |cell: usize, name: &str| {
            FilePlace { line: Some(raw.number), column: Some(cells[cell] + 1), ..FilePlace::file() }
                .with_name(name)
        };
        if record.is_empty() || feature.is_empty() {
            return Err(Fault::new(
                place(if record.is_empty() { 0 } else { 3 }, "partnb or featureid"),
                FileProblem::EmptyCell,
            ));
        }
        let metres = self
            .metres(actual, unit, raw.number)
            .map_err(|problem| Fault::new(place(2, "actual").with_value(actual), problem))?;
        let is_other = |open: &OpenBall| (open.record.as_str(), open.ball.as_str()) != (record, feature);
        if self.open.as_ref().is_some_and(is_other) {
            self.end()?;
        }
        let open = self.open.get_or_insert_with(|| OpenBall::new(record, feature, raw.number));
        if open.centre[axis].replace(metres).is_some() {
            return Err(Fault::rule(
                place(1, "idsymbol"),
                format!("{symbol} of {feature} is given twice in part {record}"),
                "Count the part number up from run to run, or keep one of the two.",
            ));
        }
        let touched = open.touched();
        if touched.is_some() {
            self.open = None;
        }
        Ok(touched.into_iter().collect())
    }

    fn end(&mut self) -> Result<(), Fault> {
        let Some(open) = self.open.take() else { return Ok(()) };
        let axis = ["xValue", "yValue", "zValue"][open.missing()];
        Err(Fault::rule(
            open.place(),
            format!("{} of part {} has no {axis}", open.ball, open.record),
            "Report X, Y and Z of every ball, one below the other.",
        ))
    }
}

impl Characteristics {
    fn metres(&mut self, actual: &str, unit: &str, line: u64) -> Result<f64, FileProblem> {
        let parsed = parse_number(actual)?;
        self.decimals.note(actual, parsed, line)?;
        let stated = unit_named(unit, Dimension::Length).filter(|unit| unit.kind == Dimension::Length);
        let unit =
            stated.or(self.given.filter(|_| unit.is_empty())).ok_or_else(|| FileProblem::UnknownUnit {
                unit: unit.to_owned(),
                quantity: "actual".into(),
                kind: Dimension::Length,
                usual: "mm in the column unit".into(),
            })?;
        usable_si(unit.to_si(parsed.value))
    }
}
