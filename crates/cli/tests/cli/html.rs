//! `--html` and `--charts`: pages that need nothing else, charts for papers.

use std::fs;
use std::path::Path;

use crate::json::diagnosis;
use crate::support::{cases, diagnose, hexbench, hexbench_in, root, text};

/// Pages are mailed around: the largest of the bundled cases.
const LARGEST_BYTES: usize = 480_000;
/// The page of the demo's case.
const LARGEST_OF_DEMO_BYTES: usize = 400_000;
/// A page of ten times the readings is at most this much larger: more of them are thinned.
const LARGEST_GROWTH: f64 = 1.5;

fn page(case: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("report.html");
    text(diagnose(case, &["--html", file.to_str().unwrap()]));
    fs::read_to_string(file).unwrap()
}

/// The page of `compare` with files of a case and more arguments.
fn comparison(case: &str, more: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("comparison.html");
    let command = ["compare", "hexapod.toml", "measurements.csv", "--html"];
    text(hexbench_in(case).args(command).arg(&file).args(more).output().unwrap());
    fs::read_to_string(file).unwrap()
}

/// Whole, small, drawn, and without anything from elsewhere.
pub(crate) fn assert_sound(html: &str, what: &str, charts: usize) {
    assert!(html.starts_with("<!doctype html>") && html.ends_with("</html>"), "{what}: cut");
    assert!(html.len() < LARGEST_BYTES, "{what}: {} bytes", html.len());
    let drawn = html.matches("<svg").count();
    assert!(drawn >= charts, "{what}: {drawn} charts");
    assert!(!html.contains("NaN") && !html.contains(">inf<"), "{what}: a number that is none");
    let elsewhere = html.replace("http://www.w3.org/", "");
    for sign in ["http:", "https:", "<script", "<link", "src=", "url("] {
        assert!(!elsewhere.contains(sign), "{what}: {sign}");
    }
}

#[test]
fn every_case_has_a_page_with_its_verdict_its_charts_and_nothing_from_elsewhere() {
    for case in cases() {
        let html = page(&case);
        assert_sound(&html, &case, 9);
        let verdict = diagnosis(&case)["verdict"].as_str().unwrap().to_uppercase();
        assert!(html.contains(&format!(">{verdict}</span>")), "{case}: no verdict");
    }
    let demo = page("mujoco-foundation").len();
    assert!(demo < LARGEST_OF_DEMO_BYTES, "{demo} bytes");
}

#[test]
fn every_case_can_be_compared_on_a_page() {
    for case in cases() {
        let html = comparison(&case, &["--holdout", "holdout.csv"]);
        assert_sound(&html, &case, 8);
        let adequate = case == "mujoco-clean";
        let word = if adequate { ">ADEQUATE</span>" } else { ">NOT ADEQUATE</span>" };
        assert!(html.contains(word), "{case}: not {word}");
        assert!(html.contains("held-out readings (") && html.contains("id=\"coordinates\""), "{case}");
    }
}

#[test]
fn a_saved_model_is_compared_on_a_page_under_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("model.toml");
    let fit = ["fit", "hexapod.toml", "measurements.csv", "--add", "base-compliance", "-o"];
    text(hexbench_in("mujoco-foundation").args(fit).arg(&model).output().unwrap());
    let html = comparison("mujoco-foundation", &["--model", model.to_str().unwrap()]);
    assert_sound(&html, "model", 8);
    assert!(html.contains("Compared: leg springs + base-compliance") && html.contains("the model leaves"));
    assert!(html.contains("As saved, nothing fitted here") && html.contains("model.toml"));
}

#[test]
fn a_period_is_drawn_where_there_is_one() {
    assert!(page("not-in-catalogue").contains("leg length within 8.0"));
    assert!(comparison("not-in-catalogue", &[]).contains("id=\"period\""));
    assert!(!page("mujoco-clean").contains("id=\"period\""));
}

#[test]
fn an_effect_that_is_a_curve_of_its_variable_is_drawn_as_one() {
    let html = page("friction");
    assert!(html.contains("joint-friction in each leg over change of leg force"));
    assert!(html.contains("the effect explains"));
    assert!(
        page("absolute-pitch")
            .contains("actuator-pitch in each leg over leg length within one period of 3.0")
    );
}

/// The readings of a case at so many times as many poses: each again a few micrometres further.
fn at_more_poses(case: &str, times: usize, file: &Path) {
    let rows = fs::read_to_string(root().join("data/cases").join(case).join("measurements.csv")).unwrap();
    let (head, rows) = rows.split_once('\n').unwrap();
    let moved = |row: &str, k: usize| {
        let mut cells: Vec<String> = row.split(',').map(str::to_owned).collect();
        cells[0] = (cells[0].parse::<usize>().unwrap() + 1000 * k).to_string();
        cells[2] = format!("{:.4}", cells[2].parse::<f64>().unwrap() + 0.003 * k as f64);
        cells.join(",")
    };
    let all = (0..times).flat_map(|k| rows.lines().map(move |row| moved(row, k)));
    fs::write(file, format!("{head}\n{}\n", all.collect::<Vec<_>>().join("\n"))).unwrap();
}

#[test]
fn more_readings_hardly_make_a_larger_page() {
    let folder = tempfile::tempdir().unwrap();
    let bytes = |times: usize| {
        let data = folder.path().join("measurements.csv");
        at_more_poses("mujoco-foundation", times, &data);
        let file = folder.path().join("comparison.html");
        let mut command = hexbench_in("mujoco-foundation");
        command.args(["compare", "hexapod.toml"]).arg(&data).arg("--html").arg(&file);
        text(command.output().unwrap());
        fs::metadata(file).unwrap().len() as f64
    };
    let (few, many) = (bytes(1), bytes(10));
    assert!(many < LARGEST_GROWTH * few, "{few} bytes become {many}");
}

#[test]
fn every_chart_of_the_page_becomes_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let charts = folder.path().join("deep/charts");
    text(diagnose("mujoco-foundation", &["--charts", charts.to_str().unwrap()]));
    let files = fs::read_dir(&charts).unwrap().map(|f| f.unwrap().path());
    let drawings = files.filter(|f| f.extension().is_some_and(|e| e == "svg")).count();
    for name in ["machine", "leg-space-map", "residuals-force", "predicted-errors", "correlation", "scatter"]
    {
        let svg = fs::read_to_string(charts.join(name).with_extension("svg")).unwrap();
        assert!(svg.starts_with("<svg") && !svg.contains("var(--"), "{name} stands alone");
        // A system without fonts has no pictures.
        let Ok(picture) = fs::read(charts.join(name).with_extension("png")) else { continue };
        assert!(picture.starts_with(b"\x89PNG"), "{name}");
    }
    assert_eq!(drawings, page("mujoco-foundation").matches("<figure>").count());
}

#[test]
fn names_in_files_are_text_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let case = root().join("data/cases/contact");
    let machine = fs::read_to_string(case.join("hexapod.toml")).unwrap();
    let named =
        machine.lines().map(|l| if l.starts_with("name") { "name = '<script>alert(1)</script>'" } else { l });
    let hexapod = folder.path().join("hexapod.toml");
    fs::write(&hexapod, named.collect::<Vec<_>>().join("\n")).unwrap();
    let arguments = [hexapod.as_path(), &case.join("measurements.csv")];
    for command in ["diagnose", "compare"] {
        let file = folder.path().join("report.html");
        text(hexbench().arg(command).args(arguments).arg("--html").arg(&file).output().unwrap());
        let html = fs::read_to_string(file).unwrap();
        assert!(html.contains("&lt;script&gt;alert(1)&lt;&#x2f;script&gt;") && !html.contains("<script>"));
    }
}

#[test]
fn the_story_of_a_thermal_effect_says_the_temperature() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let scene = root().join("scenes/hidden-5");
    text(hexbench().arg("simulate").arg(scene).args(["-o", &at("bench"), "-q"]).output().unwrap());
    let files = ["bench/hexapod.toml", "bench/measurements.csv"].map(at);
    text(hexbench().arg("diagnose").args(files).args(["--html", &at("page.html")]).output().unwrap());
    let page = fs::read_to_string(at("page.html")).unwrap();
    let caption = page.split("The load at which the added effects explain most").nth(1).unwrap();
    let said = &caption[..caption.find("Motions").unwrap()];
    assert!(said.contains("K warmer than at the reference") || said.contains("K colder than"), "{said}");
    assert!(!said.contains("after the reference"), "time does not act in this model: {said}");
}
