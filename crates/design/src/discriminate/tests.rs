//! Distances against plain least squares, plans against random ones.

use std::sync::Arc;

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Approach, Hexapod, Metrology, Observation, Vector6, Wrench};
use hexbench_model::effects::sizes::WIDEST;
use hexbench_model::effects::term::Term;
use hexbench_model::estimation::fit_named::term_named;
use hexbench_model::estimation::noise::{Noise, NoiseSource, Structure};
use hexbench_model::estimation::tolerances::InputKind;
use hexbench_model::terms::catalogue;
use nalgebra::{DMatrix, DVector};
use rand::RngExt;

use super::{Contest, SeparatingPlan, candidate_readings};
use crate::regressor::{ModelRegressor, PoseRegressor};
use crate::space::{Conditions, Loading};
use crate::test_machine::machine;
use crate::{Budget, Space};

/// Visibility of the effects, standard deviations.
const VISIBLE: f64 = 5.0;
const SIGMA: Metrology = Metrology { sigma_translation: 0.5e-6, sigma_rotation: 3e-6 };

fn noise() -> Noise {
    Noise {
        translation: SIGMA.sigma_translation,
        rotation: SIGMA.sigma_rotation,
        source: NoiseSource::Metrology,
        dof: f64::INFINITY,
        structure: Structure::Independent,
    }
}

fn springs() -> Vector6 {
    Vector6::repeat(1.0 / 4e6)
}

fn space() -> Space {
    let down = Wrench::from_array([0.0, 0.0, -120.0, 0.0, 0.0, 0.0]);
    let load = |w: [f64; 6]| Loading { reference: down, load: Wrench::from_array(w) };
    let tilt = 5f64.to_radians();
    Space {
        low: [-0.02, -0.02, -0.01, -tilt, -tilt, -tilt],
        high: [0.02, 0.02, 0.01, tilt, tilt, tilt],
        stroke: None,
        joint_angle: None,
        least_dexterity: 0.0,
        loads: vec![
            load([0.0, 0.0, -338.0, 0.0, 0.0, 0.0]),
            load([100.0, 0.0, -120.0, 0.0, 0.0, 0.0]),
            load([0.0, 0.0, -120.0, 0.0, 0.0, 15.0]),
        ],
        load_ranges: Vec::new(),
        conditions: Conditions {
            waits: vec![5.0, 300.0],
            approaches: Approach::ALL.to_vec(),
            delta_t: vec![0.0],
        },
        budget: Budget::default(),
    }
}

fn terms(ids: &[&str]) -> Vec<Arc<dyn Term>> {
    ids.iter().map(|id| term_named(id, &catalogue()).unwrap()).collect()
}

/// Springs, six of base-compliance, three of load-offset; inputs follow.
const PARAMETERS: usize = 15;

/// `T^2` of unit natural sizes of `a` (columns of `rows`) by least squares with the priors as further equations.
fn by_least_squares(rows: &DMatrix<f64>, a: std::ops::Range<usize>, b: std::ops::Range<usize>) -> f64 {
    let rival = b.clone();
    let fitted: Vec<usize> = (0..6).chain(b).chain(PARAMETERS..rows.ncols()).collect();
    let n = fitted.len();
    let width = |k: usize| if rival.contains(&k) { WIDEST } else { 1.0 };
    let prior = DMatrix::from_fn(n, n, |i, j| if i == j { 1.0 / width(fitted[i]) } else { 0.0 });
    let mut c = DMatrix::zeros(rows.nrows() + n, n);
    c.rows_mut(0, rows.nrows()).copy_from(&rows.select_columns(&fitted));
    c.rows_mut(rows.nrows(), n).copy_from(&prior);
    let svd = c.clone().svd(true, true);
    let left = |k: usize| {
        let mut y = DVector::zeros(rows.nrows() + n);
        y.rows_mut(0, rows.nrows()).copy_from(&rows.column(k));
        let x = svd.solve(&y, 1e-14).unwrap();
        (y - &c * x).norm_squared()
    };
    a.map(left).sum()
}

#[test]
fn distances_are_what_least_squares_cannot_fit() {
    // Each side leaves out errors of inputs that hardly show, by readings of its own.
    const CLOSE: f64 = 1e-4;
    let (hexapod, terms) = (machine(), terms(&["base-compliance", "load-offset"]));
    let candidate_readings = candidate_readings(&space(), &hexapod, &terms, 1).unwrap();
    let contest =
        Contest::new(&hexapod, springs(), noise(), &terms, &candidate_readings, 12, VISIBLE).unwrap();
    let some: Vec<Observation> = candidate_readings.iter().step_by(7).copied().collect();
    let information: DMatrix<f64> = contest.informations(&some).unwrap().into_iter().sum();
    let distances = contest.distances(&information);
    let settings = space().settings();
    let regressor = ModelRegressor::new(&hexapod, springs(), noise(), &terms, &settings, 1).unwrap();
    let regressor = regressor.within_tolerances(&space(), InputKind::COLUMNS).unwrap();
    assert!(regressor.inputs() > 0);
    let rows = regressor.rows(some).unwrap();
    // Sizes differ by factors that the ratio of distance and size takes out: parameters keep their proportions.
    let size = |rival: usize| {
        let natural: f64 = {
            let all: Vec<f64> = regressor.sizes().collect();
            if rival == 0 { all[0] } else { all[6] }
        };
        let p = terms[rival].info().parameters[0];
        contest.assumed(rival)[0].1 / p.per_si / natural
    };
    for (pair, (a, b)) in [([0, 1], (6..12, 12..15)), ([1, 0], (12..15, 6..12))] {
        let expected = size(pair[0]) * by_least_squares(&rows, a, b).sqrt();
        let found = distances.iter().find(|d| d.of == pair).unwrap().value;
        assert!((found / expected - 1.0).abs() < CLOSE, "{pair:?}: {found} against {expected}");
    }
}

#[test]
fn a_plan_holds_the_worst_pair_further_apart_than_random_plans() {
    const READINGS: usize = 6;
    const DRAWS: usize = 30;
    let (hexapod, terms) = (machine(), terms(&["base-compliance", "platform-compliance", "load-offset"]));
    let candidate_readings = candidate_readings(&space(), &hexapod, &terms, 1).unwrap();
    let contest =
        Contest::new(&hexapod, springs(), noise(), &terms, &candidate_readings, READINGS, VISIBLE).unwrap();
    let plan =
        SeparatingPlan::search(&contest, &space(), &hexapod, &candidate_readings, READINGS, &|| ()).unwrap();
    assert_eq!(plan.readings.iter().map(|r| r.repeats).sum::<usize>(), READINGS);
    let least = |d: &[super::Distance]| d.iter().map(|d| d.value).fold(f64::INFINITY, f64::min);
    let informations = contest.informations(&candidate_readings).unwrap();
    let mut rng = stream(4, Purpose::Test, []);
    let mut random = || {
        let drawn: Vec<usize> =
            (0..READINGS).map(|_| rng.random_range(0..candidate_readings.len())).collect();
        let total =
            drawn.iter().skip(1).fold(informations[drawn[0]].clone(), |sum, &i| sum + &informations[i]);
        least(&contest.distances(&total))
    };
    let best_of_random = (0..DRAWS).map(|_| random()).fold(0.0, f64::max);
    let found = least(&plan.distances);
    assert!(found > best_of_random, "{found:.2} against {best_of_random:.2}");
}

#[test]
fn conditions_vary_only_where_an_effect_depends_on_them() {
    let hexapod: Hexapod = machine();
    let still =
        candidate_readings(&space(), &hexapod, &terms(&["base-compliance", "load-offset"]), 1).unwrap();
    assert!(still.iter().all(|o| o.approach == Approach::Direct && (o.elapsed - 5.0).abs() < 1e-9));
    let moving = candidate_readings(&space(), &hexapod, &terms(&["creep", "joint-friction"]), 1).unwrap();
    assert!(
        moving.iter().any(|o| o.approach == Approach::Overloaded) && moving.iter().any(|o| o.elapsed > 100.0)
    );
}

#[test]
fn an_effect_that_no_reading_shows_is_refused_with_the_reason() {
    let (hexapod, terms) = (machine(), terms(&["creep", "base-compliance"]));
    let still = Space { conditions: Conditions::default(), ..space() };
    let candidate_readings = candidate_readings(&still, &hexapod, &terms, 1).unwrap();
    let refused = Contest::new(&hexapod, springs(), noise(), &terms, &candidate_readings, 6, VISIBLE)
        .err()
        .unwrap()
        .to_string();
    assert!(refused.contains("creep") && refused.contains("elapsed_s"), "{refused}");
}
