//! The MJCF writer without MuJoCo: what is refused, and that the text says what the structure says. scripts/mujoco.sh has MuJoCo
//! bring the models to rest.

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Pose, Wrench};
use hexbench_truth::{
    Situation, TruthError, World,
    campaign::machines::RING_B,
    mechanisms::{self, REGISTRY},
    mjcf,
};
use serde_json::{Value, json};

const STIFFNESS: [f64; 6] = [4e6, 3.5e6, 4.2e6, 3.1e6, 2.9e6, 3.8e6];

/// Effects on the structure that MJCF has no means for, or that this writer does not use.
const REFUSED: &[&str] = &[
    "leg-length-compliance",
    "leg-nonlinearity",
    "leg-asymmetry",
    "leg-backlash",
    "joint-friction",
    "bracket-compliance",
    "leg-coupling",
    "out:periodic-compliance",
    "out:plate-bending",
    "out:base-bending",
    "out:load-mass-error",
];

fn world() -> World {
    World::new(RING_B.hexapod("ring_b"), &STIFFNESS)
}

fn situation() -> Situation {
    let pose = Pose::from_array([0.02, -0.01, 0.005, 0.08, -0.05, 0.1]);
    Situation {
        delta_t: 0.4,
        elapsed: 120.0,
        ..Situation::new(pose, Wrench::from_array([60.0, -30.0, -330.0, 4.0, 2.0, -1.0]))
    }
}

fn with(id: &str, parameters: Value) -> World {
    world().with(mechanisms::build(id, parameters).unwrap())
}

/// How often a piece of text occurs.
fn count(model: &str, piece: &str) -> usize {
    model.matches(piece).count()
}

#[test]
fn every_effect_is_either_written_or_refused_by_name() {
    for effect in REGISTRY {
        let world =
            world().with((effect.draw)(&RING_B.hexapod("ring_b"), &mut stream(5, Purpose::Test, [1])));
        let written = mjcf::export(&world, &situation());
        match written {
            Ok(_) => assert!(!REFUSED.contains(&effect.id), "{} was written", effect.id),
            Err(TruthError::Inexpressible { world, what }) => {
                assert!(REFUSED.contains(&effect.id), "{} was refused: {world}: {what}", effect.id);
                assert!(!what.is_empty());
            }
            Err(other) => panic!("{}: {other}", effect.id),
        }
    }
}

#[test]
fn a_plain_machine_has_six_legs_six_motors_and_no_gravity() {
    let model = mjcf::export(&world(), &situation()).unwrap();
    for (piece, expected) in [
        ("<connect name=\"leg-", 6),
        ("<weld", 0),
        ("<motor name=", 6),
        ("<force name=\"leg-", 6),
        ("<freejoint", 1),
        ("gravity=\"0 0 0\"", 1),
        ("ctrl=\"60 -30 -330 4 2 -1\"", 1),
    ] {
        assert_eq!(count(&model, piece), expected, "{piece}\n{model}");
    }
    for (leg, stiffness) in STIFFNESS.iter().enumerate() {
        let spring =
            format!("<joint name=\"leg-{}-slide-1\" type=\"slide\" axis=\"0 0 1\" stiffness=\"", leg + 1);
        let after = model.split(&spring).nth(1).unwrap().split('"').next().unwrap();
        let relative = after.parse::<f64>().unwrap() / stiffness - 1.0;
        assert!(relative.abs() < 4.0 * f64::EPSILON, "leg {}: {after} for {stiffness}", leg + 1);
    }
}

#[test]
fn legs_with_weight_are_true_masses_and_nothing_else_has_weight() {
    let model = mjcf::export(&with("leg-weight", json!({ "mass": 2.5 })), &situation()).unwrap();
    assert_eq!(count(&model, "mass=\"0.5\""), 30, "six legs of five rods");
    assert_eq!(count(&model, "gravity=\"0 0 -9.81\""), 1);
    assert_eq!(count(&model, "<body"), count(&model, "gravcomp=\"1\"") + 30, "legs alone have weight");
}

#[test]
fn joints_that_bend_are_springs_at_both_ends() {
    let joints = json!({ "base": 600.0, "platform": 400.0 });
    let model = mjcf::export(&with("joint-rotation-stiffness", joints), &situation()).unwrap();
    assert_eq!(count(&model, "stiffness=\"600\""), 12);
    assert_eq!(count(&model, "stiffness=\"400\""), 12);
    assert_eq!(count(&model, "<weld name=\"leg-"), 6);
}

#[test]
fn a_foundation_is_rigid_where_its_stiffness_is_infinite() {
    let stiff =
        hexbench_core::Matrix6::from_diagonal(&hexbench_core::Vector6::new(0.0, 5e-9, 0.0, 0.0, 0.0, 2e-7));
    let mut half_rigid = world();
    half_rigid.mechanisms.push(Box::new(Foundation(stiff)));
    let model = mjcf::export(&half_rigid, &situation()).unwrap();
    let joints: Vec<&str> = ["x", "y", "z", "rx", "ry", "rz"]
        .into_iter()
        .filter(|axis| model.contains(&format!("<joint name=\"base-{axis}\"")))
        .collect();
    assert_eq!(joints, ["y", "rz"]);
}

#[test]
fn two_effects_of_one_kind_on_the_load_are_refused() {
    let tilt = || mechanisms::build("load-tilt", json!({ "angles": [0.02, 0.01] })).unwrap();
    let written = mjcf::export(&world().with(tilt()).with(tilt()), &situation());
    assert!(matches!(written, Err(TruthError::Inexpressible { .. })), "{written:?}");
}

#[test]
fn names_are_escaped() {
    let mut odd = world();
    odd.hexapod.name = "a<b & \"c\"".to_owned();
    let model = mjcf::export(&odd, &situation()).unwrap();
    assert!(model.starts_with("<mujoco model=\"a&lt;b &amp; &quot;c&quot;\">"), "{}", &model[..60]);
}

/// A foundation of any compliance.
#[derive(Debug)]
struct Foundation(hexbench_core::Matrix6);

impl hexbench_truth::Mechanism for Foundation {
    fn id(&self) -> &'static str {
        "base-compliance"
    }

    fn act(&self, _: &hexbench_truth::Instant<'_>, setup: &mut hexbench_truth::Setup) {
        setup.yield_base(&self.0);
    }

    fn scaled(&self, factor: f64) -> Box<dyn hexbench_truth::Mechanism> {
        Box::new(Self(self.0 * factor))
    }

    fn parameters(&self) -> serde_json::Map<String, Value> {
        serde_json::Map::new()
    }
}
