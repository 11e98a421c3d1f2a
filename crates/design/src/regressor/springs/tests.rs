//! Rows and slopes of springs against the paper and differences.

use hexbench_core::{Measurand, Wrench};
use hexbench_model::estimation::paper::block;

use super::*;
use crate::regressor::reading;
use crate::space::Loading;
use crate::test_machine::machine;

fn loads() -> Vec<Setting> {
    let of = |load: [f64; 6]| {
        let reference = Wrench::from_array([0.0, 0.0, -119.7, 0.0, 0.0, 0.0]);
        Setting::from(Loading { reference, load: Wrench::from_array(load) })
    };
    vec![of([0.0, 0.0, -338.4, 0.0, 0.0, 0.0]), of([100.0, 20.0, -50.0, 3.0, -4.0, 5.0])]
}

fn pose() -> Pose {
    Pose::from_array([0.012, -0.02, 0.008, 0.1, -0.15, 0.3])
}

/// Numbers of unequal units and sizes.
const WEIGHTS: Weights =
    Weights { translation: 2e6, rotation: 3e5, compliance: [2e-7, 3e-7, 1e-7, 2e-7, 4e-7, 2e-7] };

/// A slope of some criterion by the information, symmetric and full.
fn by_information() -> DMatrix<f64> {
    DMatrix::from_fn(6, 6, |i, j| 1.0 / (1.0 + i as f64 + j as f64))
}

#[test]
fn rows_are_those_of_the_paper() {
    let hexapod = machine();
    let regressor = SpringRegressor::new(&hexapod, &loads()[1..], 1, Weights::UNWEIGHTED);
    let mut found = DMatrix::zeros(6, 6);
    regressor.inform(&pose(), &mut found).unwrap();
    let a = block(&hexapod, &reading(pose(), &loads()[1]), Measurand::DeflectionEuler).unwrap();
    let error = (found.fixed_view::<6, 6>(0, 0) - a.tr_mul(&a)).amax() / found.amax();
    assert!(error < 1e-13, "{error}");
}

#[test]
fn slopes_agree_with_differences() {
    const STEP: f64 = 1e-6;
    let (hexapod, g) = (machine(), by_information());
    let regressor = SpringRegressor::new(&hexapod, &loads(), 3, WEIGHTS);
    let along = |k: usize, s: f64| {
        let mut x = pose().to_array();
        x[k] += s;
        let mut information = DMatrix::zeros(6, 6);
        regressor.inform(&Pose::from_array(x), &mut information).unwrap();
        (&g * information).trace()
    };
    let exact = regressor.slopes(&pose(), &g).unwrap();
    let largest = exact.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    for k in 0..6 {
        let difference = (along(k, STEP) - along(k, -STEP)) / (2.0 * STEP);
        assert!((exact[k] - difference).abs() < 1e-7 * largest, "{k}: {} {difference}", exact[k]);
    }
}

#[test]
fn slopes_by_the_loads_agree_with_differences() {
    /// Information is of second degree in a load: differences are exact but for rounding.
    const STEP: f64 = 1e-2;
    let (hexapod, g) = (machine(), by_information());
    let regressor = SpringRegressor::new(&hexapod, &loads(), 1, WEIGHTS).repeated(&[3, 2]);
    let directions =
        [Vector6::new(10.0, -5.0, 30.0, 1.0, -2.0, 3.0), Vector6::new(0.0, 7.0, -9.0, 2.0, 0.0, 1.0)];
    let along = |share: f64| {
        let moved = |(s, d): (&Setting, &Vector6)| {
            let load = Wrench::from_array((s.loading.load.to_vector() + d * share).into());
            Setting::from(Loading { load, ..s.loading })
        };
        let settings: Vec<Setting> = loads().iter().zip(&directions).map(moved).collect();
        let mut information = DMatrix::zeros(6, 6);
        regressor.under(&settings).inform(&pose(), &mut information).unwrap();
        (&g * information).trace()
    };
    let exact = regressor.load_slope(&pose(), &g, &directions).unwrap();
    let difference = (along(STEP) - along(-STEP)) / (2.0 * STEP);
    let rounding = 100.0 * f64::EPSILON * along(0.0) / STEP;
    assert!((exact - difference).abs() < rounding, "{exact} {difference}, rounding {rounding:.1e}");
    assert!(rounding < 1e-6 * exact.abs(), "{exact} {rounding}");
}
