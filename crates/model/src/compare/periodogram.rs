//! The strongest period of the residual elongations in leg length.
//!
//! Least-squares periodogram with a floating mean, for uneven spacing; the carrier is 1 (length) or the change of leg
//! force (compliance). The chance of a false alarm of the highest peak is that of one frequency raised to the number of
//! independent ones. Source: Lomb 1976; Scargle 1982; Zechmeister and Kuerster 2009, Astron. Astrophys. 496 (eq. 4, 24).

use std::f64::consts::TAU;

use serde::Serialize;

use super::Judged;
use super::association::{added_columns, points};
use crate::period::period_grid;

/// Grid steps per independent frequency.
const OVERSAMPLING: f64 = 4.0;
/// Chance below which a peak is reported.
const REPORTED: f64 = 0.01;

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
    let periods = period_grid(&judged.lin.conditions);
    let legs: Vec<Option<usize>> = std::iter::once(None).chain((0..6).map(Some)).collect();
    let looks = legs.iter().flat_map(|leg| [false, true].map(|compliance| (*leg, compliance)));
    let looked: Vec<Peak> = looks.filter_map(|(leg, compliance)| peak(judged, leg, compliance, &periods)).collect();
    let count = looked.len() as f64;
    let best = looked.into_iter().min_by(|a, b| a.false_alarm.total_cmp(&b.false_alarm).then(b.f.total_cmp(&a.f)))?;
    let false_alarm = (best.false_alarm * count).min(1.0);
    (false_alarm < REPORTED).then_some(Peak { false_alarm, ..best })
}

fn peak(judged: &Judged<'_>, leg: Option<usize>, compliance: bool, periods: &[f64]) -> Option<Peak> {
    let p = points(judged, leg, compliance, |c, l| c.commanded_lengths[l]);
    let base = vec![p.carrier.clone()];
    let wave = |period: f64, f: fn(f64) -> f64| -> Vec<f64> {
        p.carrier.iter().zip(&p.x).map(|(s, q)| s * f(TAU * q / period)).collect()
    };
    let at = |&period: &f64| {
        let (f, single) = added_columns(&p.y, &base, &[wave(period, f64::sin), wave(period, f64::cos)])?;
        Some((period, f, single))
    };
    let (period, f, single) = periods.iter().filter_map(at).max_by(|a, b| a.1.total_cmp(&b.1))?;
    let independent = (periods.len() as f64 / OVERSAMPLING).max(1.0);
    // 1 - (1 - p)^M without losing small p.
    let false_alarm = -f64::exp_m1(independent * f64::ln_1p(-single));
    let of = if compliance { "compliance" } else { "length" };
    Some(Peak { leg: leg.map(|l| l + 1), of, period_mm: period * 1e3, f, false_alarm })
}
