//! Two worlds, one answer: the static equilibrium of the first world against the machine that comes to rest in the second.

use std::{path::PathBuf, sync::Arc};

use hexbench_rapier::{
    RapierStatics,
    cross_check::{self, CrossCheckCase, WorldDifference},
};
use hexbench_truth::{
    LegMemory, Setup, Statics, TruthError, World, equilibrium::Equilibrium, mechanisms,
    mechanisms::JointFriction,
};
use rayon::prelude::*;

const SEED: u64 = 20_240_917;
/// Cases of the run: three machines for each effect, and for none.
const CASES: usize = 3 * (mechanisms::REGISTRY.len() + 1);
/// Agreement asked for, as a share of deflection, rotation and largest leg force. What the engine leaves open (gaps of
/// joints, unrest) is 100 times less.
const AGREEMENT: f64 = 1e-4;

fn second_world() -> Arc<dyn Statics> {
    Arc::new(RapierStatics::default())
}

fn artefacts() -> PathBuf {
    std::env::var_os("HEXBENCH_ARTEFACTS").map_or_else(
        || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../target/artefacts"),
        PathBuf::from,
    )
}

#[test]
fn both_worlds_agree_on_every_machine_and_effect() {
    let statics = second_world();
    let compare = |index| {
        let case = CrossCheckCase::draw(index, SEED);
        case.compare(&statics).map_err(|e| format!("case {index}, {}: {e}", case.effect_name()))
    };
    let outcomes: Vec<Result<WorldDifference, String>> = (0..CASES).into_par_iter().map(compare).collect();
    let (done, failed): (Vec<_>, Vec<_>) = outcomes.into_iter().partition(Result::is_ok);
    let done: Vec<WorldDifference> = done.into_iter().flatten().collect();
    let failed: Vec<String> = failed.into_iter().filter_map(Result::err).collect();
    std::fs::create_dir_all(artefacts()).unwrap();
    std::fs::write(artefacts().join("rapier.csv"), cross_check::csv(&done)).unwrap();
    std::fs::write(artefacts().join("rapier.txt"), cross_check::summary(&done)).unwrap();
    assert!(failed.is_empty(), "{failed:#?}");
    for c in &done {
        assert!(c.worst() < AGREEMENT, "{c:?}");
    }
}

/// The second world with one leg softer than it should be.
#[derive(Debug)]
struct SoftLeg(RapierStatics);

impl Statics for SoftLeg {
    fn rest(&self, setup: &Setup, remembered: &[LegMemory; 6]) -> Result<Equilibrium, TruthError> {
        let mut wrong = setup.clone();
        wrong.laws[2].compliance *= 1.01;
        self.0.rest(&wrong, remembered)
    }
}

#[test]
fn one_percent_in_one_leg_is_noticed() {
    let faulty: Arc<dyn Statics> = Arc::new(SoftLeg(RapierStatics::default()));
    for index in [0, 31, 62] {
        let case = CrossCheckCase::draw(index, SEED);
        assert_eq!(case.effect_name(), "none");
        let sound = case.compare(&second_world()).unwrap();
        let wrong = case.compare(&faulty).unwrap();
        assert!(sound.worst() < AGREEMENT, "{sound:?}");
        assert!(wrong.worst() > 3.0 * AGREEMENT, "{wrong:?}");
    }
}

#[test]
fn what_the_engine_lacks_is_an_error_that_says_so() {
    let case = CrossCheckCase::draw(0, SEED);
    let mut world: World =
        case.world().with(Box::new(JointFriction { slider_force: 1.0, stick_ratio: None }));
    world.statics = second_world();
    let error = world.reading(&case.situation).unwrap_err();
    assert!(matches!(error, TruthError::Inexpressible { .. }), "{error}");
    assert!(error.to_string().contains("rigid friction slider"), "{error}");
}

#[test]
fn a_machine_that_does_not_come_to_rest_in_time_is_an_error() {
    let case = CrossCheckCase::draw(0, SEED);
    let mut world = case.world();
    world.statics = Arc::new(RapierStatics { most_steps: 20, ..RapierStatics::default() });
    let error = world.reading(&case.situation).unwrap_err();
    assert!(matches!(error, TruthError::NotConverged { iterations: 20, .. }), "{error}");
}
