//! Which readings count: left out by name, or all kept; the page and the JSON tell the other answer.

use std::fs;
use std::process::Output;

use serde_json::Value;

use crate::support::{hexbench_in, root, text};

/// Line with a wrong number.
const WRONG: u64 = 31;

/// `diagnose` of a sound machine's measurements with one wrong number.
fn diagnosed(more: &[&str]) -> Output {
    run("diagnose", 30.0, more)
}

/// A command on a sound machine's measurements with one number so many um off.
fn run(command: &str, off_um: f64, more: &[&str]) -> Output {
    let folder = tempfile::tempdir().unwrap();
    let data = folder.path().join("measurements.csv");
    fs::write(&data, with_wrong_number(off_um)).unwrap();
    hexbench_in("mujoco-clean").args([command, "hexapod.toml"]).arg(&data).args(more).output().unwrap()
}

fn with_wrong_number(off_um: f64) -> String {
    let file = root().join("data/cases/mujoco-clean/measurements.csv");
    let mut lines: Vec<String> = fs::read_to_string(file).unwrap().lines().map(str::to_owned).collect();
    let column = lines[0].split(',').position(|name| name == "db_um").unwrap();
    let wrong = &mut lines[usize::try_from(WRONG).unwrap() - 1];
    let mut cells: Vec<String> = wrong.split(',').map(str::to_owned).collect();
    cells[column] = (cells[column].parse::<f64>().unwrap() + off_um).to_string();
    *wrong = cells.join(",");
    lines.join("\n") + "\n"
}

/// The page as one line of words.
fn page(more: &[&str]) -> String {
    text(diagnosed(more)).split_whitespace().collect::<Vec<_>>().join(" ")
}

fn json(more: &[&str]) -> Value {
    let more: Vec<&str> = more.iter().copied().chain(["--json", "-"]).collect();
    serde_json::from_str(&text(diagnosed(&more))).unwrap()
}

#[test]
fn the_page_says_what_would_change() {
    let left_out = page(&[]);
    assert!(left_out.contains(
        "With line 31 kept, the verdict would be outside instead of measurement, the stiffness of leg 1"
    ));
    assert!(left_out.contains("times the noise."), "{left_out}");
    let kept = page(&["--keep-all"]);
    assert!(kept.contains("As requested, this reading is kept"), "{kept}");
    assert!(kept.contains("Without line 31, the verdict would be measurement instead of outside"), "{kept}");
    let excluded = page(&["--exclude", "31"]);
    assert!(excluded.contains("Left out beforehand, as requested: line 31."), "{excluded}");
}

#[test]
fn the_json_has_the_alternative() {
    let (left_out, kept) = (json(&[]), json(&["--keep-all"]));
    assert_eq!((&left_out["keep_all"], &kept["keep_all"]), (&Value::Bool(false), &Value::Bool(true)));
    let other = &left_out["alternative"];
    assert_eq!(other["rows"], serde_json::json!([WRONG]));
    assert_eq!((&other["verdict"], &other["added"]), (&kept["verdict"], &kept["added"]));
    assert_eq!(other["chi2_reduced"], kept["steps"][0]["chi2_reduced"]);
    for leg in 0..6 {
        assert_eq!(other["stiffness"][leg], kept["parameters"][leg]);
    }
}

#[test]
fn lines_are_excluded_one_by_one_and_in_ranges_beside_keeping_the_rest() {
    let d = json(&["--exclude", "2-3,7", "--exclude", "5", "--keep-all"]);
    assert_eq!(d["excluded"], serde_json::json!([2, 3, 5, 7]));
    assert_eq!(d["alternative"]["rows"], serde_json::json!([WRONG]));
    let d = json(&["--exclude", "31"]);
    assert_eq!((&d["verdict"], &d["alternative"]), (&"adequate".into(), &Value::Null));
}

#[test]
fn a_line_without_a_reading_exits_with_3_and_what_is_no_line_with_2() {
    for (lines, said) in [("1", "line 1 of"), ("400-500", "lines 400-500 of")] {
        let output = diagnosed(&["--exclude", lines]);
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(3), "{stderr}");
        assert!(
            stderr.contains(said) && stderr.contains("next: ") && stderr.contains("lines 2 to 169"),
            "{stderr}"
        );
    }
    for lines in ["x", "15-12", ""] {
        assert_eq!(diagnosed(&["--exclude", lines]).status.code(), Some(2), "{lines}");
    }
}

#[test]
fn results_of_other_choices_are_not_compared_in_silence() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, more: &[&str]| {
        let path = folder.path().join(name).to_string_lossy().into_owned();
        diagnosed(&[more, &["--json", &path]].concat());
        path
    };
    let (a, b) = (file("a.json", &[]), file("b.json", &["--keep-all"]));
    let compared = text(hexbench_in("mujoco-clean").args(["runs", &a, &b]).output().unwrap());
    let words: Vec<&str> = compared.split_whitespace().collect();
    assert!(words.join(" ").contains("The readings were chosen differently"), "{compared}");
}

#[test]
fn a_number_in_another_unit_is_one_wrong_line_and_no_other_unit_of_the_file() {
    let words =
        |bytes: &[u8]| String::from_utf8_lossy(bytes).split_whitespace().collect::<Vec<_>>().join(" ");
    let checked = words(&run("check", 1e6, &[]).stdout);
    let wrong = format!("line {WRONG} is more than 1000 sigma away");
    assert!(checked.contains("NOT READY First correct what is wrong, as stated below."), "{checked}");
    assert!(
        checked.contains(&wrong) && checked.contains("mostly in db") && !checked.contains("--read-as"),
        "{checked}"
    );
    for command in ["fit", "compare"] {
        let warned = words(&run(command, 1e6, &[]).stderr);
        assert!(warned.contains(&format!("warning: {wrong}")), "{command}: {warned}");
    }
    let diagnosed = words(&run("diagnose", 1e6, &[]).stdout);
    assert!(diagnosed.contains(&wrong) && diagnosed.contains("MEASUREMENT"), "{diagnosed}");
}

#[test]
fn a_gross_number_is_kept_where_that_is_asked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("diagnosis.json");
    let answer = |more: &[&str]| {
        let page = text(run("diagnose", 5000.0, &[more, &["--json", path.to_str().unwrap()]].concat()));
        let told: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
        fs::remove_file(&path).unwrap();
        (told["steps"][0]["chi2_reduced"].as_f64().unwrap(), page)
    };
    let ((left_out, _), (kept, page)) = (answer(&[]), answer(&["--keep-all"]));
    assert!(left_out < 2.0 && kept > 100.0, "{left_out} {kept}");
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(page.contains("As requested, this reading is kept"), "{page}");
}

#[test]
fn the_model_saved_is_that_of_the_sound_readings() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.toml");
    let asked = ["-o", path.to_str().unwrap(), "--json", "-"];
    let told: Value = serde_json::from_str(&text(run("diagnose", 5000.0, &asked))).unwrap();
    let kept: toml::Table = toml::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
    assert_eq!(kept["data"]["excluded"].as_array().unwrap().len(), 1);
    let [wanted, std] = ["value", "std"].map(|key| told["parameters"][0][key].as_f64().unwrap());
    let saved = kept["leg"][0]["stiffness_N_per_um"].as_float().unwrap();
    // The page averages over the explanations that remain; all readings together are tens of standard deviations away.
    assert!((saved - wanted).abs() < std, "{saved} {wanted} +- {std}");
}

#[test]
fn a_requested_reading_that_makes_the_files_wrong_is_told_as_such() {
    let files = ["diagnose", "hexapod.toml", "measurements.csv", "--read-as", "deflection-sign=reversed"];
    let page = text(hexbench_in("paper-protocol").args(files).output().unwrap());
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(page.contains("To do: remove --read-as deflection-sign=reversed."), "{page}");
    assert!(!page.contains("correct the file"), "{page}");
}

#[test]
fn the_readings_to_take_next_are_written_as_a_run_sheet_and_the_model_is_saved_by_the_command_shown() {
    let folder = tempfile::tempdir().unwrap();
    let sheet = folder.path().join("next.csv");
    let run = |words: &[&str]| text(hexbench_in("paper-protocol").args(words).output().unwrap());
    let files = ["diagnose", "hexapod.toml", "measurements.csv"];
    run(&[&files[..], &["--next", sheet.to_str().unwrap()]].concat());
    let rows = fs::read_to_string(sheet).unwrap();
    assert!(rows.starts_with("note_row,pose,repeat,a_mm") && rows.lines().count() > 2, "{rows}");
    assert!(rows.lines().skip(1).all(|row| row.ends_with(",,,,,,")), "{rows}");
    let page = text(hexbench_in("mujoco-foundation").args(files).output().unwrap());
    assert!(page.contains("hexbench diagnose hexapod.toml measurements.csv -o model.toml"), "{page}");
}
