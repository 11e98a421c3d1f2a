//! The strongest period of the residual elongations in leg length.
//!
//! Least-squares periodogram with a floating mean, for uneven spacing; the carrier is 1 (length) or the change of leg
//! force (compliance). The chance of a false alarm of the highest peak is that of one frequency raised to the number of
//! independent ones. Source: Lomb 1976; Scargle 1982; Zechmeister and Kuerster 2009, Astron. Astrophys. 496 (eq. 4, 24).

use std::f64::consts::TAU;

use rayon::prelude::*;
use serde::Serialize;

use super::Judged;
use super::association::{Look, added_columns};
use crate::period::period_grid;

/// Grid steps per independent frequency.
const OVERSAMPLING: f64 = 4.0;
/// Chance below which a peak is reported.
const REPORTED: f64 = 0.01;

/// Distinct poses below which a period is a tale.
const FEWEST_POSES: usize = 10;
/// Steps between neighbours of the grid at which the highest peak is refined.
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

/// The most significant peak over all legs together and each alone, when it is beyond chance.
pub fn peaks(judged: &Judged<'_>) -> Option<Peak> {
    if distinct_poses(judged) < FEWEST_POSES {
        return None;
    }
    let periods = period_grid(&judged.lin.conditions);
    let legs: Vec<Option<usize>> = std::iter::once(None).chain((0..6).map(Some)).collect();
    let looks = legs.iter().flat_map(|leg| [false, true].map(|compliance| (*leg, compliance)));
    let looked: Vec<Peak> =
        looks.filter_map(|(leg, compliance)| peak(&Look { judged, leg, compliance }, &periods)).collect();
    let count = looked.len() as f64;
    let best = looked
        .into_iter()
        .min_by(|a, b| a.false_alarm.total_cmp(&b.false_alarm).then(b.f.total_cmp(&a.f)))?;
    let false_alarm = (best.false_alarm * count).min(1.0);
    (false_alarm < REPORTED).then_some(Peak { false_alarm, ..best })
}

fn distinct_poses(judged: &Judged<'_>) -> usize {
    let bits = |c: &crate::campaign::Condition| c.commanded_lengths.map(f64::to_bits);
    let mut poses: Vec<[u64; 6]> = judged.lin.conditions.iter().map(|c| bits(c).into()).collect();
    poses.sort_unstable();
    poses.dedup();
    poses.len()
}

fn peak(look: &Look<'_>, periods: &[f64]) -> Option<Peak> {
    let base = [look.column(|_, _| 1.0)];
    let judged = look.judged;
    let at = |&period: &f64| {
        let wave = |f: fn(f64) -> f64| look.column(|c, l| f(TAU * c.commanded_lengths[l] / period));
        let waves = [wave(f64::sin), wave(f64::cos)];
        let (f, single) = added_columns(judged.white.as_slice(), &base, &waves, judged.rank)?;
        Some((period, f, single))
    };
    let highest = |all: &[f64]| {
        let found: Vec<(f64, f64, f64)> = all.par_iter().filter_map(at).collect();
        found.into_iter().max_by(|a, b| a.1.total_cmp(&b.1))
    };
    let (coarse, ..) = highest(periods)?;
    let (period, f, single) = highest(&around(coarse, periods))?;
    let independent = (periods.len() as f64 / OVERSAMPLING).max(1.0);
    // 1 - (1 - p)^M without losing small p.
    let false_alarm = -f64::exp_m1(independent * f64::ln_1p(-single));
    let leg = look.leg.map(|l| l + 1);
    Some(Peak { leg, of: look.of(), period_mm: period * 1e3, f, false_alarm })
}

/// Periods between the neighbours of a grid value, equally spaced in frequency.
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
