//! Ball centers as exported by measuring programs, one file for each layout. A layout is recognized by the contents of a file, never by
//! its name, and pages say which layout was read.

mod calypso;
mod pc_dmis;
mod point_list;

use super::error::Fault;
use super::lines::{Lines, RawLine};
use super::points::{BallTable, Gathered, Touch, twice_in};
use super::units::Unit;
use super::warning::Notice;
use super::{FilePlace, FileProblem, Warning};
use crate::{BallPlace, Vector3};

/// A layout.
pub(super) struct Layout {
    /// The program, and what of it.
    name: &'static str,
    /// True for the first lines of such a file, blank ones left out.
    recognizes: fn(&[String]) -> bool,
    /// A reader of one file.
    reader: fn(Option<&'static Unit>) -> Box<dyn LayoutReader>,
}

/// Reads the lines of a file one after the other.
trait LayoutReader {
    /// Takes a line; points that are complete with it.
    fn line(&mut self, raw: &RawLine<'_>) -> Result<Vec<Touched>, Fault>;
    /// At the end of the file.
    fn end(&mut self) -> Result<(), Fault>;
}

/// A ball of a record.
struct Touched {
    record: String,
    ball: String,
    centre: Vector3,
    line: u64,
}

/// A ball whose coordinates come one by one, m.
struct OpenBall {
    record: String,
    ball: String,
    centre: [Option<f64>; 3],
    /// Where it begins.
    line: u64,
}

impl OpenBall {
    fn new(record: &str, ball: &str, line: u64) -> Self {
        Self { record: record.to_owned(), ball: ball.to_owned(), centre: [None; 3], line }
    }

    /// The ball, once all its coordinates are there.
    fn touched(&self) -> Option<Touched> {
        let [Some(x), Some(y), Some(z)] = self.centre else { return None };
        let (record, ball) = (self.record.clone(), self.ball.clone());
        Some(Touched { record, ball, centre: Vector3::new(x, y, z), line: self.line })
    }

    /// Which coordinate is missing first.
    fn missing(&self) -> usize {
        self.centre.iter().position(Option::is_none).unwrap_or_default()
    }

    /// Where it begins.
    fn place(&self) -> FilePlace {
        FilePlace { line: Some(self.line), ..FilePlace::file() }
    }
}

const LAYOUTS: [&Layout; 3] = [&calypso::LAYOUT, &pc_dmis::LAYOUT, &point_list::LAYOUT];

/// Lines that are looked at to recognize a layout.
const LOOKED_AT: usize = 64;

/// The layout of a file; none: a table with names of columns, or something else.
pub(super) fn recognized(bytes: &[u8]) -> Option<&'static Layout> {
    let mut lines = Lines::new(bytes);
    let mut first = Vec::new();
    while first.len() < LOOKED_AT {
        match lines.next_line() {
            Ok(Some(raw)) if raw.text.trim().is_empty() => {}
            Ok(Some(raw)) => first.push(raw.text.to_owned()),
            Ok(None) => break,
            // Who reads it says what is wrong.
            Err(_) => return None,
        }
    }
    LAYOUTS.into_iter().find(|layout| (layout.recognizes)(&first))
}

/// Reads a file of a layout; `unit` is that of coordinates that state none.
///
/// # Errors
/// The first thing that is wrong, with its line.
pub(super) fn read(
    layout: &'static Layout,
    bytes: &[u8],
    unit: Option<&'static Unit>,
) -> Result<BallTable, Fault> {
    let mut lines = Lines::new(bytes);
    let (mut reader, mut gathered) = ((layout.reader)(unit), Gathered::default());
    while let Some(raw) = lines.next_line()? {
        if raw.text.trim().is_empty() {
            continue;
        }
        for Touched { record, ball, centre, line } in reader.line(&raw)? {
            let problem = twice_in("ball", &format!("record {record}"), &ball);
            let place = FilePlace { line: Some(line), ..FilePlace::file() };
            if !gathered.add(Touch { group: record, ball: BallPlace { ball, centre }, line }) {
                return Err(Fault::new(place, problem));
            }
        }
    }
    reader.end()?;
    let encoding = lines.encoding.map(|name| Warning::new(FilePlace::file(), Notice::Encoding(name)));
    Ok(BallTable {
        records: gathered.finish()?,
        layout: Some(layout.name),
        warnings: encoding.into_iter().collect(),
    })
}

/// The record and the ball in a name such as `R01_P2`.
fn record_and_ball(name: &str, place: FilePlace) -> Result<(String, String), Fault> {
    match name.rsplit_once(['_', '.', '/']).filter(|(record, ball)| !record.is_empty() && !ball.is_empty()) {
        Some((record, ball)) => Ok((record.to_owned(), ball.to_owned())),
        None => Err(Fault::rule(
            place.with_value(name),
            "the name contains no record",
            "Name the measured features RECORD_BALL, for example R01_P1 for ball P1 in record R01.",
        )),
    }
}

/// Coordinates of a program that states no unit.
fn no_unit() -> FileProblem {
    FileProblem::Rule {
        rule: "the file states no unit for its coordinates".into(),
        next: "Add --unit mm, or the unit in which the coordinates were exported.".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::Dimension;
    use super::super::column_names::ColumnNames;
    use super::super::points::PointTable;
    use super::super::units::unit_named;
    use super::*;

    fn read(text: &str, unit: Option<&str>) -> Result<BallTable, String> {
        let unit = unit.and_then(|unit| unit_named(unit, Dimension::Length));
        PointTable::of_balls(&ColumnNames::default(), unit).table(text.as_bytes()).map_err(|fault| {
            let error = fault.in_file("balls.txt".as_ref());
            format!("{error}; next: {}", error.next_step())
        })
    }

    /// What all these files say, as the plain table.
    const PLAIN: &str = "record,ball,x_mm,y_mm,z_mm\nR1,P1,1.5,2,-3\nR1,P2,4,5,6.25\nR2,P1,7,8,9\n";

    fn same(text: &str, unit: Option<&str>, layout: &str) {
        let (plain, other) = (read(PLAIN, None).unwrap(), read(text, unit).unwrap());
        assert!(other.layout.unwrap().contains(layout), "{:?}", other.layout);
        for (one, other) in plain.records.iter().zip(&other.records) {
            assert_eq!((&one.id, &one.balls), (&other.id, &other.balls));
        }
        assert_eq!(plain.records.len(), other.records.len());
    }

    const LIST: &str = "// SA version\n// axes: x y z\nR1 P1 1.5 2.0 -3.0\nR1 P2 4 5 6.25\n\nR2 P1 7 8 9\n";

    #[test]
    fn lists_of_points_are_read_with_their_unit_given() {
        same(LIST, Some("mm"), "SpatialAnalyzer");
        same(&LIST.replace("R1 P1", "\"R1\" P1").replace(' ', ","), Some("mm"), "SpatialAnalyzer");
        same("R1_P1\t1.5\t2.0\t-3\nR1_P2\t4\t5\t6.25\nR2_P1\t7\t8\t9\n", Some("mm"), "list");
        assert!(read(LIST, None).unwrap_err().contains("no unit for its coordinates; next: Add --unit mm"));
        let three = LIST.replace("R1 P", "A R1 P").replace("R2 P", "A R2 P");
        assert_eq!(read(&three, Some("mm")).unwrap().records[1].id, "A::R2");
        assert!(read(&LIST.replace("R2 P1", "R2"), Some("mm")).is_err());
        assert!(read(&format!("{}R3 P 1 7 8 9\n", LIST.repeat(40)), Some("mm")).is_err());
    }

    fn characteristics(decimal: &str) -> String {
        let head = "planid\tpartnb\tid\ttype\tidsymbol\tactual\tnominal\tfeatureid\tunit\n";
        let rows = [
            ("R1", "P1", ["1.5", "2", "-3"]),
            ("R1", "P2", ["4", "5", "6.25"]),
            ("R2", "P1", ["7", "8", "9"]),
        ];
        let row = |(part, ball, numbers): (&str, &str, [&str; 3])| {
            let line = |(axis, number): (&str, &str)| {
                format!("plan\t{part}\t{ball}_{axis}\t\t{axis}Value\t{number}\t0.0\t{ball}\tmm\n")
            };
            let size = format!("plan\t{part}\t{ball}_D\t\tdiameter\t20.0\t20.0\t{ball}\tmm\n");
            ["x", "y", "z"].into_iter().zip(numbers).map(line).collect::<String>() + &size
        };
        (head.to_owned() + &rows.map(row).concat()).replace('.', decimal) + "END\n"
    }

    #[test]
    fn characteristics_of_calypso_are_read_with_points_and_with_commas() {
        for decimal in [".", ","] {
            same(&characteristics(decimal), None, "Calypso");
        }
        let text = characteristics(".");
        let (first, second) = text.split_at(text.find("plan\tR2").unwrap());
        let head = text.lines().next().unwrap();
        same(&format!("{first}{head}\n{second}"), None, "Calypso");
        let lost = text.lines().filter(|line| !line.contains("P2_y")).collect::<Vec<_>>().join("\n");
        assert!(read(&lost, None).unwrap_err().contains("P2 of part R1 has no yValue"));
        assert!(
            read(&text.replace("\tmm", "\tdeg"), None).unwrap_err().contains("\"deg\" is not a known unit")
        );
        assert!(read(&text.replace("R2", "R1"), None).unwrap_err().contains("P1 is twice in record R1"));
    }

    fn report(record: &str, ball: &str, [x, y, z]: [&str; 3]) -> String {
        format!(
            "DIM LOC1= LOCATION OF SPHERE {record}_{ball}  UNITS=MM ,$\nGRAPH=OFF  TEXT=OFF  MULT=10.00  OUTPUT=BOTH\n\
             AX    NOMINAL       +TOL       -TOL       MEAS        DEV     OUTTOL\n\
             X      0.0000     0.1000     0.1000     {x}     0.0000     0.0000 ----#----\n\
             Y      0.0000     0.1000     0.1000     {y}     0.0000     0.0000\n\
             Z      0.0000     0.1000     0.1000     {z}     0.0000     0.0000\nEND OF DIMENSION LOC1\n"
        )
    }

    #[test]
    fn reports_of_pc_dmis_are_read_by_their_measured_column() {
        let text = "PART NAME  : bench\n".to_owned()
            + &report("R1", "P1", ["1.5", "2", "-3"])
            + &report("R1", "P2", ["4", "5", "6.25"])
            + &report("R2", "P1", ["7", "8", "9"]);
        same(&text, None, "PC-DMIS");
        same(&text.replace("DIM LOC1= LOCATION OF SPHERE ", "LOC1 = LOCATION,"), None, "PC-DMIS");
        let inch = read(&text.replace("UNITS=MM", "UNITS=IN"), None).unwrap();
        assert!((inch.records[1].balls[0].centre.x - 7.0 * 0.0254).abs() < 1e-15);
        assert!(
            read(&text.replace("R2_P1", "P1"), None)
                .unwrap_err()
                .contains("\"P1\": the name contains no record")
        );
        assert!(read(&text.replace(" UNITS=MM", ""), None).unwrap_err().contains("states no unit"));
        let lost = text.replacen("\nY ", "\nW ", 1);
        assert!(read(&lost, None).unwrap_err().contains("R1_P1 has no line Y"));
    }
}
