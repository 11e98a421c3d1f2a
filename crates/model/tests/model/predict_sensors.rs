//! What a fitted model says of gauges, points, levels and scales that have not been read, against an independent world.

use std::sync::Arc;

use hexbench_core::{Dataset, Hexapod, Observation, Sensor, SensorKind, Tolerances, Vector3};
use hexbench_model::application::model_file::{DataOrigin, Estimator, Model};
use hexbench_model::application::predict::{
    PredictError, SensorPrediction, predict_sensors, predict_sensors_with_covariance,
};
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::{TermSpec, fit};
use hexbench_model::estimation::linearization::Linearization;
use hexbench_model::terms::catalogue;

use crate::cases;
use crate::common::plan::rich_plan;
use crate::common::world::World;
use crate::common::{PAPER_STIFFNESS, paper_machine};
use crate::sensors::{GAUGE_M, balls, gauges, read, scales, with};

/// Of a level.
const LEVEL_RAD: f64 = 1e-6;

/// One of every kind: eleven numbers, which make two blocks of six.
fn every_kind() -> Hexapod {
    let level = Sensor::new("level", SensorKind::Inclination { axis: Vector3::x(), sigma: LEVEL_RAD });
    let others = [balls(GAUGE_M).remove(0), level, scales(GAUGE_M).remove(2)];
    with(gauges(GAUGE_M).into_iter().chain(others).collect())
}

fn world() -> World {
    World::on_springs(&paper_machine(), PAPER_STIFFNESS)
}

/// The fit of a machine and sensors that stand exactly where they are said to stand.
/// A tolerance of nothing.
const EXACT: f64 = 1e-15;

fn model(hexapod: &Hexapod, data: &Dataset, terms: &[&str]) -> Model {
    let campaign = Campaign::new(hexapod, data).unwrap();
    let all = catalogue();
    let wanted = |id: &&str| {
        let term = Arc::clone(all.iter().find(|t| t.info().id == *id).unwrap());
        let prior = vec![1e-4; term.info().parameters.len()];
        TermSpec { term, rich: false, shape: 1.0, prior }
    };
    let terms: Vec<TermSpec> = terms.iter().map(wanted).collect();
    let fitted = fit(&campaign, &terms, None).unwrap();
    let mut model = Model::new(&campaign, &fitted, Estimator::Gls, DataOrigin::default());
    // Machine, loads and sensors of this world are as its files say.
    model.hexapod.tolerances = Tolerances::every(EXACT);
    model
}

fn with_lines(plan: Vec<Observation>) -> Vec<Observation> {
    (2..).zip(plan).map(|(line, o)| Observation { line, ..o }).collect()
}

/// The numbers of every row, in the order of the columns.
fn numbers(data: &Dataset, count: usize) -> Vec<Vec<f64>> {
    data.rows().map(|row| row.iter().flat_map(|o| o.measured).take(count).collect()).collect()
}

/// Mean square of readings minus predictions over what is uncertain of both.
fn chi2(
    model: &Model,
    predicted: &[Vec<SensorPrediction>],
    data: &Dataset,
    noise: impl Fn(usize) -> f64,
) -> f64 {
    let count = model.sensor_channels().len();
    let squares: Vec<f64> = numbers(data, count)
        .iter()
        .zip(predicted)
        .flat_map(|(row, predicted)| row.iter().zip(predicted).enumerate())
        .map(|(k, (x, p))| (x - p.value).powi(2) / (p.sigma.powi(2) + noise(k).powi(2)))
        .collect();
    squares.iter().sum::<f64>() / squares.len() as f64
}

#[test]
fn held_out_readings_of_every_kind_are_met_at_the_noise_and_the_truth_within_its_uncertainty() {
    const CAMPAIGNS: u64 = 24;
    let (hexapod, world) = (every_kind(), world());
    let plan = with_lines(rich_plan(25, 1.0, 12));
    let truth = read(&world, &hexapod, &plan, None);
    let (mut with_noise, mut without) = (0.0, 0.0);
    for seed in 1..=CAMPAIGNS {
        let fitted = model(&hexapod, &read(&world, &hexapod, &rich_plan(40, 1.0, 5), Some(seed)), &[]);
        let predicted = predict_sensors(&fitted, &plan).unwrap();
        let sigma = |k: usize| if k == 9 { LEVEL_RAD } else { GAUGE_M };
        let readings = read(&world, &hexapod, &plan, Some(1000 + seed));
        with_noise += chi2(&fitted, &predicted, &readings, sigma) / CAMPAIGNS as f64;
        without += chi2(&fitted, &predicted, &truth, |_| 0.0) / CAMPAIGNS as f64;
    }
    // 6600 readings: within four standard deviations, 4 sqrt(2 / 6600).
    assert!((with_noise - 1.0).abs() < 0.07, "{with_noise}");
    // Six compliances a campaign are all that is uncertain: 4 sqrt(2 / (6 * 24)).
    assert!((without - 1.0).abs() < 0.47, "{without}");
}

#[test]
fn a_predicted_reading_leaves_no_residual_whatever_is_in_the_model() {
    let (hexapod, world) = (every_kind(), world());
    let data = read(&world, &hexapod, &rich_plan(40, 1.0, 5), Some(3));
    let fitted = model(&hexapod, &data, &["base-compliance", "metrology-drift"]);
    let plan = with_lines(rich_plan(9, 4.0, 8));
    let mut asked = read(&world, &hexapod, &plan, None);
    let predicted = predict_sensors(&fitted, &plan).unwrap();
    for (n, o) in asked.observations.iter_mut().enumerate() {
        let numbers = predicted[n / 2].iter().skip(6 * o.block).map(|p| p.value);
        o.measured = [0.0; 6];
        o.measured.iter_mut().zip(numbers).for_each(|(to, from)| *to = from);
    }
    let campaign = Campaign::new(&hexapod, &asked).unwrap();
    let residuals = Linearization::at(&campaign, &fitted.point).unwrap().residuals();
    assert_eq!(residuals.len(), 6 * 2 * plan.len());
    assert!(residuals.amax() < 1e-6, "{:e} standard deviations of a reading", residuals.amax());
    assert!(predicted.iter().flatten().any(|p| p.value.abs() > 1e-4), "loads that bend the machine");
}

#[test]
fn sensors_in_the_mean_of_which_one_looks_err_together() {
    // Half way between two gauges that look the same way, a third one reads their mean.
    let mut hexapod = every_kind();
    let gauge = |name: &str, x: f64| {
        let (point, direction) = (Vector3::new(x, 0.02, 0.03), Vector3::z());
        Sensor::new(name, SensorKind::Distance { point, direction, sigma: GAUGE_M })
    };
    hexapod.sensors.extend([gauge("left", -0.1), gauge("right", 0.1), gauge("middle", 0.0)]);
    let fitted = model(&hexapod, &read(&world(), &hexapod, &rich_plan(40, 1.0, 5), Some(3)), &[]);
    let plan = with_lines(rich_plan(5, 1.0, 8));
    let several = predict_sensors(&fitted, &plan).unwrap();
    for ((numbers, covariance), alone) in
        predict_sensors_with_covariance(&fitted, &plan).unwrap().iter().zip(&several)
    {
        let n = numbers.len();
        assert_eq!((numbers, covariance.nrows()), (alone, n));
        let at = |i: usize, j: usize| covariance[(n - 3 + i, n - 3 + j)];
        let mean = 0.25 * (at(0, 0) + 2.0 * at(0, 1) + at(1, 1));
        assert!((mean / at(2, 2) - 1.0).abs() < 1e-6, "{mean:e} {:e}", at(2, 2));
        assert!((at(0, 0).sqrt() / numbers[n - 3].sigma - 1.0).abs() < 1e-12);
    }
}

#[test]
fn a_kept_model_says_the_same_of_its_sensors() {
    let hexapod = every_kind();
    let fitted = model(&hexapod, &read(&world(), &hexapod, &rich_plan(40, 1.0, 5), Some(3)), &[]);
    let kept = Model::from_toml(&fitted.to_toml().unwrap()).unwrap();
    let plan = with_lines(rich_plan(5, 1.0, 8));
    assert_eq!(predict_sensors(&kept, &plan), predict_sensors(&fitted, &plan));
}

#[test]
fn a_singular_pose_is_named_by_its_line_and_no_sensor_predicts_nothing() {
    let hexapod = every_kind();
    let fitted = model(&hexapod, &read(&world(), &hexapod, &rich_plan(40, 1.0, 5), Some(3)), &[]);
    let mut plan = with_lines(rich_plan(5, 1.0, 8));
    plan[3].pose.translation.x = f64::NAN;
    let error: PredictError = predict_sensors(&fitted, &plan).unwrap_err();
    assert_eq!(error.line, plan[3].line);
    assert!(matches!(error.cause, ModelError::SingularPose { .. } | ModelError::NotFinite { .. }));
    let (machine, data, holdout) = cases::case("mujoco-clean");
    let bare = model(&machine, &data, &[]);
    assert!(predict_sensors(&bare, &holdout.observations[..3]).unwrap().iter().all(Vec::is_empty));
}
