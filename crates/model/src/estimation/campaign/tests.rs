//! Which readings share an error, and what that does to their means.

#![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

use super::*;
use crate::estimation::noise::SharedReference;
use crate::test_machine::readings;

/// Share of the variance that readings of a record have in common.
const SHARE: f64 = 0.36;

/// The campaign of readings that share a reference, each condition read twice, the second time off by a standard deviation.
fn twice(record: SharedReference, numbers: impl Fn(usize) -> Option<i64>) -> Campaign {
    let (hexapod, mut data) = readings(Measurand::DeflectionEuler, Vec::new());
    let mut again = data.observations.clone();
    for row in &mut again {
        row.measured[0] += 1e-6;
    }
    data.observations.extend(again);
    for (i, row) in data.observations.iter_mut().enumerate() {
        row.reference_record = numbers(i);
    }
    let structure = Structure::Reference { share: SHARE, record };
    Campaign::with_noise(&hexapod, &data, Noise { structure, ..Noise::stated(1e-6, 1e-5) }).unwrap()
}

/// Standard deviations of a mean by what is its own and by what it shares, um; and the squares of what its readings differ by.
fn mean_of_two(campaign: &Campaign) -> [f64; 3] {
    let group = &campaign.groups[0];
    [1e6 * group.sigma[0], 1e6 * group.shared[0], group.pure_error]
}

fn agree(found: [f64; 3], expected: [f64; 3]) {
    let is_near = |(a, b): (f64, f64)| (a - b).abs() < 1e-9;
    assert!(found.into_iter().zip(expected).all(is_near), "{found:?} {expected:?}");
}

#[test]
fn repeats_after_one_reference_scatter_by_their_own_noise_alone() {
    let own = 1.0 - SHARE;
    let expected = [(own / 2.0).sqrt(), SHARE.sqrt(), 0.5 / own];
    agree(mean_of_two(&twice(SharedReference::Pose, |_| None)), expected);
    agree(mean_of_two(&twice(SharedReference::Named, |_| Some(4))), expected);
}

#[test]
fn repeats_that_each_have_a_reference_scatter_by_all_of_their_noise() {
    let expected = [((1.0 - SHARE) / 2.0).sqrt(), (SHARE / 2.0).sqrt(), 0.5];
    agree(mean_of_two(&twice(SharedReference::Repeat, |_| None)), expected);
    agree(mean_of_two(&twice(SharedReference::Named, |_| None)), expected);
}

#[test]
fn numbers_of_references_keep_readings_apart_where_they_name_records_only() {
    let by_repeat = |i: usize| Some(i64::from(i >= 9));
    let named = twice(SharedReference::Named, by_repeat);
    assert_eq!(named.groups.len(), 18, "repeats after two references are no repeats of each other");
    assert_eq!((named.groups[0].record, named.groups[8].record, named.groups[9].record), (0, 0, 1));
    assert_eq!(twice(SharedReference::Pose, by_repeat).groups.len(), 9);
}
