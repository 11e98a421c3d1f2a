//! Readings whose file numbers their references, against a truth in which those references err.

use hexbench_core::Dataset;
use hexbench_model::inference::examination::FindingKind;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::{Diagnosis, diagnose};
use hexbench_model::terms::catalogue;
use hexbench_truth::campaign::{CaseKind, SimulatedCase};
use hexbench_truth::laboratory::entry;

const SEED: u64 = 31;
const CAMPAIGNS: usize = 10;

fn case(id: &str, index: usize) -> SimulatedCase {
    SimulatedCase::draw_in(entry(id).unwrap(), CaseKind::Clean, index, SEED, None).unwrap()
}

fn told(case: &SimulatedCase, data: &Dataset) -> Diagnosis {
    diagnose(&case.hexapod, data, None, &catalogue()).unwrap().diagnosis
}

/// Squares of the errors of the stiffnesses over their standard uncertainty.
fn squares(case: &SimulatedCase, d: &Diagnosis) -> f64 {
    let truth = case.truth["leg_stiffness_N_per_um"].as_array().unwrap();
    let off = |leg: usize| {
        let found = d.stiffness(leg).unwrap();
        ((found.value - truth[leg].as_f64().unwrap()) / found.std).powi(2)
    };
    (0..6).map(off).sum()
}

#[test]
fn references_that_the_file_numbers_are_found_and_the_uncertainties_hold() {
    let mut sum = 0.0;
    for index in 0..CAMPAIGNS {
        let case = case("reference-records", index);
        let d = told(&case, &case.measurements);
        assert_eq!(d.verdict, Verdict::Adequate, "campaign {index}: {:?} {:?}", d.added, d.findings);
        let kinds: Vec<_> = d.findings.iter().map(|f| f.kind).collect();
        assert_eq!(kinds, [FindingKind::ReferenceRecord], "campaign {index}: {:?}", d.findings);
        let percent: f64 = d.findings[0].size.split(' ').next().unwrap().parse().unwrap();
        assert!(
            (35.0..=65.0).contains(&percent),
            "campaign {index}: {percent} % of the variance, one half is true"
        );
        sum += squares(&case, &d);
    }
    // Mean of chi-square of sixty degrees of freedom, within three of its standard deviations; more where tolerances are not used up.
    let mean = sum / (6 * CAMPAIGNS) as f64;
    let spread = (2.0 / (6 * CAMPAIGNS) as f64).sqrt();
    assert!(mean < 1.0 + 3.0 * spread, "{mean}");
}

#[test]
fn numbers_of_references_that_do_not_err_change_nothing() {
    for index in 0..CAMPAIGNS {
        let case = case("none", index);
        let mut data = case.measurements.clone();
        data.columns.reference_record = true;
        for (run, rows) in (1..).zip(data.observations.chunks_mut(5)) {
            for row in rows {
                row.reference_record = Some(run);
            }
        }
        let (with, without) = (told(&case, &data), told(&case, &case.measurements));
        assert_eq!((with.verdict, with.findings.len()), (without.verdict, without.findings.len()), "{index}");
        // The stiffnesses are averaged with faults that are not sure, of which those of other references are some.
        let [with, without] = [&with, &without].map(|d| squares(&case, d));
        assert!((with / without - 1.0).abs() < 1e-3, "{index}: {with} {without}");
    }
}
