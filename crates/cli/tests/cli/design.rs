//! `hexbench design`: the problem of the paper, and plans within a budget.

use hexbench_core::Approach;
use hexbench_core::files::read_conditions;

use crate::support::{complaint, hexbench, root, text};

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

/// Kalas et al. 2018: thirteen variables, of which the load is best at its largest ("the index O1 increased with increased magnitude of dF3").
#[test]
fn the_thirteenth_variable_of_the_paper_is_best_at_the_largest_mass() {
    /// As starts count as agreeing.
    const FOUR_DIGITS: f64 = 1e-4;
    let folder = tempfile::tempdir().unwrap();
    let plan = folder.path().join("plan.csv");
    let space = "data/designs/paper-loads-space.toml";
    let options = ["--starts", "32", "-o", plan.to_str().unwrap()];
    let page = text(
        hexbench()
            .current_dir(root())
            .args(["design", "scenes/paper/hexapod.toml", space])
            .args(options)
            .output()
            .unwrap(),
    );
    assert!(page.lines().all(|l| l.chars().count() <= 80), "{page}");
    insta::assert_snapshot!("design_paper_loads", page);
    let value = |page: &str| -> f64 {
        page.split("O1 = ").nth(1).unwrap().split_whitespace().next().unwrap().parse().unwrap()
    };
    let given = value(&design(&["--starts", "32"]));
    assert!((value(&page) / given - 1.0).abs() < FOUR_DIGITS, "{} {given}", value(&page));
    let read = read_conditions(&plan).unwrap().dataset;
    // To the bit: rounding stays at the bound.
    assert!(read.observations.iter().all(|o| o.wrench.force.z.to_bits() == (-34.5 * 9.806_65_f64).to_bits()));
}

/// Two loads in three parts each, some of which are best inside their ranges.
#[test]
fn loads_chosen_within_a_budget_are_better_than_their_corners_and_keep_their_bounds() {
    let folder = tempfile::tempdir().unwrap();
    let [space, plan] = ["space.toml", "plan.csv"].map(|n| folder.path().join(n));
    let poses =
        "format = \"space/1\"\n[poses]\na_mm = [-20, 20]\nb_mm = [-20, 20]\ngamma_deg = [-20, 20]\n[loads]\n";
    let found = |loads: &str| -> (f64, String) {
        std::fs::write(&space, format!("{poses}{loads}")).unwrap();
        let mut command = hexbench();
        command.arg("design").arg(root().join("scenes/paper/hexapod.toml")).arg(&space);
        command.args(["--criterion", "a", "--readings", "8", "--candidates", "32", "--starts", "4", "-o"]);
        let page = text(command.arg(&plan).output().unwrap());
        let value = page.split("A = ").nth(1).unwrap().split_whitespace().next().unwrap().parse().unwrap();
        (value, page)
    };
    let corner = |k: usize| {
        let end = |bit: usize, ends: [i32; 2]| ends[k >> bit & 1];
        format!("[{}, 0, {}, 0, {}, 0]", end(0, [-60, 30]), end(1, [-300, -90]), end(2, [-8, 5]))
    };
    let corners: Vec<String> = (0..8).map(corner).collect();
    let (listed, _) = found(&format!("wrenches_N_Nm = [{}]\n", corners.join(", ")));
    let (chosen, page) = found("[[loads.between]]\nfx_N = [-60, 30]\nfz_N = [-300, -90]\nmy_Nm = [-8, 5]\n");
    assert!(chosen >= listed && page.contains("is chosen: fx"), "{chosen} {listed}\n{page}");
    for o in &read_conditions(&plan).unwrap().dataset.observations {
        let [fx, fy, fz, mx, my, mz] = o.wrench.to_array();
        let inside =
            (-60.0..=30.0).contains(&fx) && (-300.0..=-90.0).contains(&fz) && (-8.0..=5.0).contains(&my);
        assert!(inside && [fy, mx, mz].iter().all(|x| x.abs() < f64::MIN_POSITIVE), "{:?}", o.wrench);
    }
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

/// A plan of the space whose conditions vary, and what is said on standard error.
fn with_conditions(more: &[&str]) -> (String, String) {
    let mut command = hexbench();
    let files = ["design", "scenes/paper/hexapod.toml", "data/designs/effects-space.toml"];
    let output = command.current_dir(root()).args(files).args(more).output().unwrap();
    (String::from_utf8_lossy(&output.stdout).into_owned(), complaint(&output))
}

#[test]
fn conditions_that_no_estimated_parameter_uses_stay_as_they_are() {
    let few = ["--hours", "3", "--starts", "2", "--candidates", "32"];
    let page = |more: &[&str]| {
        let (page, _) = with_conditions(&[&few[..], more].concat());
        page.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let springs = page(&[]);
    assert!(springs.contains("depends on it: approach 1, delta_T 0 K and wait 5 s."), "{springs}");
    assert!(!springs.contains("delta_T K"), "no column for what is the same everywhere: {springs}");
    let friction = page(&["--add", "joint-friction"]);
    assert!(friction.contains("depends on it: delta_T 0 K and wait 5 s."), "{friction}");
}

#[test]
fn poses_that_coincide_are_counted_once_and_told() {
    let (page, _) = with_conditions(&["--poses", "6", "--starts", "2"]);
    assert!(page.contains("6 poses asked,") && page.contains("distinct: the others coincide."), "{page}");
}

#[test]
fn what_a_space_or_a_budget_lacks_is_named() {
    let (_, load) = with_conditions(&["--hours", "3", "--add", "base-compliance"]);
    assert!(
        load.contains("it lacks a load with fy") && load.contains("Add a load with fy to [loads]"),
        "{load}"
    );
    let (_, time) = with_conditions(&["--hours", "0.001"]);
    assert!(time.contains("does not allow a single reading") && time.contains("Raise --hours."), "{time}");
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

/// Sensors for the readings of a case.
fn sensors(more: &[&str]) -> std::process::Output {
    let mut command = hexbench();
    let case = ["data/cases/mujoco-clean/hexapod.toml", "data/cases/mujoco-clean/measurements.csv"];
    command.current_dir(root()).arg("design").args(case).args(["--sensors", "data/designs/gauges.toml"]);
    command.args(more).output().unwrap()
}

#[test]
fn sensors_are_chosen_and_the_machine_is_written_with_them() {
    let folder = tempfile::tempdir().unwrap();
    let [machine, json, html] = ["hexapod.toml", "choice.json", "page.html"].map(|n| folder.path().join(n));
    let files =
        ["-o", machine.to_str().unwrap(), "--json", json.to_str().unwrap(), "--html", html.to_str().unwrap()];
    let page = text(sensors(&[&["--choose", "4"][..], &files].concat()));
    assert!(page.lines().all(|l| l.chars().count() <= 80), "{page}");
    insta::assert_snapshot!("design_sensors", page);
    let chosen = hexbench_core::files::read_hexapod(&machine).unwrap().sensors;
    let file: serde_json::Value = serde_json::from_slice(&std::fs::read(json).unwrap()).unwrap();
    crate::schemas::check("sensor-choice/1", std::slice::from_ref(&file));
    let names: Vec<&str> =
        file["sensors"].as_array().unwrap().iter().filter_map(|s| s["name"].as_str()).collect();
    assert_eq!(names, chosen.iter().map(|s| s.name.as_str()).collect::<Vec<_>>());
    assert_eq!(names.len(), 4);
    let numbers: Vec<u64> =
        file["numbers"].as_array().unwrap().iter().filter_map(|n| n["number"].as_u64()).collect();
    assert_eq!(numbers, [3, 4, 5, 6]);
    let html = std::fs::read_to_string(html).unwrap();
    assert!(names.iter().all(|name| html.contains(name)), "{html}");
}

#[test]
fn sensors_are_chosen_within_their_budget_for_an_effect() {
    let page =
        text(sensors(&["--budget", "5", "--choose", "5", "--see", "base-compliance", "--starts", "4"]));
    assert!(page.contains("base-compliance of usual size is"), "{page}");
    let words = page.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("They cost 5 of 5."), "{page}");
}

#[test]
fn sensors_are_chosen_for_poses_that_are_designed_first() {
    let chosen = |more: &[&str]| {
        let mut command = hexbench();
        command.current_dir(root()).args([
            "design",
            "scenes/paper/hexapod.toml",
            "data/designs/paper-space.toml",
        ]);
        let options = ["--sensors", "data/designs/gauges.toml", "--starts", "4"];
        command.args(options).args(more).output().unwrap()
    };
    let page = text(chosen(&["--choose", "6"]));
    assert!(page.contains("Plan  mm and deg") && page.contains("6 of 38 sensors"), "{page}");
    // A single load hides most effects behind the springs.
    assert!(page.contains("Not detectable with these sensors"), "{page}");
    // Two poses under one load are two readings of a gauge.
    let refused = chosen(&["--choose", "6", "--budget", "1"]);
    let told = String::from_utf8(refused.stderr).unwrap();
    assert_eq!(refused.status.code(), Some(4), "{told}");
    assert!(
        told.contains("no set of 6 candidate sensors") && told.contains("Allow a larger --budget"),
        "{told}"
    );
}

/// Arguments after the files; exit code; what is said.
const REFUSED_SENSORS: [(&[&str], i32, &str); 6] = [
    (&[], 2, "Add --choose N, --budget COST, or both"),
    (&["--choose", "40"], 2, "has 38 sensors to choose from"),
    (&["--budget", "0.5"], 2, "the cheapest sensor costs 1"),
    (&["--choose", "4", "--see", "actuator-pitch"], 4, "hexbench terms actuator-pitch"),
    (&["--choose", "4", "--see", "nothing"], 2, "there is no term `nothing`"),
    (&["--choose", "4", "--see", "creep", "--criterion", "a"], 2, "cannot be used with"),
];

#[test]
fn sensors_that_cannot_be_chosen_are_told_with_what_to_write() {
    for (more, code, says) in REFUSED_SENSORS {
        let output = sensors(more);
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{more:?}: {told}");
        let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(told.contains(says), "{more:?}: {told}");
    }
}
