//! Slopes in closed form beside differences of the whole model.

#![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

use hexbench_core::{Measurand, Observation, Wrench};
use nalgebra::Rotation3;

use super::*;
use crate::estimation::linearization::own_residuals;
use crate::machine::kinematics::Legs;
use crate::machine::placement::Placement;
use crate::test_machine::readings;

/// Step of a joint for its derivatives, m.
const JOINT_STEP: f64 = 1e-6;
/// Step of a gain or an angle for its derivatives.
const SMALL_STEP: f64 = 1e-6;
/// Step of the point of attack for its derivatives, m; the moment is linear in it.
const POINT_STEP: f64 = 1e-3;

/// Deflection over the size of the machine, and the steps of the differences.
const SECOND_ORDER: f64 = 2e-3;

/// One of every kind, six numbers in all.
fn sensors() -> Vec<Sensor> {
    let (sigma, point) = (1e-6, Vector3::new(0.08, -0.05, 0.03));
    let direction = Vector3::new(0.6, 0.0, -0.8);
    let kinds = [
        SensorKind::Distance { point, direction, sigma },
        SensorKind::Point { point: -point, sigma: [sigma; 3] },
        SensorKind::Inclination { axis: direction, sigma },
        SensorKind::LegLength { leg: 2, sigma },
    ];
    kinds.into_iter().enumerate().map(|(k, kind)| Sensor::new(format!("s{k}"), kind)).collect()
}

#[test]
fn slopes_of_springs_agree_with_differences() {
    let [vector, euler] = [Measurand::DeflectionRotationVector, Measurand::DeflectionEuler];
    let poses = [vector, euler, Measurand::AbsolutePose].map(|measurand| (measurand, Vec::new()));
    for (measurand, sensors) in poses.into_iter().chain([(vector, sensors())]) {
        let is_input = |kind: &InputKind| match kind {
            InputKind::Joints => measurand != Measurand::AbsolutePose,
            InputKind::Frame => false,
            InputKind::LoadGain | InputKind::LoadDirection | InputKind::LoadPoint => true,
        };
        let inputs: Vec<InputKind> = InputKind::ALL.into_iter().filter(is_input).collect();
        let kinds = if sensors.is_empty() { "poses" } else { "sensors" };
        let (hexapod, data) = readings(measurand, sensors);
        let campaign = Campaign::new(&hexapod, &data).unwrap().unwhitened();
        let mut point = ModelPoint::start(&campaign);
        point.compliances = Vector6::new(1.0, 1.2, 0.9, 1.1, 0.8, 1.3) * 1e-7;
        let lin = Linearization::at(&campaign, &point).unwrap();
        let closed = by_springs(&campaign, &point.compliances, &lin);
        let differences = by_differences(&campaign, &point, &lin, &inputs);
        let columns: Vec<usize> = inputs.iter().flat_map(|kind| kind.columns()).collect();
        assert_eq!(columns.len(), differences.ncols());
        for (&k, b) in columns.iter().zip(differences.column_iter()) {
            let a = closed.column(k);
            let off = (a - b).norm() / b.norm();
            assert!(off < SECOND_ORDER, "{measurand:?} {kinds} column {k}: {off:.2e}");
        }
    }
}

fn step(kind: InputKind) -> f64 {
    match kind {
        InputKind::Joints => JOINT_STEP,
        InputKind::LoadPoint => POINT_STEP,
        InputKind::LoadGain | InputKind::LoadDirection | InputKind::Frame => SMALL_STEP,
    }
}

/// Reading over the standard deviation of its own noise by inputs of some kinds.
fn by_differences(
    campaign: &Campaign,
    point: &ModelPoint,
    start: &Linearization,
    kinds: &[InputKind],
) -> DMatrix<f64> {
    let here = start.residuals();
    let drawn: Vec<Legs> =
        campaign.groups.iter().map(|group| point.machine.legs(&group.mean.pose).unwrap()).collect();
    let inputs = kinds.iter().flat_map(|&kind| (0..kind.count()).map(move |k| (kind, k)));
    // A residual falls as the prediction rises.
    let column = |(kind, k)| (&here - residuals_with(campaign, point, &drawn, (kind, k))) / step(kind);
    DMatrix::from_columns(&inputs.map(column).collect::<Vec<_>>())
}

/// Residuals with one input a step off.
fn residuals_with(
    campaign: &Campaign,
    point: &ModelPoint,
    drawn: &[Legs],
    (kind, k): (InputKind, usize),
) -> DVector<f64> {
    if kind == InputKind::Joints {
        return with_joint_moved(campaign, point, drawn, k);
    }
    own_residuals(campaign, point, |_, o| {
        let mut o = *o;
        let pose = o.pose;
        for wrench in [&mut o.wrench, &mut o.reference] {
            match kind {
                InputKind::LoadGain => scale(wrench, k),
                InputKind::LoadDirection => {
                    let turn = Rotation3::from_scaled_axis(axis(k) * SMALL_STEP);
                    wrench.force = turn * wrench.force;
                    wrench.moment = turn * wrench.moment;
                }
                InputKind::LoadPoint => {
                    wrench.moment += (pose.rotation() * (axis(k) * POINT_STEP)).cross(&wrench.force);
                }
                InputKind::Joints | InputKind::Frame => {}
            }
        }
        o
    })
    .unwrap()
}

fn scale(wrench: &mut Wrench, k: usize) {
    let part = if k < 3 { &mut wrench.force } else { &mut wrench.moment };
    part[k % 3] *= 1.0 + SMALL_STEP;
}

/// Residuals with one joint coordinate elsewhere; the machine stands where the commanded lengths put it. `drawn`: legs at the commanded
/// poses.
fn with_joint_moved(campaign: &Campaign, point: &ModelPoint, drawn: &[Legs], k: usize) -> DVector<f64> {
    let (mut real, leg) = (point.clone(), k % 18 / 3);
    let joints = if k < 18 { &mut real.machine.base_joints } else { &mut real.machine.platform_joints };
    joints[leg][k % 3] += JOINT_STEP;
    let [base, platform] = [real.machine.base_joints[leg], real.machine.platform_joints[leg]];
    own_residuals(campaign, &real, |i, o| {
        let length = (o.pose.translation + o.pose.rotation() * platform - base).norm();
        let twist = drawn[i].platform_jacobian.column(leg) * (drawn[i].lengths[leg] - length);
        Observation { pose: Placement::from(&o.pose).moved(&twist, 1.0).pose(), ..*o }
    })
    .unwrap()
}
