//! Campaigns of gauges alone, through the commands: what they do not read is not told.

use std::path::{Path, PathBuf};

use crate::scenes::simulate;
use crate::support::{complaint, hexbench, root, text};

/// Six gauges on a granite table, simulated into a folder.
fn granite(folder: &Path) -> PathBuf {
    let data = folder.join("data");
    simulate(&root().join("scenes/granite"), &data, &[]);
    data
}

fn page(data: &Path, arguments: &[&str]) -> String {
    text(hexbench().current_dir(data).args(arguments).output().unwrap())
}

/// The lines of a page from a title to the next empty line.
fn section<'a>(page: &'a str, title: &str) -> Vec<&'a str> {
    page.lines().skip_while(|line| !line.starts_with(title)).take_while(|line| !line.is_empty()).collect()
}

/// The file without the columns of these sensors, and the machine without their tables.
fn without(data: &Path, sensors: &[&str]) {
    let file = data.join("measurements.csv");
    let table = std::fs::read_to_string(&file).unwrap();
    let header: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    let stays = |k: &usize| !sensors.iter().any(|s| header[*k] == format!("{s}_um"));
    let kept: Vec<usize> = (0..header.len()).filter(stays).collect();
    assert_eq!(kept.len() + sensors.len(), header.len());
    let cut = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        kept.iter().map(|&k| cells[k]).collect::<Vec<_>>().join(",") + "\n"
    };
    std::fs::write(&file, table.lines().map(cut).collect::<String>()).unwrap();
    let machine = data.join("hexapod.toml");
    let tables = std::fs::read_to_string(&machine).unwrap();
    let stays = |table: &&str| !sensors.iter().any(|s| table.contains(&format!("name = \"{s}\"")));
    let kept: Vec<&str> = tables.split("[[sensor]]").filter(stays).collect();
    std::fs::write(&machine, kept.join("[[sensor]]")).unwrap();
}

#[test]
fn no_angle_is_told_of_gauges_that_read_lengths() {
    let folder = tempfile::tempdir().unwrap();
    let data = granite(folder.path());
    let files = ["hexapod.toml", "measurements.csv", "--holdout", "holdout.csv"];
    let with = |command: &[&'static str]| [command, &files].concat();
    let json = page(&data, &[&with(&["diagnose"])[..], &["--json", "a.json"]].concat());
    assert!(!json.contains("urad per reading"), "{json}");
    for (command, title) in
        [(&["compare"][..], "The error"), (&["fit"], "Errors"), (&["diagnose"], "The error falls")]
    {
        let page = page(&data, &with(command));
        let errors = section(&page, title);
        assert!(errors.len() > 2 && errors.iter().all(|line| !line.contains("urad")), "{page}");
        let about: Vec<&str> = page.lines().take_while(|line| !line.is_empty()).collect();
        assert!(about.iter().all(|line| !line.contains("urad")), "{page}");
    }
    let runs = page(&data, &["runs", "a.json", "a.json"]);
    let errors = section(&runs, "The error");
    assert!(errors.len() > 2 && errors.iter().all(|line| !line.contains("urad")), "{runs}");
    let diagnosis: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(data.join("a.json")).unwrap()).unwrap();
    for errors in [&diagnosis["noise"], &diagnosis["steps"][0]["rms"]] {
        assert!(errors["rotation_urad"].is_null() && errors["translation_um"].is_number(), "{errors}");
    }
}

#[test]
fn the_papers_estimator_takes_no_gauges_for_pose_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let data = granite(folder.path());
    let fit = ["fit", "hexapod.toml", "measurements.csv", "--estimator", "paper"];
    let refused = hexbench().current_dir(&data).args(fit).output().unwrap();
    let told = String::from_utf8(refused.stderr).unwrap();
    assert!(!refused.status.success() && told.contains("sensors and poses with empty cells need"), "{told}");
}

#[test]
fn legs_are_told_where_six_gauges_determine_them_and_else_said_to_be_undetermined() {
    let folder = tempfile::tempdir().unwrap();
    let data = granite(folder.path());
    let compare = ["compare", "hexapod.toml", "measurements.csv"];
    let six = page(&data, &compare);
    assert!(section(&six, "Legs").iter().any(|line| line.contains("noise alone")), "{six}");
    without(&data, &["t3"]);
    let five = page(&data, &compare);
    let said = section(&five, "Legs").join(" ");
    assert!(said.contains("These readings do not determine"), "{five}");
    assert!(!five.contains("They correlate significantly with no variable"), "{five}");
}

#[test]
fn poses_are_planned_for_the_gauges_that_will_read_them() {
    let folder = tempfile::tempdir().unwrap();
    let data = granite(folder.path());
    let space = "format = \"space/1\"\n[poses]\na_mm = [-20, 20]\ngamma_deg = [-10, 10]\n[loads]\nreference_kg = 12\nmasses_kg = [34]\n";
    std::fs::write(data.join("space.toml"), space).unwrap();
    let design = ["design", "hexapod.toml", "space.toml", "--poses", "3", "--starts", "1"];
    let between = ["--between", "base-compliance", "--between", "platform-compliance"];
    let discriminate = [&["discriminate", "hexapod.toml", "space.toml"][..], &between].concat();
    let words = |command: &[&str]| page(&data, command).split_whitespace().collect::<Vec<_>>().join(" ");
    for command in [&design[..], &discriminate] {
        let said = words(command);
        assert!(
            said.contains("Every reading is taken by z1, z2, z3, t1, t2 and t3 of the hexapod file"),
            "{said}"
        );
    }
    // In units of what the gauges state, though nothing is stated of poses.
    let sure = |said: &str| said.contains("What it will determine") && said.contains("leg-6.stiffness");
    assert!(sure(&words(&design)));
    without(&data, &["t1", "t2", "t3"]);
    let said = words(&design);
    assert!(said.contains("Every reading is taken by z1, z2 and z3"), "{said}");
    assert!(said.contains("O1 = ") && !said.contains("m and rad side by side"), "{said}");
}

#[test]
fn measured_columns_of_gauges_are_passed_over_in_silence_where_poses_are_predicted() {
    let folder = tempfile::tempdir().unwrap();
    let data = granite(folder.path());
    page(&data, &["fit", "hexapod.toml", "measurements.csv", "-o", "model.toml"]);
    let told =
        hexbench().current_dir(&data).args(["predict", "model.toml", "measurements.csv"]).output().unwrap();
    assert!(told.status.success() && told.stderr.is_empty(), "{}", complaint(&told));
}

#[test]
fn a_page_draws_single_legs_where_gauges_tell_of_them_and_says_so_where_not() {
    let folder = tempfile::tempdir().unwrap();
    let data = granite(folder.path());
    let drawn = |name: &str| {
        page(&data, &["diagnose", "hexapod.toml", "measurements.csv", "--html", name]);
        std::fs::read_to_string(data.join(name)).unwrap()
    };
    let charts = ["id=\"leg-space\"", "id=\"residuals\"", "id=\"machine\""];
    let six = drawn("six.html");
    assert!(charts.iter().all(|chart| six.contains(chart)) && !six.contains("id=\"single-legs\""));
    without(&data, &["t3"]);
    let five = drawn("five.html");
    assert!(charts.iter().all(|chart| !five.contains(chart)), "legs that five numbers cannot tell are drawn");
    assert!(five.contains("id=\"single-legs\"") && five.contains("Not determined by these readings"));
}
