//! All limits of a suite.

/// Limits of a group, three lines each: id and title, why, how it is tested and its values.
macro_rules! limits {
    ($group:expr; $($id:literal $title:literal [$why:literal] $test:expr => $values:expr;)+) => {
        vec![$(RegressLimit::new(($id, $group), $title, $why, $test, $values)),+]
    };
}

mod accuracy;
mod diagnosis;
mod effort;
mod exact;
mod files;
mod honesty;
mod laboratory;

use super::fitted::Fitted;
use super::limit::{LimitTest, LimitUnit, RegressLimit};
use super::suite::RegressSuite;
use super::trials::SuiteTrials;
use crate::calibration::CalibrationRecord;
use crate::recovery::scene::HiddenSubject;

/// Least standard deviation of logarithms: counts that happen to be all the same in a baseline need not always be.
const ROUGH: f64 = 0.1;
/// The same of chi-square per number.
const FINE: f64 = 0.02;
/// Relative errors: from rounding to nonsense.
const ERRORS: LimitTest = LimitTest::Size { range: [1e-9, 10.0], least: ROUGH, unit: LimitUnit::Percent };
/// Chi-square per number of models that are right: it hardly leaves 1; what does counts as a misfit elsewhere.
const CHI2: LimitTest = LimitTest::Size { range: [0.6, 1.7], least: FINE, unit: LimitUnit::Plain };
/// Counts of work.
const COUNTS: LimitTest = LimitTest::Size { range: [1.0, 1e6], least: ROUGH, unit: LimitUnit::Plain };
/// The limits of a suite, in the order of the pages.
pub fn limits(suite: &RegressSuite) -> Vec<RegressLimit> {
    let mut all = accuracy::general();
    all.extend(suite.subjects.iter().filter(|s| !s.effects.is_empty()).map(|&s| accuracy::of_effect(s)));
    all.extend(honesty::general());
    all.extend(diagnosis::answers());
    all.extend(diagnosis::probabilities());
    all.extend(laboratory::all());
    all.extend(files::all());
    all.extend(suite.subjects.iter().flat_map(|&s| exact::of_subject(s)));
    all.push(exact::bounds());
    all.extend(effort::counts());
    all
}

fn fits(t: &SuiteTrials, value: impl Fn(&Fitted) -> Option<f64>) -> Vec<f64> {
    t.fitted().filter_map(|(_, f)| value(f)).collect()
}

fn fits_of(t: &SuiteTrials, subject: HiddenSubject, value: impl Fn(&Fitted) -> Option<f64>) -> Vec<f64> {
    t.fitted().filter(|(s, _)| **s == subject).filter_map(|(_, f)| value(f)).collect()
}

/// What a share is counted from: 1 for something bad, 0 for nothing.
fn share(bad: bool) -> f64 {
    f64::from(u8::from(bad))
}

fn values(t: &SuiteTrials, value: impl Fn(&CalibrationRecord) -> Option<f64>) -> Vec<f64> {
    t.answered().filter_map(|a| value(&a.record)).collect()
}

/// A name as one word.
fn slug(name: &str) -> String {
    name.replace([',', '(', ')'], "").replace(' ', "-")
}
