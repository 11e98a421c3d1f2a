//! The power of a plan: what the linear model reckons is what happens in the simulated world.

use std::path::Path;
use std::sync::Arc;

use hexbench_core::Observation;
use hexbench_core::statistics::Proportion;
use hexbench_design::power::{PowerSettings, Visibility};
use hexbench_experiments::harness::{self, Silent};
use hexbench_experiments::power::{Campaigns, Power, PowerPlan, Simulated, Simulation, plan_of};
use hexbench_model::effects::term::Term;
use hexbench_model::terms::catalogue;
use hexbench_truth::Scene;

/// Chance that a test here fails although everything is right, shared out among its comparisons.
const FALSE_FAILURE: f64 = 1e-3;

fn plan(scene: &str) -> PowerPlan {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(scene);
    plan_of(&Scene::read(&folder).unwrap()).unwrap()
}

fn terms(ids: &[&str]) -> Vec<Arc<dyn Term>> {
    catalogue().into_iter().filter(|t| ids.contains(&t.info().id)).collect()
}

fn settings() -> PowerSettings {
    PowerSettings { draws: 20, ..PowerSettings::default() }
}

fn studied(plan: &PowerPlan, ids: &[&str], campaigns: usize, diagnoses: bool) -> Power {
    simulate(plan, &terms(ids), Simulation { campaigns, diagnoses })
}

fn simulate(plan: &PowerPlan, terms: &[Arc<dyn Term>], simulation: Simulation) -> Power {
    let all = Campaigns::new(plan, terms, settings(), simulation, &[]).unwrap();
    let gathered = harness::run(&all, None, &Silent).unwrap();
    all.power(&gathered).unwrap()
}

/// Name, computed chance and simulation of everything that was simulated.
fn simulated(power: &Power) -> Vec<(String, f64, &Simulated)> {
    let mut all = Vec::new();
    for (e, check) in power.study.effects.iter().zip(&power.checks) {
        assert!(check.why_not.is_none(), "{}: {:?}", e.term, check.why_not);
        let usual =
            check.usual.as_ref().map(|s| (format!("{} as usual", e.term), e.power_at_usual_size.middle, s));
        let seen = check
            .when_seen
            .as_ref()
            .map(|s| (format!("{} when seen", e.term), power.study.settings.power, s));
        all.extend(usual.into_iter().chain(seen));
    }
    all
}

fn assert_compatible(shares: &[(String, f64, Proportion)]) {
    let error = FALSE_FAILURE / shares.len() as f64;
    for (name, computed, share) in shares {
        assert!(
            share.is_compatible_with(*computed, error),
            "{name}: computed {computed:.3}, simulated {} of {}",
            share.hits,
            share.of
        );
    }
}

/// Play, a yielding base, coupled legs, a load off center, and shapes: an exponent, a time constant, a friction force.
const SEVERAL: [&str; 7] = [
    "leg-backlash",
    "base-compliance",
    "leg-coupling",
    "load-offset",
    "leg-nonlinearity",
    "creep",
    "joint-friction",
];

#[test]
fn effects_are_seen_as_often_as_reckoned_and_noise_alone_as_seldom() {
    let power = studied(&plan("paper-rich"), &SEVERAL, 200, false);
    let mut shares: Vec<(String, f64, Proportion)> =
        simulated(&power).into_iter().map(|(name, computed, s)| (name, computed, s.seen)).collect();
    assert_eq!(shares.len(), 2 * SEVERAL.len());
    for (e, check) in power.study.effects.iter().zip(&power.checks) {
        shares.push((
            format!("{} false alarm", e.term),
            power.study.settings.alarm,
            check.false_alarms.unwrap(),
        ));
    }
    assert_compatible(&shares);
}

#[test]
fn stiffnesses_go_astray_as_reckoned() {
    // The reckoning is of first order in the effect; the rest is the linearization of the plan itself.
    const LINEARIZATION_PERCENT: f64 = 0.1;
    let power = studied(&plan("paper-rich"), &["base-compliance", "bracket-compliance", "creep"], 1, false);
    for (e, check) in power.study.effects.iter().zip(&power.checks) {
        let simulated = check.usual.as_ref().unwrap().bias_percent;
        for (computed, found) in e.bias_at_usual_size_percent.iter().zip(simulated) {
            let second_order = computed * computed / 100.0;
            let miss = (computed - found).abs();
            assert!(miss < second_order + LINEARIZATION_PERCENT, "{}: {computed} {found}", e.term);
        }
    }
}

#[test]
fn a_noise_estimated_from_repeats_is_paid_for_as_reckoned() {
    const REPEATS: i64 = 3;
    let mut plan = plan("paper-rich");
    let thrice =
        |o: &Observation| (1..=REPEATS).map(|repeat| Observation { repeat, ..*o }).collect::<Vec<_>>();
    plan.rows.observations = plan.rows.observations.iter().take(12).flat_map(thrice).collect();
    let plan = plan.with_noise_from_repeats().unwrap();
    let power = studied(&plan, &["leg-coupling", "leg-nonlinearity"], 200, false);
    let shares: Vec<_> =
        simulated(&power).into_iter().map(|(name, _, s)| (name, s.chance_by_the_world, s.seen)).collect();
    assert!(shares.len() >= 3);
    assert_compatible(&shares);
}

#[test]
fn the_plan_of_the_paper_is_blind_and_the_rich_one_sees() {
    let study = |scene| simulate(&plan(scene), &catalogue(), Simulation::default()).study;
    let (paper, rich) = (study("paper"), study("paper-rich"));
    let usual = |s: &hexbench_design::power::PowerStudy, least: f64| {
        s.effects.iter().filter(|e| e.power_at_usual_size.middle >= least).count()
    };
    assert_eq!(usual(&paper, 0.9), 0);
    assert!(usual(&rich, 0.9) >= 9, "{}", usual(&rich, 0.9));
    let alike = |s: &hexbench_design::power::PowerStudy| {
        let n = s.effects.len();
        (0..n)
            .flat_map(|i| (0..i).map(move |j| (i, j)))
            .filter(|&(i, j)| s.alike.cosine[i][j] >= 0.95)
            .count()
    };
    assert!(alike(&paper) >= 5 && alike(&rich) <= 2, "{} {}", alike(&paper), alike(&rich));
    let blind: Vec<_> =
        paper.effects.iter().filter(|e| e.verdict == Visibility::NoTrace).map(|e| e.term).collect();
    assert_eq!(blind, ["leg-asymmetry", "leg-backlash"]);
}

#[test]
fn the_same_seed_gives_the_same_figures_on_any_number_of_threads() {
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let power = pool.install(|| studied(&plan("paper"), &["leg-coupling", "load-tilt"], 4, true));
        let answers = power.checks[0].when_seen.as_ref().unwrap().answers.clone().unwrap();
        assert_eq!(answers.of(), 4);
        serde_json::to_string(&power).unwrap()
    };
    assert_eq!(on(1), on(3));
}
