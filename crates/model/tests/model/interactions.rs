//! Effects beside each other: without noise the right terms give the right numbers, against a small world of these tests' own.

use std::sync::Arc;

use hexbench_core::{Measurand, Vector6};
use hexbench_model::effects::chain::Action;
use hexbench_model::effects::term::{Term, TermInfo};
use hexbench_model::estimation::campaign::{Campaign, Condition};
use hexbench_model::estimation::fit::Fit;
use hexbench_model::estimation::fit_named::fit_named;
use hexbench_model::machine::geometry::Machine;
use rayon::prelude::*;

use crate::common::plan::{dataset, rich_plan};
use crate::common::structure::{Structure, yielding};
use crate::common::terms::{by_id, drawn_with_pairs};
use crate::common::{PAPER_STIFFNESS, measured_machine};

/// Bounds of `hexbench validate interactions`.
const STIFFNESS: f64 = 1e-3;
const PARAMETER: f64 = 3e-3;

/// Effects of a machine, and the parameters the model should find for them.
type Hidden = (&'static str, fn(&mut Structure, f64), fn(f64) -> Vec<f64>);

const BRACKET: Hidden = ("bracket-compliance", |m, size| m.bracket = 1e-7 * size, |size| vec![1e-7 * size]);
const COUPLING: Hidden = ("leg-coupling", |m, size| m.coupling = 2e-8 * size, |size| vec![2e-8 * size]);
const CONTACT: Hidden =
    ("leg-nonlinearity", |m, size| m.contact = (0.65e-6 * size, 2.0 / 3.0), |size| vec![0.65e-6 * size]);
const TENSION: Hidden = ("leg-asymmetry", |m, size| m.tension = 5e-8 * size, |size| vec![5e-8 * size]);
const JOINTS: Hidden = (
    "joint-rotation-stiffness",
    |m, size| m.bending = [600.0 * size, 400.0 * size],
    |size| vec![600.0 * size, 400.0 * size],
);
/// Stiff at the base end alone.
const STIFF_BELOW: Hidden =
    ("joint-rotation-stiffness", |m, size| m.bending = [2000.0 * size, 0.0], |size| vec![2000.0 * size, 0.0]);
const BASE: Hidden = (
    "base-compliance",
    |m, size| m.bodies[0] = yielding(2e8 / size, 5e6 / size),
    |size| yielding(2e8 / size, 5e6 / size).iter().copied().collect(),
);
const PLATE: Hidden = (
    "platform-compliance",
    |m, size| m.bodies[1] = yielding(3e8 / size, 4e6 / size),
    |size| yielding(3e8 / size, 4e6 / size).iter().copied().collect(),
);

fn campaign(hidden: &[Hidden], size: f64) -> Campaign {
    let drawn = drawn_with_pairs();
    let mut machine = Structure::on_springs(&drawn, PAPER_STIFFNESS);
    for (_, set, _) in hidden {
        set(&mut machine, size);
    }
    let readings = machine.measured(&rich_plan(24, 1.0, 31));
    let stated = measured_machine(1e-12, 6e-12).metrology;
    let hexapod = hexbench_core::Hexapod { metrology: stated, ..drawn };
    Campaign::new(&hexapod, &dataset(Measurand::DeflectionRotationVector, readings)).unwrap()
}

/// Largest relative error of a stiffness, and of a parameter relative to the largest of its kind.
fn errors(fit: &Fit, hidden: &[Hidden], size: f64) -> [f64; 2] {
    let relative = |(c, k): (&f64, f64)| (1.0 / (c * k) - 1.0).abs();
    let stiffness = fit.point.compliances.iter().zip(PAPER_STIFFNESS).map(relative).fold(0.0, f64::max);
    let mut parameter = 0.0_f64;
    for (a, (.., truth)) in fit.point.active.iter().zip(hidden) {
        let truth = truth(size);
        let kinds = if truth.len() == 6 { 2 } else { 1 };
        for (found, true_values) in
            a.values.chunks(a.values.len() / kinds).zip(truth.chunks(truth.len() / kinds))
        {
            let largest = true_values.iter().copied().fold(0.0, f64::max);
            let worst = found.iter().zip(true_values).map(|(f, t)| (f - t).abs() / largest);
            parameter = worst.fold(parameter, f64::max);
        }
    }
    [stiffness, parameter]
}

fn terms(hidden: &[Hidden]) -> Vec<Arc<dyn Term>> {
    hidden.iter().map(|(id, ..)| by_id(id)).collect()
}

#[test]
fn effects_beside_each_other_are_found_as_large_as_they_are() {
    let sets: [&[Hidden]; 9] = [
        &[JOINTS],
        &[JOINTS, BRACKET],
        &[JOINTS, COUPLING],
        &[CONTACT, JOINTS],
        &[TENSION, JOINTS],
        &[JOINTS, BASE],
        &[JOINTS, PLATE],
        &[BRACKET, BASE],
        &[TENSION, JOINTS, BRACKET],
    ];
    let trials: Vec<_> = sets.iter().flat_map(|set| [(*set, 1.0), (*set, 10.0)]).collect();
    trials.into_par_iter().for_each(|(hidden, size)| assert_found(hidden, size));
}

#[test]
fn joints_stiff_at_one_end_are_told_from_a_soft_base() {
    assert_found(&[STIFF_BELOW, BASE], 1.0);
}

fn assert_found(hidden: &[Hidden], size: f64) {
    let names: Vec<&str> = hidden.iter().map(|(id, ..)| *id).collect();
    let fit = fit_named(&campaign(hidden, size), &terms(hidden)).unwrap();
    let [stiffness, parameter] = errors(&fit, hidden, size);
    println!("{} x{size}: stiffness {stiffness:.1e}, parameter {parameter:.1e}", names.join(" + "));
    assert!(stiffness < STIFFNESS, "{names:?} x{size}: stiffness {stiffness:.1e}");
    assert!(parameter < PARAMETER, "{names:?} x{size}: parameter {parameter:.1e}");
}

/// Brackets as they would be if nothing beside the legs took load off them.
struct BlindBrackets(Arc<dyn Term>);

impl Term for BlindBrackets {
    fn info(&self) -> &TermInfo {
        self.0.info()
    }

    fn actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        let [reference, loaded] = at.states.map(|state| at.legs.forces(&state.wrench));
        let lateral = |leg: usize| 1.0 - at.legs.directions[leg].z.powi(2);
        out.push(Action::Elongation(Vector6::from_fn(|leg, _| {
            lateral(leg) * (loaded[leg] - reference[leg])
        })));
    }
}

#[test]
fn a_term_that_ignores_what_the_others_do_is_found_out() {
    let hidden = [JOINTS, BRACKET];
    let blind: Vec<Arc<dyn Term>> =
        vec![by_id("joint-rotation-stiffness"), Arc::new(BlindBrackets(by_id("bracket-compliance")))];
    let fit = fit_named(&campaign(&hidden, 1.0), &blind).unwrap();
    let [stiffness, parameter] = errors(&fit, &hidden, 1.0);
    println!("blind brackets: stiffness {stiffness:.1e}, parameter {parameter:.1e}");
    assert!(parameter > 3.0 * PARAMETER, "stiffness {stiffness:.1e}, parameter {parameter:.1e}");
}
