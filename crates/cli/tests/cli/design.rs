//! `hexbench design`: the problem of the paper, and plans within a budget.

use hexbench_core::Approach;
use hexbench_core::files::read_conditions;

use crate::support::{hexbench, root, text};

fn design(more: &[&str]) -> String {
    let mut command = hexbench();
    command.current_dir(root()).args([
        "design",
        "scenes/paper/hexapod.toml",
        "data/designs/paper-space.toml",
    ]);
    text(command.args(more).output().unwrap())
}

#[test]
fn the_papers_problem_is_solved_with_turns_to_the_end_of_the_stroke() {
    let folder = tempfile::tempdir().unwrap();
    let plan = folder.path().join("plan.csv");
    let page = design(&["--starts", "32", "-o", plan.to_str().unwrap()]);
    assert!(page.lines().all(|l| l.chars().count() <= 80), "{page}");
    insta::assert_snapshot!("design_paper", page);
    let rows = std::fs::read_to_string(plan).unwrap();
    assert_eq!(rows.lines().count(), 1 + 3 * 3);
    assert!(rows.starts_with("pose,repeat,a_mm"), "{rows}");
}

#[test]
fn more_poses_inform_more_about_legs_that_soften_with_their_length() {
    let value = |poses: &str| -> f64 {
        let page = design(&[
            "--criterion",
            "d",
            "--add",
            "leg-length-compliance",
            "--starts",
            "4",
            "--poses",
            poses,
        ]);
        page.split("D = ").nth(1).unwrap().split_whitespace().next().unwrap().parse().unwrap()
    };
    assert!(value("6") > value("3"));
}

#[test]
fn a_range_the_wrong_way_round_is_told_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let space = folder.path().join("space.toml");
    let turned = "format = \"space/1\"\n[poses]\na_mm = [30, -30]\n[loads]\nmasses_kg = [10]\n";
    std::fs::write(&space, turned).unwrap();
    let output =
        hexbench().arg("design").arg(root().join("scenes/paper/hexapod.toml")).arg(&space).output().unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(3), "{told}");
    assert!(told.contains("the lowest comes first") && told.contains('3'), "{told}");
}

/// Effects that need conditions, within a budget in time, on a machine of stated noise.
fn effects(more: &[&str]) -> Vec<String> {
    let mut words = vec!["design", "data/cases/friction/hexapod.toml", "data/designs/effects-space.toml"];
    for term in ["metrology-drift", "creep", "thermal-expansion", "joint-friction"] {
        words.extend(["--add", term]);
    }
    words.extend(["--candidates", "64", "--starts", "4"]);
    words.iter().chain(more).map(ToString::to_string).collect()
}

#[test]
fn effects_that_need_waits_temperatures_and_both_approaches_are_determined_within_the_time() {
    let folder = tempfile::tempdir().unwrap();
    let plan = folder.path().join("plan.csv");
    let page =
        text(hexbench().current_dir(root()).args(effects(&["-o", plan.to_str().unwrap()])).output().unwrap());
    assert!(page.lines().all(|l| l.chars().count() <= 80), "{page}");
    insta::assert_snapshot!("design_effects", page);
    let read = read_conditions(&plan).unwrap().dataset;
    let (mut poses, mut seconds) = (Vec::new(), 0.0);
    for o in &read.observations {
        if !poses.contains(&o.pose) {
            poses.push(o.pose);
        }
        seconds += 40.0 + o.elapsed + if o.approach == Approach::Overloaded { 60.0 } else { 30.0 };
    }
    seconds += 120.0 * poses.len() as f64;
    assert!(seconds <= 3.0 * 3600.0, "{seconds} s");
    assert!(read.columns.approach && read.columns.delta_t && read.columns.elapsed);
}

#[test]
fn so_many_readings_are_chosen_as_are_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let plan = folder.path().join("plan.csv");
    let more = ["--readings", "30", "--starts", "4", "--criterion", "a", "-o", plan.to_str().unwrap()];
    let page = design(&more);
    assert!(page.contains("30 readings at") && page.contains("A-efficiency at least"), "{page}");
    assert_eq!(read_conditions(&plan).unwrap().dataset.observations.len(), 30);
}

/// Arguments after the machine and the space; exit code; what is said.
const REFUSED: [(&[&str], i32, &str); 6] = [
    (&["--readings", "60", "--hours", "3"], 2, "cannot be used with"),
    (&["--readings", "60", "--poses", "3"], 2, "cannot be used with"),
    (&["--readings", "0"], 2, "0 is not in 1..=2000"),
    (&["--hours", "-1"], 2, "a budget must be positive"),
    (&["--hours", "3"], 4, "takes no time"),
    (&["--readings", "30", "--add", "creep"], 4, "creep.fraction"),
];

#[test]
fn budgets_that_make_no_sense_are_told() {
    for (more, code, says) in REFUSED {
        let mut command = hexbench();
        command.current_dir(root()).args([
            "design",
            "scenes/paper/hexapod.toml",
            "data/designs/paper-space.toml",
        ]);
        let output = command.args(more).output().unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{more:?}: {told}");
        assert!(told.contains(says), "{more:?}: {told}");
    }
}

#[test]
fn loads_that_show_nothing_are_not_determined() {
    let folder = tempfile::tempdir().unwrap();
    let space = folder.path().join("space.toml");
    std::fs::write(
        &space,
        "format = \"space/1\"\n[poses]\na_mm = [-3, 3]\n[loads]\nwrenches_N_Nm = [[0, 0, 0, 0, 0, 0]]\n",
    )
    .unwrap();
    hexbench().arg("design").arg(root().join("scenes/paper/hexapod.toml")).arg(&space).assert().code(4);
}
