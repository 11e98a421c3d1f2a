//! Misstatements: each changes what it says and leaves the rest.

use std::{collections::BTreeSet, fs, path::Path};

use hexbench_core::{Dataset, Matrix3, Observation, Vector3};
use hexbench_truth::campaign::{CaseKind, SimulatedCase};
use hexbench_truth::misstatements::{MisstatedFile, MisstatementEntry, entry, registry};
use hexbench_truth::so3::exp;

const SEED: u64 = 11;
/// At least as many ways as a study needs.
const LEAST: usize = 50;
/// Roundings of numbers up to one.
const EPS: f64 = 1e-14;

fn sound() -> SimulatedCase {
    SimulatedCase::draw_on("ring_a", CaseKind::Clean, 0, SEED).unwrap()
}

fn written(how: &MisstatementEntry) -> SimulatedCase {
    let mut case = sound();
    how.apply(&mut case).unwrap();
    case
}

/// Rows as meant beside rows as written.
fn rows(id: &str) -> Vec<(Observation, Observation)> {
    let (meant, written) = (sound(), written(entry(id).unwrap()));
    meant.measurements.observations.into_iter().zip(written.measurements.observations).collect()
}

fn turn(axis: usize, angle: f64) -> Matrix3 {
    exp(&Vector3::from_fn(|k, _| if k == axis { angle } else { 0.0 }))
}

#[test]
fn ids_are_unique_and_every_file_is_registered() {
    let ids: BTreeSet<&str> = registry().map(|e| e.id).collect();
    assert_eq!(ids.len(), registry().count());
    assert!(ids.len() >= LEAST, "{}", ids.len());
    let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    assert!(ids.iter().all(|id| id.chars().all(is_plain)), "{ids:?}");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/misstatements");
    let list = fs::read_to_string(folder.join("mod.rs")).unwrap();
    for file in fs::read_dir(folder).unwrap().map(|f| f.unwrap().path()) {
        let stem = file.file_stem().unwrap().to_string_lossy().into_owned();
        let line = format!("    {stem},");
        let known = ["mod", "numbers", "rotations"].contains(&stem.as_str());
        assert!(known || list.lines().any(|l| l == line), "{stem}");
    }
}

#[test]
fn every_misstatement_has_a_sentence_and_a_cause() {
    for how in registry() {
        assert!(how.sentence.ends_with('.') && how.sentence.len() > 20, "{}", how.id);
        assert!(!how.causes.is_empty() && how.is_caused_by(how.causes[0]), "{}", how.id);
    }
}

/// It changes the file it says, no other, and leaves numbers that a file can hold.
#[test]
fn every_misstatement_changes_its_file_and_no_other() {
    let meant = sound();
    for how in registry() {
        let case = written(how);
        let changed = [
            case.hexapod != meant.hexapod,
            case.measurements != meant.measurements,
            case.holdout != meant.holdout,
        ];
        let expected = match how.file {
            MisstatedFile::Machine => [true, false, false],
            MisstatedFile::Tables => [false, true, true],
            MisstatedFile::Measurements => [false, true, false],
            MisstatedFile::Holdout => [false, false, true],
        };
        assert_eq!(changed, expected, "{}", how.id);
        assert!([&case.measurements, &case.holdout].into_iter().all(is_finite), "{}", how.id);
        assert!(
            case.hexapod.base_joints.iter().chain(&case.hexapod.platform_joints).all(|j| j.norm() < 10.0)
        );
        assert_eq!(case.truth["misstatement"], how.id);
        assert_eq!(case.truth["parameters"], meant.truth["parameters"]);
    }
}

fn is_finite(data: &Dataset) -> bool {
    let numbers =
        |o: &Observation| [o.measured, o.pose.to_array(), o.wrench.to_array(), o.reference.to_array()];
    data.observations.iter().flat_map(numbers).flatten().all(f64::is_finite)
}

#[test]
fn angles_of_another_convention_are_the_same_rotation() {
    for (meant, written) in rows("pose-angles-intrinsic") {
        let [u, v, w]: [f64; 3] = written.pose.angles.into();
        let same = turn(0, u) * turn(1, v) * turn(2, w);
        assert!((same - meant.pose.rotation()).amax() < EPS);
    }
    for (id, [first, second, third]) in [("pose-angles-xzy", [0, 2, 1]), ("pose-angles-yxz", [1, 0, 2])] {
        for (meant, written) in rows(id) {
            let of = |axis: usize| turn(axis, written.pose.angles[axis]);
            assert!((of(first) * of(second) * of(third) - meant.pose.rotation()).amax() < EPS, "{id}");
        }
    }
    for (meant, written) in rows("pose-angles-rotation-vector") {
        assert!((exp(&written.pose.angles) - meant.pose.rotation()).amax() < EPS);
    }
}

/// At zero angles Euler differences are a vector.
#[test]
fn readings_turned_by_a_quarter_read_y_along_their_x() {
    let mut case = sound();
    for row in &mut case.measurements.observations {
        row.pose.angles = Vector3::zeros();
    }
    let meant = case.measurements.observations.clone();
    entry("readings-yaw-90").unwrap().apply(&mut case).unwrap();
    for (meant, written) in meant.iter().zip(&case.measurements.observations) {
        let [x, y, z, rx, ry, rz] = meant.measured;
        let expected = [y, -x, z, ry, -rx, rz];
        let off = expected.iter().zip(written.measured).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // Second order in rotations of some hundred urad.
        assert!(off < 1e-7, "{off}");
    }
}

#[test]
fn a_moment_about_another_point_has_the_same_force() {
    for (meant, written) in rows("moments-about-load-cell") {
        let arm = meant.pose.rotation() * Vector3::z() * 0.04;
        assert_eq!(meant.wrench.force, written.wrench.force);
        let back = written.wrench.moment + arm.cross(&written.wrench.force);
        assert!((back - meant.wrench.moment).amax() < 1e-12);
    }
}

/// A reading to the last digit.
fn bits(row: &Observation) -> [u64; 6] {
    row.measured.map(f64::to_bits)
}

#[test]
fn shifted_loads_are_those_of_another_row() {
    let all = rows("loads-shifted-row");
    let meant: Vec<_> = all.iter().map(|(meant, _)| meant.wrench).collect();
    let shifted = all.iter().skip(1).zip(&meant).all(|((_, written), before)| written.wrench == *before);
    assert!(shifted);
    for (meant, written) in rows("loads-shifted-load") {
        assert_ne!(meant.wrench, written.wrench);
        assert_eq!(bits(&meant), bits(&written));
    }
}

#[test]
fn copies_double_the_rows_and_a_held_out_copy_is_a_row_to_learn_from() {
    let rows = sound().measurements.observations.len();
    assert_eq!(written(entry("rows-copied-as-repeats").unwrap()).measurements.observations.len(), 2 * rows);
    let case = written(entry("holdout-is-training").unwrap());
    assert_eq!(case.holdout.observations, case.measurements.observations);
    let other = written(entry("holdout-of-another-machine").unwrap());
    let moved = other.holdout.observations.iter().zip(sound().holdout.observations);
    assert!(moved.clone().all(|(a, b)| bits(a) != bits(&b) && a.wrench == b.wrench));
}
