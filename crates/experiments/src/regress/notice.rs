//! What change a limit would notice: the smallest one that fails a run with a probability of 90 %.

use statrs::distribution::{Binomial, ContinuousCDF, DiscreteCDF, FisherSnedecor, StudentsT};

use super::limit::LimitTest;
use super::rule::{RATIO, degrees, deviation, judge};
use super::sample::CondensedValues;
use crate::alarm::{LimitVerdict, POWER, bisected};

/// The mean (of errors and counts: the factor) at which a run of `count` values fails with probability [`POWER`]; `None` where
/// nothing would be noticed.
pub fn noticed(test: LimitTest, count: u64, before: &CondensedValues, level: f64) -> Option<f64> {
    if count == 0 || before.count() < 2 {
        return None;
    }
    match test {
        LimitTest::Share => share(count, before, level),
        LimitTest::Size { .. } => Some(size(test, count, before, level)),
        LimitTest::Spread => spread(count, before, level),
        LimitTest::Exact => Some(RATIO),
        LimitTest::Bound => Some(1.0),
    }
}

/// Share whose binomial law has at least the critical number of hits with probability [`POWER`].
fn share(count: u64, before: &CondensedValues, level: f64) -> Option<f64> {
    let fails = |hits: u64| {
        judge(LimitTest::Share, &CondensedValues::Share { hits, of: count }, before, 1, level).verdict
            == LimitVerdict::Worse
    };
    let critical = (1..=count).find(|&hits| fails(hits))?;
    let noticed = |p: f64| Binomial::new(p, count).is_ok_and(|law| law.sf(critical - 1) >= POWER);
    Some(bisected(0.0, 1.0, noticed))
}

fn size(test: LimitTest, count: u64, before: &CondensedValues, level: f64) -> f64 {
    let scale = deviation(test, before) * (1.0 / count as f64 + 1.0 / before.count() as f64).sqrt();
    let quantile = |p: f64| {
        StudentsT::new(0.0, 1.0, before.count() as f64 - 1.0).map_or(f64::NAN, |law| law.inverse_cdf(p))
    };
    (scale * (quantile(1.0 - level) + quantile(POWER))).exp()
}

fn spread(count: u64, before: &CondensedValues, level: f64) -> Option<f64> {
    let [nu1, nu0] = degrees(count, before);
    let law = FisherSnedecor::new(nu1, nu0).ok()?;
    let critical = bisected(1.0, 1e3, |ratio| 2.0 * law.sf(ratio) <= level);
    let noticed = bisected(1.0, 1e4, |ratio| law.sf(critical / ratio) >= POWER);
    Some(noticed * before.moments().0)
}
