//! `K = L' diag(k) L` (Kalas et al. 2018, eq. 8 to 10) of the two hexapods of the Rubin telescope, by three computations that share nothing: the
//! model, finite differences of the simulated world, and a sum over struts straight from the published table of joints.
//!
//! Joints: lsst-ts/ts_mthexapod, as the table says. Strut stiffnesses are not published; six different ones are taken, a thousandth of such
//! struts' with a thousandth of the weight: the same motions and the same matrices but for the factor, and forces of which the world
//! knows when it is at rest (rounding of lengths three meters away is 1e-7 N of 100 N/um). The mobile origin is the pivot, 2.2 m from the struts of the camera.

use hexbench_core::{Dataset, Hexapod, Matrix3, Matrix6, Observation, Pose, Vector3, Vector6, Wrench};
use hexbench_experiments::recovery::pulls::right_fit;
use hexbench_experiments::recovery::scene::subjects;
use hexbench_model::application::model_file::{DataOrigin, Estimator, Model};
use hexbench_model::application::stiffness::{StiffnessPoint, cartesian_stiffness};
use hexbench_truth::{Situation, World};
use nalgebra::Rotation3;
use serde_json::Value;

const TABLE: &str = include_str!("../../../model/tests/reference/hexapods/lsst_geometry.json");
const MACHINES: [&str; 2] = ["camera", "m2"];
/// N/m.
const STIFFNESS: [f64; 6] = [1.0e5, 1.3e5, 0.9e5, 1.1e5, 1.2e5, 0.8e5];
/// Step of the differences of the world, N; N m for moments.
const STEP: f64 = 0.03;
/// What is held, as a weight at the pivot, N.
const WEIGHT: f64 = 30.0;
/// No strut is shorter, and joints are farther from each other, m.
const SHORTEST: f64 = 0.45;
/// Ends of travel of the camera and of M2 together: mm and deg.
const POSES: [[f64; 6]; 4] = [
    [0.0; 6],
    [10.0, 0.0, -5.0, 0.1, 0.0, 0.05],
    [-7.0, 7.0, 8.0, -0.1, 0.15, -0.04],
    [0.0, -10.0, 8.9, 0.17, -0.17, 0.0],
];

fn joints(machine: &str, side: &str, pivot: Vector3) -> [Vector3; 6] {
    let table: Value = serde_json::from_str(TABLE).unwrap();
    let rows: Vec<[f64; 3]> = serde_json::from_value(table[machine][side].clone()).unwrap();
    let joint = |k: usize| Vector3::from(rows[k].map(|um: f64| um * 1e-6)) - pivot;
    std::array::from_fn(joint)
}

/// The mirror holds what we call the base, the moving end is what the table calls the base; both about the pivot.
fn machine(name: &str) -> Hexapod {
    let table: Value = serde_json::from_str(TABLE).unwrap();
    let pivot: [f64; 3] = serde_json::from_value(table[name]["pivot"].clone()).unwrap();
    let pivot = Vector3::from(pivot.map(|um| um * 1e-6));
    Hexapod::of_joints(name, joints(name, "mirror", pivot), joints(name, "base", pivot))
}

fn pose(x: [f64; 6]) -> Pose {
    let si = |k: usize| if k < 3 { x[k] * 1e-3 } else { x[k].to_radians() };
    Pose::from_array(std::array::from_fn(si))
}

/// The sum over struts; with a load also what its forces do as the struts turn: the derivative of `f n` and of `a x f n` at the load,
/// forces of the undeformed machine.
fn by_struts(hexapod: &Hexapod, pose: &Pose, load: &Vector6) -> Matrix6 {
    let [x, y, z] = [pose.angles.x, pose.angles.y, pose.angles.z];
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), z)
        * Rotation3::from_axis_angle(&Vector3::y_axis(), y)
        * Rotation3::from_axis_angle(&Vector3::x_axis(), x);
    let struts: Vec<(Vector3, Vector3, f64)> = (0..6)
        .map(|k| {
            let arm = turn * hexapod.platform_joints[k];
            let span = pose.translation + arm - hexapod.base_joints[k];
            (arm, span.normalize(), span.norm())
        })
        .collect();
    let line = |(arm, n, _): &(Vector3, Vector3, f64)| {
        let m = arm.cross(n);
        Vector6::new(n.x, n.y, n.z, m.x, m.y, m.z)
    };
    let lines = Matrix6::from_columns(&std::array::from_fn::<_, 6, _>(|k| line(&struts[k])));
    let forces = lines.try_inverse().unwrap() * load;
    let mut sum = Matrix6::zeros();
    for (k, strut) in struts.iter().enumerate() {
        let (arm, n, length) = strut;
        let w = line(strut);
        sum += w * w.transpose() * STIFFNESS[k];
        // A twist moves the joint by v + omega x a: the direction turns by (I - n n') of it over the length, the arm by omega x a.
        let mut moves = nalgebra::Matrix3x6::zeros();
        moves.fixed_view_mut::<3, 3>(0, 0).copy_from(&Matrix3::identity());
        moves.fixed_view_mut::<3, 3>(0, 3).copy_from(&-arm.cross_matrix());
        let turned = (Matrix3::identity() - n * n.transpose()) * moves * (forces[k] / length);
        let mut geometric = Matrix6::zeros();
        geometric.fixed_view_mut::<3, 6>(0, 0).copy_from(&turned);
        let lever = arm.cross_matrix() * turned;
        geometric.fixed_view_mut::<3, 6>(3, 0).copy_from(&lever);
        let swing = n.cross_matrix() * arm.cross_matrix() * forces[k];
        let block = geometric.fixed_view::<3, 3>(3, 3) + swing;
        geometric.fixed_view_mut::<3, 3>(3, 3).copy_from(&block);
        sum += geometric;
    }
    sum
}

/// Motion of the pivot per unit of load, by differences of states of rest.
fn by_differences(hexapod: &Hexapod, pose: &Pose, load: &Vector6) -> Matrix6 {
    let world = World::new(hexapod.clone(), &STIFFNESS);
    let stands = |w: Vector6| world.pose(&Situation::new(*pose, Wrench::from_array(w.into()))).unwrap();
    let column = |axis: usize| {
        let [plus, minus] = [1.0, -1.0].map(|sign| stands(load + Vector6::ith(axis, sign * STEP)));
        let shift = plus.translation - minus.translation;
        let turn = plus.rotation() * minus.rotation().transpose();
        let skew = (turn - turn.transpose()) * 0.5;
        Vector6::new(shift.x, shift.y, shift.z, skew[(2, 1)], skew[(0, 2)], skew[(1, 0)]) / (2.0 * STEP)
    };
    Matrix6::from_columns(&std::array::from_fn::<_, 6, _>(column))
}

/// A model with these very springs, which the readings of the world were fitted for.
fn model(hexapod: &Hexapod) -> Model {
    let world = World::new(hexapod.clone(), &STIFFNESS);
    let loads = (0..6).map(|k| Wrench::from_array(Vector6::ith(k, 1.0).into()));
    let read = |(n, load): (i64, Wrench)| {
        let unread = Observation::unread(Pose::default(), load, Wrench::default());
        let situation = Situation::new(Pose::default(), load);
        let measured = world.deflection(&situation).unwrap().into();
        Observation { pose_id: n, repeat: 1, measured, ..unread }
    };
    let data = Dataset::of_deflections("", (1..).zip(loads).map(read).collect());
    let subject = subjects().into_iter().find(|s| s.name == "springs").unwrap();
    let (campaign, fit) = right_fit(&subject, hexapod, &data).unwrap();
    let mut model = Model::new(&campaign, &fit, Estimator::Gls, DataOrigin::default());
    for (found, stiffness) in model.point.compliances.iter().zip(STIFFNESS) {
        // Deflections of 1e-4 of a strut: linearized where they are read, to the square of that.
        assert!((found * stiffness - 1.0).abs() < 1e-5, "{:e}", found * stiffness - 1.0);
    }
    model.point.compliances = Vector6::from(STIFFNESS.map(f64::recip));
    model
}

/// The largest difference of two compliance matrices, each number over the root of its two diagonal ones.
fn apart(found: &Matrix6, expected: &Matrix6) -> f64 {
    let size = |i: usize, j: usize| (expected[(i, i)] * expected[(j, j)]).sqrt();
    (0..36)
        .map(|k| (k % 6, k / 6))
        .map(|(i, j)| (found[(i, j)] - expected[(i, j)]).abs() / size(i, j))
        .fold(0.0, f64::max)
}

fn asked(model: &Model, pose: Pose, load: &Vector6) -> [Matrix6; 2] {
    // A thousandth of the usual newton, as everything here.
    let at = StiffnessPoint { amplitude: 1e-3, ..StiffnessPoint::default() };
    let row = Observation::unread(pose, Wrench::from_array((*load).into()), Wrench::default());
    let found = &cartesian_stiffness(model, &[row], &at).unwrap()[0];
    [found.compliance, found.stiffness]
}

/// How far differences of the world may be from the truth: what rounding of the farthest joint, in each of two states of rest, is in each
/// number of the matrix, and the square of the motion over a strut.
fn limit(hexapod: &Hexapod, compliance: &Matrix6) -> f64 {
    const ROUNDINGS: f64 = 2.0;
    let farthest = hexapod.base_joints.iter().map(Vector3::norm).fold(0.0, f64::max);
    let position = ROUNDINGS * f64::EPSILON * farthest;
    let size = |i: usize| compliance[(i, i)].sqrt();
    let rounding = |i: usize| if i < 3 { position } else { position / SHORTEST };
    let of = |(i, j): (usize, usize)| rounding(i) / (STEP * size(i) * size(j));
    let motion = STEP * (0..3).map(|i| compliance[(i, i)]).fold(0.0, f64::max) / SHORTEST;
    (0..36).map(|k| of((k % 6, k / 6))).fold(0.0, f64::max) + motion * motion
}

#[test]
fn the_unloaded_rubin_hexapods_have_the_stiffness_of_the_sum_over_their_struts() {
    /// Sums of products over six struts, through the inverse of a matrix that is conditioned as 1e3 is.
    const ROUNDING: f64 = 1e3 * 6.0 * f64::EPSILON;
    for name in MACHINES {
        let (hexapod, model) = (machine(name), model(&machine(name)));
        for x in POSES {
            let (pose, none) = (pose(x), Vector6::zeros());
            let closed = by_struts(&hexapod, &pose, &none);
            let compliance = closed.try_inverse().unwrap();
            let (world, limit) =
                (apart(&by_differences(&hexapod, &pose, &none), &compliance), limit(&hexapod, &compliance));
            let [c, k] = asked(&model, pose, &none);
            let (of_model, of_k) = (apart(&c, &compliance), apart(&k, &closed));
            println!("{name} {x:?}: world {world:.1e} of {limit:.1e}, model {of_model:.1e}, K {of_k:.1e}");
            assert!(world < limit && of_model < ROUNDING && of_k < ROUNDING, "{name} {x:?}");
        }
    }
}

#[test]
fn under_a_weight_the_stiffness_of_the_model_is_that_of_the_world_and_not_the_unloaded_one() {
    for name in MACHINES {
        let (hexapod, model) = (machine(name), model(&machine(name)));
        let load = Vector6::new(0.0, 0.0, -WEIGHT, 0.0, 0.0, 0.0);
        let world = World::new(hexapod.clone(), &STIFFNESS);
        for x in POSES {
            let pose = pose(x);
            let situation = Situation::new(pose, Wrench::from_array(load.into()));
            // Where the platform stands under the weight its stiffness is the derivative of forces there.
            let stands = world.pose(&situation).unwrap();
            let closed = by_struts(&hexapod, &stands, &load).try_inverse().unwrap();
            let differences = by_differences(&hexapod, &pose, &load);
            let unloaded = by_struts(&hexapod, &pose, &Vector6::zeros()).try_inverse().unwrap();
            let [c, _] = asked(&model, pose, &load);
            let limit = limit(&hexapod, &closed);
            let moved = (stands.translation - pose.translation).norm();
            let [of_world, found, without] = [&differences, &c, &unloaded].map(|m| apart(m, &closed));
            // The model expands its legs to second order in the motion: a compliance lacks its square over a strut, a few times.
            let expanded = 10.0 * (moved / SHORTEST).powi(2);
            println!(
                "{name} {x:?}: world {of_world:.1e} of {limit:.1e}, model {found:.1e} of {expanded:.1e}, unloaded {without:.1e}"
            );
            assert!(of_world < limit && found < expanded, "{name} {x:?}");
            assert!(without > 100.0 * expanded, "{name} {x:?}: the weight must count");
        }
    }
}
