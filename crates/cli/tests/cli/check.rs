//! What `check` remarks of files that may be right: sizes, noise and temperatures out of the ordinary.

use hexbench_core::files::{read_campaign, read_hexapod, write_campaign, write_hexapod};
use hexbench_core::{Dataset, Hexapod};

use crate::support::{hexbench, hexbench_in, root, text};

/// The page of a check of a case of which machine and readings are changed, words with one blank between.
fn checked(change: impl FnOnce(&mut Hexapod, &mut Dataset)) -> String {
    let (case, folder) = (root().join("data/cases/mujoco-clean"), tempfile::tempdir().unwrap());
    let mut machine = read_hexapod(&case.join("hexapod.toml")).unwrap();
    let mut data = read_campaign(&machine, &case.join("measurements.csv")).unwrap().dataset;
    change(&mut machine, &mut data);
    write_hexapod(&folder.path().join("hexapod.toml"), &machine).unwrap();
    write_campaign(&folder.path().join("measurements.csv"), &machine, &data).unwrap();
    let words = ["check", "hexapod.toml", "measurements.csv"];
    let output = hexbench().current_dir(folder.path()).args(words).output().unwrap();
    String::from_utf8(output.stdout).unwrap().split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn a_file_without_oddities_is_ready_without_a_remark() {
    let page = checked(|_, _| {});
    assert!(page.contains("READY The files are read as shown below. Next: `hexbench diagnose`."), "{page}");
    assert!(!page.contains("What looks odd"), "{page}");
}

#[test]
fn joints_in_meters_or_inches_are_remarked() {
    for (factor, radius) in [(1.0 / 25.4, "4.53 mm at the base"), (1e3, "115000 mm at the base")] {
        let page = checked(|machine, _| {
            machine.base_joints.iter_mut().chain(&mut machine.platform_joints).for_each(|j| *j *= factor);
        });
        assert!(page.contains(&format!("the mean radius of the joints is {radius}")), "{page}");
        assert!(
            page.contains("check the units in the names base_joints_mm and platform_joints_mm"),
            "{page}"
        );
    }
}

#[test]
fn noise_a_thousand_times_too_large_is_remarked_where_nothing_repeats() {
    let page = checked(|machine, data| {
        data.observations.retain(|o| o.repeat == 1);
        let stated = machine.metrology.as_mut().unwrap();
        stated.sigma_translation *= 1e3;
        stated.sigma_rotation *= 1e3;
    });
    assert!(page.contains("times the stated noise, less than noise of that size allows"), "{page}");
    assert!(page.contains("Look first at what looks odd"), "{page}");
}

#[test]
fn absolute_temperatures_are_remarked_and_a_warm_machine_is_not() {
    let shifted = |by: f64| checked(|_, data| data.observations.iter_mut().for_each(|o| o.delta_t += by));
    for by in [20.0, 293.15] {
        let page = shifted(by);
        assert!(page.contains("these look like absolute temperatures"), "{by}: {page}");
    }
    for by in [0.0, 5.0] {
        assert!(!shifted(by).contains("absolute temperatures"), "{by}");
    }
}

/// The tests of `power` are for all numbers of an effect together, so the sizes differ by the number of them, but not by more.
#[test]
fn single_numbers_show_from_about_the_size_that_power_says() {
    let json = |command: &str| -> serde_json::Value {
        let words = [command, "hexapod.toml", "measurements.csv", "--json", "-"];
        serde_json::from_str(&text(hexbench_in("mujoco-clean").args(words).output().unwrap())).unwrap()
    };
    let (check, power) = (json("check"), json("power"));
    let mut compared = 0;
    for of_check in check["detectable"].as_array().unwrap() {
        let (term, name) = (&of_check["term"], &of_check["parameter"]);
        let effect = power["effects"].as_array().unwrap().iter().find(|e| &e["term"] == term).unwrap();
        let number = effect["parameters"].as_array().unwrap().iter().find(|p| &p["name"] == name).unwrap();
        let sizes = [&of_check["size_at_90_percent_power"], &number["size"]].map(serde_json::Value::as_f64);
        if let [Some(alone), Some(together)] = sizes {
            assert!((0.5..2.0).contains(&(together / alone)), "{term} {name}: {alone} {together}");
            compared += 1;
        }
    }
    assert!(compared > 30, "{compared}");
}
