//! Against the statistics of Python and the textbook.

use super::{mean, median, quantile, root_mean_square, standard_deviation};

/// Unsorted, with a tie.
const SAMPLE: [f64; 8] = [2.5, -1.0, 7.25, 3.0, 3.0, 11.0, 0.5, 4.0];
/// Rounding of a few additions.
const ROUNDING: f64 = 1e-14;

#[track_caller]
fn assert_is(found: Option<f64>, expected: f64) {
    assert!((found.unwrap() - expected).abs() < ROUNDING * expected.abs().max(1.0), "{found:?}, {expected}");
}

/// Python 3.11: `statistics.quantiles(sample, n=20, method="inclusive")`, the type 7 of NumPy and R.
#[test]
fn quantiles_are_those_of_python() {
    for (share, expected) in
        [(0.0, -1.0), (0.05, -0.475), (0.25, 2.0), (0.5, 3.0), (0.9, 8.375), (0.95, 9.6875), (1.0, 11.0)]
    {
        assert_is(quantile(SAMPLE, share), expected);
    }
}

/// Python 3.11: `statistics.mean`, `statistics.stdev`, root of the mean square.
#[test]
fn mean_and_spread_are_those_of_python() {
    assert_is(mean(SAMPLE), 3.78125);
    assert_is(standard_deviation(SAMPLE), 3.792_467_864_069_516);
    assert_is(root_mean_square(SAMPLE), 5.184_863_787_989_035);
}

#[test]
fn the_median_is_the_middle_or_between_the_two_middle_ones() {
    assert_is(median([3.0, 1.0, 2.0]), 2.0);
    assert_is(median([4.0, 1.0, 3.0, 2.0]), 2.5);
    assert_is(median([7.0]), 7.0);
    assert_eq!(median(SAMPLE), quantile(SAMPLE, 0.5));
}

#[test]
fn a_share_beyond_the_sample_gives_its_ends() {
    assert_eq!(quantile(SAMPLE, -0.1), Some(-1.0));
    assert_eq!(quantile(SAMPLE, 1.1), Some(11.0));
}

#[test]
fn of_nothing_there_is_no_statistic() {
    assert_eq!([mean([]), median([]), quantile([], 0.5), root_mean_square([])], [None; 4]);
    assert_eq!([standard_deviation([]), standard_deviation([1.0])], [None; 2]);
}
