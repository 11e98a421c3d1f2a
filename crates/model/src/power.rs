//! How large an effect must be for a campaign to show it.

use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::candidates::{Candidate, Kind};
use crate::evidence::{Gram, Variant};

/// Chance of a false alarm of the test.
pub const FALSE_ALARM: f64 = 0.01;
/// Wanted chance of seeing the effect.
pub const POWER: f64 = 0.9;

/// Smallest size of one parameter that a test sees with the wanted power.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Detectable {
    /// Id of the term.
    pub term: String,
    /// The parameter.
    pub parameter: String,
    /// Unit of the size.
    pub unit: String,
    /// The size; absent when no size shows at all.
    pub size_at_90_percent_power: Option<f64>,
}

/// Detectable sizes of every parameter of every term that can be tested, beside springs and the terms in `beside`.
pub fn detectable(gram: &Gram, candidates: &[Candidate], beside: &[Variant]) -> Vec<Detectable> {
    let root = noncentrality(1.0, FALSE_ALARM, POWER).sqrt();
    let mut all = Vec::new();
    for candidate in candidates {
        let Kind::Term(term) = &candidate.kind else { continue };
        let Some(&block) = candidate.blocks.first() else { continue };
        let others: Vec<Variant> =
            beside.iter().copied().filter(|v| !candidate.blocks.contains(&v.block)).collect();
        let lengths = gram.signature_lengths(&others, block);
        for (p, length) in term.info().parameters.iter().zip(lengths) {
            let size = root / length * p.per_si;
            all.push(Detectable {
                term: term.info().id.to_owned(),
                parameter: p.name.to_owned(),
                unit: p.unit.to_owned(),
                size_at_90_percent_power: (size.is_finite() && length > 0.0).then_some(size),
            });
        }
    }
    all
}

/// Noncentrality at which a chi-square test with `dof` degrees of freedom has the wanted power.
pub fn noncentrality(dof: f64, false_alarm: f64, power: f64) -> f64 {
    let Ok(central) = ChiSquared::new(dof) else { return f64::INFINITY };
    let threshold = central.inverse_cdf(1.0 - false_alarm);
    let (mut low, mut high) = (0.0, 10.0 + 10.0 * threshold);
    for _ in 0..80 {
        let middle = f64::midpoint(low, high);
        if 1.0 - noncentral_cdf(threshold, dof, middle) < power {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high)
}

/// Distribution function of the noncentral chi-square: a Poisson mixture of central ones (Abramowitz and Stegun 26.4.25).
pub fn noncentral_cdf(x: f64, dof: f64, lambda: f64) -> f64 {
    let half = lambda / 2.0;
    let reach = half + 12.0 * half.sqrt() + 30.0;
    let (mut log_weight, mut sum, mut k) = (-half, 0.0, 0.0);
    while k <= reach {
        if let Ok(d) = ChiSquared::new(dof + 2.0 * k) {
            sum += log_weight.exp() * d.cdf(x);
        }
        k += 1.0;
        log_weight += half.max(f64::MIN_POSITIVE).ln() - k.ln();
    }
    sum.clamp(0.0, 1.0)
}
