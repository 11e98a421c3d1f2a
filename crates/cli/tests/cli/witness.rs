//! `hexbench witness`: the worlds beside each other.

use std::fs;
use std::path::Path;
use std::process::Output;

use serde_json::{Value, json};

use crate::support::{complaint, hexbench, root, text};

fn witness(scene: &str, more: &[&str]) -> Output {
    hexbench().current_dir(root()).args(["witness", scene]).args(more).output().unwrap()
}

/// Rests as `scripts/mujoco_check.py` writes them, here those of the simulated world itself, as `export` tells them.
fn rests(scene: &str, states: usize, folder: &Path) -> Value {
    let out = folder.join("states");
    let count = states.to_string();
    let done = hexbench()
        .current_dir(root())
        .args(["export", scene, "--mjcf", "--states", &count, "-o", out.to_str().unwrap()])
        .output()
        .unwrap();
    assert!(done.status.success(), "{}", complaint(&done));
    let table = fs::read_to_string(out.join("states.csv")).unwrap();
    let mut lines = table.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let states: Vec<Value> = lines
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            let at = |name: &str| cells[names.iter().position(|n| *n == name).unwrap()];
            let number = |name: &str| at(name).parse::<f64>().unwrap();
            let load = ["fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm"].map(number);
            let position = ["rest_a_mm", "rest_b_mm", "rest_c_mm"].map(|name| number(name) * 1e-3);
            let [a, b, c] = ["alpha", "beta", "gamma"].map(|k| number(&format!("rest_{k}_deg")).to_radians() / 2.0);
            // Extrinsic X-Y-Z: q = qz qy qx.
            let ((sa, ca), (sb, cb), (sc, cc)) = (a.sin_cos(), b.sin_cos(), c.sin_cos());
            let orientation = [
                cc * cb * ca + sc * sb * sa,
                cc * cb * sa - sc * sb * ca,
                cc * sb * ca + sc * cb * sa,
                sc * cb * ca - cc * sb * sa,
            ];
            let forces: Vec<f64> = (1..=6).map(|leg| number(&format!("force_{leg}_N"))).collect();
            json!({"model": at("model"), "load_N_Nm": load, "position_m": position, "orientation": orientation, "forces_N": forces})
        })
        .collect();
    json!({"format": "rest/1", "program": "another program", "states": states})
}

fn written(value: &Value, folder: &Path) -> String {
    let path = folder.join("rest.json");
    fs::write(&path, value.to_string()).unwrap();
    path.display().to_string()
}

#[test]
fn two_worlds_stand_beside_each_other_and_agree() {
    let folder = tempfile::tempdir().unwrap();
    let html = folder.path().join("worlds.html");
    let page = text(witness("scenes/paper-rich", &["--states", "4", "--html", html.to_str().unwrap()]));
    assert!(page.lines().all(|l| l.chars().count() <= 80), "{page}");
    for said in [
        "hexbench and Rapier",
        "The worlds agree",
        "Rapier against hexbench",
        "Forces in the legs",
        "--mujoco",
    ] {
        assert!(page.contains(said), "{said} is not in\n{page}");
    }
    let html = fs::read_to_string(html).unwrap();
    assert!(html.contains("<svg") && html.contains("Where the platform rests"), "{html}");
}

#[test]
fn a_third_world_is_read_and_one_that_rests_elsewhere_is_no_witness() {
    let folder = tempfile::tempdir().unwrap();
    let mut rests = rests("scenes/paper-rich", 3, folder.path());
    let compared = |rests: &Value| {
        let file = written(rests, folder.path());
        witness("scenes/paper-rich", &["--states", "3", "--mujoco", &file])
    };
    let page = text(compared(&rests));
    assert!(
        page.contains("hexbench, Rapier and another program") && page.contains("The worlds agree"),
        "{page}"
    );
    // A micrometre aside in one state.
    let position = &mut rests["states"][1]["position_m"][0];
    *position = (position.as_f64().unwrap() + 1e-6).into();
    let output = compared(&rests);
    assert_eq!(output.status.code(), Some(1), "{}", complaint(&output));
    assert!(complaint(&output).contains("of the deflection apart"), "{}", complaint(&output));
    assert!(String::from_utf8_lossy(&output.stdout).contains("do not agree"));
}

#[test]
fn a_file_of_other_states_is_refused_with_the_next_step() {
    type Change = fn(&mut Value);
    let folder = tempfile::tempdir().unwrap();
    let made = rests("scenes/paper", 2, folder.path());
    let cases: [(Change, &str); 6] = [
        (|r| r["format"] = "rest/2".into(), "the format must be \"rest/1\""),
        (|r| drop(r["states"].as_array_mut().unwrap().pop()), "1 states, 2 are compared"),
        (|r| r["states"][0]["load_N_Nm"][2] = 1.0.into(), "state 1: another model or another load"),
        (|r| r["states"][1]["model"] = "state-001.xml".into(), "state 2: another model"),
        (
            |r| r["states"][0]["orientation"][0] = 2.0.into(),
            "state 1: an orientation that is no unit quaternion",
        ),
        (|r| r["surplus"] = 1.into(), "unknown key `surplus`"),
    ];
    for (change, wanted) in cases {
        let mut rests = made.clone();
        change(&mut rests);
        let file = written(&rests, folder.path());
        let output = witness("scenes/paper", &["--states", "2", "--mujoco", &file]);
        assert_eq!(output.status.code(), Some(3), "{wanted}: {}", complaint(&output));
        assert!(
            complaint(&output).contains(wanted) && complaint(&output).contains("mujoco_check.py"),
            "{}",
            complaint(&output)
        );
    }
    let output = witness("scenes/paper", &["--html", "scenes/paper/scene.toml"]);
    assert_eq!(output.status.code(), Some(2), "{}", complaint(&output));
    let output = witness("scenes/paper", &["--mujoco", "no-such-file.json"]);
    assert_eq!(output.status.code(), Some(5), "{}", complaint(&output));
}
