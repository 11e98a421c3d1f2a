//! `hexbench design`: the problem of the paper.

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
