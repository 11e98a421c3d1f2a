//! The first-order chain from load to reading: its derivatives, and its linearity in each parameter alone.

use hexbench_core::{Matrix6, Measurand, Vector3, Vector6};
use hexbench_model::effects::chain::{Action, Link, Load};
use hexbench_model::estimation::campaign::{Campaign, Condition};
use hexbench_model::estimation::equilibrium::Tangents;
use hexbench_model::machine::geometry::Machine;
use proptest::prelude::*;

use crate::common::random::Random;
use crate::common::{self, paper_machine, plan};

/// Steps are 1e-5 of a parameter's natural size; the third derivative of the chain is of the size of the chain, so
/// the difference errs by 1e-10 of it, and by eps / 1e-5.
const STEP: f64 = 1e-5;
const DIFFERENCE: f64 = 1e-9;
/// A handful of 6x6 products and one inverse of condition number below 1e3.
const ROUNDING: f64 = 1e3 * 36.0 * f64::EPSILON;

const COMPLIANCE: f64 = 2.5e-7;
const FORCE: f64 = 100.0;
const RADIUS: f64 = 0.12;

/// One reading in random circumstances, with everything a condition can carry.
fn condition(random: &mut Random, measurand: Measurand) -> Condition {
    let pose = plan::random_pose(random, 15.0, 8.0);
    let mut o = plan::reading(
        pose,
        plan::random_wrench(random, 300.0, 20.0),
        plan::random_wrench(random, 100.0, 5.0),
    );
    o.elapsed = 100.0;
    o.measured = std::array::from_fn(|_| random.within(2e-5));
    if measurand == Measurand::AbsolutePose {
        let x = pose.to_array();
        o.measured = std::array::from_fn(|k| x[k] + random.within(2e-5));
    }
    let data = plan::dataset(measurand, vec![o]);
    let hexapod = common::measured_machine(0.5e-6, 3e-6);
    let campaign = Campaign::new(&hexapod, &data).unwrap();
    let compliances = Vector6::repeat(COMPLIANCE);
    let machine = Machine::nominal(&paper_machine());
    campaign.conditions(&machine, &compliances, &[], Tangents::ForFit).unwrap().remove(0)
}

fn vector(random: &mut Random, size: f64) -> Vector6 {
    Vector6::from_fn(|_, _| random.within(size))
}

/// A twist with rotations smaller by the radius.
fn twist(random: &mut Random, size: f64) -> Vector6 {
    Vector6::from_fn(|k, _| random.within(if k < 3 { size } else { size / RADIUS }))
}

/// A symmetric positive stiffness a tenth as stiff as the legs.
fn stiffness(random: &mut Random) -> Matrix6 {
    let scale = Matrix6::from_diagonal(&Vector6::from_fn(|k, _| if k < 3 { 1.0 } else { RADIUS }));
    let root = scale * Matrix6::from_fn(|_, _| random.within(1.0)) * (0.1 / COMPLIANCE).sqrt();
    root * root.transpose()
}

/// One action of every kind with an effect of a tenth of the springs' at unit parameter.
fn one_of_each(random: &mut Random) -> Vec<Action> {
    let mut target = Matrix6::zeros();
    for (i, j) in (0..3).flat_map(|i| (3..6).map(move |j| (i, j))) {
        target[(i, j)] = random.within(0.2 * RADIUS);
    }
    vec![
        Action::Force(vector(random, 0.3 * FORCE)),
        Action::Elongation(vector(random, 0.3 * FORCE * COMPLIANCE)),
        Action::Stiffness(Box::new(stiffness(random))),
        Action::Base(twist(random, 0.3 * FORCE * COMPLIANCE)),
        Action::Plate(twist(random, 0.3 * FORCE * COMPLIANCE)),
        Action::Target(Box::new(target)),
        Action::Reading(twist(random, 0.3 * FORCE * COMPLIANCE)),
        Action::Shift(std::array::from_fn(|_| {
            Vector3::from_fn(|_, _| random.within(0.3 * FORCE * COMPLIANCE))
        })),
        // A second one of the kinds that multiply others.
        Action::Stiffness(Box::new(stiffness(random))),
        Action::Bending([0.05 / COMPLIANCE * RADIUS * RADIUS; 2]),
    ]
}

/// Springs, actions and parameter values at which the chain is examined: every kind is at work.
struct Case {
    condition: Condition,
    compliances: Vector6,
    actions: Vec<Action>,
    values: Vec<f64>,
}

impl Case {
    fn new(seed: u64, measurand: Measurand) -> Self {
        let mut random = Random::new(seed);
        let condition = condition(&mut random, measurand);
        let compliances = Vector6::from_fn(|_, _| COMPLIANCE * (1.0 + random.within(0.5)));
        let actions = one_of_each(&mut random);
        let values = actions.iter().map(|_| 0.3 + random.unit()).collect();
        Self { condition, compliances, actions, values }
    }

    fn link(&self, compliances: &Vector6, values: &[f64]) -> Link {
        let mut load = Load::default();
        for (action, value) in self.actions.iter().zip(values) {
            load.add(action, *value);
        }
        Link::at(&self.condition, compliances, &load)
    }

    fn here(&self) -> Link {
        self.link(&self.compliances, &self.values)
    }

    /// Prediction with parameter `k` moved by `h`.
    fn beside(&self, k: usize, h: f64) -> Vector6 {
        let mut values = self.values.clone();
        values[k] += h;
        self.link(&self.compliances, &values).prediction()
    }

    fn beside_spring(&self, leg: usize, h: f64) -> Vector6 {
        let mut compliances = self.compliances;
        compliances[leg] += h;
        self.link(&compliances, &self.values).prediction()
    }
}

const MEASURANDS: [Measurand; 3] =
    [Measurand::DeflectionEuler, Measurand::DeflectionRotationVector, Measurand::AbsolutePose];

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn derivatives_by_parameters_are_those_of_the_prediction(seed in 0_u64..1_000_000, kind in 0_usize..3) {
        let case = Case::new(seed, MEASURANDS[kind]);
        let link = case.here();
        let scale = link.prediction().amax();
        for (k, action) in case.actions.iter().enumerate() {
            let difference = (case.beside(k, STEP) - case.beside(k, -STEP)) / (2.0 * STEP);
            let error = (difference - link.by_action(&case.condition, action)).amax() / scale;
            prop_assert!(error < DIFFERENCE, "action {} of {:?}: {:.1e}", k, action, error);
        }
    }

    #[test]
    fn derivatives_by_springs_are_those_of_the_prediction(seed in 0_u64..1_000_000, kind in 0_usize..3) {
        let case = Case::new(seed, MEASURANDS[kind]);
        let link = case.here();
        let scale = link.prediction().amax();
        let step = STEP * COMPLIANCE;
        for leg in 0..6 {
            let difference = (case.beside_spring(leg, step) - case.beside_spring(leg, -step)) / (2.0 * step);
            let error = COMPLIANCE * (difference - link.by_spring(leg)).amax() / scale;
            prop_assert!(error < DIFFERENCE, "leg {}: {:.1e}", leg, error);
        }
    }

    #[test]
    fn the_prediction_is_linear_in_each_parameter_alone(seed in 0_u64..1_000_000) {
        let case = Case::new(seed, Measurand::DeflectionEuler);
        let link = case.here();
        let scale = link.prediction().amax();
        for (k, action) in case.actions.iter().enumerate() {
            // A stiffness beside the legs enters through an inverse and is the one exception.
            if matches!(action, Action::Stiffness(_) | Action::Bending(_)) {
                continue;
            }
            for far in [-2.0, 7.0] {
                let straight = link.prediction() + far * link.by_action(&case.condition, action);
                let error = (case.beside(k, far) - straight).amax() / (scale * 10.0);
                prop_assert!(error < ROUNDING, "action {}: {:.1e}", k, error);
            }
        }
    }
}

#[test]
fn springs_alone_turn_force_into_motion_by_the_compliance_matrix() {
    let mut random = Random::new(8);
    for measurand in MEASURANDS {
        let c = condition(&mut random, measurand);
        let compliances = Vector6::repeat(COMPLIANCE);
        let found = Link::at(&c, &compliances, &Load::default()).prediction();
        let j = c.legs.platform_jacobian;
        let motion = j * Matrix6::from_diagonal(&compliances) * c.force_change();
        let expected = c.weights.of(c.observer * motion);
        let error = (found - expected).amax() / expected.amax();
        assert!(error < ROUNDING, "{measurand:?}: {error:.1e}");
    }
}

#[test]
fn a_stiffness_beside_the_legs_adds_to_theirs() {
    // (K_legs + K) dx = W for a wrench that the springs see in full.
    let mut random = Random::new(9);
    for seed in 0..20 {
        let case = Case::new(seed, Measurand::DeflectionRotationVector);
        let beside = stiffness(&mut random);
        let mut load = Load::default();
        load.add(&Action::Stiffness(Box::new(beside)), 1.0);
        let link = Link::at(&case.condition, &case.compliances, &load);
        let l = case.condition.legs.leg_jacobian;
        let legs = l.transpose() * Matrix6::from_diagonal(&case.compliances.map(f64::recip)) * l;
        let wrench = l.transpose() * case.condition.force_change();
        let motion = (legs + beside).try_inverse().unwrap() * wrench;
        let expected = case.condition.weights.of(case.condition.observer * motion);
        let error = (link.prediction() - expected).amax() / expected.amax();
        assert!(error < ROUNDING, "{error:.1e}");
    }
}

#[test]
fn nothing_moves_without_a_change_of_load() {
    let mut random = Random::new(10);
    let mut c = condition(&mut random, Measurand::DeflectionEuler);
    c.set_forces([c.force; 2], &Vector6::zeros());
    assert_eq!(Link::at(&c, &Vector6::repeat(COMPLIANCE), &Load::default()).prediction(), Vector6::zeros());
}
