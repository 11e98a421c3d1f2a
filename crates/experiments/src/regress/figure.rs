//! Figures of samples as people read them.

use hexbench_report::number::{hundredths, significant};

use super::limit::{Test, Unit};
use super::sample::Sample;

/// Factor beyond which it does not matter how much would be noticed.
const LARGEST_FACTOR: f64 = 100.0;
/// Digits of a figure.
const DIGITS: i32 = 3;

/// A sample in one figure with what is behind it.
pub fn figure(test: Test, sample: &Sample) -> String {
    match *sample {
        Sample::Share { of: 0, .. } | Sample::Size { n: 0, .. } | Sample::Spread { n: 0, .. } => {
            "none".to_owned()
        }
        Sample::Share { hits, of } => format!("{hits} of {of} ({} %)", hundredths(hits as f64 / of as f64)),
        Sample::Size { n, .. } => format!("{} (n = {n})", mean(test, sample.moments().0.exp())),
        Sample::Spread { n, .. } => format!("{:.2} (n = {n})", sample.moments().0),
        Sample::Exact { ref values } if values.is_empty() => "none".to_owned(),
        Sample::Exact { ref values } if values.iter().any(Option::is_none) => "not found".to_owned(),
        Sample::Exact { .. } => exact(sample.moments().0),
    }
}

/// What a limit would notice, in the words of its figure; `reference` is the baseline.
pub fn notice(test: Test, noticed: Option<f64>, reference: &Sample) -> String {
    let Some(value) = noticed else { return "nothing".to_owned() };
    if matches!(test, Test::Size { .. }) && value > LARGEST_FACTOR {
        return format!("nothing below x {LARGEST_FACTOR}");
    }
    match test {
        Test::Share => format!("{} %", hundredths(value)),
        Test::Size { .. } => {
            format!("{} (x {value:.2})", mean(test, reference.moments().0.exp() * value))
        }
        Test::Spread => format!("{value:.2}"),
        Test::Exact => format!("x {value}"),
        Test::Bound => "above 1".to_owned(),
    }
}

fn mean(test: Test, value: f64) -> String {
    match test {
        Test::Size { unit: Unit::Percent, .. } => format!("{} %", small(100.0 * value)),
        _ => small(value),
    }
}

fn small(value: f64) -> String {
    if value < 1e-3 { exact(value) } else { significant(value, DIGITS) }
}

fn exact(value: f64) -> String {
    format!("{value:.1e}")
}
