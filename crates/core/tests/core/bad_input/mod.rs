//! Bad input: every kind has its message, its place and its next step, and `docs/reference/file-messages.md` lists them all.

mod document;
mod hexapods;
mod noticed;
mod plans;
mod samples;
mod tables;

use hexbench_core::files::{FileError, read_hexapod, read_measurements, read_plan};
use std::fs;

/// One bad file and what is expected of the reader.
pub(crate) struct Case {
    /// What is wrong, in the words of the documentation.
    pub(crate) what: &'static str,
    /// Name of the file: `measurements.csv`, `plan.csv` or `hexapod.toml`.
    pub(crate) file: &'static str,
    /// Its bytes.
    pub(crate) bytes: Vec<u8>,
    /// Line and column, zero where none is expected.
    pub(crate) at: (u64, usize),
    /// A part of the message.
    pub(crate) says: &'static str,
}

/// One bad input in a file of its own name in a folder of its own.
pub(crate) fn error_of(case: &Case) -> FileError {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(case.file);
    fs::write(&path, &case.bytes).unwrap();
    let error = match case.file {
        "hexapod.toml" => read_hexapod(&path).err(),
        "plan.csv" => read_plan(&path, None).err(),
        _ => read_measurements(&path).err(),
    };
    error.unwrap_or_else(|| panic!("{} must be refused", case.what))
}

/// The message, the place, the caret and the next step are as they should be.
pub(crate) fn check(case: &Case) {
    let error = error_of(case);
    let message = error.message();
    assert!(message.contains(case.says), "{message}");
    let (line, column) = (error.place.line.unwrap_or(0), error.place.column.unwrap_or(0));
    assert_eq!((line, column), case.at, "{message}");
    assert!(error.next_step().ends_with('.'), "{}", error.next_step());
    check_caret(case, &error);
}

/// The span, where there is one, lies on the stated line and holds the stated value.
fn check_caret(case: &Case, error: &FileError) {
    let Some(span) = error.place.span.clone() else { return };
    assert!(span.end <= case.bytes.len() && span.start <= span.end, "{span:?}");
    let line = case.bytes[..span.start].split(|byte| *byte == b'\n').count() as u64;
    assert_eq!(Some(line), error.place.line);
    if let Some(value) = error.place.value.as_ref().filter(|value| !value.ends_with("...")) {
        let marked = String::from_utf8_lossy(&case.bytes[span]);
        assert_eq!(marked.trim_matches('"'), value);
    }
}

/// A test for each line, and all of them as a list for the documentation.
macro_rules! bad_input {
    ($file:literal; $($name:ident: $what:literal, $bytes:expr => $at:expr, $says:literal;)*) => {
        $(#[test] fn $name() { $crate::bad_input::check(&$crate::bad_input::Case {
            what: $what, file: $file, bytes: $bytes.into(), at: $at, says: $says,
        }); })*

        pub(crate) fn cases() -> Vec<$crate::bad_input::Case> {
            vec![$($crate::bad_input::Case { what: $what, file: $file, bytes: $bytes.into(), at: $at, says: $says }),*]
        }
    };
}
pub(crate) use bad_input;
