//! Campaigns are reproducible, and their effects as visible as asked for.

use hexbench_core::streams::{Purpose, stream};
use hexbench_truth::{
    TruthError, World,
    campaign::{CaseKind, CaseSpec, SimulatedCase, machines},
};
use rayon::prelude::*;

fn cases(threads: usize) -> Vec<SimulatedCase> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let jobs: Vec<(CaseKind, usize)> = CaseKind::ALL.iter().flat_map(|&k| [(k, 0), (k, 1)]).collect();
    pool.install(|| {
        jobs.par_iter().filter_map(|&(k, i)| CaseSpec::draw(k, i, 11, 0, None).build().ok()).collect()
    })
}

#[test]
fn the_same_seed_gives_the_same_measurements_on_any_number_of_threads() {
    let (one, three) = (cases(1), cases(3));
    assert!(one.len() >= 12, "{}", one.len());
    for (a, b) in one.iter().zip(&three) {
        assert_eq!(a.measurements, b.measurements);
        assert_eq!(a.holdout, b.holdout);
        assert_eq!(a.truth, b.truth);
    }
}

#[test]
fn effects_have_the_distance_asked_for() {
    for index in 0..16 {
        let spec = CaseSpec::draw(CaseKind::Single, index, 5, 4, Some([30.0, 30.0]));
        let case = spec.build().unwrap();
        let distance = case.truth["distance"].as_f64().unwrap();
        assert!((distance / 30.0 - 1.0).abs() < 1e-4, "{:?}: {distance}", spec.effects);
    }
}

#[test]
fn every_family_of_machines_holds_its_platform() {
    for family in machines::FAMILIES {
        for seed in 0..20 {
            let mut rng = stream(seed, Purpose::Test, [1]);
            let hexapod = machines::draw(family, &mut rng);
            let stiffness = machines::leg_stiffness(family, &mut rng);
            let world = World::new(hexapod.clone(), &stiffness);
            let plan = hexbench_truth::campaign::PlanKind::Rich.draw(&hexapod, &mut rng);
            for row in plan.training {
                let result = world.deflection(&row.situation);
                assert!(result.is_ok(), "{family} {seed}: {result:?}");
            }
        }
    }
}

/// A set-up that leans far over is no tilt that somebody has overlooked.
#[test]
fn a_tilt_that_anybody_would_see_is_not_drawn() {
    let effects = vec!["load-tilt"];
    let spec = CaseSpec { effects, ..CaseSpec::draw(CaseKind::Single, 0, 5, 4, Some([1e5, 1e5])) };
    let refused = spec.build().unwrap_err();
    assert!(matches!(refused, TruthError::NotVisible { scale, .. } if scale < 100.0), "{refused}");
}
