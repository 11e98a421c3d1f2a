//! Turning the whole setup turns what a term predicts.

use hexbench_core::{Hexapod, Matrix6, Measurand, Observation, Pose, Vector3, Vector6, Wrench};
use hexbench_model::effects::chain::{Link, Load};
use hexbench_model::effects::term::Term;
use hexbench_model::estimation::campaign::Condition;
use hexbench_model::estimation::linearization::actions;
use hexbench_model::machine::geometry::Machine;
use hexbench_model::terms::catalogue;
use nalgebra::UnitQuaternion;

use crate::common::paper_machine;
use crate::common::plan::dataset;
use crate::common::terms::{NATURAL, SPRING, by_id, conditions_on, drawn_with_pairs, rows, some_shape};

/// Terms that know the vertical or the normal of the base: a bracket's plane, two tilt axes, gravity.
const KNOWS_THE_VERTICAL: [&str; 3] = ["bracket-compliance", "load-tilt", "leg-weight"];
/// Springs along fixed axes turn as a matrix: a test of its own.
const TURNS_AS_A_MATRIX: &str = "base-compliance";
/// Products of a dozen 3x3 and 6x6 matrices of condition number below 1e3, after 2 to 3 digits lost in differences of
/// lengths.
const ROUNDING: f64 = 1e-9;

/// Whitened columns of a term at a condition.
fn columns(term: &dyn Term, rich: bool, shape: f64, machine: &Machine, at: &Condition) -> Vec<Vector6> {
    let mut out = Vec::new();
    actions(term, rich, shape, machine, at, &mut out);
    let springs = Vector6::repeat(SPRING);
    let mut load = Load::default();
    for (k, action) in out.iter().enumerate() {
        load.add(action, 1e-3 * size(term, k));
    }
    let link = Link::at(at, &springs, &load);
    // Twists in fixed axes: the observer of rotation vectors is the identity, the weights are equal per half.
    out.iter().map(|a| at.weights.numbers(link.by_action(at, a))).collect()
}

fn size(term: &dyn Term, k: usize) -> f64 {
    term.info().parameters.get(k).map_or(0.0, |p| NATURAL.size(p.scale))
}

/// The same setup, turned as a whole about the origin of the fixed frame.
struct Turned {
    machine: Machine,
    conditions: Vec<Condition>,
    spread: Matrix6,
}

impl Turned {
    fn new(turn: UnitQuaternion<f64>, plan: &[Observation]) -> Self {
        let r = *turn.to_rotation_matrix().matrix();
        let mut spread = Matrix6::zeros();
        spread.fixed_view_mut::<3, 3>(0, 0).copy_from(&r);
        spread.fixed_view_mut::<3, 3>(3, 3).copy_from(&r);
        let drawn = paper_machine();
        let pairs = drawn.bracket_pairs();
        // Platform joints stay in mobile axes; the base and everything in fixed axes turns.
        let hexapod =
            Hexapod { base_joints: drawn.base_joints.map(|a| r * a), brackets: Some(pairs), ..drawn };
        let wrench = |w: &Wrench| Wrench { force: r * w.force, moment: r * w.moment };
        let turned = |o: &Observation| {
            let measured = spread * Vector6::from(o.measured);
            Observation {
                pose: Pose::from_rotation(r * o.pose.translation, &(r * o.pose.rotation())),
                wrench: wrench(&o.wrench),
                reference: wrench(&o.reference),
                measured: std::array::from_fn(|k| measured[k]),
                ..*o
            }
        };
        let data = dataset(Measurand::DeflectionRotationVector, plan.iter().map(turned).collect());
        let conditions = conditions_on(&hexapod, &data);
        let mut machine = Machine::nominal(&hexapod);
        // The home pose turns too.
        machine.home_lengths = Machine::nominal(&drawn_with_pairs()).home_lengths;
        let home = machine.home_lengths;
        let conditions = conditions
            .into_iter()
            .map(|c| Condition { extension: c.commanded_lengths - home, ..c })
            .collect();
        let centre = Machine::nominal(&drawn_with_pairs()).base_centre;
        machine.base_centre = r * centre;
        Self { machine, conditions, spread }
    }
}

/// First parameters of the vectors that a term keeps along fixed axes, and their lengths: these turn with the setup.
/// A yielding base turns as a matrix and has a test of its own.
fn fixed_vectors(id: &str) -> Vec<(usize, usize)> {
    match id {
        "load-tilt" => vec![(0, 2)],
        "metrology-drift" => vec![(0, 3), (3, 3)],
        "joint-geometry" => (0..6).map(|leg| (3 * leg, 3)).collect(),
        _ => Vec::new(),
    }
}

/// Columns of a turned setup by the parameters of the still one: a turned vector is `p' = R p`, so the column of `p_k`
/// is the sum of `R_ik` times the columns of `p'_i`.
fn by_still_parameters(id: &str, columns: &[Vector6], spread: &Matrix6) -> Vec<Vector6> {
    let mut all = columns.to_vec();
    for (first, length) in fixed_vectors(id) {
        for k in 0..length {
            all[first + k] = (0..length).map(|i| columns[first + i] * spread[(i, k)]).sum();
        }
    }
    all
}

fn assert_turns(term: &dyn Term, turn: UnitQuaternion<f64>, plan: &[Observation]) {
    let id = term.info().id;
    let before =
        conditions_on(&drawn_with_pairs(), &dataset(Measurand::DeflectionRotationVector, plan.to_vec()));
    let turned = Turned::new(turn, plan);
    let shape = some_shape(term, &before);
    let still = Machine::nominal(&drawn_with_pairs());
    let pairs = before.iter().zip(&turned.conditions).map(|(b, t)| {
        (columns(term, false, shape, &still, b), columns(term, false, shape, &turned.machine, t))
    });
    let pairs: Vec<_> = pairs.collect();
    let count = pairs[0].0.len();
    for k in 0..count {
        let (mut worst, mut scale) = (0.0_f64, 0.0_f64);
        for (b, t) in &pairs {
            let t = by_still_parameters(id, t, &turned.spread);
            worst = worst.max((turned.spread * b[k] - t[k]).amax());
            scale = scale.max(b[k].amax());
        }
        assert!(worst <= ROUNDING * scale.max(1e-12), "{id}, parameter {k}: {worst:.1e} of {scale:.1e}");
    }
}

#[test]
fn turning_the_whole_setup_about_the_vertical_turns_the_predicted_twist() {
    let plan = rows(6, 5);
    for term in catalogue().iter().filter(|t| t.info().id != TURNS_AS_A_MATRIX) {
        for angle in [0.3, 1.0, -2.0] {
            assert_turns(term.as_ref(), UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle), &plan);
        }
    }
}

#[test]
fn turning_the_whole_setup_anyhow_turns_the_predicted_twist_of_terms_that_know_no_vertical() {
    let plan = rows(6, 6);
    for term in catalogue().iter().filter(|t| t.info().id != TURNS_AS_A_MATRIX) {
        if KNOWS_THE_VERTICAL.contains(&term.info().id) {
            continue;
        }
        for turn in [Vector3::new(0.9, -0.4, 0.2), Vector3::new(-0.3, 1.4, 1.1)] {
            assert_turns(term.as_ref(), UnitQuaternion::from_scaled_axis(turn), &plan);
        }
    }
}

/// Fixed axes mean springs along x and y: a quarter turn swaps them, and a full matrix turns like a tensor.
#[test]
fn a_yielding_base_turns_as_a_full_compliance_matrix() {
    let plan = rows(6, 7);
    let term = by_id("base-compliance");
    let quarter = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2);
    let turned = Turned::new(quarter, &plan);
    let before = conditions_on(&drawn_with_pairs(), &dataset(Measurand::DeflectionRotationVector, plan));
    let still = Machine::nominal(&drawn_with_pairs());
    for (b, t) in before.iter().zip(&turned.conditions) {
        let (b, t) = (
            columns(term.as_ref(), true, 1.0, &still, b),
            columns(term.as_ref(), true, 1.0, &turned.machine, t),
        );
        // x of the still base is y of the turned one.
        for (k, turned_k) in [(0, 1), (1, 0), (2, 2), (3, 4), (4, 3), (5, 5)] {
            let error = (turned.spread * b[k] - t[turned_k]).amax();
            assert!(error <= ROUNDING * b[k].amax().max(1e-12), "compliance {k}: {error:.1e}");
        }
        // cross-x-y turns into minus itself.
        let error = (turned.spread * b[6] + t[6]).amax();
        assert!(error <= ROUNDING * b[6].amax(), "cross compliance: {error:.1e}");
    }
}
