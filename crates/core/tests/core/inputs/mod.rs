//! A table of inputs as people make them: read as the plain file is read, or refused with the right hint; never misread.
//! `docs/results/inputs.md` lists them.

mod balls;
mod document;
mod measurements;
mod workbook_tables;

use hexbench_core::files::{
    ColumnNames, FileError, TableReading, Warning, read_balls, read_loads, read_measurements,
};
use hexbench_core::{BallRecord, Dataset};

use crate::workbooks::{Cell, cells, ods, xlsx};

/// A file, and what it comes to.
pub(crate) struct Input {
    /// What it is, in the words of the document.
    pub(crate) what: &'static str,
    pub(crate) bytes: Vec<u8>,
    pub(crate) meaning: Meaning,
}

pub(crate) enum Meaning {
    /// The same numbers as the plain file, with these words among the warnings; none: no warning.
    Read(&'static str),
    /// An error with these words, and a next step with those.
    Refused(&'static str, &'static str),
}
pub(crate) use Meaning::{Read, Refused};

pub(crate) fn input(what: &'static str, bytes: impl Into<Vec<u8>>, meaning: Meaning) -> Input {
    Input { what, bytes: bytes.into(), meaning }
}

pub(crate) fn utf16(text: &str, big_endian: bool) -> Vec<u8> {
    let mark = std::iter::once(0xfeff);
    let bytes = |unit: u16| if big_endian { unit.to_be_bytes() } else { unit.to_le_bytes() };
    mark.chain(text.encode_utf16()).flat_map(bytes).collect()
}

/// Text as Windows writes it west of Poland; every character has one byte.
pub(crate) fn windows_1252(text: &str) -> Vec<u8> {
    text.chars().map(|symbol| u8::try_from(u32::from(symbol)).unwrap()).collect()
}

/// Cells between other separators, with decimal commas.
pub(crate) fn german(plain: &str) -> String {
    plain.replace(',', ";").replace('.', ",")
}

/// What a kind of table reads.
pub(crate) trait Reads: Sized {
    fn read(bytes: &[u8]) -> Result<(Self, Vec<Warning>), FileError>;
    /// True when the numbers are the same up to the rounding of a change of unit.
    fn is(&self, other: &Self) -> bool;
}

/// A file in a folder of its own.
fn in_a_file<T>(bytes: &[u8], read: impl FnOnce(&std::path::Path) -> T) -> T {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table");
    std::fs::write(&path, bytes).unwrap();
    read(&path)
}

fn near(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-14 * b.abs())
}

impl Reads for Dataset {
    fn read(bytes: &[u8]) -> Result<(Self, Vec<Warning>), FileError> {
        let read = in_a_file(bytes, read_measurements);
        read.map(|TableReading { dataset, warnings }| (dataset, warnings))
    }

    fn is(&self, other: &Self) -> bool {
        let rows = self.observations.iter().zip(&other.observations);
        self.observations.len() == other.observations.len()
            && rows.into_iter().all(|(a, b)| {
                near(&a.pose.to_array(), &b.pose.to_array())
                    && near(&a.wrench.to_array(), &b.wrench.to_array())
                    && near(&a.measured, &b.measured)
            })
    }
}

impl Reads for Vec<BallRecord> {
    fn read(bytes: &[u8]) -> Result<(Self, Vec<Warning>), FileError> {
        let read = in_a_file(bytes, |path| read_balls(path, &ColumnNames::default(), None));
        read.map(|table| (table.records, table.warnings))
    }

    fn is(&self, other: &Self) -> bool {
        let same = |(a, b): (&BallRecord, &BallRecord)| {
            let balls = a.balls.iter().zip(&b.balls);
            a.id == b.id
                && a.balls.len() == b.balls.len()
                && balls
                    .into_iter()
                    .all(|(a, b)| a.ball == b.ball && near(a.centre.as_slice(), b.centre.as_slice()))
        };
        self.len() == other.len() && self.iter().zip(other).all(same)
    }
}

/// What the program says of a file: nothing, warnings, or why it is refused and what to do.
pub(crate) fn said<T: Reads>(bytes: &[u8]) -> (String, String) {
    match T::read(bytes) {
        Ok((_, warnings)) => {
            (warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "), String::new())
        }
        Err(error) => (error.message(), error.next_step()),
    }
}

fn check<T: Reads>(plain: &str, inputs: Vec<Input>) {
    let (expected, _) = T::read(plain.as_bytes()).unwrap();
    for Input { what, bytes, meaning } in inputs {
        let (told, next) = said::<T>(&bytes);
        match (T::read(&bytes), meaning) {
            (Ok((read, _)), Read(words)) => {
                assert!(
                    if words.is_empty() { told.is_empty() } else { told.contains(words) },
                    "{what}: {told}"
                );
                assert!(read.is(&expected), "{what} is read as something else");
            }
            (Err(_), Refused(message, step)) => {
                assert!(told.contains(message), "{what}: {told}");
                assert!(next.contains(step) && next.ends_with('.'), "{what}: {told}: {next}");
            }
            (Ok(_), Refused(..)) => panic!("{what} is read: {told}"),
            (Err(_), Read(_)) => panic!("{what} is refused: {told}; {next}"),
        }
    }
}

#[test]
fn tables_of_measurements_as_people_make_them_are_read_or_refused_and_never_misread() {
    check::<Dataset>(&measurements::plain(), measurements::inputs());
}

#[test]
fn tables_of_ball_centres_as_people_make_them_are_read_or_refused_and_never_misread() {
    check::<Vec<BallRecord>>(balls::PLAIN, balls::inputs());
}

#[test]
fn one_workbook_may_hold_balls_and_loads() {
    let balls = "record,ball,x_mm,y_mm,z_mm\nR1,A,1,2,3\nL1,A,1,2,3.01";
    let loads = "record,ref_record,a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,mass_kg\nL1,R1,0,0,0,0,0,0,10";
    let none = ColumnNames::default();
    for book in [ods, xlsx] {
        let bytes = book(&[("Balls", cells(balls)), ("Loads", cells(loads))]);
        assert_eq!(in_a_file(&bytes, |path| read_balls(path, &none, None)).unwrap().records.len(), 2);
        let table = in_a_file(&bytes, |path| read_loads(path, &none, None)).unwrap();
        assert_eq!(
            (table.rows[0].record.as_str(), table.rows[0].hung.loaded.to_bits()),
            ("L1", 10_f64.to_bits())
        );
        assert!(table.warnings.is_empty(), "{:?}", table.warnings);
    }
    let spoilt = xlsx(&[("Balls", cells(&balls.replace("3.01", "three"))), ("Loads", cells(loads))]);
    let said = in_a_file(&spoilt, |path| read_balls(path, &none, None)).unwrap_err().message();
    assert_eq!(said, "sheet \"Balls\", row 3, column 5 (z_mm): \"three\": this is not a number");
}
