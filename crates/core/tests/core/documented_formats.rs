//! The examples in `docs/reference/file-formats.md` are files that can be read.

use hexbench_core::Measurand;
use hexbench_core::files::{UNITS, parse_hexapod, read_measurements_from};

const PAGE: &str = include_str!("../../../../docs/reference/file-formats.md");

fn examples(language: &str) -> Vec<&'static str> {
    let fence = format!("```{language}\n");
    PAGE.split(&fence).skip(1).map(|rest| rest.split_once("```").unwrap().0).collect()
}

#[test]
fn the_hexapod_of_the_page_is_read() {
    let hexapod = parse_hexapod(examples("toml")[0], "example").unwrap();
    assert_eq!(hexapod.nominal_stiffness, Some([4.5e6; 6]));
    assert_eq!(hexapod.brackets, Some(vec![[0, 1], [2, 3], [4, 5]]));
}

#[test]
fn the_tables_of_the_page_are_read_without_warning() {
    let readings: Vec<_> = examples("csv")
        .iter()
        .filter(|text| text.starts_with("pose,"))
        .map(|text| {
            read_measurements_from(text.as_bytes(), "example").unwrap_or_else(|error| panic!("{error}"))
        })
        .collect();
    let kinds: Vec<_> = readings.iter().map(|reading| reading.dataset.measurand).collect();
    assert_eq!(kinds, [Measurand::DeflectionEuler, Measurand::AbsolutePose]);
    assert!(readings.iter().all(|reading| reading.warnings.is_empty()));
    assert!((readings[1].dataset.observations[0].wrench.force.z + 49.05).abs() < 1e-12);
}

#[test]
fn the_page_names_every_unit() {
    for unit in UNITS {
        let row = PAGE.lines().find(|line| line.starts_with(&format!("| {} |", unit.kind.name()))).unwrap();
        assert!(row.contains(&format!("`{}`", unit.name)), "{} is not in: {row}", unit.name);
    }
}
