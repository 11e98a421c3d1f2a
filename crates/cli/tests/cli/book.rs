//! `hexbench runs` of three results and more: a campaign book.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::support::{complaint, hexbench, root, text};

/// Stiffness of leg 3 in `scenes/paper-rich`, and after something happened to it, N/um.
const LEG_3: [&str; 2] = ["2.7503", "2.55"];
const DATES: &str = "2026-01-12,2026-02-09,2026-03-10,2026-04-13,2026-05-11,2026-06-08";

/// The scene, with leg 3 as given.
fn scene(folder: &Path, leg: &str) -> PathBuf {
    let to = folder.join(format!("scene-{leg}"));
    let from = root().join("scenes/paper-rich");
    fs::create_dir_all(to.join("sealed")).unwrap();
    for file in ["scene.toml", "hexapod.toml"] {
        fs::copy(from.join(file), to.join(file)).unwrap();
    }
    let truth = fs::read_to_string(from.join("sealed/truth.toml")).unwrap();
    assert!(truth.contains(LEG_3[0]));
    fs::write(to.join("sealed/truth.toml"), truth.replace(LEG_3[0], leg)).unwrap();
    to
}

/// A campaign on a scene, fitted with the effect that is in it.
fn fitted(folder: &Path, scene: &Path, seed: usize) -> PathBuf {
    let bench = folder.join(format!("bench-{seed}"));
    let json = folder.join(format!("{seed}.json"));
    let of = |words: &[&str]| hexbench().current_dir(folder).args(words).output().unwrap();
    text(of(&[
        "simulate",
        scene.to_str().unwrap(),
        "--seed",
        &seed.to_string(),
        "-o",
        bench.to_str().unwrap(),
    ]));
    let file = |name: &str| bench.join(name).to_str().unwrap().to_owned();
    let [hexapod, data, holdout] = ["hexapod.toml", "measurements.csv", "holdout.csv"].map(file);
    let fit = [
        "fit",
        &hexapod,
        &data,
        "--holdout",
        &holdout,
        "--add",
        "base-compliance",
        "-o",
        "model.toml",
        "--json",
    ];
    text(of(&fit.iter().copied().chain([json.to_str().unwrap()]).collect::<Vec<_>>()));
    json
}

/// Six campaigns; leg 3 is as given in the last three.
fn campaigns(folder: &Path, last: &str) -> Vec<PathBuf> {
    let [first, last] = [LEG_3[0], last].map(|leg| scene(folder, leg));
    (1..=6).map(|seed| fitted(folder, if seed > 3 { &last } else { &first }, seed)).collect()
}

fn runs(files: &[PathBuf], more: &[&str]) -> std::process::Output {
    hexbench().arg("runs").args(files).args(more).output().unwrap()
}

fn words(page: &str) -> String {
    page.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn a_leg_that_grew_softer_is_named_with_its_date_and_everything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let files = campaigns(folder.path(), LEG_3[1]);
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let [html, json, table, charts] = ["book.html", "book.json", "book.csv", "charts"].map(path);
    let more = ["--dates", DATES, "--html", &html, "--json", &json, "--table", &table, "--charts", &charts];
    let page = text(runs(&files, &more));
    let told = words(&page);
    assert!(told.contains("What changed CHANGED Leg 3 is softer by 0."), "{page}");
    assert!(told.contains("since campaign 4 (2026-04-13)"), "{page}");
    assert!(
        told.contains("Check leg 3: joints, preload, drive, and any work done before campaign 4"),
        "{page}"
    );
    assert!(told.contains("at most 1 % of such books raise any alarm"), "{page}");
    assert!(page.lines().all(|l| l.chars().count() <= 80 || l.contains(".json")), "{page}");

    let html = fs::read_to_string(html).unwrap();
    assert_eq!(html.matches("<figure").count(), 3, "legs, error, effects");
    for chart in ["stiffness", "error", "effects"] {
        assert!(Path::new(&charts).join(chart).with_extension("svg").is_file(), "{chart}");
    }
    let numbers: Value = serde_json::from_str(&fs::read_to_string(json).unwrap()).unwrap();
    crate::schemas::check("book/1", std::slice::from_ref(&numbers));
    let charts = numbers["charts"].as_array().unwrap();
    let alarmed: Vec<_> = charts.iter().filter(|c| c["changes"] != Value::Array(Vec::new())).collect();
    let names: Vec<_> = alarmed.iter().map(|c| c["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["leg-3.stiffness"]);
    let size = alarmed[0]["changes"][0]["size"].as_f64().unwrap();
    let std = alarmed[0]["changes"][0]["std"].as_f64().unwrap();
    assert!((size + 0.2003).abs() < 4.0 * std, "{size} +- {std}");

    let table = fs::read_to_string(table).unwrap();
    let points: usize = charts.iter().map(|c| c["points"].as_array().unwrap().len()).sum();
    assert_eq!(table.lines().count(), points + 1);
    let row = table.lines().find(|l| l.starts_with("leg-3.stiffness,4,2026-04-13")).unwrap();
    assert!(row.ends_with(",yes"), "{row}");
    assert_eq!(runs(&files, &["--check"]).status.code(), Some(1));
}

#[test]
fn a_machine_that_stays_is_steady() {
    let folder = tempfile::tempdir().unwrap();
    let files = campaigns(folder.path(), LEG_3[0]);
    let page = text(runs(&files, &["--check"]));
    assert!(words(&page).contains("What changed STEADY None of 13 numbers changed significantly"), "{page}");
}

#[test]
fn dates_belong_to_books_and_are_as_many_as_results() {
    let folder = tempfile::tempdir().unwrap();
    let first = fitted(folder.path(), &scene(folder.path(), LEG_3[0]), 1);
    let complaint = |count: usize, more: &[&str]| {
        let output = runs(&vec![first.clone(); count], more);
        (output.status.code(), complaint(&output))
    };
    for (count, dates, reason) in [
        (2, "2026-01-01,2026-02-01", "are for campaign books"),
        (3, "2026-01-01", "has 1 dates for 3 results"),
        (3, "2026-01-01,2026-02-30,2026-03-01", "no month has this day"),
        (3, "yesterday", "a date is written as 2026-01-31"),
        (1, "2026-01-01", "2 values required"),
    ] {
        let (code, told) = complaint(count, &["--dates", dates]);
        assert_eq!(code, Some(2), "{told}");
        assert!(told.contains(reason), "{told}");
    }
    let page = text(runs(&vec![first.clone(); 3], &[]));
    assert!(
        words(&page).contains("Campaigns 1 and 3 have the same measurements, which therefore count twice."),
        "{page}"
    );
}
