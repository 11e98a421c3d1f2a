//! The strongest period of the residual elongations in leg length.
//!
//! Least-squares periodogram with a floating mean, for uneven spacing; the carrier is 1 (length) or the change of leg
//! force (compliance). The chance of a false alarm of the highest peak is that of one frequency raised to the number of
//! independent ones. Source: Lomb 1976; Scargle 1982; Zechmeister and Kuerster 2009, Astron. Astrophys. 496 (eq. 4, 24).

use std::f64::consts::TAU;

use hexbench_core::parallel;
use serde::Serialize;

use super::JudgedModel;
use super::association::{COMPLIANCE, Look, added_columns};
use super::waves::{Poses, WaveTest, Waves};
use crate::effects::period::period_grid;

/// Grid steps per independent frequency.
const OVERSAMPLING: f64 = 4.0;
/// Chance below which a peak is reported.
const REPORTED: f64 = 0.01;

/// Distinct poses below which a period is a tale.
const FEWEST_POSES: usize = 10;
/// Steps between neighbors of the grid at which the highest peak is refined.
const REFINED: i32 = 24;

/// A peak of the periodogram.
#[derive(Debug, Clone, Serialize)]
pub struct Peak {
    /// Leg from 1; absent for all legs together.
    pub leg: Option<usize>,
    /// `length` or `compliance`.
    pub of: &'static str,
    /// Period in leg length, mm.
    pub period_mm: f64,
    /// F of the sine and cosine against the floating mean.
    pub f: f64,
    /// Chance of such a peak by noise, over all periods, legs and carriers looked at.
    pub false_alarm: f64,
}

/// Periodogram of the residual elongations of one leg, or of all together.
#[derive(Debug, Clone)]
pub struct Spectrum {
    /// Leg from 1; absent for all legs together.
    pub leg: Option<usize>,
    /// `length` or `compliance`.
    pub of: &'static str,
    /// `[period in mm, F of the sine and cosine against the floating mean]`, the longest period first.
    pub points: Vec<[f64; 2]>,
}

/// Periodograms of all legs together and of each alone, each for both carriers.
#[derive(Debug, Clone)]
pub struct Spectra {
    /// All of them.
    pub all: Vec<Spectrum>,
    /// The F that noise alone exceeds in one of a hundred such sets.
    pub level: f64,
    /// The most significant peak, when it is beyond chance.
    pub peak: Option<Peak>,
}

impl Spectrum {
    fn new(look: &Look<'_>, scanned: &[WaveTest]) -> Self {
        let points = scanned.iter().map(|s| [s.period * 1e3, s.f]).collect();
        Self { leg: look.leg.map(|l| l + 1), of: look.of(), points }
    }

    /// The same look at another model.
    pub fn again(&self, judged: &JudgedModel<'_>) -> Option<Self> {
        let periods = usable_periods(judged)?;
        let looks = [Look { judged, leg: self.leg.map(|l| l - 1), compliance: self.of == COMPLIANCE }];
        let scanned = scan(&looks, Waves::of(judged).as_ref(), &periods);
        Some(Self::new(&looks[0], scanned.first()?)).filter(|s| !s.points.is_empty())
    }
}

impl Spectra {
    /// All of them; `None` with too few poses.
    pub fn of(judged: &JudgedModel<'_>) -> Option<Self> {
        let periods = usable_periods(judged)?;
        let waves = Waves::of(judged);
        let looks: Vec<Look<'_>> = looks(judged).collect();
        let scanned = scan(&looks, waves.as_ref(), &periods);
        let all = || looks.iter().zip(&scanned);
        let looked: Vec<Peak> =
            all().filter_map(|(look, s)| peak(look, waves.as_ref(), s, &periods)).collect();
        let count = looked.len().max(1) as f64;
        let single = -f64::exp_m1(f64::ln_1p(-REPORTED / count) / independent(&periods));
        let dof = judged.white.len() as f64 - 3.0 - judged.rank;
        let all = all().map(|(look, s)| Spectrum::new(look, s)).filter(|s| !s.points.is_empty()).collect();
        (dof > 0.0).then(|| Self { all, level: exceeded_with(single, dof), peak: significant(looked) })
    }
}

/// The F(2, dof) that chance exceeds with a probability: its law has a closed form.
fn exceeded_with(probability: f64, dof: f64) -> f64 {
    0.5 * dof * (probability.powf(-2.0 / dof) - 1.0)
}

fn usable_periods(judged: &JudgedModel<'_>) -> Option<Vec<f64>> {
    let enough = Poses::of(judged).lengths.len() >= FEWEST_POSES;
    enough.then(|| period_grid(&judged.lin.conditions)).filter(|periods| !periods.is_empty())
}

/// All legs together and each alone, each for both carriers.
fn looks<'a>(judged: &'a JudgedModel<'a>) -> impl Iterator<Item = Look<'a>> {
    let legs = std::iter::once(None).chain((0..6).map(Some));
    legs.flat_map(move |leg| [false, true].map(|compliance| Look { judged, leg, compliance }))
}

/// The most significant peak, when it is beyond chance after as many looks.
fn significant(looked: Vec<Peak>) -> Option<Peak> {
    let count = looked.len() as f64;
    let best = looked
        .into_iter()
        .min_by(|a, b| a.false_alarm.total_cmp(&b.false_alarm).then(b.f.total_cmp(&a.f)))?;
    let false_alarm = (best.false_alarm * count).min(1.0);
    (false_alarm < REPORTED).then_some(Peak { false_alarm, ..best })
}

/// The periods at which a wave of each look has a test, in their order.
fn scan(looks: &[Look<'_>], waves: Option<&Waves>, periods: &[f64]) -> Vec<Vec<WaveTest>> {
    let one_by_one = || looks.iter().map(|look| column_by_column(look, periods)).collect();
    waves.map_or_else(one_by_one, |waves| waves.tests(looks, periods))
}

/// The same where errors of readings are correlated.
fn column_by_column(look: &Look<'_>, periods: &[f64]) -> Vec<WaveTest> {
    let base = [look.column(|_, _| 1.0)];
    let judged = look.judged;
    let at = |&period: &f64| {
        let wave = |f: fn(f64) -> f64| look.column(|c, l| f(TAU * c.commanded_lengths[l] / period));
        let waves = [wave(f64::sin), wave(f64::cos)];
        let (f, chance) = added_columns(judged.white.as_slice(), &base, &waves, judged.rank)?;
        Some(WaveTest { period, f, chance })
    };
    parallel::filter_map(periods, at)
}

/// Independent frequencies among oversampled ones.
fn independent(periods: &[f64]) -> f64 {
    (periods.len() as f64 / OVERSAMPLING).max(1.0)
}

/// The highest point, refined between its neighbors.
fn peak(look: &Look<'_>, waves: Option<&Waves>, scanned: &[WaveTest], periods: &[f64]) -> Option<Peak> {
    let by_f = |a: &&WaveTest, b: &&WaveTest| a.f.total_cmp(&b.f);
    let coarse = scanned.iter().max_by(by_f)?.period;
    let near = scan(std::slice::from_ref(look), waves, &around(coarse, periods));
    let WaveTest { period, f, chance } = *near.iter().flatten().max_by(by_f)?;
    // 1 - (1 - p)^M without losing small p.
    let false_alarm = -f64::exp_m1(independent(periods) * f64::ln_1p(-chance));
    let leg = look.leg.map(|l| l + 1);
    Some(Peak { leg, of: look.of(), period_mm: period * 1e3, f, false_alarm })
}

/// Periods between the neighbors of a grid value, equally spaced in frequency.
fn around(period: f64, periods: &[f64]) -> Vec<f64> {
    let step = match periods {
        [a, b, ..] => (1.0 / b - 1.0 / a).abs(),
        _ => 0.0,
    };
    let shift = |k: i32| step * f64::from(k) / f64::from(REFINED);
    (-REFINED..=REFINED)
        .map(|k| 1.0 / (1.0 / period + shift(k)))
        .filter(|p| p.is_finite() && *p > 0.0)
        .collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

    use super::*;
    use crate::estimation::fit::fit_baseline;
    use crate::results::diagnose::prepare;
    use hexbench_core::files::{read_hexapod, read_measurements};
    use statrs::distribution::{ContinuousCDF, FisherSnedecor};

    #[test]
    fn waves_summed_over_poses_have_the_tests_of_their_columns() {
        let file = |name: &str| {
            let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/cases/not-in-catalogue");
            std::path::Path::new(folder).join(name)
        };
        let hexapod = read_hexapod(&file("hexapod.toml")).unwrap();
        let data = read_measurements(&file("measurements.csv")).unwrap().dataset;
        let campaign = prepare(&hexapod, &data).unwrap();
        let fit = fit_baseline(&campaign).unwrap();
        let judged = JudgedModel::of(&campaign, &data, &fit.point, true).unwrap();
        let waves = Waves::of(&judged).unwrap();
        let periods: Vec<f64> = (1..40).map(|k| 0.04 / f64::from(k)).collect();
        let looks: Vec<Look<'_>> = looks(&judged).collect();
        for (look, fast) in looks.iter().zip(waves.tests(&looks, &periods)) {
            let plain = column_by_column(look, &periods);
            assert!(plain.len() == fast.len() && plain.len() > 30);
            for (a, b) in fast.iter().zip(&plain) {
                let same = (a.f / b.f - 1.0).abs() < 1e-7 && (a.chance / b.chance - 1.0).abs() < 1e-6;
                assert!(same, "{:?} {}: {a:?} {b:?}", look.leg, look.compliance);
            }
        }
    }

    #[test]
    fn the_level_of_chance_is_that_of_the_law_of_f() {
        for (p, dof) in [(0.01, 20.0), (1e-6, 900.0)] {
            let f = exceeded_with(p, dof);
            let back = FisherSnedecor::new(2.0, dof).unwrap().sf(f);
            assert!((back / p - 1.0).abs() < 1e-8, "F(2, {dof}) = {f}: chance {back}, not {p}");
        }
    }
}
