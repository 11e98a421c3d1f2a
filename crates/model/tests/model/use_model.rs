//! Predictions against held-out measurements, and commands that land where they should.

use std::sync::Arc;

use hexbench_core::{Dataset, Hexapod, Observation, Pose, Wrench};
use hexbench_model::application::compensate::compensate;
use hexbench_model::application::model_file::{DataOrigin, Estimator, Model};
use hexbench_model::application::predict::predict;
use hexbench_model::error::ModelError;
use hexbench_model::estimation::fit::{TermSpec, fit};
use hexbench_model::results::diagnose::prepare;
use hexbench_model::terms::catalogue;

use crate::cases;

fn model(hexapod: &Hexapod, data: &Dataset, terms: &[(&str, f64, f64)]) -> Model {
    let campaign = prepare(hexapod, data).unwrap();
    let all = catalogue();
    let wanted: Vec<TermSpec> = terms
        .iter()
        .map(|(id, shape, prior)| {
            let term = Arc::clone(all.iter().find(|t| t.info().id == *id).unwrap());
            let prior = vec![*prior; term.info().parameters.len()];
            TermSpec { term, rich: false, shape: *shape, prior }
        })
        .collect();
    Model::new(&campaign, &fit(&campaign, &wanted, None).unwrap(), Estimator::Gls, DataOrigin::default())
}

/// Springs alone, fitted to readings that need more.
pub(crate) fn springs() -> Model {
    let (hexapod, data, _) = cases::case("mujoco-foundation");
    model(&hexapod, &data, &[])
}

pub(crate) fn foundation() -> (Model, Dataset) {
    let (hexapod, data, holdout) = cases::case("mujoco-foundation");
    (model(&hexapod, &data, &[("base-compliance", 1.0, 1e-4)]), holdout)
}

pub(crate) fn absolute() -> (Model, Dataset) {
    let (hexapod, data, holdout) = cases::case("absolute-pitch");
    (model(&hexapod, &data, &[("joint-geometry", 1.0, 1e-3), ("actuator-pitch", 3e-3, 1e-4)]), holdout)
}

/// Chi-square per number of held-out readings over noise and uncertainty of the prediction.
fn held_out(model: &Model, holdout: &Dataset) -> f64 {
    let predicted = predict(model, &holdout.observations).unwrap();
    let noise = model.noise.sigma();
    let terms = holdout.observations.iter().zip(&predicted).flat_map(|(o, p)| {
        (0..6).map(move |k| (o.measured[k] - p.value[k]).powi(2) / (noise[k].powi(2) + p.sigma[k].powi(2)))
    });
    terms.sum::<f64>() / (6 * predicted.len()) as f64
}

#[test]
fn predictions_meet_held_out_deflections_and_poses_at_the_noise() {
    for (name, (model, holdout)) in [("foundation", foundation()), ("absolute", absolute())] {
        let chi2 = held_out(&model, &holdout);
        assert!((0.6..1.4).contains(&chi2), "{name}: {chi2}");
    }
}

fn size(values: &[f64; 6]) -> f64 {
    values.iter().fold(0.0, |m, v| m.max(v.abs()))
}

#[test]
fn the_corrected_command_lands_on_the_wanted_pose() {
    let (model, holdout) = foundation();
    let rows: Vec<Observation> =
        holdout.observations.iter().map(|o| Observation { reference: Wrench::default(), ..*o }).collect();
    let corrected = compensate(&model, &rows).unwrap();
    let commanded: Vec<Observation> =
        rows.iter().zip(&corrected).map(|(o, c)| Observation { pose: c.command, ..*o }).collect();
    for ((row, c), p) in rows.iter().zip(&corrected).zip(predict(&model, &commanded).unwrap()) {
        let (at, wanted) = (c.command.to_array(), row.pose.to_array());
        let miss: [f64; 6] = std::array::from_fn(|k| at[k] + p.value[k] - wanted[k]);
        assert!(size(&miss) < 1e-9, "line {}: {miss:?}", row.line);
        assert!(size(&c.remaining) < 1e-9);
        assert!(size(&c.without) > 1e-6, "the load moves the platform");
    }
}

#[test]
fn the_way_through_the_reference_state_changes_a_linear_machine_by_second_order_only() {
    let (model, holdout) = foundation();
    let rows = &holdout.observations[..6];
    let direct: Vec<Observation> =
        rows.iter().map(|o| Observation { reference: Wrench::default(), ..*o }).collect();
    let (through, straight) = (compensate(&model, rows).unwrap(), compensate(&model, &direct).unwrap());
    for (a, b) in through.iter().zip(&straight) {
        let gap = (a.command.to_vector() - b.command.to_vector()).amax();
        assert!(gap < 5e-9, "{gap}");
        // One set of numbers is behind both steps: what is certain of the whole way is not uncertain by its parts.
        for (by_way, at_once) in a.sigma.iter().zip(&b.sigma) {
            assert!((by_way / at_once - 1.0).abs() < 1e-2, "{by_way} {at_once}");
        }
    }
}

#[test]
fn loads_that_may_be_off_make_predictions_uncertain() {
    let (mut model, holdout) = foundation();
    let row = Observation {
        reference: Wrench::default(),
        wrench: Wrench::from_array([0.0, 0.0, -200.0, 0.0, 0.0, 0.0]),
        ..holdout.observations[0]
    };
    let mut with = |gain: f64| {
        model.hexapod.tolerances.load_gain = gain;
        predict(&model, &[row]).unwrap()[0]
    };
    let (known, open) = (with(1e-9), with(0.1));
    for k in 0..6 {
        let by_gain = (open.sigma[k].powi(2) - known.sigma[k].powi(2)).sqrt();
        assert!((by_gain / (0.1 * known.value[k]).abs() - 1.0).abs() < 0.01, "{k}: {by_gain} {known:?}");
    }
}

#[test]
fn absolute_commands_land_too() {
    let (model, holdout) = absolute();
    let rows = &holdout.observations[..8];
    let corrected = compensate(&model, rows).unwrap();
    let commanded: Vec<Observation> =
        rows.iter().zip(&corrected).map(|(o, c)| Observation { pose: c.command, ..*o }).collect();
    let machine = &model.point.machine;
    for (row, p) in rows.iter().zip(predict(&model, &commanded).unwrap()) {
        let reached = machine.platform_place(&Pose::from_array(p.value)).pose();
        let miss = (reached.to_vector() - row.pose.to_vector()).amax();
        assert!(miss < 1e-9, "line {}: {miss}", row.line);
    }
    assert!(
        corrected.iter().all(|c| size(&c.without) > 1e-5),
        "the joints are off by a fraction of a millimetre"
    );
}

#[test]
fn a_singular_pose_is_an_error_with_its_line() {
    let (model, holdout) = foundation();
    let mut rows = holdout.observations[..4].to_vec();
    // All six platform joints in the plane of the base: the legs lie flat.
    let height = model.hexapod.base_joints[0].z - model.hexapod.platform_joints[0].z;
    rows[2].pose = Pose::from_array([0.0, 0.0, height, 0.0, 0.0, 0.0]);
    let expected = rows[2].line;
    for error in [predict(&model, &rows).unwrap_err(), compensate(&model, &rows).unwrap_err()] {
        assert_eq!(error.line, expected);
        assert!(matches!(error.cause, ModelError::SingularPose { .. }), "{error}");
    }
}

#[test]
fn a_load_beyond_reason_is_an_error_and_not_a_number() {
    let (model, holdout) = foundation();
    let mut row = holdout.observations[0];
    row.wrench = Wrench::from_array([0.0, 0.0, -1e9, 0.0, 0.0, 0.0]);
    assert!(predict(&model, &[row]).is_err());
}

#[test]
fn the_uncertainty_grows_with_the_load_and_is_zero_without() {
    let (model, holdout) = foundation();
    let mut row = holdout.observations[0];
    row.reference = row.wrench;
    let idle = predict(&model, &[row]).unwrap()[0];
    assert!(size(&idle.value) < 1e-15 && size(&idle.sigma) < 1e-15);
    row.reference = Wrench::default();
    row.wrench = Wrench::from_array([0.0, 0.0, -100.0, 0.0, 0.0, 0.0]);
    let one = predict(&model, &[row]).unwrap()[0];
    row.wrench = Wrench::from_array([0.0, 0.0, -200.0, 0.0, 0.0, 0.0]);
    let two = predict(&model, &[row]).unwrap()[0];
    assert!((two.sigma[2] / one.sigma[2] - 2.0).abs() < 0.01);
}
