//! `hexbench discover`: a law outside the catalogue, from files to a term that the diagnosis names.

use serde_json::Value;

use crate::support::{complaint, diagnose, hexbench, hexbench_in, root, text};

const CASE: &str = "not-in-catalogue";

fn discover(case: &str, more: &[&str]) -> std::process::Output {
    let files = ["discover", "hexapod.toml", "measurements.csv", "--holdout", "holdout.csv"];
    hexbench_in(case).args(files).args(more).output().unwrap()
}

#[test]
fn outside_then_a_law_then_named() {
    let folder = tempfile::tempdir().unwrap();
    let term = folder.path().join("term.toml");
    let term = term.to_str().unwrap();
    let outside = text(diagnose(CASE, &[]));
    assert!(outside.contains("OUTSIDE") && outside.contains("hexbench discover"), "{outside}");
    let page = text(discover(CASE, &["-o", term]));
    assert!(page.contains("LAW FOUND") && page.contains("8.00 mm"), "{page}");
    assert!(page.lines().all(|l| l.chars().count() <= 80), "{page}");
    let named = text(diagnose(CASE, &["--term", term, "--check=named"]));
    assert!(named.contains("which is at the level of the noise"), "{named}");
}

#[cfg(unix)]
#[test]
fn the_next_commands_work_as_they_are_pasted() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["hexapod.toml", "measurements.csv", "holdout.csv"] {
        std::fs::copy(root().join("data/cases").join(CASE).join(name), folder.path().join(name)).unwrap();
    }
    let words =
        ["discover", "hexapod.toml", "measurements.csv", "--holdout", "holdout.csv", "-o", "my law.toml"];
    let page = text(hexbench().current_dir(folder.path()).args(words).output().unwrap());
    let next = page.split("\nNext\n").nth(1).unwrap_or_else(|| panic!("{page}"));
    let commands: Vec<&str> = next
        .lines()
        .skip_while(|line| !line.trim_start().starts_with("hexbench"))
        .take_while(|line| line.contains("hexbench") || line.contains("--"))
        .collect();
    let program = std::path::Path::new(env!("CARGO_BIN_EXE_hexbench"));
    let path = format!("{}:{}", program.parent().unwrap().display(), std::env::var("PATH").unwrap());
    let mut shell = std::process::Command::new("sh");
    let script = format!("set -e\n{}", commands.join("\n"));
    let output = shell.args(["-c", &script]).env("PATH", path).current_dir(folder.path()).output().unwrap();
    assert!(output.status.success(), "{script}: {}", complaint(&output));
    assert!(
        String::from_utf8_lossy(&output.stdout).contains("which is at the level of the noise"),
        "{script}"
    );
    let model = std::fs::read_to_string(folder.path().join("model.toml")).unwrap();
    assert!(model.contains("sin(2*pi*q/period)"), "the model holds the law: {model}");
}

#[test]
fn a_diagnosis_outside_the_catalogue_proposes_the_law() {
    let page = text(diagnose(CASE, &[]));
    let said = page.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains("A law outside the catalogue explains it"), "{page}");
    assert!(said.contains("repeats every 8.00 mm") && said.contains("--term term.toml"), "{page}");
    let read = |output| serde_json::from_str::<Value>(&text(output)).unwrap();
    let (told, found) = (read(diagnose(CASE, &["--json", "-"])), read(discover(CASE, &["--json", "-"])));
    assert_eq!(told["law"], found["laws"][0]);
    assert!(read(diagnose("two-effects", &["--json", "-"]))["law"].is_null());
}

#[test]
fn the_file_of_a_discovery_has_its_keys() {
    let told: Value = serde_json::from_str(&text(discover(CASE, &["--json", "-"]))).unwrap();
    let none = serde_json::from_str(&text(discover("mujoco-clean", &["--json", "-"]))).unwrap();
    let case = ["discover", "hexapod.toml", "measurements.csv", "--json", "-"];
    let folder = root().join("data/cases/mujoco-clean");
    let alone = text(hexbench().current_dir(folder).args(case).output().unwrap());
    crate::schemas::check("discovery/1", &[told.clone(), none, serde_json::from_str(&alone).unwrap()]);
    assert_eq!((&told["found"], &told["reason"]), (&Value::from(true), &Value::from("law")));
    let law = &told["laws"][0];
    assert_eq!(
        (&law["id"], &law["kind"], &law["legs"]),
        (&"law-1".into(), &"elongation".into(), &"all".into())
    );
    assert!(law["formula"].as_str().unwrap().contains("sin(2*pi*q/period)"), "{law}");
    assert!(law["held_out"]["after"].as_f64() < law["held_out"]["before"].as_f64(), "{law}");
    assert_eq!(law["look_at"].as_array().map(Vec::len), Some(3));
}

#[test]
fn the_page_for_a_browser_shows_the_law_through_the_residuals() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("page.html");
    text(discover(CASE, &["--html", path.to_str().unwrap()]));
    let page = std::fs::read_to_string(path).unwrap();
    for piece in ["LAW FOUND", "folded at that period", "Periodogram"] {
        assert!(page.contains(piece), "{piece}");
    }
}

/// On a machine of nearly equal legs a law of all legs fits as well as the creep that is hidden.
#[test]
fn an_effect_of_the_catalogue_that_does_as_well_as_a_law_wins() {
    let folder = tempfile::tempdir().unwrap();
    let bench = folder.path().join("bench");
    text(
        hexbench().arg("simulate").arg(root().join("scenes/granite")).arg("-o").arg(&bench).output().unwrap(),
    );
    let files = ["discover", "hexapod.toml", "measurements.csv", "--holdout", "holdout.csv"];
    let page = text(hexbench().current_dir(&bench).args(files).output().unwrap());
    assert!(page.contains("NO LAW NEEDED") && page.contains("The catalogue explains it: creep."), "{page}");
    assert!(page.lines().any(|l| l.trim_start().starts_with("searched") && l.ends_with("laws")), "{page}");
}

/// The law that `discover` would write for a machine of equal legs that creep.
const SETTLING: &str = r#"
format = "term/1"
id = "compliance-settling"
title = "The compliance of all legs grows with time towards an end value"
prior = 0.0005
elongation = "size*df*(1 - exp(-elapsed/tau))"
[[parameters]]
name = "size"
unit = "nm/N"
scale = 320
[shape]
name = "tau"
unit = "s"
bounds = [15, 250]
grid = [30, 35, 40, 45, 50, 55, 60, 65, 70, 80, 90, 100, 120]
"#;

/// The grid of time constants on which creep competes is coarser than that of the law: both are judged by those they are fitted with.
#[test]
fn an_effect_is_judged_by_the_shape_it_is_fitted_with() {
    let folder = tempfile::tempdir().unwrap();
    let bench = folder.path().join("bench");
    text(
        hexbench().arg("simulate").arg(root().join("scenes/granite")).arg("-o").arg(&bench).output().unwrap(),
    );
    std::fs::write(bench.join("law.toml"), SETTLING).unwrap();
    let files = ["diagnose", "hexapod.toml", "measurements.csv", "--term", "law.toml", "--json", "-"];
    let told: Value =
        serde_json::from_str(&text(hexbench().current_dir(&bench).args(files).output().unwrap())).unwrap();
    let candidates = told["candidates"].as_array().unwrap();
    let creep = candidates.iter().find(|c| c["term"] == "creep").unwrap();
    assert!(creep["probability"].as_f64().unwrap() > 0.01, "{candidates:?}");
}

#[test]
fn without_a_law_no_term_file_is_written_and_the_page_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let term = folder.path().join("term.toml");
    let output = discover("mujoco-clean", &["-o", term.to_str().unwrap()]);
    let told = complaint(&output);
    assert!(text(output).contains("Nothing is missing"), "{told}");
    assert!(told.contains("no law was found") && !term.exists(), "{told}");
}

/// Lines of the section of README.md about laws, each with the word after its `#`.
fn second_story() -> Vec<(Vec<String>, Option<String>)> {
    let readme = std::fs::read_to_string(root().join("README.md")).unwrap();
    let section = readme.split("## A law outside the catalogue").nth(1).unwrap();
    let block = section.split("```").nth(1).unwrap();
    let line = |l: &str| {
        let (command, word) = l.split_once('#').unwrap_or((l, ""));
        let word = word.trim().split([':', '\n']).next().filter(|w| w.chars().any(char::is_uppercase));
        (command.split_whitespace().map(str::to_owned).collect(), word.map(str::to_owned))
    };
    block.lines().skip(1).map(line).collect()
}

#[test]
fn the_second_story_of_the_readme_works_as_pasted_and_is_that_of_the_demo() {
    let lines = second_story();
    assert_eq!(lines.len(), 5);
    let demo = text(hexbench().args(["demo", "--no-report"]).output().unwrap());
    let on_one_line = demo.split_whitespace().collect::<Vec<_>>().join(" ");
    let folder = tempfile::tempdir().unwrap();
    for file in ["hexapod.toml", "measurements.csv", "holdout.csv"] {
        let case = root().join(&lines[0].0[1]).join(file);
        std::fs::copy(case, folder.path().join(file)).unwrap();
    }
    for (command, word) in &lines {
        assert!(on_one_line.contains(&command.join(" ")), "{demo}");
        if command[0] == "hexbench" {
            let page = text(hexbench().args(&command[1..]).current_dir(folder.path()).output().unwrap());
            assert!(page.contains(word.as_deref().unwrap_or_default()), "{word:?}: {page}");
        }
    }
    assert!(folder.path().join("model.toml").is_file());
}

/// Where readings may lie that tell laws of time apart.
const SPACE: &str = r#"format = "space/1"
[poses]
a_mm = [-10, 10]
b_mm = [-10, 10]
c_mm = [-5, 5]
alpha_deg = [-3, 3]
beta_deg = [-3, 3]
gamma_deg = [-3, 3]
[loads]
reference_N_Nm = [0, 0, -120, 0, 0, 0]
wrenches_N_Nm = [[0, 0, -338, 0, 0, 0], [100, 0, -120, 0, 0, 0]]
[conditions]
elapsed_s = [5, 3000]
"#;

/// A scene in which one leg drifts, so little that a line, a logarithm and an approach to an end value look alike.
fn drifting(folder: &std::path::Path) -> String {
    let scene = folder.join("scene");
    std::fs::create_dir_all(scene.join("sealed")).unwrap();
    for file in ["scene.toml", "hexapod.toml"] {
        std::fs::copy(root().join("scenes/hidden-3").join(file), scene.join(file)).unwrap();
    }
    let truth = "format = \"truth/1\"\nleg_stiffness_N_per_um = [4, 4.3, 3.8, 4.1, 3.9, 4.2]\n\n\
                 [[effect]]\nid = \"out:leg-drift\"\nleg = 4\nrate = 4e-9\n";
    std::fs::write(scene.join("sealed/truth.toml"), truth).unwrap();
    scene.to_str().unwrap().to_owned()
}

#[test]
fn laws_that_look_alike_are_told_with_readings_that_separate_them_and_discriminate_takes_their_files() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    text(
        hexbench()
            .args(["simulate", &drifting(folder.path()), "-o", &at("case"), "--seed", "5"])
            .output()
            .unwrap(),
    );
    let [hexapod, data, holdout] =
        ["hexapod.toml", "measurements.csv", "holdout.csv"].map(|name| at(&format!("case/{name}")));
    let files =
        ["discover", &hexapod, &data, "--holdout", &holdout, "--all", &at("laws"), "--json", &at("d.json")];
    let page = text(hexbench().args(files).output().unwrap());
    let told: Value = serde_json::from_str(&std::fs::read_to_string(at("d.json")).unwrap()).unwrap();
    assert!(told["laws"].as_array().unwrap().len() > 1, "{page}");
    assert!(!told["next"].as_array().unwrap().is_empty() && page.contains("What to measure next"), "{page}");
    let [first, second] = [0, 1].map(|k| told["laws"][k]["term"].as_str().unwrap().to_owned());
    let space = at("space.toml");
    std::fs::write(&space, SPACE).unwrap();
    let separated = hexbench()
        .args(["discriminate", &hexapod, &space, "--readings", "2", "--json", "-"])
        .args(["--term", &at("laws/law-1.toml"), "--term", &at("laws/law-2.toml")])
        .args(["--between", &first, "--between", &second])
        .output()
        .unwrap();
    let separated: Value = serde_json::from_str(&text(separated)).unwrap();
    assert_eq!(separated["readings"].as_array().unwrap().len(), 2, "{separated}");
}
