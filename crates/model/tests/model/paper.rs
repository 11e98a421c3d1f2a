//! The paper's estimator against its formulas written out, and against the regressor of the model.

use hexbench_core::{Dataset, Hexapod, Matrix6, Observation, Vector6};
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::linearization::{Linearization, ModelPoint};
use hexbench_model::estimation::paper::{block, fit_paper, regressor};
use hexbench_model::estimation::parameters::Parameters;
use hexbench_model::estimation::unobservable::unobservable;
use hexbench_model::machine::kinematics::{Legs, analytic_leg_jacobian};

use crate::cases;

/// Eq. 12 with its sum written out: `A_ij = Jbar_ij sum_k J_kj dF_k`.
fn naive_block(hexapod: &Hexapod, o: &Observation) -> Matrix6 {
    let legs = Legs::at(&hexapod.base_joints, &hexapod.platform_joints, &o.pose).unwrap();
    let j = legs.leg_jacobian.try_inverse().unwrap();
    let jbar = analytic_leg_jacobian(&legs, &o.pose.angles).try_inverse().unwrap();
    let df = o.wrench.to_vector() - o.reference.to_vector();
    let mut a = Matrix6::zeros();
    for row in 0..6 {
        for leg in 0..6 {
            for k in 0..6 {
                a[(row, leg)] += jbar[(row, leg)] * j[(k, leg)] * df[k];
            }
        }
    }
    a
}

#[test]
fn the_regressor_is_the_papers_formula() {
    for name in ["paper-protocol", "mujoco-clean"] {
        let (hexapod, data, _) = cases::case(name);
        for o in &data.observations {
            let (ours, naive) = (block(&hexapod, o, data.measurand).unwrap(), naive_block(&hexapod, o));
            assert!((ours - naive).amax() < 1e-12 * naive.amax(), "{name} line {}", o.line);
        }
    }
}

#[test]
fn without_weights_and_deflection_the_regressor_of_the_model_is_the_papers() {
    let (hexapod, data, _) = cases::case("mujoco-clean");
    let undeflected: Vec<Observation> =
        data.observations.iter().map(|o| Observation { measured: [0.0; 6], ..*o }).collect();
    let data = Dataset { observations: undeflected, ..data };
    let campaign = Campaign::new(&hexapod, &data).unwrap();
    // Springs of zero compliance leave the machine where it was commanded to.
    let lin = Linearization::at(&campaign, &ModelPoint::start(&campaign)).unwrap();
    let columns = lin.common_block();
    for (i, group) in campaign.groups.iter().enumerate() {
        let expected = block(&hexapod, &group.mean, data.measurand).unwrap();
        let weighted = columns.fixed_view::<6, 6>(6 * i, 0).into_owned();
        let unweighted = lin.conditions[i].weights.numbers(weighted);
        assert!((unweighted - expected).amax() < 1e-12 * expected.amax());
    }
}

#[test]
fn noiseless_deflections_give_the_springs_back() {
    let (hexapod, data, _) = cases::case("paper-protocol");
    let springs = Vector6::new(4.1981, 3.7898, 2.7503, 4.32, 3.6716, 3.7288).map(|k| 1e-6 / k);
    let deflected = data.observations.iter().map(|o| {
        let y = block(&hexapod, o, data.measurand).unwrap() * springs;
        Observation { measured: std::array::from_fn(|k| y[k]), ..*o }
    });
    let data = Dataset { observations: deflected.collect(), ..data };
    let fitted = fit_paper(&Campaign::new(&hexapod, &data).unwrap(), &data).unwrap();
    assert_eq!(fitted.rank, 6);
    assert!((fitted.compliances - springs).amax() < 1e-12 * springs.amax());
}

#[test]
fn one_vertical_pose_on_a_symmetric_machine_leaves_combinations_that_are_named() {
    let (hexapod, data, _) = cases::case("mujoco-clean");
    let mut o = data.observations[0];
    o.wrench = hexbench_core::Wrench::default();
    o.reference = o.wrench;
    let legs = Legs::at(&hexapod.base_joints, &hexapod.platform_joints, &o.pose).unwrap();
    // A wrench that leg 3 does not feel.
    let w = legs.leg_jacobian.tr_mul(&Vector6::new(1.0, 2.0, 0.0, -1.0, 3.0, 1.0)) * 30.0;
    o.wrench = hexbench_core::Wrench::from_array(std::array::from_fn(|k| w[k]));
    let data = Dataset { observations: vec![o], ..data };
    let fitted = fit_paper(&Campaign::new(&hexapod, &data).unwrap(), &data).unwrap();
    assert_eq!(fitted.rank, 5);
    let springs = Parameters::at(&ModelPoint::start(&Campaign::new(&hexapod, &data).unwrap()), false);
    assert_eq!(unobservable(&fitted.null_space, &springs), ["leg 3 has no effect on the data at all"]);
    assert!(fitted.compliances[2].abs() < 1e-12, "minimum norm leaves the undetermined part at zero");
}

#[test]
fn the_uncertainty_covers_the_truth_over_simulated_noise() {
    let (hexapod, data, _) = cases::case("paper-protocol");
    let a = regressor(&hexapod, &data).unwrap();
    let fitted = fit_paper(&Campaign::new(&hexapod, &data).unwrap(), &data).unwrap();
    // Covariance against the formula of weighted propagation, written out.
    let noise = Campaign::new(&hexapod, &data).unwrap().noise.sigma();
    let gram = (a.tr_mul(&a)).try_inverse().unwrap();
    let inverse = gram * a.transpose();
    for leg in 0..6 {
        let variance: f64 = (0..a.nrows()).map(|r| (inverse[(leg, r)] * noise[r % 6]).powi(2)).sum();
        assert!((fitted.covariance[(leg, leg)] / variance - 1.0).abs() < 1e-6);
    }
}
