//! Absolute poses read far away and in turned axes say the same of the machine.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use hexbench_core::{Dataset, Hexapod, Measurand, Observation, Pose, Vector3};
use hexbench_model::application::compensate::compensate;
use hexbench_model::application::model_file::{DataOrigin, Estimator, Model};
use hexbench_model::application::predict::predict;
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::{Fit, TermSpec, fit, fit_baseline};
use hexbench_model::estimation::frames::{Frames, ReadingAxes};
use hexbench_model::estimation::residuals::prediction_errors;
use hexbench_model::results::diagnose::{diagnose, prepare};
use hexbench_model::terms::catalogue;
use nalgebra::Isometry3;

use crate::cases;
use crate::common::plan::{noisy, rich_plan};
use crate::common::random::Random;
use crate::common::world::{World, coordinates, rigid};
use crate::common::{PAPER_STIFFNESS, measured_machine, paper_machine};

/// Rounding of positions of 3 m and of rotation matrices, in m and rad, after sums over some tens of rows.
const ROUNDING: f64 = 1e-12;
/// A chart of rotations that is turned by the errors of the closed-form start, some mrad, moves weights by their product with the
/// tilts of the poses: this share of a standard deviation.
const SIGMAS: f64 = 2e-3;
/// The same of chi-square, which is stationary: its square.
const SAME: f64 = 2e-5;

fn frame(shift: [f64; 3], turn: [f64; 3]) -> Isometry3<f64> {
    Isometry3::new(Vector3::from(shift), Vector3::from(turn))
}

/// Names and instruments: 3 m away, quarter and half turns about every axis, any turn, a target on its head 200 mm off.
fn instruments() -> Vec<(String, Frames)> {
    let none = Isometry3::identity();
    let mut all = vec![("3 m away".to_owned(), frame([2.0, -2.0, 1.0], [0.0; 3]), none)];
    for axis in 0..3 {
        for angle in [FRAC_PI_2, -FRAC_PI_2, PI] {
            let mut turn = [0.0; 3];
            turn[axis] = angle;
            all.push((format!("turned {angle:.2} about axis {axis}"), frame([0.5, 0.3, -0.2], turn), none));
            let target = frame([0.05, -0.12, 0.15], turn);
            all.push((format!("target turned {angle:.2} about axis {axis}"), none, target));
        }
    }
    let target = frame([0.12, 0.0, 0.16], [0.0, PI, 0.0]);
    all.push(("any turn".to_owned(), frame([2.0, -2.0, 1.0], [1.1, -2.0, 0.7]), none));
    all.push(("any two turns".to_owned(), frame([-1.5, 2.5, 0.4], [-0.4, 1.7, 2.1]), target));
    all.push((
        "both half a turn".to_owned(),
        frame([0.0; 3], [0.0, 0.0, PI]),
        frame([0.0; 3], [0.0, 0.0, -PI]),
    ));
    all.into_iter().map(|(name, metrology, target)| (name, Frames { metrology, target })).collect()
}

/// The same readings by an instrument elsewhere.
fn seen(data: &Dataset, frames: &Frames) -> Dataset {
    let mut seen = data.clone();
    for o in &mut seen.observations {
        let place = frames.metrology * rigid(&Pose::from_array(o.measured)) * frames.target;
        o.measured = coordinates(&place);
    }
    seen
}

fn gap(a: &Isometry3<f64>, b: &Isometry3<f64>) -> f64 {
    (a.translation.vector - b.translation.vector).norm().max(a.rotation.angle_to(&b.rotation))
}

/// Readings of a rigid machine exactly as commanded.
fn as_commanded(rows: Vec<Observation>) -> Vec<Observation> {
    rows.into_iter().map(|o| Observation { measured: o.pose.to_array(), ..o }).collect()
}

fn rows(rows: Vec<Observation>) -> Dataset {
    crate::common::plan::dataset(Measurand::AbsolutePose, as_commanded(rows))
}

#[test]
fn the_closed_form_finds_any_frames_of_poses_that_are_exact() {
    let data = rows(rich_plan(30, 1.0, 3));
    for (name, frames) in instruments() {
        let found = Frames::between(&paper_machine(), &seen(&data, &frames).observations);
        // The weight of the target nearest to the platform, (1e-4 / 0.06)^2, times turns of up to half a circle.
        let error = gap(&found.metrology, &frames.metrology).max(gap(&found.target, &frames.target));
        assert!(error < 1e-4, "{name}: {error:.1e}");
    }
}

#[test]
fn a_blundered_row_does_not_move_the_start() {
    let data = rows(rich_plan(12, 1.0, 4));
    for (name, frames) in instruments() {
        for bad in 0..12 {
            for blunder in [
                frame([10.0, 0.0, 0.0], [0.0; 3]),
                frame([0.0; 3], [0.0, 2.0, 1.0]),
                frame([0.0, 0.03, 0.0], [0.2, 0.0, 0.0]),
            ] {
                let mut seen = seen(&data, &frames);
                let o = &mut seen.observations[bad];
                o.measured = coordinates(&(rigid(&Pose::from_array(o.measured)) * blunder));
                let found = Frames::between(&paper_machine(), &seen.observations);
                let error = gap(&found.metrology, &frames.metrology).max(gap(&found.target, &frames.target));
                assert!(error < 1e-3, "{name}, row {bad}: {error:.1e}");
            }
        }
    }
}

#[test]
fn poses_that_leave_the_frames_open_still_give_frames_that_fit_them() {
    let one = rich_plan(1, 1.0, 5);
    let shifted: Vec<Observation> = rich_plan(8, 1.0, 6)
        .into_iter()
        .map(|mut o| {
            o.pose.angles = Vector3::zeros();
            o
        })
        .collect();
    let about_one_axis: Vec<Observation> = rich_plan(8, 1.0, 7)
        .into_iter()
        .map(|mut o| {
            o.pose.angles.x = 0.0;
            o.pose.angles.y = 0.0;
            o
        })
        .collect();
    for plan in [one, rich_plan(2, 1.0, 5), shifted, about_one_axis] {
        let data = rows(plan);
        for (name, frames) in instruments() {
            let seen = seen(&data, &frames);
            let found = Frames::between(&paper_machine(), &seen.observations);
            let left = found.departure(&seen.observations);
            let poses = data.observations.len();
            println!("{name}, {poses} poses: {left:?}");
            assert!(left.translation < 2e-3 && left.rotation < 2e-3, "{name}, {poses} poses: {left:?}");
            assert_eq!(found.astray(&paper_machine(), &seen.observations), None);
        }
    }
}

#[test]
fn springs_of_poses_that_never_tilt_are_the_same_too() {
    let straight = |o: Observation| Observation { pose: Pose { angles: Vector3::zeros(), ..o.pose }, ..o };
    let plan: Vec<Observation> = rich_plan(30, 1.0, 14).into_iter().map(straight).collect();
    let machine = measured_machine(0.5e-6, 3e-6);
    let mut world = World::on_springs(&machine, PAPER_STIFFNESS);
    let found = |world: &World| {
        let data = world.measure(Measurand::AbsolutePose, &plan);
        fit_baseline(&Campaign::new(&machine, &data).unwrap()).unwrap()
    };
    let plain = found(&world);
    for (name, frames) in instruments() {
        world.metrology_frame = frames.metrology;
        world.target_frame = frames.target;
        let turned = found(&world);
        let off = (turned.point.compliances - plain.point.compliances)
            .component_div(&plain.point.compliances)
            .amax();
        println!("{name}: {off:.1e} of the springs, {:?}, chi2 {:.1e}", turned.termination, turned.chi2);
        assert!(turned.is_settled() && off < 1e-6, "{name}: {off:.1e}");
    }
}

#[test]
fn a_reading_metres_off_is_named_and_the_others_are_fitted() {
    let machine = measured_machine(0.5e-6, 3e-6);
    let world = World::on_springs(&machine, PAPER_STIFFNESS);
    let read = |poses, plan, seed| {
        let read = world.measure(Measurand::AbsolutePose, &rich_plan(poses, 1.0, plan));
        noisy(&read, 0.5e-6, 3e-6, seed)
    };
    // Readings held out: without them poses are left out in turn, which says nothing of the one that is wrong and takes most of the time.
    let files = [read(40, 12, 5), read(6, 13, 6)];
    let frames = Frames { metrology: frame([1.5, -2.0, 1.6], [0.0, FRAC_PI_2, PI]), ..Frames::default() };
    for [data, held] in [files.clone(), files.map(|file| seen(&file, &frames))] {
        for (k, size) in [(1, 1e-3), (1, 0.05), (1, 2.0), (5, 1.0)] {
            let mut data = data.clone();
            data.observations[7].measured[k] += size;
            let found = diagnose(&machine, &data, Some(&held), &catalogue()).unwrap().diagnosis;
            let rows: Vec<_> = found.findings.iter().map(|f| f.rows.clone()).collect();
            assert_eq!(rows, [vec![data.observations[7].line]], "{k} {size}: {:?}", found.findings);
        }
    }
}

fn stiffness_gap(a: &Fit, b: &Fit) -> f64 {
    (0..6).map(|k| (a.point.compliances[k] - b.point.compliances[k]).abs() / a.std(k)).fold(0.0, f64::max)
}

fn wanted(id: &str, shape: f64, prior: f64) -> TermSpec {
    let term = Arc::clone(catalogue().iter().find(|t| t.info().id == id).unwrap());
    let prior = vec![prior; term.info().parameters.len()];
    TermSpec { term, rich: false, shape, prior }
}

fn calibrated(hexapod: &Hexapod, data: &Dataset) -> (Campaign, Fit) {
    let campaign = prepare(hexapod, data).unwrap();
    let terms = [wanted("joint-geometry", 1.0, 1e-3), wanted("actuator-pitch", 3e-3, 1e-4)];
    let found = fit(&campaign, &terms, None).unwrap();
    (campaign, found)
}

#[test]
fn springs_of_exact_readings_are_the_same_in_any_frames() {
    let plan = rich_plan(30, 1.0, 8);
    let machine = measured_machine(0.5e-6, 3e-6);
    let mut world = World::on_springs(&machine, PAPER_STIFFNESS);
    let found = |world: &World| {
        let data = world.measure(Measurand::AbsolutePose, &plan);
        fit_baseline(&Campaign::new(&machine, &data).unwrap()).unwrap()
    };
    let plain = found(&world);
    for (name, frames) in instruments() {
        world.metrology_frame = frames.metrology;
        world.target_frame = frames.target;
        let turned = found(&world);
        let off = (turned.point.compliances - plain.point.compliances)
            .component_div(&plain.point.compliances)
            .amax();
        println!("{name}: {off:.1e} of the springs, {} iterations", turned.effort.iterations);
        assert!(turned.is_settled(), "{name}");
        assert!(off < 1e-9, "{name}: {off:.1e}");
        let machine = &turned.point.machine;
        assert!(gap(&machine.metrology_frame, &frames.metrology) < 1e-7, "{name}");
        assert!(gap(&machine.target_frame, &frames.target) < 1e-7, "{name}");
    }
}

#[test]
fn what_noisy_readings_say_of_the_machine_does_not_depend_on_its_place_in_the_room() {
    let (hexapod, data, _) = cases::case("absolute-pitch");
    let (_, plain) = calibrated(&hexapod, &data);
    // A target elsewhere has its own noise: a position error at the lever arm of a rotation.
    let same_noise = |(_, f): &(String, Frames)| f.target.translation.vector.norm() == 0.0;
    for (name, frames) in instruments().into_iter().filter(same_noise) {
        let (_, turned) = calibrated(&hexapod, &seen(&data, &frames));
        let chi2 = turned.chi2 / plain.chi2 - 1.0;
        let gap = stiffness_gap(&plain, &turned);
        println!(
            "{name}: chi2 {chi2:.1e}, springs {gap:.1e} sigma, {} {} iterations",
            plain.effort.iterations, turned.effort.iterations
        );
        assert!(chi2.abs() < SAME, "{name}: {chi2:.1e}");
        assert!(gap < SIGMAS, "{name}: {gap:.1e}");
        let std = turned.std(0) / plain.std(0) - 1.0;
        assert!(std.abs() < SIGMAS, "{name}: {std:.1e}");
    }
}

#[test]
fn noise_from_repeats_is_the_same_where_angles_jump_or_lock() {
    let (hexapod, data, _) = cases::case("absolute-pitch");
    let silent = Hexapod { metrology: None, ..hexapod };
    let plain = Campaign::new(&silent, &data).unwrap().noise;
    for (name, frames) in instruments().into_iter().filter(|(_, f)| f.target.translation.vector.norm() == 0.0)
    {
        let turned = Campaign::new(&silent, &seen(&data, &frames)).unwrap();
        let off = (turned.noise.rotation / plain.rotation - 1.0).abs();
        assert!(off < 1e-2, "{name}: {off:.1e}");
        assert!((turned.noise.translation / plain.translation - 1.0).abs() < 1e-6, "{name}");
    }
}

#[test]
fn differences_of_readings_jump_nowhere() {
    let mut random = Random::new(11);
    for (name, frames) in instruments() {
        let axes = ReadingAxes::of(&frames);
        for _ in 0..20 {
            let platform = Pose::from_array(std::array::from_fn(|_| random.within(0.15)));
            let step: [f64; 6] = std::array::from_fn(|_| random.within(1e-5));
            let from = frames.seen(&platform).to_array();
            let back = axes.difference(&from, &axes.moved(&from, &step));
            let error = (0..6).map(|k| (back[k] - step[k]).abs()).fold(0.0, f64::max);
            assert!(error < ROUNDING, "{name}: {error:.1e}");
        }
    }
}

#[test]
fn a_model_of_turned_frames_is_saved_predicts_and_corrects_commands_as_one_of_straight_frames() {
    let (hexapod, data, holdout) = cases::case("absolute-pitch");
    let frames = Frames {
        metrology: frame([1.5, -2.0, 0.8], [0.0, FRAC_PI_2, 0.0]),
        target: frame([0.0; 3], [PI, 0.0, 0.0]),
    };
    let model = |data: &Dataset| {
        let (campaign, found) = calibrated(&hexapod, data);
        let text = Model::new(&campaign, &found, Estimator::Gls, DataOrigin::default()).to_toml().unwrap();
        Model::from_toml(&text).unwrap()
    };
    let (plain, turned) = (model(&data), model(&seen(&data, &frames)));
    let held = seen(&holdout, &frames);
    let [before, after] = [(&plain, &holdout), (&turned, &held)]
        .map(|(m, rows)| prediction_errors(&hexapod, rows, m.noise, &m.point).unwrap());
    let square = |all: &[hexbench_model::estimation::residuals::Residual]| {
        all.iter().map(|r| r.whitened.norm_squared()).sum::<f64>()
    };
    assert!((square(&after) / square(&before) - 1.0).abs() < 1e-2, "{} {}", square(&before), square(&after));

    // Predicted poses agree as poses, far from the angles in which they are written.
    let there = |m: &Model, rows: &Dataset| predict(m, &rows.observations).unwrap();
    for (a, b) in there(&plain, &holdout).iter().zip(there(&turned, &held)) {
        let a = frames.metrology * rigid(&Pose::from_array(a.value)) * frames.target;
        let off = gap(&a, &rigid(&Pose::from_array(b.value)));
        assert!(off < 2e-7, "{off:.1e}");
    }
    let rows = &holdout.observations[..6];
    for (a, b) in compensate(&plain, rows).unwrap().iter().zip(compensate(&turned, rows).unwrap()) {
        let off = (a.command.to_vector() - b.command.to_vector()).amax();
        assert!(off < 2e-7, "{off:.1e}");
    }
}

#[test]
fn held_out_poses_read_in_other_frames_are_refused() {
    let (hexapod, data, holdout) = cases::case("absolute-pitch");
    let elsewhere = Frames { metrology: frame([1.0, 0.0, 0.0], [0.0; 3]), ..Frames::default() };
    let (campaign, found) = calibrated(&hexapod, &data);
    let error =
        prediction_errors(&hexapod, &seen(&holdout, &elsewhere), campaign.noise, &found.point).unwrap_err();
    assert!(matches!(error, ModelError::Astray { .. }), "{error}");
}

#[test]
fn poses_in_another_unit_or_of_other_rows_are_refused_with_the_next_step() {
    let (hexapod, data, _) = cases::case("absolute-pitch");
    let changed = |change: &dyn Fn(usize, &mut Observation)| {
        let mut data = data.clone();
        data.observations.iter_mut().enumerate().for_each(|(i, o)| change(i, o));
        data
    };
    let poses: Vec<[f64; 6]> = data.observations.iter().map(|o| o.measured).collect();
    let wrong = [
        ("metres for millimetres", changed(&|_, o| (0..3).for_each(|k| o.measured[k] *= 1000.0))),
        (
            "degrees for radians",
            changed(&|_, o| (3..6).for_each(|k| o.measured[k] = o.measured[k].to_degrees())),
        ),
        ("left-handed", changed(&|_, o| o.measured[0] *= -1.0)),
        ("other rows", changed(&|i, o| o.measured = poses[(i + 40) % poses.len()])),
    ];
    for (what, data) in wrong {
        let error = prepare(&hexapod, &data).and_then(|c| fit_baseline(&c)).unwrap_err();
        assert!(matches!(error, ModelError::Astray { .. }), "{what}: {error}");
        assert!(error.next_step("measurements.csv").contains("units"), "{what}");
    }
}

#[test]
fn the_verdict_is_the_same_from_three_metres_away() {
    let (hexapod, data, holdout) = cases::case("absolute-pitch");
    let frames = Frames { metrology: frame([1.5, -2.0, 1.6], [0.3, FRAC_PI_2, 0.0]), ..Frames::default() };
    let told =
        |data: &Dataset, holdout: &Dataset| diagnose(&hexapod, data, Some(holdout), &catalogue()).unwrap();
    let plain = told(&data, &holdout);
    let turned = told(&seen(&data, &frames), &seen(&holdout, &frames));
    assert_eq!(turned.diagnosis.verdict, plain.diagnosis.verdict);
    assert_eq!(turned.diagnosis.added, plain.diagnosis.added);
}
