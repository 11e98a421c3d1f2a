//! Laws that a scene states as formulas.

use hexbench_core::{Pose, Wrench};
use hexbench_truth::campaign::machines;
use hexbench_truth::mechanisms::build;
use hexbench_truth::own_law::OWN_LAW;
use hexbench_truth::{Mechanism, Situation, World};
use serde_json::{Value, json};

use hexbench_core::streams::{Purpose, stream};

fn machine(effect: Box<dyn Mechanism>) -> World {
    let hexapod = machines::draw("ring_a", &mut stream(1, Purpose::Test, []));
    let mut world = World::new(hexapod, &[4e6; 6]);
    world.mechanisms.push(effect);
    world
}

fn situation() -> Situation {
    let pose = Pose::from_array([0.01, -0.02, 0.005, 0.05, -0.02, 0.1]);
    let load = Wrench::from_array([60.0, -40.0, -250.0, 8.0, -5.0, 3.0]);
    Situation { elapsed: 120.0, delta_t: 0.7, ..Situation::new(pose, load) }
}

/// Largest difference of two deflections over the largest number of the first.
fn difference(one: Box<dyn Mechanism>, other: Box<dyn Mechanism>) -> f64 {
    let [a, b] = [one, other].map(|effect| machine(effect).deflection(&situation()).unwrap());
    (a - b).amax() / a.amax()
}

fn formula(keys: Value) -> Box<dyn Mechanism> {
    build(OWN_LAW, keys).unwrap()
}

#[test]
fn a_formula_moves_the_machine_as_the_mechanism_with_the_same_law_does() {
    const ROUNDING: f64 = 1e-9;
    let pairs = [
        (
            json!({ "elongation": "size*max(f, 0)", "size": 5e-8 }),
            ("leg-asymmetry", json!({ "tension_compliance": 5e-8 })),
        ),
        (
            json!({ "elongation": "rate*elapsed", "rate": 5e-9, "legs": [3] }),
            ("out:leg-drift", json!({ "leg": 3, "rate": 5e-9 })),
        ),
        (
            json!({ "elongation": "f*(a/reach)^3*growth/(4e6)", "reach": 0.04, "growth": 0.1 }),
            ("out:cubic-compliance", json!({ "growth": 0.1, "reach": 0.04, "axis": 0 })),
        ),
    ];
    for (own, (id, known)) in pairs {
        let plain = machine(formula(json!({ "elongation": "0*f" }))).deflection(&situation()).unwrap();
        let moved = machine(formula(own.clone())).deflection(&situation()).unwrap();
        assert!((moved - plain).amax() > 1e-4 * plain.amax(), "{own} does nothing");
        let off = difference(formula(own), build(id, known).unwrap());
        assert!(off < ROUNDING, "{id}: {off}");
    }
}

#[test]
fn a_formula_is_scaled_and_tells_what_it_is() {
    let own = json!({ "elongation": "size*f*abs(f)", "size": 2e-10 });
    let double = json!({ "elongation": "size*f*abs(f)", "size": 4e-10 });
    let off = difference(formula(own.clone()).scaled(2.0), formula(double));
    assert!(off < 1e-12, "{off}");
    let none = difference(formula(own.clone()).scaled(0.0), formula(json!({ "elongation": "0*f" })));
    assert!(none < 1e-12, "{none}");
    let told = formula(own).parameters();
    assert_eq!(told["formula"]["elongation"], "size*f*abs(f)");
    assert_eq!(told["formula"]["numbers"]["size"], 2e-10);
}

#[test]
fn what_is_no_law_is_refused() {
    for (keys, part) in [
        (json!({}), "elongation"),
        (json!({ "elongation": "size*f" }), "`size` at character 1 is unknown"),
        (json!({ "elongation": "f", "legs": [0] }), "1 to 6"),
        (json!({ "elongation": "f", "legs": [] }), "1 to 6"),
        (json!({ "elongation": "q*1", "q": 2.0 }), "`q` is a variable"),
        (json!({ "elongation": "f", "size": "large" }), "expected a number, found \"large\""),
    ] {
        let why = build(OWN_LAW, keys.clone()).unwrap_err().to_string();
        assert!(why.contains(part), "{keys}: {why}");
    }
}
