//! Figures as cells of a table; a dash stands for what is not stated.

use hexbench_report::number::significant;

use super::figures::{Interval, Mean};
use super::paired::{Differences, Exchanges, Ratio, Ratios};
use crate::alarm::probability;
use crate::shares::or_dash;

pub(super) fn number(value: Option<f64>) -> String {
    or_dash(value, |x| significant(x, 3))
}

pub(super) fn share(interval: Option<Interval>) -> String {
    let in_words = |i: Interval| {
        let [low, high] = i.bounds.map(|b| format!("{:.1}", 100.0 * b));
        format!("{:.1} ({low} .. {high})", 100.0 * i.hits as f64 / i.of as f64)
    };
    or_dash(interval, in_words)
}

pub(super) fn counts(outcomes: Option<[usize; 3]>) -> String {
    or_dash(outcomes, |[right, honest, wrong]| format!("{right} / {honest} / {wrong}"))
}

pub(super) fn percent(mean: Option<Mean>) -> Option<Mean> {
    let times =
        |m: Mean| Mean { mean: 100.0 * m.mean, standard_error: m.standard_error.map(|s| 100.0 * s), ..m };
    mean.map(times)
}

pub(super) fn gained(found: &Exchanges) -> Option<String> {
    let (difference, bounds) = found.difference()?;
    let [low, high] = bounds.map(|b| format!("{:.1}", 100.0 * b));
    Some(format!("{:.1} ({low} .. {high})", 100.0 * difference))
}

pub(super) fn chance(found: &Exchanges) -> Option<String> {
    (found.cases > 0).then(|| probability(found.chance()))
}

pub(super) fn with_error(mean: Option<Mean>) -> String {
    let in_words = |m: Mean| match m.standard_error {
        Some(se) => format!("{:.2} +- {se:.2}", m.mean),
        None => format!("{:.2}", m.mean),
    };
    or_dash(mean, in_words)
}

/// The same of numbers that may be small.
pub(super) fn exact(mean: Option<Mean>) -> String {
    let in_words = |m: Mean| match m.standard_error {
        Some(se) => format!("{} +- {}", significant(m.mean, 3), significant(se, 2)),
        None => significant(m.mean, 3),
    };
    or_dash(mean, in_words)
}

pub(super) fn ratios(compared: &Ratios) -> Vec<String> {
    compared.of.iter().map(|r| or_dash(*r, ratio_in_words)).collect()
}

pub(super) fn ratio_in_words((ratio, interval): Ratio) -> String {
    let short = |x: f64| significant(x, 2);
    match interval {
        None => short(ratio),
        Some([low, high]) => format!("{} ({} .. {})", short(ratio), short(low), short(high)),
    }
}

pub(super) fn differences(compared: &Differences, in_words: fn(Option<Mean>) -> String) -> Vec<String> {
    let best = |m: &Mean| m.mean == 0.0 && m.standard_error == Some(0.0);
    compared
        .of
        .iter()
        .map(|d| if d.as_ref().is_some_and(best) { "0".to_owned() } else { in_words(*d) })
        .collect()
}
