//! `hexbench power`: a plan before it is measured.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use hexbench_model::terms::catalogue;
use serde_json::Value;

use crate::scenes::simulate;
use crate::support::{complaint, hexbench, root, text};

/// The plan of a scene, as its measurements, in a folder of its own.
struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    fn of(scene: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        simulate(&root().join("scenes").join(scene), &folder.path().join("data"), &[]);
        Self { folder }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join("data").join(name)
    }

    fn power(&self, more: &[&str]) -> Output {
        power(&self.path("hexapod.toml"), &self.path("measurements.csv"), more)
    }
}

fn power(hexapod: &Path, plan: &Path, more: &[&str]) -> Output {
    hexbench().arg("power").arg(hexapod).arg(plan).args(more).output().unwrap()
}

fn refused(output: &Output, code: i32) -> String {
    let told = complaint(output);
    assert_eq!(output.status.code(), Some(code), "{told}");
    assert!(output.stdout.is_empty(), "nothing is told on standard output");
    told
}

/// A machine that states nothing but its joints, and a plan of one row for it.
fn bare(columns: &str, row: &str) -> (tempfile::TempDir, PathBuf, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let plan = folder.path().join("plan.csv");
    fs::write(&plan, format!("{columns}\n{row}\n")).unwrap();
    (folder, root().join("scenes/paper/hexapod.toml"), plan)
}

const COLUMNS: &str = "a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm";

#[test]
fn the_plan_of_the_paper_reads_as_before() {
    let page = text(Bench::of("paper").power(&[]));
    assert!(page.lines().all(|l| l.chars().count() <= 80), "{page}");
    insta::assert_snapshot!("power_paper", page);
}

#[test]
fn one_effect_is_told_in_detail_and_simulated() {
    let bench = Bench::of("paper-rich");
    let page = text(bench.power(&["--effect", "base-compliance", "--simulate", "10", "--verbose"]));
    assert!(page.lines().all(|l| l.chars().count() <= 80), "{page}");
    insta::assert_snapshot!("power_one_effect", page);
}

#[test]
fn figures_and_charts_are_written() {
    let bench = Bench::of("paper");
    let (json, charts, page) = (bench.path("power.json"), bench.path("charts"), bench.path("power.md"));
    let files = ["--json", json.to_str().unwrap(), "--markdown", page.to_str().unwrap()];
    text(bench.power(&[&files[..], &["--svg", charts.to_str().unwrap()]].concat()));
    let figures: Value = serde_json::from_str(&fs::read_to_string(&json).unwrap()).unwrap();
    assert_eq!(figures["format"], "power/1");
    assert_eq!(
        figures["effects"].as_array().unwrap().len() + figures["untestable"].as_array().unwrap().len(),
        catalogue().len()
    );
    assert!(fs::read_to_string(&page).unwrap().starts_with("# What this plan can detect\n"));
    for name in ["taken-for.svg", "cosine.svg", "power.svg"] {
        assert!(fs::read_to_string(charts.join(name)).unwrap().starts_with("<svg"), "{name}");
    }
}

#[test]
fn a_designed_plan_and_a_term_of_ones_own_are_understood() {
    let (folder, hexapod, _) = bare("", "");
    let (plan, own) = (folder.path().join("designed.csv"), folder.path().join("own.toml"));
    let space = root().join("data/designs/paper-space.toml");
    let mut design = hexbench();
    design.arg("design").arg(&hexapod).arg(space).args(["--starts", "2", "-o"]).arg(&plan);
    text(design.output().unwrap());
    fs::write(&own, OWN_TERM).unwrap();
    let page = text(power(
        &hexapod,
        &plan,
        &["--sigma", "0.5,3", "--term", own.to_str().unwrap(), "--simulate", "2"],
    ));
    assert!(page.contains("own-softening") && page.contains("no such effect"), "{page}");
    assert!(page.contains("No approach (or order) column: joint-friction."), "{page}");
}

const OWN_TERM: &str = r#"
format = "term/1"
id = "own-softening"
title = "Legs soften with the distance from the middle"
elongation = "s * df * (q - q_home)^2"
[[parameters]]
name = "s"
unit = "1/(N m)"
per_si = 1
scale = 1e-5
"#;

#[test]
fn absolute_poses_test_what_deflections_cannot() {
    let rows: Vec<String> = (0..12)
        .map(|k| {
            let [x, y, t] = [7 * k % 31 - 15, 11 * k % 29 - 14, 5 * k % 13 - 6];
            format!("{x},{y},{t},{},{t},{},0,0,-{},0,0,0", t / 2, x / 3, if k % 2 == 0 { 50 } else { 340 })
        })
        .collect();
    let (folder, hexapod, plan) = bare(COLUMNS, &rows.join("\n"));
    let map = folder.path().join("map.svg");
    let more = ["--sigma", "0.5,3", "--absolute", "--effect", "actuator-scale", "--svg"];
    let page = text(power(&hexapod, &plan, &[&more[..], &[map.to_str().unwrap()]].concat()));
    assert!(fs::read_to_string(map).unwrap().contains("Best explanation"));
    assert!(page.contains("absolute poses") && page.contains("actuator-scale"), "{page}");
    let deflections = text(power(&hexapod, &plan, &["--sigma", "0.5,3"]));
    let words = deflections.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("It needs absolute poses, not deflections: joint-geometry"), "{words}");
}

#[test]
fn a_plan_whose_noise_nobody_states_is_wrong_usage() {
    let (_folder, hexapod, plan) = bare(COLUMNS, "0,0,0,0,0,0,0,0,-100,0,0,0");
    let told = refused(&power(&hexapod, &plan, &[]), 2);
    assert!(told.contains("plan.csv") && told.contains("--sigma UM,URAD"), "{told}");
}

#[test]
fn a_bad_plan_is_told_with_its_place() {
    let (_folder, hexapod, plan) = bare(COLUMNS, "0,0,0,0,0,0,0,heavy,-100,0,0,0");
    let told = refused(&power(&hexapod, &plan, &["--sigma", "0.5,3"]), 3);
    for part in ["plan.csv", "line 2", "column 8", "fy_N", "heavy", "next: "] {
        assert!(told.contains(part), "{part} is missing in {told}");
    }
}

#[test]
fn a_plan_that_loads_nothing_determines_nothing() {
    let (_folder, hexapod, plan) = bare(COLUMNS, "0,0,0,0,0,0,0,0,0,0,0,0");
    let told = refused(&power(&hexapod, &plan, &["--sigma", "0.5,3"]), 4);
    assert!(told.contains("no leg changes its force") && told.contains("fx_N ... mz_Nm"), "{told}");
}

#[test]
fn arguments_that_make_no_sense_are_wrong_usage() {
    let row = "0,0,0,0,0,0,0,0,-100,0,0,0";
    let (_folder, hexapod, plan) = bare(COLUMNS, row);
    for (more, part) in [
        (&["--alarm", "0"][..], "0.0001 to 0.9999"),
        (&["--power", "nan"][..], "not finite"),
        (&["--sigma", "1"][..], "two with a comma between"),
        (&["--sigma", "1,-1"][..], "must be positive"),
        (&["--sigma", "1,1", "--effect", "base-complience"][..], "did you mean `base-compliance`?"),
        (&["--sigma", "1,1", "--noise-from-repeats"][..], "too few readings"),
        (&["--sigma", "1,1", "--simulate", "0"][..], "0 is not in"),
    ] {
        let told = refused(&power(&hexapod, &plan, more), 2);
        assert!(told.contains(part), "{part} is missing in {told}");
    }
    let references = "ref_fx_N,ref_fy_N,ref_fz_N,ref_mx_Nm,ref_my_Nm,ref_mz_Nm";
    let (_folder, hexapod, plan) = bare(&format!("{COLUMNS},{references}"), &format!("{row},0,0,0,0,0,0"));
    let told = refused(&power(&hexapod, &plan, &["--sigma", "1,1", "--absolute"]), 2);
    assert!(told.contains("no reference state"), "{told}");
}

#[test]
fn the_study_of_both_plans_writes_its_document_and_charts() {
    let folder = tempfile::tempdir().unwrap();
    let markdown = folder.path().join("docs/power.md");
    let mut command = hexbench();
    command.current_dir(root()).args(["validate", "power", "--campaigns", "1", "--markdown"]).arg(&markdown);
    let page = text(command.output().unwrap());
    assert!(page.contains("Three facts"), "{page}");
    let document = fs::read_to_string(&markdown).unwrap();
    let charts: Vec<&str> =
        document.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(path, _)| path).collect();
    assert_eq!(charts.len(), 6);
    for chart in charts {
        assert!(folder.path().join("docs").join(chart).is_file(), "{chart}");
    }
}

/// The six gauges of a scene, and half of them.
#[test]
fn sensors_of_the_machine_read_the_plan() {
    let folder = tempfile::tempdir().unwrap();
    let data = folder.path().join("data");
    crate::scenes::simulate(&root().join("scenes/granite"), &data, &[]);
    let machine = std::fs::read_to_string(data.join("hexapod.toml")).unwrap();
    // Its last table is that of the sensor t3.
    let fewer = &machine[..machine.rfind("[[sensor]]").unwrap()];
    std::fs::write(data.join("fewer.toml"), fewer).unwrap();
    let run = |machine: &str, more: &[&str]| {
        let mut command = hexbench();
        command.current_dir(&data).args(["power", machine, "measurements.csv", "--json", "-"]).args(more);
        command.output().unwrap()
    };
    let seen = |machine: &str| -> f64 {
        let found: serde_json::Value = serde_json::from_str(&text(run(machine, &[]))).unwrap();
        let effects = found["effects"].as_array().unwrap();
        let creep = effects.iter().find(|e| e["term"] == "creep").unwrap();
        creep["seen_at"]["middle"].as_f64().unwrap()
    };
    let [six, five] = [seen("hexapod.toml"), seen("fewer.toml")];
    assert!(six < five, "{six} with six gauges, {five} with five");
    let refused = run("hexapod.toml", &["--simulate", "10"]);
    let told = String::from_utf8(refused.stderr).unwrap();
    assert_eq!(refused.status.code(), Some(2), "{told}");
    assert!(told.contains("--simulate is for full poses"), "{told}");
}
