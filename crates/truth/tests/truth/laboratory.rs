//! Faults of the laboratory: each breaks one thing and leaves the rest.

use std::{collections::BTreeSet, fs, path::Path};

use hexbench_core::Dataset;
use hexbench_truth::campaign::{CaseKind, SimulatedCase};
use hexbench_truth::laboratory::{CAREFUL, FaultEntry, entry, registry};

const SEED: u64 = 11;
/// Standard deviations of the noise of cases, m and rad.
const SIGMA: [f64; 6] = [0.5e-6, 0.5e-6, 0.5e-6, 3e-6, 3e-6, 3e-6];

fn clean(fault: &FaultEntry, index: usize) -> SimulatedCase {
    SimulatedCase::draw_in(fault, CaseKind::Clean, index, SEED, None).unwrap()
}

/// Errors added by a fault to every number of the measurements, in standard deviations of the noise.
fn added(fault: &FaultEntry, index: usize) -> Vec<[f64; 6]> {
    let [with, without] = [fault, &CAREFUL].map(|f| clean(f, index).measurements.observations);
    let rows = with.iter().zip(&without);
    rows.map(|(a, b)| std::array::from_fn(|k| (a.measured[k] - b.measured[k]) / SIGMA[k])).collect()
}

fn touched(rows: &[[f64; 6]]) -> usize {
    rows.iter().flatten().filter(|x| x.abs() > 1e-6).count()
}

fn spread(values: impl Iterator<Item = f64>) -> f64 {
    let squares: Vec<f64> = values.map(|x| x * x).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// Errors of a fault, noise included, over many campaigns, in standard deviations.
fn errors(id: &str) -> Vec<[f64; 6]> {
    const CAMPAIGNS: usize = 12;
    let of = |index| {
        let case = clean(entry(id).unwrap(), index);
        let rows: Vec<_> = case.measurements.observations.iter().map(Into::into).collect();
        let ideal = case.campaign.ideal(&rows, case.measurements.measurand).unwrap();
        let errors = case.measurements.observations.iter().zip(ideal);
        errors.map(|(o, r)| std::array::from_fn(|k| (o.measured[k] - r[k]) / SIGMA[k])).collect::<Vec<_>>()
    };
    (0..CAMPAIGNS).flat_map(of).collect()
}

#[test]
fn ids_are_unique_and_every_file_is_registered() {
    let ids: BTreeSet<&str> = registry().map(|e| e.id).collect();
    assert_eq!(ids.len(), registry().count());
    let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-' || c == '.';
    assert!(ids.iter().all(|id| id.chars().all(is_plain)), "{ids:?}");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/laboratory");
    let list = fs::read_to_string(folder.join("mod.rs")).unwrap();
    for file in fs::read_dir(folder).unwrap().map(|f| f.unwrap().path()) {
        let stem = file.file_stem().unwrap().to_string_lossy().into_owned();
        let line = format!("    {stem},");
        assert!(["mod", "pick"].contains(&stem.as_str()) || list.lines().any(|l| l == line), "{stem}");
    }
}

#[test]
fn a_careful_laboratory_measures_the_case_as_it_is() {
    let (a, b) = (clean(&CAREFUL, 3), SimulatedCase::draw(CaseKind::Clean, 3, SEED, None).unwrap());
    assert_eq!((a.measurements, a.holdout, a.truth), (b.measurements, b.holdout, b.truth));
}

/// Every fault changes some campaign, and never how many rows there are or what is hidden.
#[test]
fn every_fault_changes_something_of_the_campaign_and_nothing_of_the_truth() {
    for fault in registry().filter(|e| e.id != CAREFUL.id) {
        let differs = |index| {
            let (with, without) = (clean(fault, index), clean(&CAREFUL, index));
            let rows = |data: &Dataset| data.observations.len();
            assert_eq!(rows(&with.measurements), rows(&without.measurements), "{}", fault.id);
            assert_eq!(with.truth, without.truth, "{}", fault.id);
            let numbers = [&with, &without].map(|c| {
                c.measurements.observations.iter().all(|o| o.measured.iter().all(|x| x.is_finite()))
            });
            assert_eq!(numbers, [true; 2], "{}", fault.id);
            with.measurements != without.measurements || with.hexapod != without.hexapod
        };
        assert!((0..4).any(differs), "{} changes nothing", fault.id);
    }
}

#[test]
fn single_faults_hit_as_many_numbers_as_they_say_and_leave_the_holdout() {
    for (id, numbers) in
        [("outlier-8", 1), ("outlier-60", 1), ("unit-slip", 1), ("sign-slip", 1), ("rows-swapped", 12)]
    {
        let fault = entry(id).unwrap();
        assert_eq!(touched(&added(fault, 1)), numbers, "{id}");
        assert_eq!(clean(fault, 1).holdout, clean(&CAREFUL, 1).holdout, "{id}");
    }
    let [small, large] = ["outlier-8", "outlier-60"].map(|id| added(entry(id).unwrap(), 2));
    let where_it_is = |rows: &[[f64; 6]]| rows.iter().flatten().position(|x| x.abs() > 1e-6);
    assert_eq!(where_it_is(&small), where_it_is(&large), "sizes of a fault hit the same number");
}

#[test]
fn a_knock_is_as_long_as_it_says_and_hits_one_condition() {
    let rows = added(entry("knocked-condition").unwrap(), 1);
    let knocked: Vec<f64> = rows.iter().map(|r| r.iter().map(|x| x * x).sum::<f64>().sqrt()).collect();
    let hit: Vec<f64> = knocked.into_iter().filter(|&length| length > 1e-6).collect();
    assert_eq!(hit.len(), 2, "both readings of a condition");
    assert!(hit.iter().all(|length| (length - 20.0).abs() < 1e-6), "{hit:?}");
}

#[test]
fn noise_has_the_law_it_is_called_by() {
    const SHARE: f64 = 0.08;
    let all = |id: &str| spread(errors(id).iter().flatten().copied());
    for (id, expected) in [
        ("none", 1.0),
        ("correlated-0.8", 1.0),
        ("uneven-axis-2.5x", 1.0),
        ("shared-reference", 1.0),
        ("setup-0.5", 1.25_f64.sqrt()),
    ] {
        let found = all(id);
        assert!((found / expected - 1.0).abs() < SHARE, "{id}: {found}, {expected} expected");
    }
    let coordinates = errors("correlated-0.8");
    let products = coordinates.iter().map(|e| e[0] * e[4]).sum::<f64>() / coordinates.len() as f64;
    assert!((products - 0.8).abs() < SHARE, "{products}");
    let uneven = errors("uneven-axis-2.5x");
    let of = |k: usize| spread(uneven.iter().map(|e| e[k]));
    assert!((of(2) / of(0) - 2.5).abs() < 0.25, "{}", of(2) / of(0));
    let size = |id: &str| {
        let mut sizes: Vec<f64> = errors(id).iter().flatten().map(|x| x.abs()).collect();
        sizes.sort_by(f64::total_cmp);
        sizes[sizes.len() / 2]
    };
    // Median of the size of Student's t of three degrees: 0.7649 (SciPy stats.t.ppf(0.75, 3)).
    assert!((size("student-3-scale") / 0.7649 - 1.0).abs() < SHARE, "{}", size("student-3-scale"));
    assert!((size("student-3-variance") * 3.0_f64.sqrt() / 0.7649 - 1.0).abs() < SHARE);
}

#[test]
fn what_is_stated_is_off_by_the_factor_of_its_name() {
    let stated = |id: &str| clean(entry(id).unwrap(), 0).hexapod.metrology.unwrap().sigma_translation;
    assert!((stated("none") / stated("noise-1.2x") - 1.2).abs() < 1e-12);
    assert!((stated("none") / stated("noise-0.5x") - 0.5).abs() < 1e-12);
}
