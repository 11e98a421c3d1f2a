//! `hexbench init`: machines from the numbers of a drawing.

use std::fs;
use std::path::Path;
use std::process::Output;

use hexbench_core::files::{parse_hexapod, read_hexapod};

use crate::support::{complaint, hexbench, root, text};

const RINGS: [&str; 10] = [
    "--base-radius",
    "115",
    "--base-gap",
    "20",
    "--platform-radius",
    "90",
    "--platform-gap",
    "20",
    "--height",
    "95",
];

fn init(folder: &Path, arguments: &[&str]) -> Output {
    hexbench().current_dir(folder).arg("init").args(arguments).output().unwrap()
}

/// The joints of a machine as a table, each side in a frame of its own height.
fn table(folder: &Path, heights: [f64; 2]) {
    let machine = read_hexapod(&root().join("data/cases/mujoco-clean/hexapod.toml")).unwrap();
    let sides = [("base", machine.base_joints), ("platform", machine.platform_joints)];
    let rows = sides.iter().zip(heights).flat_map(|((side, joints), height)| {
        let row = move |(leg, j): (usize, &hexbench_core::Vector3)| {
            format!("{side};{leg};{};{};{height}\n", j.x * 1e3, j.y * 1e3)
        };
        (1..).zip(joints).map(row).collect::<Vec<_>>()
    });
    fs::write(folder.join("joints.csv"), format!("side;leg;x_mm;y_mm;z_mm\n{}", rows.collect::<String>()))
        .unwrap();
}

#[test]
fn two_rings_give_the_machine_of_the_drawing() {
    let folder = tempfile::tempdir().unwrap();
    let more = ["--noise", "0.5,3", "--picture", "machine.svg", "-o", "new/hexapod.toml"];
    let page = text(init(folder.path(), &[&RINGS[..], &more].concat()));
    for part in ["READ", "95.0 mm", "leg lengths  120.", "From above", "hexbench check new/hexapod.toml"] {
        assert!(page.contains(part), "{part} in {page}");
    }
    let written = fs::read_to_string(folder.path().join("new/hexapod.toml")).unwrap();
    let made = parse_hexapod(&written, "hexapod.toml").unwrap();
    // The bundled machine is drawn with such pairs, its gap and its turn are not round.
    let bundled = read_hexapod(&root().join("data/cases/mujoco-clean/hexapod.toml")).unwrap();
    for (made, bundled) in made.base_joints.iter().zip(&bundled.base_joints) {
        assert!((made - bundled).norm() < 1e-6, "{made} {bundled}");
    }
    assert!(made.platform_joints.iter().all(|j| j.z == 0.0 && (j.norm() - 0.09).abs() < 1e-9));
    assert_eq!(made.metrology.map(|m| (m.sigma_translation, m.sigma_rotation)), Some((0.5e-6, 3e-6)));
    assert!(written.contains("# Centers of the base joints") && !written.contains("-0.0,"), "{written}");
    assert!(fs::read_to_string(folder.path().join("machine.svg")).unwrap().starts_with("<svg"));
}

#[test]
fn a_table_of_joints_with_a_height_gives_the_same_machine_as_its_file() {
    let folder = tempfile::tempdir().unwrap();
    table(folder.path(), [0.0, 7.0]);
    text(init(folder.path(), &["--joints", "joints.csv", "--height", "95"]));
    let made = read_hexapod(&folder.path().join("hexapod.toml")).unwrap();
    let bundled = read_hexapod(&root().join("data/cases/mujoco-clean/hexapod.toml")).unwrap();
    let pairs = |a: [hexbench_core::Vector3; 6], b: [hexbench_core::Vector3; 6]| {
        a.into_iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
    };
    assert!(pairs(made.base_joints, bundled.base_joints) < 1e-9);
    assert!(pairs(made.platform_joints, bundled.platform_joints) < 1e-9);
}

#[test]
fn what_a_drawing_cannot_mean_is_refused_with_what_to_do_and_nothing_is_replaced() {
    let folder = tempfile::tempdir().unwrap();
    table(folder.path(), [0.0, 0.0]);
    fs::write(folder.path().join("kept.toml"), "mine").unwrap();
    let with = |at: usize, value: &'static str| {
        let mut rings = RINGS;
        rings[at] = value;
        rings.to_vec()
    };
    let cases: [(Vec<&str>, i32, &str, &str); 7] = [
        (vec!["--joints", "joints.csv"], 2, "lie in one plane", "--height"),
        (vec![], 2, "--base-radius is missing", "--joints"),
        (with(1, "-115"), 2, "a length is positive", "mm"),
        (with(3, "130"), 2, "between 0 and 120 degrees", "drawing"),
        ([&RINGS[..], &["-o", "kept.toml"]].concat(), 2, "exists already", "-o"),
        ([&RINGS[..], &["--noise", "0.5"]].concat(), 2, "two positive numbers", "0.5,3"),
        (vec!["--joints", "none.csv"], 5, "there is no such file", "spelling"),
    ];
    for (arguments, code, says, next) in cases {
        let output = init(folder.path(), &arguments);
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {told}");
        assert!(told.contains(says) && told.contains(next), "{arguments:?}: {told}");
    }
    assert_eq!(fs::read_to_string(folder.path().join("kept.toml")).unwrap(), "mine");
    assert!(!folder.path().join("hexapod.toml").exists());
}

#[test]
fn a_plan_has_a_table_for_its_readings_that_is_refused_until_it_is_filled_in() {
    let folder = tempfile::tempdir().unwrap();
    let page =
        text(init(folder.path(), &[&RINGS[..], &["--noise", "0.5,3", "--plan", "--load", "150"]].concat()));
    assert!(page.contains("hexbench power hexapod.toml plan.csv"), "{page}");
    let run = |arguments: &[&str]| hexbench().current_dir(folder.path()).args(arguments).output().unwrap();
    let power = text(run(&["power", "hexapod.toml", "plan.csv"]));
    assert!(power.contains("63 readings of deflections at 9 poses"), "{power}");
    let empty = run(&["check", "hexapod.toml", "measurements.csv"]);
    let said = complaint(&empty);
    assert!(empty.status.code() == Some(3) && said.contains("delta_T_K): the cell is empty"), "{said}");
    let table = folder.path().join("measurements.csv");
    let mut count = 0.0;
    let unfilled = fs::read_to_string(&table).unwrap();
    let filled = unfilled.lines().map(|line| match line.strip_suffix(",,,,,,,,") {
        Some(row) => {
            count += 1.0;
            let [x, y, z, about_x, about_y, about_z] =
                [0.0, 1.0, -9.0, 2.0, 3.0, 4.0].map(|of| of + 0.01 * count);
            format!("{row},0.1,60,{x},{y},{z},{about_x},{about_y},{about_z}\n")
        }
        None => format!("{line}\n"),
    });
    let filled: String = filled.collect();
    fs::write(&table, filled).unwrap();
    assert!(text(run(&["check", "hexapod.toml", "measurements.csv"])).contains("63"));
    let again = init(folder.path(), &[&RINGS[..], &["-o", "other.toml", "--plan"]].concat());
    assert_eq!(again.status.code(), Some(2), "{}", complaint(&again));
    assert!(!folder.path().join("other.toml").exists());
}
