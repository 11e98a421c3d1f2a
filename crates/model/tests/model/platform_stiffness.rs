//! The Cartesian stiffness of a fitted model against closed forms.

use hexbench_core::{Matrix6, Observation, Pose, Vector3, Vector6, Wrench};
use hexbench_model::application::compensate::compensate;
use hexbench_model::application::model_file::Model;
use hexbench_model::application::stiffness::{
    CartesianStiffness, StiffnessAxes, StiffnessPoint, cartesian_stiffness,
};
use hexbench_model::machine::kinematics::Legs;

use crate::common::relative_difference;
use crate::use_model::{absolute, foundation, springs};

/// Deflections of a newton are predicted to 1e-13 m of some 2e-7 m.
const PREDICTED: f64 = 2e-6;

fn pose() -> Pose {
    Pose::from_array([0.01, -0.005, 0.004, 0.05, -0.04, 0.3])
}

fn at(model: &Model, load: Wrench, at: &StiffnessPoint) -> CartesianStiffness {
    let rows = [Observation::unread(pose(), load, Wrench::default())];
    cartesian_stiffness(model, &rows, at).unwrap().remove(0)
}

fn legs(model: &Model) -> Legs {
    Legs::at(&model.hexapod.base_joints, &model.hexapod.platform_joints, &pose()).unwrap()
}

#[test]
fn springs_alone_give_the_sum_over_the_legs_with_their_uncertainty() {
    let model = springs();
    let found = at(&model, Wrench::default(), &StiffnessPoint::default());
    let j = legs(&model).platform_jacobian;
    let compliance = j * Matrix6::from_diagonal(&model.point.compliances) * j.transpose();
    let error = relative_difference(&found.compliance, &compliance);
    assert!(error < PREDICTED, "compliance {error:.1e}");
    let error = relative_difference(&found.stiffness, &compliance.try_inverse().unwrap());
    assert!(error < 100.0 * PREDICTED, "stiffness {error:.1e}");
    // One entry by hand: C_zz is linear in the six compliances.
    let slopes = Vector6::from_fn(|leg, _| j[(2, leg)].powi(2));
    let covariance = model.covariance.fixed_view::<6, 6>(0, 0);
    let std = (slopes.transpose() * covariance * slopes)[(0, 0)].sqrt();
    assert!(
        (found.compliance_std[(2, 2)] / std - 1.0).abs() < 1e-4,
        "{} {std}",
        found.compliance_std[(2, 2)]
    );
}

#[test]
fn a_soft_foundation_adds_its_compliance_where_the_platform_is() {
    let model = foundation().0;
    let found = at(&model, Wrench::default(), &StiffnessPoint::default());
    let j = legs(&model).platform_jacobian;
    let springs = j * Matrix6::from_diagonal(&model.point.compliances) * j.transpose();
    let base = Matrix6::from_diagonal(&Vector6::from_column_slice(&model.point.active[0].values));
    // The motion of the base, seen at the mobile origin.
    let mut carry = Matrix6::identity();
    let lever = pose().translation - model.hexapod.base_centre();
    carry.fixed_view_mut::<3, 3>(0, 3).copy_from(&-lever.cross_matrix());
    let expected = springs + carry * base * carry.transpose();
    let error = relative_difference(&found.compliance, &expected);
    assert!(error < 10.0 * PREDICTED, "{error:.1e}");
}

#[test]
fn another_point_and_mobile_axes_are_the_same_stiffness_seen_elsewhere() {
    let model = springs();
    let point = Vector3::new(0.02, -0.03, 0.08);
    let here = at(&model, Wrench::default(), &StiffnessPoint::default());
    let there = StiffnessPoint { point, axes: StiffnessAxes::Mobile, ..StiffnessPoint::default() };
    let found = at(&model, Wrench::default(), &there);
    let rotation = pose().rotation();
    let mut carry = Matrix6::zeros();
    carry.fixed_view_mut::<3, 3>(0, 0).copy_from(&rotation.transpose());
    carry.fixed_view_mut::<3, 3>(3, 3).copy_from(&rotation.transpose());
    carry.fixed_view_mut::<3, 3>(0, 3).copy_from(&-(point.cross_matrix() * rotation.transpose()));
    let expected = carry * here.compliance * carry.transpose();
    let error = relative_difference(&found.compliance, &expected);
    assert!(error < PREDICTED, "{error:.1e}");
    // Moments turn the platform alike wherever they act.
    for (a, b) in here.of_moments.iter().zip(&found.of_moments) {
        assert!((a.stiffness / b.stiffness - 1.0).abs() < PREDICTED, "{a:?} {b:?}");
        assert!((a.direction.dot(&(rotation * b.direction)).abs() - 1.0).abs() < 1e-6, "{a:?} {b:?}");
    }
}

#[test]
fn principal_stiffnesses_bound_every_direction() {
    let model = springs();
    let k = at(&model, Wrench::default(), &StiffnessPoint::default());
    let along = |d: &Vector3| (d.dot(&(k.compliance.fixed_view::<3, 3>(0, 0) * d))).recip();
    let [soft, _, stiff] = k.of_forces;
    for d in [Vector3::x(), Vector3::y(), Vector3::z(), Vector3::new(1.0, 1.0, 1.0).normalize()] {
        let s = along(&d) * (1.0 + 1e-9);
        assert!(soft.stiffness <= s && along(&d) <= stiff.stiffness * (1.0 + 1e-9), "{d:?}: {s}");
    }
    for p in k.of_forces {
        assert!((along(&p.direction) / p.stiffness - 1.0).abs() < 1e-9, "{p:?}");
        assert!(p.std > 0.0 && p.std < 0.1 * p.stiffness, "{p:?}");
    }
}

#[test]
fn a_load_changes_the_stiffness_by_its_own_share() {
    // A load turns the legs' directions by load / (stiffness * length): some 1e-3 of the stiffness for 500 N.
    let model = springs();
    let free = at(&model, Wrench::default(), &StiffnessPoint::default());
    let load = Wrench { force: Vector3::new(0.0, 0.0, -500.0), moment: Vector3::zeros() };
    let loaded = at(&model, load, &StiffnessPoint::default());
    let change = relative_difference(&loaded.stiffness, &free.stiffness);
    assert!((1e-5..1e-2).contains(&change), "{change:.1e}");
}

#[test]
fn a_model_of_absolute_poses_has_the_stiffness_of_its_calibrated_legs() {
    let model = absolute().0;
    let found = at(&model, Wrench::default(), &StiffnessPoint::default());
    // The platform stands where the true legs have the lengths that the drawing commands.
    let row = Observation::unread(pose(), Wrench::default(), Wrench::default());
    let beside = compensate(&model, &[row]).unwrap()[0].without;
    let stands = Pose::from_array(std::array::from_fn(|k| pose().to_array()[k] + beside[k]));
    let j = model.point.calibrated_machine().legs(&stands).unwrap().platform_jacobian;
    let compliance = j * Matrix6::from_diagonal(&model.point.compliances) * j.transpose();
    let error = relative_difference(&found.compliance, &compliance);
    assert!(error < 10.0 * PREDICTED, "{error:.1e}");
}
