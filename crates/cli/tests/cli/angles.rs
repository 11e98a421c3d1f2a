//! `[conventions] angles`: the same campaign stated otherwise gives the same answer, and what is written reads back.

use std::fs::{self, File};
use std::path::Path;

use hexbench_core::files::{
    ColumnNames, campaign_to_csv, hexapod_to_toml, read_campaign, read_conditions_named, read_hexapod,
    write_measurements,
};
use hexbench_core::{AngleConvention, Hexapod, Measurand};
use serde_json::Value;

use crate::support::{complaint, hexbench, root, text};

/// Numbers of an answer may differ by rounding of the angles, which the fit amplifies.
const ROUNDING: f64 = 1e-6;

/// The files of a bundled case, stated by a convention.
fn stated(case: &str, angles: AngleConvention) -> (tempfile::TempDir, Hexapod) {
    let (folder, case) = (tempfile::tempdir().unwrap(), root().join("data/cases").join(case));
    let inside = read_hexapod(&case.join("hexapod.toml")).unwrap();
    let machine = Hexapod { angles, ..inside.clone() };
    fs::write(folder.path().join("hexapod.toml"), hexapod_to_toml(&machine)).unwrap();
    for table in ["measurements.csv", "holdout.csv"] {
        let data = read_campaign(&inside, &case.join(table)).unwrap().dataset;
        let mut file = File::create(folder.path().join(table)).unwrap();
        campaign_to_csv(&mut file, &machine, &data).unwrap();
    }
    (folder, machine)
}

fn diagnosis(folder: &Path) -> Value {
    let files = ["diagnose", "hexapod.toml", "measurements.csv", "--holdout", "holdout.csv", "--json", "-"];
    serde_json::from_str(&text(hexbench().current_dir(folder).args(files).output().unwrap())).unwrap()
}

fn stiffness(diagnosis: &Value) -> Vec<f64> {
    let all = diagnosis["parameters"].as_array().unwrap();
    all.iter().map(|p| p["value"].as_f64().unwrap_or(f64::NAN)).collect()
}

#[test]
fn a_campaign_stated_by_another_convention_has_the_same_answer() {
    for case in ["mujoco-foundation", "absolute-pitch"] {
        let usual = diagnosis(&root().join("data/cases").join(case));
        for angles in [AngleConvention::FixedZyx, AngleConvention::RotationVector] {
            let (folder, _) = stated(case, angles);
            let answer = diagnosis(folder.path());
            for key in ["verdict", "added", "credible_set"] {
                assert_eq!(answer[key], usual[key], "{case} {angles:?} {key}");
            }
            for (value, expected) in stiffness(&answer).iter().zip(stiffness(&usual)) {
                assert!(
                    (value - expected).abs() < ROUNDING * expected.abs(),
                    "{case} {angles:?}: {value} {expected}"
                );
            }
        }
    }
}

#[test]
fn a_convention_that_is_not_stated_is_found_and_the_line_to_add_is_named() {
    let (folder, _) = stated("mujoco-foundation", AngleConvention::FixedZyx);
    let machine = folder.path().join("hexapod.toml");
    let silent = fs::read_to_string(&machine).unwrap().replace("angles = \"intrinsic-xyz\"\n", "");
    fs::write(&machine, silent).unwrap();
    let answer = diagnosis(folder.path());
    assert_eq!(answer["verdict"], "measurement", "{answer}");
    let findings = answer["findings"].as_array().unwrap();
    let finding = findings.iter().find(|f| f["kind"] == "angle-convention").unwrap();
    assert!(finding["next"].as_str().unwrap().contains("angles = \"intrinsic-xyz\""), "{finding}");
}

#[test]
fn a_convention_that_is_stated_and_wrong_is_found_and_the_right_line_is_named() {
    for (meant, said) in [
        (AngleConvention::default(), "intrinsic-xyz"),
        (AngleConvention::FixedZyx, "rotation-vector"),
        (AngleConvention::FixedYxz, "intrinsic-xyz"),
    ] {
        let (folder, machine) = stated("mujoco-foundation", meant);
        let angles = AngleConvention::of_word(said).unwrap();
        let wrong = hexapod_to_toml(&Hexapod { angles, ..machine });
        fs::write(folder.path().join("hexapod.toml"), wrong).unwrap();
        let answer = diagnosis(folder.path());
        let findings = answer["findings"].as_array().unwrap();
        let finding = findings.iter().find(|f| f["kind"] == "angle-convention");
        let finding = finding.unwrap_or_else(|| panic!("{meant:?} for {said}: {findings:?}"));
        let next = finding["next"].as_str().unwrap();
        assert!(next.contains(&format!("angles = \"{}\"", meant.word())), "{meant:?} for {said}: {next}");
    }
}

#[test]
fn plans_and_predictions_are_written_as_they_are_read() {
    let (folder, machine) = stated("mujoco-foundation", AngleConvention::FixedZyx);
    let run =
        |arguments: &[&str]| text(hexbench().current_dir(folder.path()).args(arguments).output().unwrap());
    run(&["fit", "hexapod.toml", "measurements.csv", "-o", "model.toml"]);
    run(&["predict", "model.toml", "holdout.csv", "-o", "predicted.csv"]);
    let data = read_campaign(&machine, &folder.path().join("holdout.csv")).unwrap().dataset;
    let predicted = read_campaign(&machine, &folder.path().join("predicted.csv")).unwrap().dataset;
    let conditions =
        read_conditions_named(&folder.path().join("predicted.csv"), &ColumnNames::default(), Some(&machine))
            .unwrap();
    for ((o, p), c) in
        data.observations.iter().zip(&predicted.observations).zip(&conditions.dataset.observations)
    {
        assert!((p.pose.to_vector() - o.pose.to_vector()).amax() < 1e-10);
        assert!((c.pose.to_vector() - o.pose.to_vector()).amax() < 1e-10);
        let off = (0..6).map(|k| (o.measured[k] - p.measured[k]).abs()).fold(0.0, f64::max);
        assert!(off < 100e-6, "{off}");
    }
}

#[test]
fn a_word_that_is_no_convention_is_refused_with_its_line() {
    let (folder, _) = stated("mujoco-clean", AngleConvention::FixedZyx);
    let machine = folder.path().join("hexapod.toml");
    fs::write(&machine, fs::read_to_string(&machine).unwrap().replace("intrinsic-xyz", "uvw")).unwrap();
    let output = hexbench().current_dir(folder.path()).args(["check", "hexapod.toml"]).output().unwrap();
    let said = complaint(&output);
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(said.contains("this is no convention of angles") && said.contains("intrinsic-xyz"), "{said}");
}

/// The rotation vector of a small change of the angles of a pose, fixed axes.
fn rotation_vector(angles: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    let [_, beta, gamma] = angles;
    let [(sb, cb), (sg, cg)] = [beta.sin_cos(), gamma.sin_cos()];
    [cg * cb * x - sg * y, sg * cb * x + cg * y, z - sb * x]
}

#[test]
fn a_table_of_rotation_vectors_has_its_own_names_on_every_page() {
    let (folder, case) = (tempfile::tempdir().unwrap(), root().join("data/cases/mujoco-clean"));
    let machine = read_hexapod(&case.join("hexapod.toml")).unwrap();
    let mut data = read_campaign(&machine, &case.join("measurements.csv")).unwrap().dataset;
    data.measurand = Measurand::DeflectionRotationVector;
    for o in &mut data.observations {
        let [_, _, _, x, y, z] = o.measured;
        let turned = rotation_vector([o.pose.angles.x, o.pose.angles.y, o.pose.angles.z], [x, y, z]);
        o.measured[3..].copy_from_slice(&turned);
    }
    fs::copy(case.join("hexapod.toml"), folder.path().join("hexapod.toml")).unwrap();
    write_measurements(&folder.path().join("measurements.csv"), &data).unwrap();
    let run = |words: &[&str]| text(hexbench().current_dir(folder.path()).args(words).output().unwrap());
    let diagnosed = run(&["diagnose", "hexapod.toml", "measurements.csv", "-v", "--html", "page.html"]);
    let charted = fs::read_to_string(folder.path().join("page.html")).unwrap();
    let compared = run(&["compare", "hexapod.toml", "measurements.csv"]);
    assert!(diagnosed.contains("ADEQUATE"), "{diagnosed}");
    for (page, name) in [(&diagnosed, " drz"), (&compared, "drz"), (&charted, "drz (µrad)")] {
        assert!(page.contains(name) && !page.contains("dgamma"), "{name}: {page}");
    }
}
