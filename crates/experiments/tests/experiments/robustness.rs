//! A small study of robustness: the control is as good as calibration says, and the same bytes come on any number of threads.

use std::path::Path;

use hexbench_core::Vector3;
use hexbench_core::streams::{Purpose, stream};
use hexbench_experiments::harness::{self, Silent};
use hexbench_experiments::robustness::{
    Robustness, RobustnessProtocol, Violation, case, detections, page, sheets,
};
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::fit;
use hexbench_model::estimation::tolerances::within_tolerances;
use hexbench_model::inference::examination::FindingKind;
use hexbench_report::render::markdown;
use hexbench_truth::laboratory::{self, CAREFUL};
use hexbench_truth::scene::{PartName, Scene, VirtualBench};
use rand::RngExt;
use rand_distr::StandardNormal;

/// Those of a small study, whose tests take seconds; the command has all.
const FAULTS: [&str; 4] = ["noise-2x", "outlier-60", "sign-slip", "joints-0.2mm"];

fn study(threads: usize, trials: usize) -> Robustness {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let protocol = RobustnessProtocol { trials, ..RobustnessProtocol::default() }.with_faults(&FAULTS);
    let gathered = pool.install(|| harness::run(&protocol, None, &Silent)).unwrap();
    Robustness::of(protocol, gathered)
}

#[test]
fn the_same_seed_gives_the_same_study_on_any_number_of_threads() {
    let [one, three] = [1, 3].map(|threads| study(threads, 2));
    assert!(one.failures.is_empty(), "{:?}", one.failures);
    assert_eq!(one.records, three.records);
    assert_eq!(page(&one), page(&three));
    judge(&one);
}

/// A clean machine and one with an effect, each under every fault.
fn judge(study: &Robustness) {
    let all = Violation::of_each(&study.records);
    assert_eq!(all.len(), 1 + FAULTS.len());
    let control = &all[0];
    assert_eq!(control.fault.id, CAREFUL.id);
    assert_eq!([control.clean_right(), control.effect_right()].map(|p| (p.hits, p.of)), [(1, 1); 2]);
    assert_eq!(control.other_reported().hits, 0, "a careful laboratory is blamed");
    let outlier = all.iter().find(|v| v.fault.id == "outlier-60").unwrap();
    assert_eq!(outlier.reported().hits, 2, "a number that is off by 60 sigma is not found");
    let blunder = detections(&study.records).into_iter().find(|d| d.kind == "blunder").unwrap();
    assert!(blunder.found.hits >= 3 && blunder.in_control.hits == 0, "{blunder:?}");
    let text = markdown(&page(study));
    assert!(all.iter().all(|v| text.contains(v.fault.title)), "a fault is missing on the page");
    assert!(sheets::counts(&study.records).text(0, 1).starts_with("1 of 1"));
}

#[test]
fn every_word_for_a_fault_is_a_kind_of_finding() {
    let kind = |word: &str| serde_json::from_value::<FindingKind>(word.into()).ok();
    for fault in laboratory::registry() {
        for &word in fault.findings {
            assert_eq!(
                kind(word).map(FindingKind::word),
                Some(word),
                "{}: no finding is called so",
                fault.id
            );
        }
    }
}

#[test]
fn a_campaign_is_the_same_under_every_fault_but_for_the_fault() {
    let drawn = |name: &str| case(name, 5).unwrap().unwrap();
    let (control, slipped) = (drawn("none/single-0001"), drawn("unit-slip/single-0001"));
    assert_eq!(control.hexapod, slipped.hexapod);
    assert_eq!(control.truth["parameters"], slipped.truth["parameters"]);
    assert_eq!(slipped.truth["laboratory"], "unit-slip");
    let rows = control.measurements.observations.iter().zip(&slipped.measurements.observations);
    assert_eq!(rows.filter(|(a, b)| a != b).count(), 1);
    for bad in ["none", "none/pair-0001", "magic/clean-0001", "none/clean-x", "none/clean-99999999"] {
        assert!(case(bad, 5).is_none(), "{bad}");
    }
}

/// What a load is said to be is off by a tolerance: so uncertain stiffness from absolute poses is.
#[test]
fn stiffness_from_absolute_poses_is_covered_when_loads_are_as_good_as_their_tolerances() {
    const CAMPAIGNS: u64 = 24;
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/hidden-8");
    let (mut pulls, mut exact) = (Vec::new(), Vec::new());
    for seed in 0..CAMPAIGNS {
        let mut scene = Scene::read_with_seed(&folder, Some(seed)).unwrap();
        scene.mechanisms.clear();
        let mut data = VirtualBench::new(&scene, false).dataset(PartName::Training).unwrap();
        let mut rng = stream(seed, Purpose::CaseFault, []);
        let tolerances = &scene.hexapod.tolerances;
        let mut drawn = |size: f64| Vector3::from_fn(|_, _| size * rng.sample::<f64, _>(StandardNormal));
        let (gain, turn, shift) =
            (drawn(tolerances.load_gain), drawn(tolerances.load_direction), drawn(tolerances.load_point));
        for row in &mut data.observations {
            let force = row.wrench.force;
            row.wrench.moment += shift.cross(&force);
            row.wrench.force += turn.cross(&force) + gain.component_mul(&force);
        }
        let campaign = Campaign::new(&scene.hexapod, &data).unwrap();
        let stiffness = scene.leg_stiffness;
        let of = |campaign: &Campaign| {
            let fit = fit(campaign, &[], None).unwrap();
            let pull = |leg: usize| {
                let compliance = fit.point.compliances[leg];
                (compliance - 1.0 / stiffness[leg]) / fit.std(leg)
            };
            (0..6).map(pull).collect::<Vec<f64>>()
        };
        exact.extend(of(&campaign));
        pulls.extend(of(&within_tolerances(campaign)));
    }
    let mean_square = |pulls: &[f64]| pulls.iter().map(|p| p * p).sum::<f64>() / pulls.len() as f64;
    assert!(mean_square(&pulls) < 1.4, "{}", mean_square(&pulls));
    assert!(
        mean_square(&exact) > 1.2 * mean_square(&pulls),
        "{} {}",
        mean_square(&exact),
        mean_square(&pulls)
    );
}
