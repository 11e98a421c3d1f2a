//! Campaigns of gauges alone, through the commands: what they do not read is not told.

use std::path::{Path, PathBuf};

use crate::scenes::simulate;
use crate::support::{hexbench, root, text};

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
fn legs_are_told_where_six_gauges_determine_them_and_else_said_to_be_undetermined() {
    let folder = tempfile::tempdir().unwrap();
    let data = granite(folder.path());
    let compare = ["compare", "hexapod.toml", "measurements.csv"];
    let six = page(&data, &compare);
    assert!(section(&six, "Legs").iter().any(|line| line.contains("noise alone")), "{six}");
    without(&data, &["t3"]);
    let five = page(&data, &compare);
    let said = section(&five, "Legs").join(" ");
    assert!(said.contains("not determined by these readings"), "{five}");
    assert!(!five.contains("They follow no variable"), "{five}");
}
