//! How large an effect must be for a campaign to show it.

use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor, Normal};
use statrs::function::beta::beta_reg;
use statrs::function::gamma::ln_gamma;

use crate::inference::candidates::{Candidate, CandidateKind};
use crate::inference::evidence::{Gram, Variant};
use crate::inference::search::log_odds_of_one_more;

/// Chance of a false alarm of the test.
pub const FALSE_ALARM: f64 = 0.01;
/// Wanted chance of seeing the effect.
pub const POWER: f64 = 0.9;

/// Smallest size of one parameter at which a diagnosis no longer finds the model without it more probable, with the wanted power; of a law
/// with a shape, in the middle of the shapes it may have.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
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

/// Signature of an effect of natural size, over the smallest that shows, below which it counts as none: no machine has an effect ten
/// thousand times its natural size, and what is left of a signature there may be rounding.
const SMALLEST_SIGNATURE: f64 = 1e-4;

/// Detectable sizes of every parameter of every term that can be tested, beside springs and the terms in `beside`.
pub fn detectable(gram: &Gram, candidates: &[Candidate], beside: &[Variant]) -> Vec<Detectable> {
    let lost = Normal::standard().inverse_cdf(POWER);
    let least = -log_odds_of_one_more(candidates, beside.len());
    let mut all = Vec::new();
    for candidate in candidates {
        let CandidateKind::Term(term) = &candidate.kind else { continue };
        let others: Vec<Variant> =
            beside.iter().copied().filter(|v| !candidate.blocks.contains(&v.block)).collect();
        let is_own = |b: &usize| {
            let own = candidate.version(*b).is_some_and(|version| std::ptr::eq(version.info(), term.info()));
            own && !gram.blocks[*b].rich
        };
        let of_shapes: Vec<Vec<f64>> = candidate
            .blocks
            .iter()
            .filter(|b| is_own(b))
            .map(|&b| sizes_seen(gram, &others, b, [least, lost]))
            .filter(|sizes| !sizes.is_empty())
            .collect();
        if of_shapes.is_empty() {
            continue;
        }
        for (k, p) in term.info().parameters.iter().enumerate() {
            let size = middle(of_shapes.iter().map(|sizes| sizes[k])) * p.per_si;
            all.push(Detectable {
                term: term.info().id.to_owned(),
                parameter: p.name.to_owned(),
                unit: p.unit.to_owned(),
                size_at_90_percent_power: size.is_finite().then_some(size),
            });
        }
    }
    all
}

/// Size of every parameter of a block with so much evidence when so much of its signature is lost, SI; infinite where none shows.
fn sizes_seen(gram: &Gram, others: &[Variant], block: usize, [least, lost]: [f64; 2]) -> Vec<f64> {
    let transform = &gram.blocks[block].transform;
    let believed = gram.lengths_believed(others, block, least, lost);
    let size = |(k, (length, believed)): (usize, (f64, f64))| {
        // A signature of rounding errors is none.
        let shows = length * transform[(k, k)].abs() > SMALLEST_SIGNATURE * believed;
        if shows { believed / length } else { f64::INFINITY }
    };
    let lengths = gram.signature_lengths(others, block).into_iter();
    lengths.zip(believed).enumerate().map(size).collect()
}

/// The middle value, of an even number the lower of both.
fn middle(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[(values.len() - 1) / 2]
}

/// The law of the drop of chi-square that the parameters of an effect bring: chi-square where the noise is stated, and where
/// it is estimated from repeats `dof` times an F of `dof` and `noise_dof`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChiSquareDropLaw {
    /// Determined parameters of the effect.
    pub dof: f64,
    /// Degrees of freedom behind the noise level; infinite when it is stated.
    pub noise_dof: f64,
}

impl ChiSquareDropLaw {
    /// Drop that noise alone exceeds with the chance of a false alarm.
    pub fn threshold(&self, false_alarm: f64) -> f64 {
        let at = 1.0 - false_alarm;
        if self.noise_dof.is_finite() {
            FisherSnedecor::new(self.dof, self.noise_dof)
                .map_or(f64::INFINITY, |law| self.dof * law.inverse_cdf(at))
        } else {
            ChiSquared::new(self.dof).map_or(f64::INFINITY, |law| law.inverse_cdf(at))
        }
    }

    /// Chance of a drop beyond a threshold when the effect is there with this noncentrality.
    pub fn power(&self, threshold: f64, noncentrality: f64) -> f64 {
        if self.noise_dof.is_finite() {
            1.0 - noncentral_f_cdf(threshold / self.dof, self.dof, self.noise_dof, noncentrality)
        } else {
            1.0 - noncentral_cdf(threshold, self.dof, noncentrality)
        }
    }

    /// Noncentrality at which the test has the wanted power.
    pub fn noncentrality(&self, false_alarm: f64, power: f64) -> f64 {
        let threshold = self.threshold(false_alarm);
        let (mut low, mut high) = (0.0, 10.0 + 10.0 * threshold);
        for _ in 0..80 {
            let middle = f64::midpoint(low, high);
            if self.power(threshold, middle) < power {
                low = middle;
            } else {
                high = middle;
            }
        }
        f64::midpoint(low, high)
    }
}

/// Noncentrality at which a chi-square test with `dof` degrees of freedom has the wanted power.
pub fn noncentrality(dof: f64, false_alarm: f64, power: f64) -> f64 {
    ChiSquareDropLaw { dof, noise_dof: f64::INFINITY }.noncentrality(false_alarm, power)
}

/// Distribution function of the noncentral chi-square: a Poisson mixture of central ones (Abramowitz and Stegun 26.4.25).
pub fn noncentral_cdf(x: f64, dof: f64, lambda: f64) -> f64 {
    mixture(lambda, |k| ChiSquared::new(dof + 2.0 * k).map_or(0.0, |d| d.cdf(x)))
}

/// Distribution function of the noncentral F: a Poisson mixture of incomplete beta functions (Abramowitz and Stegun 26.6.20).
pub fn noncentral_f_cdf(x: f64, dof: f64, noise_dof: f64, lambda: f64) -> f64 {
    let share = dof * x / (dof * x + noise_dof);
    mixture(lambda, |k| if share > 0.0 { beta_reg(0.5 * dof + k, 0.5 * noise_dof, share) } else { 0.0 })
}

/// Mean of `f` over the Poisson law of mean `lambda / 2`.
fn mixture(lambda: f64, f: impl Fn(f64) -> f64) -> f64 {
    let half = lambda / 2.0;
    let spread = 12.0 * half.sqrt() + 30.0;
    // Far from the mean the weights are below rounding; they are computed in logarithms from the first one that counts.
    let first = (half - spread).floor().max(0.0);
    let log_half = half.max(f64::MIN_POSITIVE).ln();
    let (mut log_weight, mut sum, mut k) = (first * log_half - half - ln_gamma(first + 1.0), 0.0, first);
    while k <= half + spread {
        sum += log_weight.exp() * f(k);
        k += 1.0;
        log_weight += log_half - k.ln();
    }
    sum.clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Digits of the reference numbers.
    const DIGITS: f64 = 1e-9;

    #[test]
    fn noncentral_laws_agree_with_scipy() {
        // scipy.stats.ncx2.cdf(x, df, nc) and ncf.cdf(x, dfn, dfd, nc), SciPy 1.16.
        for (found, wanted) in [
            (noncentral_cdf(9.2, 1.0, 14.9), 0.204_146_408_173_f64),
            (noncentral_cdf(16.8, 6.0, 20.0), 0.167_929_233_286),
            (noncentral_cdf(6.63, 1.0, 0.5), 0.968_587_666_405),
            (noncentral_cdf(300.0, 4.0, 250.0), 0.921_971_256_061),
            (noncentral_f_cdf(8.0, 1.0, 24.0, 14.9), 0.162_800_405_610),
            (noncentral_f_cdf(3.0, 6.0, 36.0, 20.0), 0.228_429_348_740),
            (noncentral_f_cdf(4.0, 3.0, 12.0, 1.0), 0.929_205_281_298),
        ] {
            assert!((found - wanted).abs() < DIGITS, "{found} {wanted}");
        }
    }

    #[test]
    fn a_test_keeps_its_level_and_reaches_its_power() {
        for noise_dof in [12.0, f64::INFINITY] {
            let law = ChiSquareDropLaw { dof: 3.0, noise_dof };
            let threshold = law.threshold(0.01);
            let (level, reached) =
                (law.power(threshold, 0.0), law.power(threshold, law.noncentrality(0.01, 0.9)));
            assert!((level - 0.01).abs() < 1e-8 && (reached - 0.9).abs() < 1e-8, "{level} {reached}");
        }
    }

    #[test]
    fn nine_in_ten_effects_of_the_stated_size_show_in_a_test_with_one_false_alarm_in_a_hundred() {
        // The quantiles of a Gaussian at 0.995 and 0.9: the other tail does not count.
        let sigmas = 2.575_829 + 1.281_552;
        assert!((noncentrality(1.0, FALSE_ALARM, POWER).sqrt() - sigmas).abs() < 1e-5);
    }
}
