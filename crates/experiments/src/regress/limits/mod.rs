//! All limits of a suite.

mod accuracy;
mod diagnosis;
mod effort;
mod exact;
mod honesty;

use super::fitted::Fitted;
use super::limit::{Limit, Test, Unit};
use super::suite::Suite;
use super::trials::Trials;
use crate::calibration::Record;
use crate::recovery::scene::Subject;

/// Least standard deviation of logarithms: counts that happen to be all the same in a baseline need not always be.
const ROUGH: f64 = 0.1;
/// The same of chi-square per number.
const FINE: f64 = 0.02;
/// Relative errors: from rounding to nonsense.
const ERRORS: Test = Test::Size { range: [1e-9, 10.0], least: ROUGH, unit: Unit::Percent };
/// Chi-square per number of models that are right: it hardly leaves 1; what does counts as a misfit elsewhere.
const CHI2: Test = Test::Size { range: [0.6, 1.7], least: FINE, unit: Unit::Plain };
/// Counts of work.
const COUNTS: Test = Test::Size { range: [1.0, 1e6], least: ROUGH, unit: Unit::Plain };
/// The limits of a suite, in the order of the pages.
pub fn limits(suite: &Suite) -> Vec<Limit> {
    let mut all = accuracy::general();
    all.extend(suite.subjects.iter().filter(|s| !s.effects.is_empty()).map(|&s| accuracy::of_effect(s)));
    all.extend(honesty::general());
    all.extend(diagnosis::answers());
    all.extend(diagnosis::probabilities());
    all.extend(suite.subjects.iter().flat_map(|&s| exact::of_subject(s)));
    all.push(exact::bounds());
    all.extend(effort::counts());
    all
}

fn fits(t: &Trials, value: impl Fn(&Fitted) -> Option<f64>) -> Vec<f64> {
    t.fitted().filter_map(|(_, f)| value(f)).collect()
}

fn fits_of(t: &Trials, subject: Subject, value: impl Fn(&Fitted) -> Option<f64>) -> Vec<f64> {
    t.fitted().filter(|(s, _)| **s == subject).filter_map(|(_, f)| value(f)).collect()
}

/// What a share is counted from: 1 for something bad, 0 for nothing.
fn share(bad: bool) -> f64 {
    f64::from(u8::from(bad))
}

fn told(t: &Trials, value: impl Fn(&Record) -> Option<f64>) -> Vec<f64> {
    t.answered().filter_map(|a| value(&a.record)).collect()
}

/// A name as one word.
fn slug(name: &str) -> String {
    name.replace([',', '(', ')'], "").replace(' ', "-")
}
