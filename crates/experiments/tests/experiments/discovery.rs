//! A small study of laws: found where one is hidden, none on clean machines, the same on any number of threads.

use hexbench_experiments::discovery::{DiscoveryProtocol, DiscoveryTrials, LawFate, page};
use hexbench_experiments::harness::{self, Silent};
use hexbench_model::results::diagnose::DiagnoseOptions;
use hexbench_model::results::discover::discover;
use hexbench_model::terms::catalogue;
use hexbench_report::render::markdown;
use hexbench_truth::campaign::{CaseKind, CaseSpec};
use hexbench_truth::laboratory;

/// Campaigns with an effect outside the catalogue: every effect once.
const OUTSIDE: usize = 9;

fn study(threads: usize, [outside, listed, clean]: [usize; 3]) -> DiscoveryTrials {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let protocol = DiscoveryProtocol { outside, listed, clean, ..DiscoveryProtocol::default() };
    let gathered = pool.install(|| harness::run(&protocol, None, &Silent)).unwrap();
    DiscoveryTrials::of(protocol, gathered)
}

#[test]
fn the_same_seed_gives_the_same_records_on_any_number_of_threads() {
    let [one, three] = [1, 3].map(|threads| study(threads, [2, 1, 1]));
    assert_eq!(one.records.len(), 4);
    assert_eq!(one.records, three.records);
}

#[test]
fn laws_are_found_where_they_are_hidden_and_nowhere_else() {
    let one = study(2, [OUTSIDE, 2, 6]);
    assert!(one.failures.is_empty(), "{:?}", one.failures);
    assert!(one.records.iter().all(|r| r.fate() != LawFate::Invented), "{:?}", one.records);
    let good = |r: &&hexbench_experiments::discovery::DiscoveryRecord| {
        r.is_sayable() && matches!(r.fate(), LawFate::Right | LawFate::Equivalent)
    };
    let sayable = one.records.iter().filter(|r| r.is_sayable()).count();
    let found = one.records.iter().filter(good).count();
    // Half of them: at distance 10 a law is seen and may yet look like an effect of the catalogue.
    assert!(2 * found >= sayable, "{found} of {sayable}");
    // A jump is found at its instant, and a weight that is applied with every load by its own law.
    for id in ["out:leg-step", "out:load-mass-error"] {
        let own: Vec<_> = one.records.iter().filter(|r| r.outside() == Some(id)).collect();
        assert!(!own.is_empty() && own.iter().any(|r| r.fate() == LawFate::Right), "{own:?}");
    }
    let text = markdown(&page(&one));
    assert!(text.contains("Written by `hexbench validate discover --markdown FILE`; do not edit."), "{text}");
}

/// One load of these machines is written half as large again. The best of thousands of laws follows it in the readings fitted, in some of
/// them together with noise; the readings held out do not know it.
#[test]
fn no_law_takes_the_place_of_a_load_that_is_written_wrong() {
    const SEED: u64 = 77;
    let fault = laboratory::entry("load-1.5x").unwrap();
    for (kind, index) in
        [(CaseKind::Clean, 18), (CaseKind::Clean, 34), (CaseKind::Single, 39), (CaseKind::Clean, 46)]
    {
        let case = CaseSpec::draw(kind, index, SEED, 0, None).build_in(fault).unwrap();
        let (measurements, holdout) = (&case.measurements, Some(&case.holdout));
        let d = discover(&case.hexapod, measurements, holdout, &catalogue(), &DiagnoseOptions::default());
        let d = d.unwrap().discovery;
        assert!(!d.found, "{index}: {}", d.text);
    }
}
