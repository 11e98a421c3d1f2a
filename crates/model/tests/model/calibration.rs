//! Terms that change the machine, its loads or its frames: their columns are what recalibration does.

use std::sync::Arc;

use hexbench_core::{Measurand, Observation, Pose, Vector3, Vector6, Wrench};
use hexbench_model::effects::term::Term;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::linearization::{Active, Linearization, ModelPoint};
use hexbench_model::machine::geometry::Machine;
use nalgebra::{DMatrix, Isometry3, Rotation3};

use crate::common::random::Random;
use crate::common::terms::{NATURAL, by_id, rows};
use crate::common::world::{World, coordinates, rigid};
use crate::common::{PAPER_STIFFNESS, measured_machine, paper_machine, six};

/// Central differences with steps of 1e-7 m or 1e-6 rad on legs of 0.2 m closed to 1e-16 m: 1e-9 by rounding.
const DIFFERENCE: f64 = 1e-8;

fn point(campaign: &Campaign) -> ModelPoint {
    ModelPoint { compliances: Vector6::from(PAPER_STIFFNESS).map(f64::recip), ..ModelPoint::start(campaign) }
}

/// Columns of a calibrating term, and central differences of the residual when the machine is recalibrated.
fn assert_recalibrates(
    term: &Arc<dyn Term>,
    campaign: &Campaign,
    here: &ModelPoint,
    values: &[f64],
    limit: f64,
) {
    let at = |values: &[f64]| {
        let active = Active { values: values.to_vec(), ..Active::new(Arc::clone(term), false, 1.0) };
        Linearization::at(campaign, &ModelPoint { active: vec![active], ..here.clone() }).unwrap()
    };
    let block: DMatrix<f64> = at(values).term_block(term.as_ref(), false, 1.0);
    for (k, p) in term.info().parameters.iter().enumerate() {
        let step = 1e-4 * NATURAL.size(p.scale);
        let beside = |h: f64| {
            let mut moved = values.to_vec();
            moved[k] += h;
            at(&moved).residuals()
        };
        let difference = (beside(step) - beside(-step)) / (2.0 * step);
        let error = (&difference + block.column(k)).amax() / difference.amax();
        println!("{}.{}: {error:.1e}", term.info().id, p.name);
        assert!(error < limit, "{}.{}: column off by {error:.1e}", term.info().id, p.name);
    }
}

#[test]
fn loads_moved_and_tilted_recalibrate_the_forces_as_their_columns_say() {
    // The reference pose sags with the springs under the calibrated load: a relative change of the columns by load over
    // stiffness times length, 300 N / (4e6 N/m * 0.19 m) = 4e-4.
    const LIMIT: f64 = 2e-3;
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let data = world.measure(Measurand::DeflectionEuler, &rows(6, 9));
    let campaign = Campaign::new(&measured_machine(0.5e-6, 3e-6), &data).unwrap();
    for (id, values) in [("load-offset", vec![3e-3, -2e-3, 5e-3]), ("load-tilt", vec![2e-3, -1e-3])] {
        assert_recalibrates(&by_id(id), &campaign, &point(&campaign), &values, LIMIT);
    }
}

/// Joints with errors of some tenths of a millimeter, base joints first.
fn joint_errors(seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    (0..36).map(|_| random.within(3e-4)).collect()
}

/// A machine built with joint errors, read absolutely without load in displaced frames: exact closure of the legs.
fn displaced_world(errors: &[f64]) -> World {
    let mut world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    for leg in 0..6 {
        world.built.base_joints[leg] += Vector3::from_column_slice(&errors[3 * leg..3 * leg + 3]);
        world.built.platform_joints[leg] += Vector3::from_column_slice(&errors[18 + 3 * leg..21 + 3 * leg]);
    }
    world.metrology_frame = Isometry3::new(Vector3::new(0.4, -0.2, 0.1), Vector3::new(0.02, -0.01, 0.3));
    world.target_frame = Isometry3::new(Vector3::new(0.01, 0.02, 0.05), Vector3::new(-0.05, 0.1, 0.02));
    world
}

fn unloaded(plan: Vec<Observation>) -> Vec<Observation> {
    let bare = |o| Observation { wrench: Wrench::default(), reference: Wrench::default(), ..o };
    plan.into_iter().map(bare).collect()
}

#[test]
fn at_the_true_joints_and_frames_absolute_poses_leave_no_residual() {
    // Legs of 0.2 m closed to 1e-16 m against a noise of 0.5 um.
    const WHITENED: f64 = 1e-8;
    let errors = joint_errors(10);
    let world = displaced_world(&errors);
    let data = world.measure(Measurand::AbsolutePose, &unloaded(rows(8, 11)));
    let campaign = Campaign::new(&measured_machine(0.5e-6, 3e-6), &data).unwrap();
    let mut here = point(&campaign);
    here.machine.metrology_frame = world.metrology_frame;
    here.machine.target_frame = world.target_frame;
    let term = by_id("joint-geometry");
    here.active = vec![Active { values: errors, ..Active::new(term, false, 1.0) }];
    let left = Linearization::at(&campaign, &here).unwrap().residuals().amax();
    assert!(left < WHITENED, "{left:.1e} standard deviations");
}

#[test]
fn joints_moved_recalibrate_closure_and_leg_forces_as_their_columns_say() {
    // At the truth the residual vanishes and with it all terms of second order.
    let errors = joint_errors(12);
    let world = displaced_world(&errors);
    for plan in [unloaded(rows(6, 13)), rows(6, 13)] {
        let data = world.measure(Measurand::AbsolutePose, &plan);
        let campaign = Campaign::new(&measured_machine(0.5e-6, 3e-6), &data).unwrap();
        let mut here = point(&campaign);
        here.machine.metrology_frame = world.metrology_frame;
        here.machine.target_frame = world.target_frame;
        assert_recalibrates(&by_id("joint-geometry"), &campaign, &here, &errors, DIFFERENCE);
    }
}

#[test]
fn frames_moved_change_the_residual_as_their_columns_say() {
    for plan in [unloaded(rows(6, 15)), rows(6, 15)] {
        assert_frames_recalibrate(&plan);
    }
}

fn assert_frames_recalibrate(plan: &[Observation]) {
    // m and rad; the curvature of a frame's motion is of size one.
    const STEP: f64 = 1e-6;
    let errors = joint_errors(14);
    let world = displaced_world(&errors);
    let data = world.measure(Measurand::AbsolutePose, plan);
    let campaign = Campaign::new(&measured_machine(0.5e-6, 3e-6), &data).unwrap();
    let mut here = point(&campaign);
    here.machine.metrology_frame = world.metrology_frame;
    here.machine.target_frame = world.target_frame;
    here.active = vec![Active { values: errors, ..Active::new(by_id("joint-geometry"), false, 1.0) }];
    let block = Linearization::at(&campaign, &here).unwrap().common_block();
    for k in 0..12 {
        let beside = |h: f64| {
            let mut moved = here.clone();
            let mut motion = [0.0; 12];
            motion[k] = h;
            moved.move_frames(&motion);
            Linearization::at(&campaign, &moved).unwrap().residuals()
        };
        let difference = (beside(STEP) - beside(-STEP)) / (2.0 * STEP);
        let error = (&difference + block.column(6 + k)).amax() / difference.amax();
        assert!(error < DIFFERENCE, "frame motion {k}: column off by {error:.1e}");
    }
}

#[test]
fn frames_of_the_machine_are_those_of_the_world() {
    let world = displaced_world(&joint_errors(16));
    let mut machine = Machine::nominal(&paper_machine());
    machine.metrology_frame = world.metrology_frame;
    machine.target_frame = world.target_frame;
    let pose = Pose::from_array([0.01, -0.02, 0.005, 0.1, -0.05, 0.2]);
    let expected = coordinates(&(world.metrology_frame * rigid(&pose) * world.target_frame));
    let error = (machine.target_pose(&pose).to_vector() - Vector6::from(expected)).amax();
    let back =
        (machine.platform_place(&machine.target_pose(&pose)).pose().to_vector() - pose.to_vector()).amax();
    assert!(error < 1e-14 && back < 1e-14, "{error:.1e}, {back:.1e}");
}

#[test]
fn the_effective_wrench_is_the_moved_and_tilted_one() {
    let mut moved = Machine::nominal(&paper_machine());
    moved.load_point = Vector3::new(0.01, 0.02, -0.03);
    moved.load_tilt = Vector3::new(1e-3, -2e-3, 0.0);
    let pose = Pose::from_array([0.0, 0.0, 0.0, 0.2, -0.1, 0.4]);
    let wrench = Wrench::from_array([10.0, -20.0, -300.0, 1.0, 2.0, 3.0]);
    let force = Rotation3::new(moved.load_tilt) * wrench.force;
    let arm = rigid(&pose).rotation * moved.load_point;
    let expected = six(&force, &(wrench.moment + arm.cross(&force)));
    let error = (moved.effective_wrench(&wrench, &(&pose).into()) - expected).amax();
    assert!(error < 1e-12, "{error:.1e}");
}
