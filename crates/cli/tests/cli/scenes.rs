//! The virtual bench through the command: every hidden effect must be found, and nothing told before.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::support::{complaint, hexbench, root, text};

/// Scenes whose effects a diagnosis of their own plan must name; the others say in their README what to expect.
fn hidden() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(root().join("scenes")).unwrap().map(|entry| entry.unwrap().path());
    let mut folders: Vec<PathBuf> = entries
        .filter(|path| path.file_name().is_some_and(|n| n.to_string_lossy().starts_with("hidden-")))
        .collect();
    folders.sort();
    assert!(folders.len() >= 10, "{folders:?}");
    folders
}

pub(crate) fn simulate(scene: &Path, into: &Path, more: &[&str]) -> String {
    text(hexbench().arg("simulate").arg(scene).arg("-o").arg(into).args(more).output().unwrap())
}

fn read(path: &Path) -> Vec<u8> {
    std::fs::read(path).unwrap_or_else(|cause| panic!("{}: {cause}", path.display()))
}

fn json(path: &Path) -> Value {
    serde_json::from_slice(&read(path)).unwrap()
}

fn words(list: &Value) -> Vec<&str> {
    let mut words: Vec<&str> = list.as_array().unwrap().iter().map(|w| w.as_str().unwrap()).collect();
    words.sort_unstable();
    words
}

/// Verdict and names that a truth calls for.
fn expected(truth: &Value) -> (&'static str, Vec<&str>) {
    let effects = words(&truth["effects"]);
    if effects.is_empty() {
        ("adequate", effects)
    } else if effects.iter().any(|id| id.starts_with("out:")) {
        ("outside", Vec::new())
    } else {
        ("named", effects)
    }
}

fn found_in(scene: &Path) {
    let folder = tempfile::tempdir().unwrap();
    let data = folder.path().join("data");
    simulate(scene, &data, &[]);
    let files = ["hexapod.toml", "measurements.csv", "--holdout", "holdout.csv", "--json", "diagnosis.json"];
    text(hexbench().current_dir(&data).arg("diagnose").args(files).output().unwrap());
    let (diagnosis, truth) = (json(&data.join("diagnosis.json")), json(&data.join("sealed/truth.json")));
    let (verdict, effects) = expected(&truth);
    assert_eq!(diagnosis["verdict"], verdict, "{}: {}", scene.display(), diagnosis["credible_set"]);
    if verdict != "outside" {
        assert_eq!(words(&diagnosis["added"]), effects, "{}", scene.display());
    }
}

#[test]
fn every_hidden_effect_is_found_by_name_and_nothing_else_is() {
    std::thread::scope(|scope| {
        let runs: Vec<_> = hidden().into_iter().map(|scene| scope.spawn(move || found_in(&scene))).collect();
        for run in runs {
            run.join().unwrap();
        }
    });
}

/// The truth is found by six distances alone.
#[test]
fn what_is_hidden_on_the_granite_table_is_found_by_its_gauges() {
    found_in(&root().join("scenes/granite"));
}

#[test]
fn the_same_seed_gives_the_same_bytes_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let run = |threads: &str, seed: &str| {
        let into = folder.path().join(format!("{threads}-{seed}"));
        let mut command = hexbench();
        command.env("RAYON_NUM_THREADS", threads).arg("simulate").arg(root().join("scenes/paper"));
        text(command.arg("-o").arg(&into).args(["--seed", seed, "--repeats", "2500"]).output().unwrap());
        ["hexapod.toml", "measurements.csv", "holdout.csv", "balls.csv", "balls.toml", "sealed/truth.json"]
            .map(|name| read(&into.join(name)))
    };
    let one = run("1", "5");
    assert!(one == run("2", "5"));
    assert!(one[1] != run("2", "6")[1]);
    assert_eq!(one[1].split(|byte| *byte == b'\n').count(), 7502);
}

#[test]
fn more_rows_do_not_change_the_rows_before() {
    let folder = tempfile::tempdir().unwrap();
    let rows = |poses: &str| {
        let into = folder.path().join(poses);
        simulate(&root().join("scenes/hidden-2"), &into, &["--poses", poses]);
        String::from_utf8(read(&into.join("measurements.csv"))).unwrap()
    };
    assert!(rows("40").starts_with(&rows("9")));
}

#[test]
fn the_page_tells_what_was_done_and_not_what_is_hidden() {
    let folder = tempfile::tempdir().unwrap();
    let run = |name: &str, more: &[&str]| {
        let arguments = ["simulate".to_owned(), root().join("scenes/hidden-6").display().to_string()];
        let mut command = hexbench();
        command.current_dir(folder.path()).args(arguments).args(["-o", name]).args(more);
        text(command.output().unwrap())
    };
    let page = run("data", &[]);
    assert!(page.lines().all(|line| line.chars().count() <= 80), "{page}");
    insta::assert_snapshot!("simulate_hidden_6", page);
    for word in ["joint-friction", "load-offset", "friction", "offset"] {
        assert!(!page.contains(word), "{page}");
    }
    let revealed = run("told", &["--reveal"]);
    assert!(revealed.contains("load-offset and joint-friction"), "{revealed}");
}

#[test]
fn nothing_outside_the_sealed_folder_tells_the_effect() {
    let folder = tempfile::tempdir().unwrap();
    let data = folder.path().join("data");
    simulate(&root().join("scenes/hidden-6"), &data, &[]);
    for file in ["hexapod.toml", "measurements.csv", "holdout.csv"] {
        let text = String::from_utf8(read(&data.join(file))).unwrap();
        assert!(!text.contains("friction") && !text.contains("load-offset"), "{file}");
    }
    for scene in hidden() {
        let told = String::from_utf8(read(&scene.join("scene.toml"))).unwrap()
            + &String::from_utf8(read(&scene.join("README.md"))).unwrap()
            + &String::from_utf8(read(&scene.join("hexapod.toml"))).unwrap();
        let truth = String::from_utf8(read(&scene.join("sealed/truth.toml"))).unwrap();
        for id in truth.lines().filter_map(|line| line.strip_prefix("id = ")) {
            assert!(!told.contains(id.trim_matches('"')), "{} tells {id}", scene.display());
        }
    }
}

#[test]
fn without_noise_repeats_are_equal() {
    let folder = tempfile::tempdir().unwrap();
    let data = folder.path().join("data");
    let page = simulate(&root().join("scenes/hidden-4"), &data, &["--noise-free"]);
    assert!(page.contains("noise    none"), "{page}");
    let table = String::from_utf8(read(&data.join("measurements.csv"))).unwrap();
    let without_repeat = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        [&cells[..1], &cells[2..]].concat().join(",")
    };
    let rows: Vec<String> = table.lines().skip(1).map(without_repeat).collect();
    assert!(rows.chunks(2).all(|pair| pair[0] == pair[1]));
}

#[test]
fn a_folder_with_something_in_it_is_left_alone_unless_forced() {
    let folder = tempfile::tempdir().unwrap();
    let note = folder.path().join("note.txt");
    std::fs::write(&note, "mine").unwrap();
    let run = |more: &[&str]| {
        let mut command = hexbench();
        command.arg("simulate").arg(root().join("scenes/paper")).arg("-o").arg(folder.path());
        command.args(more).output().unwrap()
    };
    let refused = run(&[]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(complaint(&refused).contains("--force"));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    assert_eq!(run(&["--force"]).status.code(), Some(0));
    assert!(note.is_file() && folder.path().join("sealed/truth.json").is_file());
}

#[test]
fn what_cannot_be_simulated_has_its_exit_code_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let scene = |name: &str| root().join("scenes").join(name).display().to_string();
    let far = folder.path().join("far");
    std::fs::create_dir_all(far.join("sealed")).unwrap();
    for file in ["hexapod.toml", "sealed/truth.toml"] {
        std::fs::copy(root().join("scenes/hidden-2").join(file), far.join(file)).unwrap();
    }
    let description = String::from_utf8(read(&root().join("scenes/hidden-2/scene.toml"))).unwrap();
    let lifted = description.replace(
        "make = \"rich\"",
        "make = \"rich\"\ntravel_mm = [0, 0, 0.001]\nloads_N_Nm = [[0, 0, 1e9, 0, 0, 0]]",
    );
    std::fs::write(far.join("scene.toml"), lifted).unwrap();
    let far = far.display().to_string();
    let table: [(&[&str], i32, &str); 5] = [
        (&[&scene("none")], 5, "there is no such file"),
        (&[&scene("paper"), "--poses", "7"], 2, "listed one by one"),
        (&[&scene("hidden-2"), "--poses", "0"], 2, "would have 0 rows"),
        (&[&scene("hidden-2"), "--repeats", "1000000000"], 2, "rows; it must have 1 to"),
        (&[&far], 3, "training row 1 (pose 1): the platform gave way"),
    ];
    for (arguments, code, message) in table {
        let into = folder.path().join("out");
        let output = hexbench().arg("simulate").args(arguments).arg("-o").arg(&into).output().unwrap();
        let said = complaint(&output);
        assert_eq!(output.status.code(), Some(code), "{said}");
        assert!(said.contains(message) && said.contains("next: "), "{said}");
        assert!(!into.exists() && std::fs::read_dir(folder.path()).unwrap().count() == 1, "{said}");
    }
}
