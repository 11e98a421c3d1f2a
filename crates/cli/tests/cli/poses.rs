//! From balls to poses: the estimator of the command against the simulated measuring machine, which registers by another
//! route.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use crate::scenes::simulate;
use crate::support::{complaint, hexbench, root, text};

struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    fn of(scene: &str, more: &[&str]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        simulate(&root().join("scenes").join(scene), &folder.path().join("data"), more);
        Self { folder }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join("data").join(name)
    }

    fn poses(&self, balls: &Path, more: &[&str]) -> std::process::Output {
        hexbench().current_dir(self.path("")).arg("poses").arg(balls).args(more).output().unwrap()
    }
}

fn rows(text: &str) -> Vec<HashMap<String, String>> {
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let row =
        |line: &str| names.iter().map(|n| (*n).to_owned()).zip(line.split(',').map(str::to_owned)).collect();
    lines.map(row).collect()
}

fn number(row: &HashMap<String, String>, name: &str) -> f64 {
    row[name].parse().unwrap_or_else(|_| panic!("{name}: {}", row[name]))
}

const POSE: [&str; 6] = [
    "measured_a_mm",
    "measured_b_mm",
    "measured_c_mm",
    "measured_alpha_deg",
    "measured_beta_deg",
    "measured_gamma_deg",
];
const DEFLECTION: [&str; 6] = ["da_um", "db_um", "dc_um", "dalpha_urad", "dbeta_urad", "dgamma_urad"];

/// The table has 1e-7 mm per coordinate: 1e-4 um in a translation, and as much over the radius of 0.12 m in a rotation.
const ROUNDING_UM_OR_URAD: f64 = 3e-3;

#[test]
fn poses_of_the_records_differ_by_the_deflections_of_the_table() {
    let bench = Bench::of("paper", &[]);
    let table = text(bench.poses(&bench.path("balls.csv"), &["--balls", "balls.toml"]));
    let poses = rows(&table);
    let readings = rows(&std::fs::read_to_string(bench.path("measurements.csv")).unwrap());
    assert_eq!(poses.len(), 2 * readings.len());
    for (pair, reading) in poses.chunks(2).zip(&readings) {
        for (k, (pose, deflection)) in POSE.iter().zip(DEFLECTION).enumerate() {
            let change = number(&pair[1], pose) - number(&pair[0], pose);
            let change = if k < 3 { change * 1e3 } else { change.to_radians() * 1e6 };
            let expected = number(reading, deflection);
            assert!((change - expected).abs() < ROUNDING_UM_OR_URAD, "{deflection}: {change} not {expected}");
        }
    }
}

#[test]
fn stated_uncertainties_of_a_pair_are_those_of_its_deflection() {
    let bench = Bench::of("paper", &[]);
    let poses = rows(&text(bench.poses(&bench.path("balls.csv"), &["--balls", "balls.toml"])));
    let readings = rows(&std::fs::read_to_string(bench.path("measurements.csv")).unwrap());
    for name in ["sigma_a_um", "sigma_c_um", "sigma_alpha_urad", "sigma_gamma_urad"] {
        let pair = number(&poses[0], name).hypot(number(&poses[1], name));
        let stated = number(&readings[0], name);
        assert!((pair - stated).abs() < 1e-4 * stated, "{name}: {pair} not {stated}");
    }
}

#[test]
fn the_noise_is_found_from_the_residuals() {
    const TRUE_SIGMA_UM: f64 = 1.0;
    let bench = Bench::of("paper", &["--repeats", "60"]);
    let nominal = std::fs::read_to_string(bench.path("balls.toml")).unwrap();
    let unknown: Vec<&str> = nominal.lines().filter(|line| !line.starts_with("sigma")).collect();
    std::fs::write(bench.path("unknown.toml"), unknown.join("\n")).unwrap();
    let page = text(bench.poses(&bench.path("balls.csv"), &["--balls", "unknown.toml", "-o", "poses.csv"]));
    let line =
        page.lines().find(|line| line.contains("from the residuals")).unwrap_or_else(|| panic!("{page}"));
    let found: f64 = line.split_whitespace().nth(1).unwrap().parse().unwrap();
    // 360 records with three degrees of freedom; a median knows the level to 1.25/sqrt(2 * 3 * 360), here within 4.5 of it.
    assert!((found / TRUE_SIGMA_UM - 1.0).abs() < 4.5 * 1.25 / 2160_f64.sqrt(), "{page}");
}

#[test]
fn a_record_relative_to_itself_has_not_moved_and_the_page_fits() {
    let bench = Bench::of("paper", &[]);
    let page = text(bench.poses(&bench.path("balls.csv"), &["--relative-to", "3", "-o", "poses.csv"]));
    insta::assert_snapshot!("poses_relative", page);
    let poses = rows(&std::fs::read_to_string(bench.path("poses.csv")).unwrap());
    let own = poses.iter().find(|row| row["record"] == "3").unwrap();
    assert!(POSE.iter().all(|name| number(own, name).abs() < 1e-7), "{own:?}");
}

#[test]
fn a_ball_that_moved_is_told() {
    let bench = Bench::of("paper", &[]);
    let table = std::fs::read_to_string(bench.path("balls.csv")).unwrap();
    let knocked = |line: &str| {
        if !line.starts_with("7,") || !line.contains(",P2,") {
            return line.to_owned();
        }
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        cells[6] = format!("{:.7}", cells[6].parse::<f64>().unwrap() + 0.02);
        cells.join(",")
    };
    let changed: Vec<String> = table.lines().map(knocked).collect();
    std::fs::write(bench.path("knocked.csv"), changed.join("\n") + "\n").unwrap();
    let output = bench.poses(&bench.path("knocked.csv"), &["--balls", "balls.toml"]);
    let said = complaint(&output);
    assert!(
        said.contains("record 7: balls") && said.contains("P2") && said.contains("a ball moved"),
        "{said}"
    );
    assert_eq!(said.matches("warning:").count(), 1, "{said}");
    let moved: Vec<String> = rows(&text(output))
        .iter()
        .filter(|row| row["x_moved"] == "1")
        .map(|row| row["record"].clone())
        .collect();
    assert_eq!(moved, ["7"]);
}

#[test]
fn bad_input_has_its_exit_code_place_and_next_step() {
    let bench = Bench::of("paper", &[]);
    let file = |name: &str, content: &str| {
        std::fs::write(bench.path(name), content).unwrap();
        bench.path(name)
    };
    let head = "record,ball,x_mm,y_mm,z_mm\n";
    let whole = bench.path("balls.csv");
    let short = file("short.csv", &format!("{head}a,P1,0,0,0\na,P2,1,0,0\n"));
    let line = file("line.csv", &format!("{head}a,P1,0,0,0\na,P2,1,0,0\na,P3,2,0,0\n"));
    let word = file("word.csv", &format!("{head}a,P1,0,zero,0\n"));
    file(
        "twice.toml",
        "format = \"balls/1\"\n[[platform]]\nball = \"A\"\ncenter_mm = [0, 0, 0]\n[[platform]]\nball = \"A\"\ncenter_mm = [1, 0, 0]\n",
    );
    let table: [(&Path, &[&str], i32, &str); 8] = [
        (&whole, &[], 2, "--balls"),
        (&whole, &["--relative-to", "99"], 2, "there is no record 99"),
        (&whole, &["--relative-to", "1", "--sigma-um", "-1"], 2, "a standard deviation must be positive"),
        (&whole, &["--balls", "none.toml"], 5, "there is no such file"),
        (&whole, &["--balls", "twice.toml"], 3, "ball A is twice"),
        (&short, &["--balls", "balls.toml"], 3, "line 2: record a lacks ball P3"),
        (&line, &["--balls", "balls.toml"], 3, "do not determine a pose"),
        (&word, &["--balls", "balls.toml"], 3, "line 2, column 4 (y_mm): \"zero\""),
    ];
    for (balls, more, code, message) in table {
        let output = bench.poses(balls, more);
        let said = complaint(&output);
        assert_eq!(output.status.code(), Some(code), "{said}");
        assert!(said.contains(message), "{message}: {said}");
    }
}
