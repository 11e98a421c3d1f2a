//! `space.toml`: what it says, and what it may not say.

use std::path::Path;

use hexbench_core::files::{FileError, read_hexapod};
use hexbench_design::Space;
use hexbench_design::budget::{Amount, Budget};
use hexbench_design::space_file::read_space;

const LOADS: &str = "[loads]\nmasses_kg = [10, 20]\n";

fn read(more: &str) -> Result<Space, FileError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("space.toml");
    std::fs::write(&path, format!("format = \"space/1\"\n{LOADS}{more}")).unwrap();
    let machine = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/paper/hexapod.toml");
    read_space(&path, &read_hexapod(&machine).unwrap())
}

/// What is added to the file, a part of the message, and of the next step; the fault is in the last line of what is added.
const REFUSED: [(&str, &str, &str); 26] = [
    ("[poses]\nb_mm = [5, -5]\n", "the lowest comes first", "Swap"),
    ("[conditions]\nelapsed_s = 5\n", "a list in square brackets", ""),
    ("[conditions]\nelapsed_s = []\n", "at least one condition", "Remove the key"),
    ("[conditions]\nelapsed_s = [5, -300]\n", "time does not run backwards", "Remove the sign"),
    ("[conditions]\nelapsed_s = [5, 5]\n", "each condition is listed once", "Remove the second"),
    ("[conditions]\nelapsed_mm = [5]\n", "mm", ""),
    ("[conditions]\napproach = [1, 2]\n", "approach", ""),
    ("[conditions]\nwait_s = [5]\n", "wait_s", "elapsed_s"),
    ("[budget]\nreadings = 0\n", "must be a whole number from 1", ""),
    ("[budget]\nreadings = 2.5\n", "a whole number", ""),
    ("[budget]\ntime_h = 0\n", "a budget", ""),
    ("[budget]\nreadings = 60\ntime_h = 3\n", "in readings or in time", "Remove one"),
    ("[budget]\ntime = 3\n", "unit", "time_h"),
    ("[budget]\nreading_s = -1\n", "time does not run backwards", "Remove the sign"),
    ("wrenches_N_Nm = [[0, 0, -1, 0, 0, 0]]\n", "masses_kg and wrenches_N_Nm say the same", "Remove one"),
    ("reference_kg = 2\nreference_N_Nm = [0, 0, 0, 0, 0, 1]\n", "say the same", "Remove one"),
    ("[[loads.between]]\nmass_kg = [30, 10]\n", "the lowest comes first", "Swap"),
    ("[[loads.between]]\nmass_kg = [-1, 10]\n", "no mass is negative", "Remove the sign"),
    (
        "[[loads.between]]\nmass_kg = [1, 10]\nfz_N = [0, 5]\n",
        "a mass is a force along z",
        "Remove mass or fz",
    ),
    ("[[loads.between]]\nmx_N = [0, 5]\n", "moment", "mx_Nm"),
    ("[[loads.between]]\nfx = [0, 5]\n", "unit", "fx_N"),
    ("[[loads.between]]\nfx_N = [0, 5, 7]\n", "two numbers", ""),
    ("[[loads.between]]\nalong = [1, 0, 0]\n", "only a pull has a direction", "pull_N"),
    ("[[loads.between]]\npull_N = [0, 100]\n", "a pull has a direction", "along"),
    ("[[loads.between]]\npull_N = [0, 100]\nalong = [0, 0, 0]\n", "must not be zero", ""),
    (
        "[[loads.between]]\npull_N = [0, 9]\nalong = [1, 0, 0]\nfy_N = 3\n",
        "there is no other force",
        "Remove it",
    ),
];

#[test]
fn what_a_space_may_not_say_is_told_with_its_line_and_the_next_step() {
    for (more, says, next) in REFUSED {
        let error = read(more).unwrap_err();
        let told = format!("{more}{}\n{}", error.message(), error.next_step());
        let last = 3 + more.lines().count() as u64;
        assert_eq!(error.place.line, Some(last), "{told}");
        assert!(error.message().contains(says), "{told}");
        assert!(error.next_step().contains(next) && error.next_step().ends_with('.'), "{told}");
    }
}

#[test]
fn limits_of_the_file_take_the_place_of_those_of_the_machine() {
    let plain = read("").unwrap();
    let [shortest, longest] = plain.stroke.unwrap_or([1e-6, 1e6]);
    assert_eq!((plain.joint_angle, plain.least_dexterity), (None, 0.0));
    for (more, stroke) in [
        ("min_length_mm = 187\n", [0.187, longest]),
        ("max_length_m = 0.25\n", [shortest, 0.25]),
        ("min_length_mm = 187\nmax_length_mm = 250\n", [0.187, 0.25]),
    ] {
        let limited =
            read(&format!("[limits]\n{more}joint_angle_deg = 30\nleast_dexterity = 0.1\n")).unwrap();
        let found = limited.stroke.unwrap();
        assert!(found.iter().zip(stroke).all(|(a, b)| (a / b - 1.0).abs() < 1e-12), "{more}: {found:?}");
        assert!((limited.joint_angle.unwrap() - 30_f64.to_radians()).abs() < 1e-12);
        assert!((limited.least_dexterity - 0.1).abs() < 1e-12);
    }
    let angle_alone = read("[limits]\njoint_angle_deg = 30\n").unwrap();
    assert_eq!(angle_alone.stroke, plain.stroke);
}

#[test]
fn a_load_between_bounds_is_read_with_what_is_fixed_of_it_and_begins_farthest_from_the_reference() {
    let space = read(
        "reference_kg = 5\n[[loads.between]]\nmass_g = [2e3, 40e3]\nfx_N = -20\nmz_Nmm = [-9e3, 4e3]\n\
         [[loads.between]]\npull_kN = [-0.1, 0.2]\nalong = [3, 0, 4]\n",
    )
    .unwrap();
    let near = |found: [f64; 6], expected: [f64; 6]| {
        assert!(
            found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12 * 400.0),
            "{found:?} {expected:?}"
        );
    };
    let gravity = 9.806_65;
    assert_eq!(space.loads.len(), 4);
    assert!(space.loads.iter().all(|l| l.reference == space.loads[0].reference));
    near(space.loads[2].load.to_array(), [-20.0, 0.0, -40.0 * gravity, 0.0, 0.0, -9.0]);
    near(space.loads[3].load.to_array(), [120.0, 0.0, 160.0 - 5.0 * gravity, 0.0, 0.0, 0.0]);
    let [first, second] = &space.load_ranges[..] else { panic!("{:?}", space.load_ranges) };
    assert_eq!([first.load, second.load], [2, 3]);
    assert_eq!(
        first.parts.iter().map(|p| (p.name, p.unit)).collect::<Vec<_>>(),
        [("mass", "kg"), ("mz", "Nm")]
    );
    assert_eq!(format!("{:?}", second.parts[0].bounds), "[-100.0, 200.0]");
    near(first.fixed.to_array(), [-20.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(space.at_corners().loads.len(), 2 + 4 + 2);
}

#[test]
fn a_load_of_which_nothing_is_chosen_is_told_with_what_to_write() {
    let error = read("[[loads.between]]\nfx_N = 5\nfy_N = [2, 2]\n").unwrap_err();
    assert!(error.message().contains("nothing of this load is between"), "{error:?}");
    assert!(error.place.line.is_some() && error.next_step().contains("wrenches_N_Nm"), "{error:?}");
    let many = "[[loads.between]]\nfx_N = [0, 1]\n".repeat(13);
    assert!(read(&many).unwrap_err().message().contains("at most 12 loads"));
}

#[test]
fn conditions_and_budget_are_read_in_si_units() {
    let space = read(
        "[conditions]\nelapsed_min = [0, 5]\ndelta_T_K = [-0.5, 0.5]\napproach = [1, -1]\n\
         [budget]\ntime_h = 2\nreading_s = 40\nload_change_s = 60\npose_change_min = 2\n",
    )
    .unwrap();
    assert_eq!(space.conditions.waits, [0.0, 300.0]);
    assert_eq!(space.settings().len(), 2 * 2 * 2 * 2);
    assert_eq!(space.budget.limit, Some(Amount::Time(7200.0)));
    let Budget { reading, load_change, pose_change, .. } = space.budget;
    assert_eq!(format!("{reading} {load_change} {pose_change}"), "40 60 120");
}

#[test]
fn time_is_counted_as_documented() {
    let space = read(
        "[conditions]\nelapsed_s = [5, 300]\napproach = [1, -1]\n\
         [budget]\nreading_s = 40\nload_change_s = 60\npose_change_s = 120\n",
    )
    .unwrap();
    let settings = space.settings();
    let once: Vec<f64> = settings.iter().map(|s| space.budget.time_of(s)).collect();
    // Approach 1 after 5 s and 300 s, then approach -1: the load is changed twice.
    assert_eq!(once[..4], [105.0, 400.0, 165.0, 460.0]);
    let plan = [&settings[0], &settings[0], &settings[3]];
    let expected = 2.0 * 120.0 + 105.0 + 105.0 + 460.0;
    assert!((space.budget.time(2, plan) - expected).abs() < 1e-9);
}
