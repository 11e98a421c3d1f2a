//! Names and cells of a stranger act neither on a terminal nor in a spreadsheet.

use std::fs;
use std::path::Path;

use crate::support::{complaint, hexbench, root};

/// Sets the title of a terminal, turns the direction of writing, clears the screen by a C1 character.
pub(crate) const HOSTILE: &str = "a\u{1b}]0;x\u{7}\u{202e}b\u{9b}2J";

pub(crate) fn is_harmless(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    !text.contains(|c: char| (c.is_control() && c != '\n') || ('\u{202a}'..='\u{202e}').contains(&c))
}

/// A machine and its readings, whose names are hostile; returns the name of the machine's file.
pub(crate) fn hostile_machine(folder: &Path) -> String {
    let case = root().join("data/cases/mujoco-clean");
    let text = fs::read_to_string(case.join("hexapod.toml")).unwrap();
    let letters: Vec<String> = HOSTILE.chars().map(|c| format!("\\U{:08X}", u32::from(c))).collect();
    let escaped = letters.concat();
    let lines = text
        .lines()
        .map(|line| if line.starts_with("name") { format!("name = \"{escaped}\"") } else { line.to_owned() });
    let text = lines.collect::<Vec<_>>().join("\n");
    assert!(text.contains(&escaped), "the machine has a name to replace");
    let file = format!("{HOSTILE}.toml");
    fs::write(folder.join(&file), text).unwrap();
    fs::copy(case.join("measurements.csv"), folder.join(format!("{HOSTILE}.csv"))).unwrap();
    file
}

#[cfg(unix)]
#[test]
fn no_page_lets_a_name_act_on_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let machine = hostile_machine(folder.path());
    let data = format!("{HOSTILE}.csv");
    for words in [
        &["check", &machine, &data][..],
        &["compare", &machine, &data],
        &["compare", &machine, &data, "--markdown", "-"],
        &["diagnose", &machine, &data, "--verbose"],
        &["fit", &machine, &data],
        &["power", &machine, &data],
    ] {
        let output = hexbench().current_dir(folder.path()).args(words).output().unwrap();
        assert!(output.status.success(), "{words:?}: {}", complaint(&output));
        assert!(is_harmless(&output.stdout) && is_harmless(&output.stderr), "{words:?}");
        if words.contains(&"check") {
            assert!(String::from_utf8_lossy(&output.stdout).contains("\\u{1b}]0;x\\u{7}\\u{202e}b"));
        }
    }
}

#[cfg(unix)]
#[test]
fn no_message_lets_a_name_or_a_cell_act_on_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let machine = hostile_machine(folder.path());
    fs::write(folder.path().join("bad.csv"), format!("{HOSTILE},b\n1,{HOSTILE}\n")).unwrap();
    fs::write(folder.path().join("bad.toml"), format!("format = \"{HOSTILE}\"\n")).unwrap();
    let absent = format!("{HOSTILE}-absent");
    let out = format!("{HOSTILE}/x.json");
    let data = format!("{HOSTILE}.csv");
    for words in [
        &["fit", &machine, "bad.csv"][..],
        &["fit", &machine, &absent],
        &["fit", &machine, &data, "-o", &machine],
        &["fit", "bad.toml", "bad.csv"],
        &["predict", "bad.toml", "bad.csv"],
        &["fit", &machine, &data, "--term", "bad.toml"],
        &["compare", &machine, &data, "--json", &out],
    ] {
        let output = hexbench().current_dir(folder.path()).args(words).output().unwrap();
        assert!(!output.status.success(), "{words:?}");
        let said = complaint(&output);
        assert!(is_harmless(&output.stdout) && is_harmless(&output.stderr), "{words:?}: {said:?}");
    }
}

#[test]
fn a_name_that_a_spreadsheet_would_run_is_a_text_and_a_negative_number_a_number() {
    let folder = tempfile::tempdir().unwrap();
    let places = [("p", 0.0, 0.0, 0.0), ("q", 100.0, 0.0, 0.0), ("r", 0.0, 100.0, 0.0)];
    let mut balls = vec!["record,ball,x_mm,y_mm,z_mm".to_owned()];
    for (record, shift) in [("ref", 0.0), ("=1+1", -0.5)] {
        balls.extend(places.map(|(ball, x, y, z)| format!("{record},{ball},{},{y},{z}", x + shift)));
    }
    fs::write(folder.path().join("balls.csv"), balls.join("\n") + "\n").unwrap();
    let words = ["poses", "balls.csv", "--relative-to", "ref", "--sigma-um", "1"];
    let output = hexbench().current_dir(folder.path()).args(words).output().unwrap();
    let table = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{}", complaint(&output));
    assert!(table.contains("\n'=1+1,-0.5"), "{table}");
}
