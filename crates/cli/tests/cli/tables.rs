//! Tables for other programs: every number is the one the page and the JSON tell.

use std::collections::HashMap;
use std::fs::File;
use std::path::Path;

use hexbench_core::files::{measurements_to_columns, read_measurements};
use hexbench_report::table::{DataColumn, Frame, TableFormat, TableValues};
use serde_json::Value;

use crate::support::{complaint, hexbench, hexbench_in, root, text};

/// Numbers are written with all digits; what is left is rounding of sums and of changes of unit.
const ROUNDING: f64 = 1e-9;

/// Columns of a table by name.
struct Table(HashMap<String, Vec<String>>);

impl Table {
    fn read(path: &Path) -> Self {
        let text = std::fs::read_to_string(path).unwrap();
        let mut lines = text.lines();
        let names: Vec<String> = lines.next().unwrap().split(',').map(str::to_owned).collect();
        let mut columns: HashMap<String, Vec<String>> =
            names.iter().map(|n| (n.clone(), Vec::new())).collect();
        for line in lines {
            let cells: Vec<&str> = line.split(',').collect();
            assert_eq!(cells.len(), names.len(), "{line}");
            names
                .iter()
                .zip(cells)
                .for_each(|(name, cell)| columns.get_mut(name).unwrap().push(cell.to_owned()));
        }
        Self(columns)
    }

    fn words(&self, name: &str) -> &[String] {
        self.0.get(name).unwrap_or_else(|| panic!("no column {name} among {:?}", self.0.keys()))
    }

    fn numbers(&self, name: &str) -> Vec<f64> {
        self.words(name).iter().map(|cell| cell.parse().unwrap()).collect()
    }
}

fn lines(case: &str, file: &str) -> usize {
    let path = root().join("data/cases").join(case).join(file);
    std::fs::read_to_string(path).unwrap().lines().count() - 1
}

fn table(case: &str, more: &[&str]) -> (Table, serde_json::Value) {
    let folder = tempfile::tempdir().unwrap();
    let [csv, json] = ["readings.csv", "comparison.json"].map(|name| folder.path().join(name));
    let mut command = hexbench_in(case);
    command.args(["compare", "hexapod.toml", "measurements.csv"]).args(more);
    command.arg("--table").arg(&csv).arg("--json").arg(&json);
    text(command.output().unwrap());
    (Table::read(&csv), serde_json::from_slice(&std::fs::read(json).unwrap()).unwrap())
}

#[test]
fn the_table_of_readings_adds_up_to_what_the_comparison_says() {
    let (table, json) = table("contact", &["--holdout", "holdout.csv"]);
    let part = table.words("part");
    let of = |name: &str| part.iter().filter(|p| *p == name).count();
    assert_eq!(of("measurements"), lines("contact", "measurements.csv"));
    assert_eq!(of("holdout"), lines("contact", "holdout.csv"));
    let (mut fitted, mut held) = (0.0, 0.0);
    for name in ["da_um", "db_um", "dc_um", "dalpha_urad", "dbeta_urad", "dgamma_urad"] {
        let [measured, predicted, residual, sigma] =
            ["", "predicted_", "residual_", "sigma_"].map(|prefix| table.numbers(&format!("{prefix}{name}")));
        let plain = name.split_once('_').unwrap().0;
        let whitened = table.numbers(&format!("whitened_{plain}"));
        for row in 0..part.len() {
            let left = measured[row] - predicted[row];
            assert!(
                (left - residual[row]).abs() < ROUNDING * measured[row].abs().max(1.0),
                "{name} row {row}"
            );
            assert!((whitened[row] * sigma[row] - residual[row]).abs() < ROUNDING, "{name} row {row}");
            *(if part[row] == "holdout" { &mut held } else { &mut fitted }) += whitened[row].powi(2);
        }
    }
    // Six springs were fitted to six numbers of each reading.
    let said = |where_: &str| json[where_]["chi2_reduced"].as_f64().unwrap();
    let [dof, count] = [6.0 * of("measurements") as f64 - 6.0, 6.0 * of("holdout") as f64];
    assert!((fitted / dof / said("error") - 1.0).abs() < ROUNDING, "{} {}", fitted / dof, said("error"));
    assert!((held / count / said("holdout") - 1.0).abs() < ROUNDING, "{} {}", held / count, said("holdout"));
}

#[test]
fn absolute_poses_have_a_table_too() {
    let (table, _) = table("absolute-pitch", &[]);
    let (measured, predicted) = (table.numbers("measured_a_mm"), table.numbers("predicted_a_mm"));
    let residual = table.numbers("residual_a_um");
    for row in 0..measured.len() {
        let left = (measured[row] - predicted[row]) * 1e3;
        // Millimeters with all digits of a double hold a micrometre to 1e-9.
        assert!((left - residual[row]).abs() < 1e-6, "row {row}: {left} {}", residual[row]);
    }
}

#[test]
fn a_table_of_another_kind_is_refused_before_anything_is_computed() {
    let output = hexbench().args(["compare", "a", "b", "--table", "x.xlsx"]).output().unwrap();
    let told = complaint(&output);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains(".parquet or .csv"), "{told}");
}

/// Readings of gauges and of two pose numbers, some of them missing.
#[test]
fn readings_of_sensors_have_their_names_and_units() {
    let folder = tempfile::tempdir().unwrap();
    let data = folder.path().join("data");
    crate::scenes::simulate(&root().join("scenes/granite"), &data, &[]);
    let measurements = data.join("measurements.csv");
    let text_of_file = std::fs::read_to_string(&measurements).unwrap();
    let mut lines: Vec<String> = text_of_file.lines().map(str::to_owned).collect();
    // The last gauge missed the first row.
    let cut = lines[1].rfind(',').unwrap();
    lines[1].truncate(cut + 1);
    std::fs::write(&measurements, lines.join("\n") + "\n").unwrap();
    let mut command = hexbench();
    command.current_dir(&data).args([
        "compare",
        "hexapod.toml",
        "measurements.csv",
        "--table",
        "readings.csv",
    ]);
    text(command.output().unwrap());
    let table = Table::read(&data.join("readings.csv"));
    assert_eq!(table.words("line").len(), lines.len() - 1);
    for name in ["z1", "z2", "z3", "t1", "t2", "t3"] {
        let [measured, predicted, residual, sigma] =
            ["", "predicted_", "residual_", "sigma_"].map(|p| table.words(&format!("{p}{name}_um")).to_vec());
        let whitened = table.words(&format!("whitened_{name}"));
        for row in usize::from(name == "t3")..measured.len() {
            let [m, p, r, s, w] = [&measured, &predicted, &residual, &sigma, &whitened.to_vec()]
                .map(|column| column[row].parse::<f64>().unwrap());
            assert!((m - p - r).abs() < 1e-9 && (r / s - w).abs() < 1e-6 * w.abs().max(1.0), "{name} {row}");
            assert!((s - 0.2).abs() < 1e-9, "{s}");
        }
        assert!(name != "t3" || [measured, predicted, residual].iter().all(|column| column[0].is_empty()));
    }
    // Nobody read a pose; six distances are elongations of legs, also where one was read in one of two repeats only.
    assert!(table.0.keys().all(|name| !name.contains("dalpha")), "{:?}", table.0.keys());
    assert!(table.words("leg_1_residual_um").iter().all(|cell| !cell.is_empty()));
    assert!(table.words("leg_1_force_N").iter().all(|cell| !cell.is_empty()));
}

/// A bundled campaign as another program keeps it: Parquet, and JSON lines.
fn kept_elsewhere(case: &Path, folder: &Path) -> String {
    let data = read_measurements(&case.join("measurements.csv")).unwrap().dataset;
    let columns = measurements_to_columns(&data);
    let column = |(name, values): &(String, Vec<f64>)| DataColumn {
        name: name.clone(),
        unit: String::new(),
        meaning: String::new(),
        values: TableValues::Numbers(values.clone()),
    };
    let frame =
        Frame { format: "readings/1", origin: Vec::new(), columns: columns.iter().map(column).collect() };
    frame.write(TableFormat::Parquet, &mut File::create(folder.join("m.parquet")).unwrap()).unwrap();
    let object = |row: usize| {
        let pairs = columns.iter().map(|(name, values)| (name.clone(), Value::from(values[row])));
        Value::Object(pairs.collect()).to_string() + "\n"
    };
    (0..data.observations.len()).map(object).collect()
}

#[test]
fn a_campaign_kept_as_parquet_or_json_lines_has_the_answer_of_its_csv() {
    let (folder, case) = (tempfile::tempdir().unwrap(), root().join("data/cases/friction"));
    let lines = kept_elsewhere(&case, folder.path());
    let diagnose = |data: &str, given: &str| -> Value {
        let mut command = hexbench();
        command.current_dir(&case).args(["diagnose", "hexapod.toml", data, "--json", "-"]);
        serde_json::from_str(&text(command.write_stdin(given).output().unwrap())).unwrap()
    };
    let expected = diagnose("measurements.csv", "");
    let parquet = folder.path().join("m.parquet");
    for answer in [diagnose(parquet.to_str().unwrap(), ""), diagnose("-", &lines)] {
        for key in ["verdict", "added", "parameters", "candidates"] {
            assert_eq!(answer[key], expected[key], "{key}");
        }
    }
}

/// A table of text as Parquet: numbers where all cells of a column are some.
fn parquet_of(table: &str, path: &Path) {
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = lines.next().unwrap();
    let rows: Vec<Vec<&str>> = lines.collect();
    let column = |(k, name): (usize, &&str)| {
        let cells: Vec<&str> = rows.iter().map(|row| row[k]).collect();
        let numbers: Option<Vec<f64>> = cells.iter().map(|cell| cell.parse().ok()).collect();
        let words = || TableValues::Texts(cells.iter().map(|cell| (*cell).to_owned()).collect());
        DataColumn {
            name: (*name).to_owned(),
            unit: String::new(),
            meaning: String::new(),
            values: numbers.map_or_else(words, TableValues::Numbers),
        }
    };
    let columns = names.iter().enumerate().map(column).collect();
    let frame = Frame { format: "readings/1", origin: Vec::new(), columns };
    frame.write(TableFormat::Parquet, &mut File::create(path).unwrap()).unwrap();
}

#[test]
fn balls_and_loads_may_be_parquet_or_json_lines_too() {
    let folder = tempfile::tempdir().unwrap();
    let data = folder.path().join("data");
    crate::scenes::simulate(&root().join("scenes/paper"), &data, &[]);
    let read = |name: &str| std::fs::read_to_string(data.join(name)).unwrap();
    let (balls, loads) = (read("balls.csv"), read("loads.csv"));
    parquet_of(&balls, &data.join("balls.parquet"));
    parquet_of(&loads, &data.join("loads.parquet"));
    let mut lines = loads.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let object = |line: &str| {
        let pairs = names.iter().zip(line.split(',')).map(|(name, cell)| format!("\"{name}\":{cell}"));
        format!("{{{}}}\n", pairs.collect::<Vec<_>>().join(","))
    };
    std::fs::write(data.join("loads.jsonl"), lines.map(object).collect::<String>()).unwrap();
    let campaign = |balls: &str, loads: &str| {
        let out = format!("{balls}-{loads}");
        let mut command = hexbench();
        command.current_dir(&data).args(["campaign", balls, loads, "--balls", "balls.toml", "-o", &out]);
        text(command.output().unwrap());
        read(&format!("{out}/measurements.csv"))
    };
    let expected = campaign("balls.csv", "loads.csv");
    assert_eq!(campaign("balls.parquet", "loads.parquet"), expected);
    assert_eq!(campaign("balls.csv", "loads.jsonl"), expected);
}
