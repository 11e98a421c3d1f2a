//! The gradient of a search against differences, and what the paper says of its load.

use hexbench_core::Wrench;

use super::*;
use crate::Criterion;
use crate::regressor::{SpringRegressor, Weights};
use crate::space::{ChosenPart, LoadRange};
use crate::test_machine::{level_space, machine};

/// A weight of 119.7 to 338.4 N with a side force and a moment.
fn space() -> Space {
    let mut space = level_space();
    let part = |name, k: usize, bounds: [f64; 2]| {
        let mut direction = Vector6::zeros();
        direction[k] = 1.0;
        ChosenPart { name, unit: "N", direction, bounds }
    };
    let parts =
        vec![part("fz", 2, [-338.4, -119.7]), part("fx", 0, [-80.0, 40.0]), part("my", 4, [-5.0, 6.0])];
    space.load_ranges.push(LoadRange { load: space.loads.len(), fixed: Wrench::default(), parts });
    let reference = space.loads[0].reference;
    space.loads.push(Loading { reference, load: Wrench::default() });
    space.under(space.loads_at(&[0.3, 0.8, 0.6]))
}

#[test]
fn the_gradient_by_poses_and_loads_together_agrees_with_differences() {
    const STEP: f64 = 1e-5;
    /// Of the largest component: third derivatives are of the order of the value over the range.
    const CLOSE: f64 = 1e-8;
    let (hexapod, space) = (machine(), space());
    let regressor = SpringRegressor::new(&hexapod, &space.settings(), 2, Weights::UNWEIGHTED);
    let start = space.poses(&hexapod, 3, 5).unwrap();
    for criterion in [Criterion::O1, Criterion::D, Criterion::A, Criterion::E, Criterion::O5] {
        let objective = criterion.objective(&hexapod, &space, &regressor).unwrap();
        let climb = Climb::new(&hexapod, &space, &objective, vec![&regressor; 3], &start);
        let x = climb.scaled();
        assert_eq!(x.len(), 12 + 3);
        let mut gradient = vec![0.0; x.len()];
        climb.logarithm(&x, Some(&mut gradient)).unwrap();
        let largest = gradient.iter().fold(0.0_f64, |m, g| m.max(g.abs()));
        for k in 0..x.len() {
            let beside = |step: f64| {
                let mut x = x.clone();
                x[k] += step;
                climb.logarithm(&x, None).unwrap()
            };
            let difference = (beside(STEP) - beside(-STEP)) / (2.0 * STEP);
            let off = (gradient[k] - difference).abs() / largest;
            assert!(off < CLOSE, "{} {k}: {} {difference} {off:.1e}", criterion.name(), gradient[k]);
        }
    }
}

/// Kalas et al. 2018, fig. 7: for any set of poses the index grows with the load, in proportion to its change.
#[test]
fn the_index_of_the_paper_is_proportional_to_the_load_at_any_poses() {
    let hexapod = machine();
    let mut space = space();
    let preload = space.loads[0].reference.force.z;
    space.loads.remove(0);
    space.load_ranges[0].load = 0;
    space.load_ranges[0].parts.truncate(1);
    for set in 0..50 {
        let start = space.poses(&hexapod, 3, set).unwrap();
        let space = space.under(space.loads_of_start(set, 1));
        let regressor = SpringRegressor::new(&hexapod, &space.settings(), 1, Weights::UNWEIGHTED);
        let objective = Objective::from(Criterion::O1);
        let climb = Climb::new(&hexapod, &space, &objective, vec![&regressor; 3], &start);
        let x = climb.scaled();
        let mut gradient = vec![0.0; x.len()];
        climb.logarithm(&x, Some(&mut gradient)).unwrap();
        // ln O1 = ln |change| + a function of the poses; a share of one is the whole range.
        let expected = -(338.4 - 119.7) / (space.loads[0].load.force.z - preload);
        let off = (gradient[12] / expected - 1.0).abs();
        assert!(off < 1e-9, "set {set}: {} {expected}", gradient[12]);
    }
}
