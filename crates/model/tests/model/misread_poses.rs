//! Files of absolute poses that do not mean what they say are found, whatever the frames of the instrument are.

use std::f64::consts::PI;

use hexbench_core::{Dataset, Hexapod, Measurand, Observation, Pose};
use hexbench_model::error::ModelError;
use hexbench_model::inference::examination::FindingKind;
use hexbench_model::inference::misread::{Change, names};
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::check::check;
use hexbench_model::results::diagnose::{DiagnoseOptions, diagnose, diagnose_with};
use hexbench_model::terms::catalogue;
use nalgebra::Isometry3;

use crate::common::plan::{noisy, rich_plan};
use crate::common::world::World;
use crate::common::{PAPER_STIFFNESS, measured_machine};

/// Loads at each pose.
const LOADS: usize = 5;

/// Poses, each under several loads, by an instrument that stands anywhere or in the axes of the machine.
fn campaign(metrology: Isometry3<f64>) -> (Hexapod, Dataset) {
    let machine = measured_machine(0.5e-6, 3e-6);
    let world = World { metrology_frame: metrology, ..World::on_springs(&machine, PAPER_STIFFNESS) };
    let rows = rich_plan(24, 1.0, 12);
    let at = |k: usize| {
        let rows = &rows;
        (0..LOADS).map(move |j| Observation { wrench: rows[(k + j) % rows.len()].wrench, ..rows[k] })
    };
    let mut plan: Vec<Observation> = (0..rows.len()).flat_map(at).collect();
    for (row, line) in plan.iter_mut().zip(2..) {
        row.line = line;
    }
    (machine, noisy(&world.measure(Measurand::AbsolutePose, &plan), 0.5e-6, 3e-6, 5))
}

fn elsewhere() -> Isometry3<f64> {
    Isometry3::new([-1.5, 2.5, 0.4].into(), [-0.4, 1.7, 2.1].into())
}

/// What the findings would have the file read as, or the refusal that says it.
fn read_as(hexapod: &Hexapod, data: &Dataset) -> Vec<String> {
    let changes = |next: &str| -> Vec<String> {
        let all = next.split("--read-as ").skip(1);
        all.map(|text| text.trim_end_matches(['.', ' ']).to_owned()).collect()
    };
    match diagnose(hexapod, data, None, &catalogue()) {
        Ok(study) => {
            assert_eq!(study.diagnosis.verdict, Verdict::Measurement);
            changes(&study.diagnosis.findings[0].next)
        }
        Err(error) => {
            assert!(matches!(error, ModelError::Misread { .. }), "{error}");
            changes(&error.next_step("measurements.csv"))
        }
    }
}

fn each(data: &mut Dataset, change: impl FnMut(&mut Observation)) {
    data.observations.iter_mut().for_each(change);
}

/// A mistake, and as what the file is to be read.
type Mistake = (&'static str, fn(&mut Observation));

const OF_POSES: [Mistake; 6] = [
    ("measured-pose=-a", |row| row.measured[0] *= -1.0),
    ("measured-pose=-gamma", |row| row.measured[5] *= -1.0),
    ("measured-pose=positions*25.4", |row| row.measured[..3].iter_mut().for_each(|x| *x /= 25.4)),
    ("measured-pose=angles*57.29578", |row| row.measured[3..].iter_mut().for_each(|x| *x *= PI / 180.0)),
    ("measured-pose=positions:y,x,z", |row| row.measured.swap(0, 1)),
    ("measured-pose=inverse", |row| {
        let pose = Pose::from_array(row.measured);
        let back = pose.rotation().transpose();
        row.measured = Pose::from_rotation(-(back * pose.translation), &back).to_array();
    }),
];

#[test]
fn measured_poses_that_no_frames_carry_into_the_commanded_ones_are_read_otherwise() {
    let (hexapod, sound) = campaign(elsewhere());
    for (name, mistake) in OF_POSES {
        let mut data = sound.clone();
        each(&mut data, mistake);
        assert_eq!(read_as(&hexapod, &data), [name]);
    }
}

#[test]
fn a_check_says_what_poses_seem_to_mean_to_which_nothing_can_be_fitted() {
    let (hexapod, mut data) = campaign(elsewhere());
    each(&mut data, OF_POSES[0].1);
    let found = check(&hexapod, Some(&data), None, &catalogue(), &[]).unwrap();
    let kinds: Vec<FindingKind> = found.findings.iter().map(|f| f.kind).collect();
    assert_eq!((found.ready, kinds), (false, vec![FindingKind::MeasuredPose]));
    assert_eq!(found.measurements.map(|m| m.rows), Some(data.observations.len()));
}

#[test]
fn what_is_read_as_the_finding_says_is_the_sound_file() {
    let (hexapod, sound) = campaign(elsewhere());
    let (name, mistake) = OF_POSES[0];
    let mut data = sound.clone();
    each(&mut data, mistake);
    let change: Change = name.parse().unwrap();
    let options = DiagnoseOptions::default().with_read_as([change]);
    let answer = diagnose_with(&hexapod, &data, None, &catalogue(), &options).unwrap().diagnosis;
    assert_eq!((answer.verdict, answer.added.len()), (Verdict::Adequate, 0), "{:?}", answer.findings);
    assert_eq!(names(&[change]), [name]);
}

#[test]
fn in_axes_that_coincide_the_loads_tell_a_wrong_command_from_a_wrong_instrument() {
    let (hexapod, sound) = campaign(Isometry3::identity());
    for (name, mistake) in [
        ("commanded-pose=-alpha", (|row| row.pose.angles.x *= -1.0) as fn(&mut Observation)),
        ("measured-pose=-alpha", |row| row.measured[3] *= -1.0),
    ] {
        let mut data = sound.clone();
        each(&mut data, mistake);
        assert_eq!(read_as(&hexapod, &data), [name]);
    }
}

const OF_LOADS: [Mistake; 4] = [
    ("wrench-sign=fz", |row| row.wrench.force.z *= -1.0),
    ("moment-sign=reversed", |row| row.wrench.moment *= -1.0),
    ("axes=force-columns:y,x,z", |row| row.wrench.force = row.wrench.force.yxz()),
    ("wrench-frame=mobile", |row| {
        let back = row.pose.rotation().transpose();
        (row.wrench.force, row.wrench.moment) = (back * row.wrench.force, back * row.wrench.moment);
    }),
];

#[test]
fn loads_that_differences_at_each_pose_contradict_are_read_otherwise() {
    let (hexapod, sound) = campaign(elsewhere());
    for (name, mistake) in OF_LOADS {
        let mut data = sound.clone();
        each(&mut data, mistake);
        assert_eq!(read_as(&hexapod, &data), [name]);
    }
}

#[test]
fn what_changes_within_the_file_is_found_with_its_lines() {
    let (hexapod, sound) = campaign(elsewhere());
    let rows = sound.observations.len();
    for (name, mistake) in [OF_POSES[1], OF_POSES[4], OF_LOADS[0]] {
        // Whole poses: of one that is half of each kind no difference is right.
        for range in [rows / 2 / LOADS * LOADS..rows, rows / 4 / LOADS * LOADS..rows / 2 / LOADS * LOADS] {
            let mut data = sound.clone();
            data.observations[range.clone()].iter_mut().for_each(mistake);
            let found = read_as(&hexapod, &data);
            let (what, lines) = found[0].split_once('@').unwrap();
            assert_eq!((found.len(), what), (1, name));
            let ends: Vec<u64> = lines.split('-').map(|line| line.parse().unwrap()).collect();
            let true_ends = [range.start, range.end - 1].map(|row| sound.observations[row].line);
            let apart = ends.iter().zip(true_ends).map(|(found, true_end)| found.abs_diff(true_end));
            assert!(apart.max() <= Some(3), "{name}: {ends:?} for {true_ends:?}");
        }
    }
}

#[test]
fn sound_files_mean_what_they_say_and_a_joint_that_is_off_is_no_mistake_of_a_file() {
    for metrology in [Isometry3::identity(), elsewhere()] {
        let (mut hexapod, data) = campaign(metrology);
        hexapod.base_joints[1].x += 0.4e-3;
        hexapod.platform_joints[4].y -= 0.4e-3;
        let found = check(&hexapod, Some(&data), None, &catalogue(), &[]).unwrap();
        let about_file = |kind: FindingKind| kind.is_of_file();
        assert!(!found.findings.iter().any(|f| about_file(f.kind)), "{:?}", found.findings);
    }
}
