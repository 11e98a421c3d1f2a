//! Tables that are read, with a warning or without.

use super::samples::{HEXAPOD, Table, deflections, poses};
use hexbench_core::files::{Notice, TableReading, Warning, content_hash, read_hexapod, read_measurements};
use std::fs;
use std::path::Path;

/// A file that is read with a warning, for the documentation.
pub(crate) struct Noticed {
    pub(crate) what: &'static str,
    pub(crate) text: String,
    pub(crate) says: &'static str,
}

fn comma_decimals() -> String {
    deflections().text().replace(',', ";").replace('.', ",")
}

fn load_free() -> String {
    let names = ["ref_fx_N", "ref_fy_N", "ref_fz_N", "ref_mx_Nm", "ref_my_Nm", "ref_mz_Nm"];
    let values = ["0", "0", "-338.5", "0", "0", "0"];
    names.iter().zip(values).fold(deflections(), |table, (name, value)| table.with(name, value)).text()
}

pub(crate) fn cases() -> Vec<Noticed> {
    let case = |what, text: String, says| Noticed { what, text, says };
    vec![
        case("semicolons between the columns", deflections().separated(";"), "separated by semicolons"),
        case("tabs between the columns", deflections().separated("\t"), "separated by tabs"),
        case("decimal commas (with semicolons)", comma_decimals(), "decimal comma; accepted in every cell"),
        case(
            "column far from every known name",
            deflections().with("humidity_%", "40").text(),
            "unknown column, ignored",
        ),
        case("identical rows", deflections().repeated().text(), "1 row is identical"),
        case(
            "no newline at the end",
            deflections().text().trim_end().to_owned(),
            "does not end with a newline",
        ),
        case("same wrench loaded and in reference", load_free(), "2 rows have the same wrench"),
    ]
}

pub(crate) fn warnings_of(text: &str) -> Vec<Warning> {
    read(text.as_bytes()).warnings
}

fn read(bytes: &[u8]) -> TableReading {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("measurements.csv");
    fs::write(&path, bytes).unwrap();
    read_measurements(&path).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn every_notice_is_given_once_and_has_a_next_step() {
    for case in cases() {
        let warnings = warnings_of(&case.text);
        let matching = warnings.iter().filter(|warning| warning.to_string().contains(case.says)).count();
        assert_eq!(matching, 1, "{}: {warnings:?}", case.what);
        assert!(warnings.iter().all(|warning| warning.next_step().ends_with('.')));
    }
}

#[test]
fn a_sound_table_gives_no_warning() {
    assert_eq!(read(deflections().text().as_bytes()).warnings, []);
    assert_eq!(read(poses().text().as_bytes()).warnings, []);
}

#[test]
fn a_byte_order_mark_and_windows_line_ends_change_nothing() {
    let plain = read(deflections().text().as_bytes());
    let windows = format!("\u{feff}{}", deflections().text().replace('\n', "\r\n"));
    assert_eq!(read(windows.as_bytes()), plain);
}

#[test]
fn every_separator_and_decimal_sign_gives_the_same_numbers() {
    let plain = read(deflections().text().as_bytes()).dataset;
    for text in [deflections().separated(";"), deflections().separated("\t"), comma_decimals()] {
        assert_eq!(read(text.as_bytes()).dataset, plain);
    }
}

/// What spreadsheets make of a table: all of it is the same table.
#[test]
fn tables_as_spreadsheets_write_them_are_read() {
    let plain = read(deflections().text().as_bytes()).dataset;
    let semicolons = comma_decimals();
    let marked = |bytes: Vec<u8>, mark: [u8; 2]| mark.into_iter().chain(bytes).collect::<Vec<u8>>();
    let little = semicolons.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let big = semicolons.encode_utf16().flat_map(u16::to_be_bytes).collect();
    let (names, rows) = semicolons.split_once('\n').unwrap();
    let unit = |name: &str| name.rsplit_once('_').map_or(String::new(), |(_, unit)| format!("[{unit}]"));
    let units = names.split(';').map(unit).collect::<Vec<_>>().join(";");
    let trailing = semicolons.replace('\n', ";;\n");
    // Windows-1252: one byte for the micro sign.
    let micro = semicolons
        .replace("da_um", "da_\u{b5}m")
        .chars()
        .map(|c| u8::try_from(u32::from(c)).unwrap())
        .collect();
    let files: [(&str, Vec<u8>); 7] = [
        ("sep=; above the header", format!("sep=;\r\n{}", semicolons.replace('\n', "\r\n")).into_bytes()),
        ("UTF-16, little end first", marked(little, [0xff, 0xfe])),
        ("UTF-16, big end first", marked(big, [0xfe, 0xff])),
        ("Windows-1252", micro),
        ("units in the second row", format!("{names}\n{units}\n{rows}").into_bytes()),
        ("empty columns and rows at the end", format!("{trailing};;;;\n").into_bytes()),
        ("UTF-8 with mark", format!("\u{feff}{semicolons}").into_bytes()),
    ];
    for (what, bytes) in files {
        let mut dataset = read(&bytes).dataset;
        // A row above the readings moves their lines.
        dataset.observations.iter_mut().zip(&plain.observations).for_each(|(o, plain)| o.line = plain.line);
        assert_eq!(dataset, plain, "{what}");
    }
}

#[test]
fn columns_named_to_be_ignored_are_ignored_silently() {
    let table = deflections().with("note_probe", "\"ruby, 3 mm\"").with("x_fz_N", "").with("Comment", "é");
    let reading = read(table.text().as_bytes());
    assert_eq!(reading.warnings, []);
    assert_eq!(reading.dataset, read(deflections().text().as_bytes()).dataset);
}

#[test]
fn comments_blank_lines_and_empty_spreadsheet_rows_are_skipped_but_counted() {
    let text = format!("# made by hand\n\n{}{}\n", deflections().text(), ",".repeat(20));
    let reading = read(text.as_bytes());
    let lines: Vec<u64> = reading.dataset.observations.iter().map(|row| row.line).collect();
    assert_eq!(lines, [4, 5]);
}

#[test]
fn identical_rows_are_dropped_and_their_lines_named() {
    let reading = read(deflections().repeated().text().as_bytes());
    assert_eq!(reading.dataset.observations.len(), 2);
    assert_eq!(reading.warnings[0].notice, Notice::IdenticalRows { lines: vec![[2, 4]] });
}

#[test]
fn without_pose_and_repeat_the_rows_are_numbered() {
    let reading = read(deflections().without("pose").without("repeat").text().as_bytes());
    let numbers: Vec<_> = reading.dataset.observations.iter().map(|row| (row.pose_id, row.repeat)).collect();
    assert_eq!(numbers, [(1, 1), (2, 1)]);
}

#[test]
fn shorthand_and_long_sigmas_are_the_same() {
    let short = deflections().with("sigma_translation_nm", "500").with("sigma_rotation_mrad", "0.003");
    let long = ["da", "db", "dc"]
        .iter()
        .fold(deflections(), |table: Table, axis| table.with(&format!("sigma_{axis}_um"), "0.5"));
    let long = ["alpha", "beta", "gamma"]
        .iter()
        .fold(long, |table, axis| table.with(&format!("sigma_{axis}_urad"), "3"));
    let sigma = |table: Table| read(table.text().as_bytes()).dataset.observations[0].sigma.unwrap();
    for (one, other) in sigma(short).into_iter().zip(sigma(long)) {
        assert!((one - other).abs() <= 2.0 * f64::EPSILON * other, "{one} {other}");
    }
}

#[test]
fn a_folder_and_a_missing_file_are_troubles_of_input_and_output() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("none");
    for path in [folder.path(), missing.as_path()] {
        assert!(read_measurements(path).unwrap_err().is_input_output());
        assert!(read_hexapod(path).unwrap_err().is_input_output());
        assert!(content_hash(path).unwrap_err().is_input_output());
    }
    let error = read_measurements(Path::new("none.csv")).unwrap_err();
    assert_eq!(error.to_string(), "none.csv: there is no such file");
}

#[test]
fn a_hexapod_with_a_byte_order_mark_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("hexapod.toml");
    fs::write(&path, format!("\u{feff}{HEXAPOD}").replace('\n', "\r\n")).unwrap();
    assert_eq!(read_hexapod(&path).unwrap().name, "bench");
}
