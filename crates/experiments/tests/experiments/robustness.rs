//! A small study of robustness: the control is as good as calibration says, and the same bytes come on any number of threads.

use hexbench_experiments::harness::{self, Silent};
use hexbench_experiments::robustness::{
    Robustness, RobustnessProtocol, Violation, case, detections, page, sheets,
};
use hexbench_model::inference::examination::FindingKind;
use hexbench_report::render::markdown;
use hexbench_truth::laboratory::{self, CAREFUL};

/// Words of the format for which there is no examination yet.
const NOT_EXAMINED: [&str; 2] = ["resolution", "row-order"];

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
    assert_eq!(control.other_told().hits, 0, "a careful laboratory is blamed");
    let outlier = all.iter().find(|v| v.fault.id == "outlier-60").unwrap();
    assert_eq!(outlier.told().hits, 2, "a number that is off by 60 sigma is not found");
    let blunder = detections(&study.records).into_iter().find(|d| d.kind == "blunder").unwrap();
    assert!(blunder.found.hits >= 3 && blunder.in_control.hits == 0, "{blunder:?}");
    let text = markdown(&page(study));
    assert!(all.iter().all(|v| text.contains(v.fault.title)), "a fault is missing on the page");
    assert!(sheets::counts(&study.records).text(0, 1).starts_with("1 of 1"));
}

#[test]
fn every_word_for_a_fault_is_a_kind_of_finding() {
    use FindingKind as K;
    let known = [
        K::Blunder,
        K::Pose,
        K::Load,
        K::NoiseLevel,
        K::HeavyTails,
        K::SharedReference,
        K::ReferenceRecord,
        K::SetupError,
        K::Drift,
        K::Tolerance,
    ];
    let known: Vec<String> =
        known.iter().map(|k| serde_json::to_value(k).unwrap().as_str().unwrap().to_owned()).collect();
    for fault in laboratory::registry() {
        for word in fault.findings {
            let is_known = known.iter().any(|k| k == word) || NOT_EXAMINED.contains(word);
            assert!(is_known, "{}: no finding is called {word}", fault.id);
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
