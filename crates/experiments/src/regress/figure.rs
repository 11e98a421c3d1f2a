//! Figures of samples as people read them.

use hexbench_report::number::{hundredths, significant};

use super::baseline::FirstRun;
use super::limit::{LimitTest, LimitUnit};
use super::sample::CondensedValues;

/// Factor beyond which it does not matter how much would be noticed.
const LARGEST_FACTOR: f64 = 100.0;
/// Digits of a figure.
const DIGITS: i32 = 3;

/// A sample in one figure with what is behind it.
pub fn figure(test: LimitTest, sample: &CondensedValues) -> String {
    match *sample {
        CondensedValues::Share { of: 0, .. }
        | CondensedValues::Size { n: 0, .. }
        | CondensedValues::Spread { n: 0, .. } => "none".to_owned(),
        CondensedValues::Share { hits, of } => {
            format!("{hits} of {of} ({} %)", hundredths(hits as f64 / of as f64))
        }
        CondensedValues::Size { n, .. } => format!("{} (n = {n})", mean(test, sample.moments().0.exp())),
        CondensedValues::Spread { n, .. } => format!("{:.2} (n = {n})", sample.moments().0),
        CondensedValues::Exact { ref values } if values.is_empty() => "none".to_owned(),
        CondensedValues::Exact { ref values } if values.iter().any(Option::is_none) => "not found".to_owned(),
        CondensedValues::Exact { .. } => exact(sample.moments().0),
    }
}

/// The mean of the baseline's first run in one figure.
pub fn of_first(test: LimitTest, first: &FirstRun) -> String {
    let value = match test {
        LimitTest::Share => format!("{} %", hundredths(first.mean)),
        LimitTest::Spread => format!("{:.2}", first.mean),
        _ => mean(test, first.mean.exp()),
    };
    format!("{value} (n = {})", first.n)
}

/// What a limit would notice, in the words of its figure; `reference` is the baseline.
pub fn notice(test: LimitTest, noticed: Option<f64>, reference: &CondensedValues) -> String {
    let Some(value) = noticed else { return "nothing".to_owned() };
    if matches!(test, LimitTest::Size { .. }) && value > LARGEST_FACTOR {
        return format!("nothing below x {LARGEST_FACTOR}");
    }
    match test {
        LimitTest::Share => format!("{} %", hundredths(value)),
        LimitTest::Size { .. } => {
            format!("{} (x {value:.2})", mean(test, reference.moments().0.exp() * value))
        }
        LimitTest::Spread => format!("{value:.2}"),
        LimitTest::Exact => format!("x {value}"),
        LimitTest::Bound => "above 1".to_owned(),
    }
}

fn mean(test: LimitTest, value: f64) -> String {
    match test {
        LimitTest::Size { unit: LimitUnit::Percent, .. } => format!("{} %", small(100.0 * value)),
        _ => small(value),
    }
}

fn small(value: f64) -> String {
    if value < 1e-3 { exact(value) } else { significant(value, DIGITS) }
}

fn exact(value: f64) -> String {
    format!("{value:.1e}")
}
