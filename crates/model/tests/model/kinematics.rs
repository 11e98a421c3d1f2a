//! Leg kinematics: published strut lengths, derivatives, power, singular poses, rigid motions.

use hexbench_core::{Matrix3, Pose, Vector3, Vector6};
use hexbench_model::error::ModelError;
use hexbench_model::machine::kinematics::{Legs, analytic_leg_jacobian, euler_rate_matrix, leg_lengths};
use nalgebra::{Isometry3, Rotation3};
use proptest::prelude::*;
use serde_json::Value;

use crate::common::random::Random;
use crate::common::{self, hexapod, plan, ring};

/// Half a unit of the fifth printed decimal.
const LSST_PRINTED_M: f64 = 0.5e-5;
/// Half a unit of the ninth decimal, and the rounding of lengths of 3 m.
const LSST_FULL_M: f64 = 0.51e-9;
/// One value of the second case ends in ...525 and may be rounded either way.
const LSST_ZIGZAG_UM: f64 = 0.51e-2;
/// Central differences with step h err by h^2/6 times the third derivative (at most 1.2/q^2 = 70 for legs of 130 mm
/// and more) plus eps q/h.
const STEP: f64 = 1e-5;
const DIFFERENCE: f64 = 70.0 * STEP * STEP / 6.0 + 10.0 * f64::EPSILON / STEP;
/// Sums of six products of numbers of size one, through one 6x6 inverse with condition number below 1e3.
const ROUNDING: f64 = 1e3 * 6.0 * f64::EPSILON;

fn table() -> Value {
    serde_json::from_str(include_str!("../reference/hexapods/lsst_ik_vectors.json")).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

fn six_numbers(value: &Value) -> [f64; 6] {
    numbers(value).try_into().unwrap()
}

/// Joints of a table that lists all x, then all y, then all z in um.
fn joints(value: &Value) -> [Vector3; 6] {
    let axes: Vec<Vec<f64>> = value.as_array().unwrap().iter().map(numbers).collect();
    std::array::from_fn(|i| Vector3::new(axes[0][i], axes[1][i], axes[2][i]) * 1e-6)
}

/// Change of strut lengths when the base end moves about a pivot: the mirror plays our base, the moving end our
/// platform with its origin at the pivot. `R = Rx Ry Rz`.
fn strut_changes(mirror: &[Vector3; 6], moving: &[Vector3; 6], pivot: Vector3, x: [f64; 6]) -> Vector6 {
    let platform = moving.map(|b| b - pivot);
    let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), x[3])
        * Rotation3::from_axis_angle(&Vector3::y_axis(), x[4])
        * Rotation3::from_axis_angle(&Vector3::z_axis(), x[5]);
    let moved = Pose::from_rotation(pivot + Vector3::new(x[0], x[1], x[2]), turn.matrix());
    let neutral = Pose::from_rotation(pivot, &Matrix3::identity());
    leg_lengths(mirror, &platform, &moved) - leg_lengths(mirror, &platform, &neutral)
}

#[test]
fn strut_lengths_of_the_rubin_camera_hexapod_agree_to_the_printed_digits() {
    let case = &table()["case1"];
    let pivot = Vector3::from_column_slice(&numbers(&case["pivot"]));
    let found = strut_changes(
        &joints(&case["mirror_um"]),
        &joints(&case["base_um"]),
        pivot,
        six_numbers(&case["pose"]),
    );
    let error = |key: &str| (found - Vector6::from(six_numbers(&case[key]))).amax();
    assert!(error("delta_lengths_5dec") <= LSST_PRINTED_M, "printed: {:.1e} m", error("delta_lengths_5dec"));
    assert!(error("own_9dec") <= LSST_FULL_M, "nine decimals: {:.1e} m", error("own_9dec"));
}

#[test]
fn strut_lengths_of_the_rubin_zigzag_machine_agree_to_the_printed_digits() {
    let case = &table()["case2_zigzag"];
    let number = |key: &str| case[key].as_f64().unwrap();
    let first = number("base_angle0_deg");
    let moving =
        ring(number("base_radius_um"), [0.0, 120.0, 120.0, 240.0, 240.0, 0.0].map(|d| first + d), 0.0);
    let mirror_angles = [60.0, 60.0, 180.0, 180.0, 300.0, 300.0].map(|d| first + d);
    let mirror = ring(number("mirror_radius_um"), mirror_angles, number("mirror_z_um"));
    let pivot = Vector3::from_column_slice(&numbers(&case["pivot_um"]));
    let t = numbers(&case["translation_um"]);
    let found = strut_changes(&mirror, &moving, pivot, [t[0], t[1], t[2], 0.0, 0.0, 0.0]);
    let error = (found - Vector6::from(six_numbers(&case["delta_lengths_um_2dec"]))).amax();
    assert!(error <= LSST_ZIGZAG_UM, "{error:.1e} um");
}

/// A pose moved by a small twist in fixed axes.
fn moved(pose: &Pose, twist: &Vector6) -> Pose {
    let turn = Rotation3::new(twist.fixed_rows::<3>(3).into_owned());
    Pose::from_rotation(pose.translation + twist.fixed_rows::<3>(0), &(turn.matrix() * pose.rotation()))
}

#[test]
fn the_geometric_leg_jacobian_is_the_derivative_of_the_leg_lengths_by_the_twist() {
    let machine = common::paper_machine();
    let (base, platform) = (&machine.base_joints, &machine.platform_joints);
    let mut random = Random::new(1);
    for _ in 0..50 {
        let pose = plan::random_pose(&mut random, 30.0, 20.0);
        let legs = Legs::at(base, platform, &pose).unwrap();
        for k in 0..6 {
            let at = |h: f64| leg_lengths(base, platform, &moved(&pose, &Vector6::ith(k, h)));
            let error = ((at(STEP) - at(-STEP)) / (2.0 * STEP) - legs.leg_jacobian.column(k)).amax();
            assert!(error < DIFFERENCE, "column {k}: {error:.1e}");
        }
    }
}

#[test]
fn the_analytic_leg_jacobian_is_the_derivative_of_the_leg_lengths_by_the_pose_coordinates() {
    let machine = common::paper_machine();
    let (base, platform) = (&machine.base_joints, &machine.platform_joints);
    let mut random = Random::new(2);
    for _ in 0..50 {
        let pose = plan::random_pose(&mut random, 30.0, 20.0);
        let jacobian = analytic_leg_jacobian(&Legs::at(base, platform, &pose).unwrap(), &pose.angles);
        for k in 0..6 {
            let at = |h: f64| {
                let mut x = pose.to_array();
                x[k] += h;
                leg_lengths(base, platform, &Pose::from_array(x))
            };
            let error = ((at(STEP) - at(-STEP)) / (2.0 * STEP) - jacobian.column(k)).amax();
            assert!(error < DIFFERENCE, "column {k}: {error:.1e}");
        }
    }
}

#[test]
fn euler_rates_turn_into_the_angular_velocity_of_the_rotation_matrix() {
    let mut random = Random::new(3);
    for _ in 0..50 {
        let pose = plan::random_pose(&mut random, 0.0, 80.0);
        for k in 0..3 {
            let at = |h: f64| {
                let mut x = pose.to_array();
                x[3 + k] += h;
                Pose::from_array(x).rotation()
            };
            // dR/dt R' = [omega]x.
            let spin = (at(STEP) - at(-STEP)) / (2.0 * STEP) * pose.rotation().transpose();
            let omega = Vector3::new(spin[(2, 1)], spin[(0, 2)], spin[(1, 0)]);
            let error = (omega - euler_rate_matrix(&pose.angles).column(k)).amax();
            assert!(error < DIFFERENCE, "angle {k}: {error:.1e}");
        }
    }
}

#[test]
fn a_pose_where_the_legs_do_not_hold_the_platform_is_an_error() {
    // Equal rings, one turned by a quarter: Fichter's singular posture.
    let joints = ring(0.1, [0.0, 60.0, 120.0, 180.0, 240.0, 300.0], 0.0);
    let quarter = std::f64::consts::FRAC_PI_2;
    let turned = Pose::from_array([0.0, 0.0, 0.2, 0.0, 0.0, quarter]);
    // All six legs vertical: nothing holds the platform sideways.
    let upright = Pose::from_array([0.0, 0.0, 0.2, 0.0, 0.0, 0.0]);
    // Joints upon joints: legs without length.
    let collapsed = Pose::default();
    // All platform joints in one point: the legs carry no moment.
    let point = [Vector3::zeros(); 6];
    for (platform, pose) in [(joints, turned), (joints, upright), (joints, collapsed), (point, upright)] {
        let outcome = Legs::at(&joints, &platform, &pose);
        assert!(matches!(outcome, Err(ModelError::SingularPose { .. })), "{pose:?} gave {outcome:?}");
    }
}

#[test]
fn a_pose_that_is_not_a_number_is_an_error() {
    let machine = common::paper_machine();
    for bad in [f64::NAN, f64::INFINITY] {
        let pose = Pose::from_array([0.0, 0.0, bad, 0.0, 0.0, 0.0]);
        assert!(Legs::at(&machine.base_joints, &machine.platform_joints, &pose).is_err());
    }
}

#[test]
fn whether_a_pose_is_singular_does_not_depend_on_the_unit_of_length() {
    for unit in [1e-3, 1.0, 1e3, 1e6] {
        let base = ring(0.16 * unit, [-10.0, 10.0, 110.0, 130.0, 230.0, 250.0], -0.165 * unit);
        let platform = ring(0.12 * unit, [-50.0, 50.0, 70.0, 170.0, 190.0, 290.0], 0.0);
        assert!(Legs::at(&base, &platform, &Pose::default()).is_ok(), "unit {unit}");
    }
}

prop_compose! {
    fn any_pose()(t in prop::array::uniform3(-0.03..0.03_f64), r in prop::array::uniform3(-0.4..0.4_f64)) -> Pose {
        Pose::from_array([t[0], t[1], t[2], r[0], r[1], r[2]])
    }
}

fn any_six(size: f64) -> impl Strategy<Value = Vector6> {
    prop::array::uniform6(-size..size).prop_map(Vector6::from)
}

proptest! {
    #[test]
    fn leg_forces_do_the_work_of_the_wrench(pose in any_pose(), wrench in any_six(300.0), twist in any_six(1.0)) {
        let machine = common::paper_machine();
        let legs = Legs::at(&machine.base_joints, &machine.platform_joints, &pose).unwrap();
        let work = legs.forces(&wrench).dot(&(legs.leg_jacobian * twist));
        let scale = wrench.norm() * twist.norm();
        prop_assert!((work - wrench.dot(&twist)).abs() <= ROUNDING * scale, "{:.1e}", work - wrench.dot(&twist));
    }

    #[test]
    fn platform_and_leg_jacobian_are_inverse(pose in any_pose()) {
        let machine = common::paper_machine();
        let legs = Legs::at(&machine.base_joints, &machine.platform_joints, &pose).unwrap();
        let error = (legs.leg_jacobian * legs.platform_jacobian - hexbench_core::Matrix6::identity()).amax();
        prop_assert!(error <= ROUNDING, "{error:.1e}");
    }

    #[test]
    fn leg_lengths_do_not_change_when_base_and_pose_move_together(
        pose in any_pose(), shift in prop::array::uniform3(-5.0..5.0_f64), turn in prop::array::uniform3(-1.5..1.5_f64),
    ) {
        let drawn = common::paper_machine();
        let motion = Isometry3::new(Vector3::from(shift), Vector3::from(turn));
        let moved = hexapod(drawn.base_joints.map(|a| motion.rotation * a + motion.translation.vector), drawn.platform_joints);
        let r = motion.rotation.to_rotation_matrix();
        let there = Pose::from_rotation(
            motion.rotation * pose.translation + motion.translation.vector,
            &(r.matrix() * pose.rotation()),
        );
        let before = leg_lengths(&drawn.base_joints, &drawn.platform_joints, &pose);
        let after = leg_lengths(&moved.base_joints, &moved.platform_joints, &there);
        let limit = 20.0 * f64::EPSILON * (1.0 + motion.translation.vector.norm());
        prop_assert!((before - after).amax() <= limit, "{:.1e} m", (before - after).amax());
    }
}
