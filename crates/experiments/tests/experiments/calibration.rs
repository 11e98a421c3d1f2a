//! A small study of calibration: the rates the diagnosis promises, and the same bytes on any number of threads.

use hexbench_core::statistics::Proportion;
use hexbench_experiments::calibration::{
    Calibration, CalibrationProtocol, CalibrationRecord, Fate, MOST_FALSE_NAMES, credible_coverage,
    false_names, false_outside, is_well_visible, page, pictures, stiffness_coverage, trials_csv,
};
use hexbench_experiments::harness::{self, Silent};
use hexbench_truth::campaign::CaseKind;

/// Enough for every kind to occur; a larger study is a command.
const TRIALS: usize = 60;
/// Well-visible single effects named, in the committed study about 97 %; a rate that is significantly below nine in ten
/// means that the diagnosis got worse.
const MOST_NOT_NAMED: f64 = 0.1;
/// Claims of 95 % that may fail.
const MOST_NOT_COVERED: f64 = 0.05;
/// "Outside" said of what the catalogue has, in the committed study about 1 %.
const MOST_FALSE_OUTSIDE: f64 = 0.02;

fn study(threads: usize, trials: usize) -> Calibration {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let protocol = CalibrationProtocol::default().with_trials(trials);
    let gathered = pool.install(|| harness::run(&protocol, None, &Silent)).unwrap();
    Calibration::of(protocol, gathered)
}

fn assert_not_above(found: Proportion, limit: f64, what: &str) {
    println!("{what}: {} of {}, limit {limit}", found.hits, found.of);
    assert!(found.of > 0, "{what}: nothing to judge");
    assert!(!found.is_above(limit), "{what}: {} of {}, limit {limit}", found.hits, found.of);
}

fn others(p: Proportion) -> Proportion {
    Proportion { hits: p.of - p.hits, ..p }
}

#[test]
fn a_small_study_keeps_what_the_diagnosis_promises() {
    let study = study(2, TRIALS);
    assert!(study.failures.is_empty(), "{:?}", study.failures);
    let records = &study.records;
    assert_not_above(false_names(records), MOST_FALSE_NAMES, "effects named that are not there");
    assert_not_above(false_outside(records), MOST_FALSE_OUTSIDE, "false outside");
    let visible = || records.iter().filter(|r| r.kind == CaseKind::Single && is_well_visible(r));
    let not_named = Proportion::count(visible(), |r| r.fate != Fate::Right);
    assert_not_above(not_named, MOST_NOT_NAMED, "well-visible effects not named");
    assert_not_above(
        others(credible_coverage(visible())),
        MOST_NOT_COVERED,
        "credible sets without the truth",
    );
    let right = records.iter().filter(|r| r.fate == Fate::Right && !r.is_outside());
    assert_not_above(others(stiffness_coverage(right)), MOST_NOT_COVERED, "stiffnesses outside 95 %");
}

#[test]
fn the_same_seed_gives_the_same_study_on_any_number_of_threads() {
    const FEW: usize = 12;
    let [one, three] = [1, 3].map(|threads| study(threads, FEW));
    assert_eq!(trials_csv(&one.records), trials_csv(&three.records));
    assert_eq!(page(&one, "charts"), page(&three, "charts"));
    assert_eq!(pictures(&one.records).unwrap(), pictures(&three.records).unwrap());
    let kinds: Vec<CaseKind> = one.records.iter().map(|r| r.kind).collect();
    assert!(CaseKind::ALL.iter().all(|k| kinds.contains(k)), "{kinds:?}");
}

#[test]
fn probabilities_are_probabilities_and_what_is_named_was_likely() {
    const ROUNDING: f64 = 1e-9;
    for r in &study(2, 14).records {
        let all = [r.best.1, r.outside, r.none, r.truth].into_iter().chain(r.present.values().copied());
        assert!(
            all.clone().all(|p| (0.0..=1.0 + ROUNDING).contains(&p)),
            "{}: {:?}",
            r.id,
            all.collect::<Vec<_>>()
        );
        let stated =
            |record: &CalibrationRecord, id: &String| record.present.get(id).is_some_and(|&p| p > 0.5);
        assert!(r.added.iter().all(|id| stated(r, id)), "{}: {:?} of {:?}", r.id, r.added, r.present);
        assert!(r.outside + r.none <= 1.0 + ROUNDING, "{}", r.id);
    }
}
