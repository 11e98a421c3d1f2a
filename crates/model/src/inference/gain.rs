//! What an effect is worth on readings that no fit has seen: is the gain more than chance, and is it a gain worth naming?

use std::collections::BTreeMap;

use hexbench_core::statistics::standard_deviation;
use hexbench_core::{Matrix6, Vector6};
use nalgebra::DVector;
use serde::Serialize;
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

use crate::estimation::foreseen::Foreseen;
use crate::inference::verdict::NAMED;

/// Chance that is not believed in: a useless effect passes, and one that is really there fails, in so many cases.
pub const UNLIKELY: f64 = 0.05;
/// Probability that an effect needs where held-out readings lean against it without being able to tell.
const BEYOND_DOUBT: f64 = 0.99;
/// Gain, nats, below which readings promise nothing, so that they cannot lean against an effect either: odds of 20 to 1.
const PROMISES_NOTHING: f64 = 3.0;
/// An effect that takes less than this share off the held-out error is not worth naming. A twentieth of what a noise statement is usually
/// off by: nobody could see a smaller one by measuring again.
pub const WORTH_NAMING: f64 = 0.005;

/// What held-out readings say of an effect that was added to a model.
///
/// For every condition `k` held out (averaged readings at one pose under one load) both models state a predictive density
/// ([`Foreseen`]); `d_k` is the difference of their logarithms, above zero where the larger model foresees better. Conditions at one
/// pose share what the pose has of its own, so that sums over poses are what counts:
///
/// ```text
/// D_p = sum over the conditions of pose p of d_k,    D = sum D_p,    S^2 = n / (n - 1) sum (D_p - D / n)^2
/// chance          one-sided, Student's t with n - 1 degrees of freedom, of a D like this one when the larger model gains nothing
/// E, s            mean and standard deviation of D if the larger model is right as fitted, its parameters uncertain
/// chance if real  Phi((D - E) / max(s, S)): of a gain as small as this one if the effect is there as fitted
/// ```
///
/// - shown: the chance is at most 5 %;
/// - refuted: `D` is not above zero, and the chance if real is at most 5 %: the gain would have shown, and did not;
/// - open: these readings cannot tell. The evidence `P` of the readings fitted stands where they lean towards the effect; where they
///   lean against it, `P e^D / (1 - P + P e^D)` has to be 99 % still, or 95 % where `E` is below three nats.
///
/// So a useless effect is shown in 5 % at most, and a real one refuted in 5 % at most. A useless one that seems sure in the readings
/// fitted survives as open where these promise little; where it promises nine nats or more, in 5 % at most.
///
/// Source: predictive densities of what was left out, Geisser and Eddy (1979), Journal of the American Statistical Association 74;
/// their paired differences, Vehtari, Gelman and Gabry (2017), Statistics and Computing 27, section 5.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct HeldOutGain {
    /// What it comes to.
    pub outcome: GainOutcome,
    /// `D`, nats.
    pub nats: f64,
    /// `E`, nats.
    pub expected_nats: f64,
    /// Chance of a gain like this one from an effect that gains nothing; absent with fewer than two poses.
    pub chance: Option<f64>,
    /// Chance of a gain as small as this one if the effect is there as fitted.
    pub chance_if_real: f64,
}

/// Whether held-out readings show an effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(rename_all = "kebab-case")]
pub enum GainOutcome {
    /// They are better foreseen with it, by more than chance.
    Shown,
    /// They cannot tell.
    Open,
    /// They would be better foreseen with it if it were there, and are not.
    Refuted,
}

impl HeldOutGain {
    /// Of the larger model over the smaller one; each with the parts of the readings that were held out together.
    pub fn of(before: &[Foreseen], after: &[Foreseen]) -> Self {
        let mut sums = Sums::default();
        for (smaller, larger) in before.iter().zip(after) {
            sums.add(smaller, larger);
        }
        sums.judged()
    }

    /// True when an effect of this probability, which the readings fitted give it, is still sure.
    pub fn leaves_sure(&self, probability: f64) -> bool {
        let odds = probability / (1.0 - probability).max(f64::MIN_POSITIVE) * self.nats.exp();
        match self.outcome {
            GainOutcome::Shown => true,
            GainOutcome::Refuted => false,
            GainOutcome::Open => {
                let least = if self.expected_nats < PROMISES_NOTHING { NAMED } else { BEYOND_DOUBT };
                self.nats >= 0.0 || odds >= least / (1.0 - least)
            }
        }
    }
}

/// Sums over held-out conditions.
#[derive(Default)]
struct Sums {
    /// `D_p`.
    poses: BTreeMap<[u64; 6], f64>,
    expected: f64,
    variance: f64,
}

impl Sums {
    /// Another part of the readings.
    fn add(&mut self, smaller: &Foreseen, larger: &Foreseen) {
        let mut slope = DVector::zeros(larger.residuals.len());
        for (k, pose) in larger.poses.iter().enumerate() {
            let Some(one) = Difference::of(smaller, larger, k) else { continue };
            *self.poses.entry(*pose).or_default() += one.gain;
            self.expected += one.expected;
            self.variance += one.variance;
            slope.fixed_rows_mut::<6>(6 * k).copy_from(&one.slope);
        }
        // What is uncertain of the parameters and inputs acts on all conditions alike.
        self.variance += slope.norm_squared() + larger.spread.squared_along(&slope);
    }

    fn judged(&self) -> HeldOutGain {
        let nats: f64 = self.poses.values().sum();
        let spread = self.spread();
        let chance = spread.map(|s| above(nats / s, self.poses.len() as f64 - 1.0));
        let widest = self.variance.sqrt().max(spread.unwrap_or(0.0));
        let chance_if_real =
            if widest > 0.0 { Normal::standard().cdf((nats - self.expected) / widest) } else { 1.0 };
        let outcome = match chance {
            Some(p) if p <= UNLIKELY => GainOutcome::Shown,
            _ if nats <= 0.0 && chance_if_real <= UNLIKELY => GainOutcome::Refuted,
            _ => GainOutcome::Open,
        };
        HeldOutGain { outcome, nats, expected_nats: self.expected, chance, chance_if_real }
    }

    /// `S`; none with fewer than two poses, or where all of them gain the same.
    fn spread(&self) -> Option<f64> {
        let one = standard_deviation(self.poses.values().copied())?;
        let spread = one * (self.poses.len() as f64).sqrt();
        (spread > 0.0).then_some(spread)
    }
}

/// Chance that Student's t lies above a value.
fn above(t: f64, freedom: f64) -> f64 {
    StudentsT::new(0.0, 1.0, freedom).map_or(1.0, |law| law.sf(t))
}

/// One condition: difference of the logarithms of the predictive densities, and its law if the larger model is right.
///
/// With the residuals `r0`, `r1 = r0 - delta` and the covariances `V0`, `V1` of smaller and larger model:
///
/// ```text
/// d    = (r0' V0^-1 r0 - r1' V1^-1 r1 + ln |V0| - ln |V1|) / 2
/// E d  = (delta' V0^-1 delta - tr (V0^-1 V1 - I) + ln |V0| - ln |V1|) / 2
/// var d = |V1^1/2 slope|^2 + tr (((V0^-1 - V1^-1) V1)^2) / 2,   slope = V0^-1 delta
/// ```
///
/// The trace is what errors of the parameters add to the square of `delta` on average: it takes the place of the square of its truth.
struct Difference {
    gain: f64,
    expected: f64,
    /// The second part of the variance.
    variance: f64,
    slope: Vector6,
}

impl Difference {
    fn of(smaller: &Foreseen, larger: &Foreseen, k: usize) -> Option<Self> {
        let (r0, r1) = (smaller.residual(k), larger.residual(k));
        let v1 = larger.covariance(k);
        let (f0, f1) = (smaller.covariance(k).cholesky()?, v1.cholesky()?);
        let logs = f0.ln_determinant() - f1.ln_determinant();
        let delta = r0 - r1;
        let slope = f0.solve(&delta);
        let ratio = f0.solve(&v1);
        let excess = ratio - Matrix6::identity();
        Some(Self {
            gain: 0.5 * (r0.dot(&f0.solve(&r0)) - r1.dot(&f1.solve(&r1)) + logs),
            expected: 0.5 * (delta.dot(&slope) - excess.trace() + logs),
            variance: 0.5 * (excess * excess).trace(),
            slope,
        })
    }
}

/// Share of the held-out error that an effect takes off: whitened root mean square, noise included.
///
/// ```text
/// share = 1 - sqrt(chi2 after / chi2 before),   expected: chi2 before = chi2 after + sum delta^2 / numbers
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct Worth {
    /// As measured; below zero where the error grows.
    pub share: f64,
    /// As the fitted effect promises for these readings.
    pub expected_share: f64,
}

impl Worth {
    /// Of `numbers` held-out numbers; `chi2`: their reduced chi-squares before and after. `last`: what the last model foresees of them, which
    /// lends its inputs, for without the effect these may take its place.
    pub fn of([before, after, last]: [&[Foreseen]; 3], chi2: [f64; 2], numbers: usize) -> Self {
        let change = |((a, b), last): ((&Foreseen, &Foreseen), &Foreseen)| {
            (a.residuals_at_inputs_of(last) - b.residuals_at_inputs_of(last)).norm_squared()
        };
        let promised: f64 =
            before.iter().zip(after).zip(last).map(change).sum::<f64>() / numbers.max(1) as f64;
        let share = |before: f64| if before > 0.0 { 1.0 - (chi2[1] / before).sqrt() } else { 0.0 };
        Self { share: share(chi2[0]), expected_share: share(chi2[1] + promised) }
    }

    /// True when neither what was measured nor what is promised is worth naming.
    pub fn is_small(&self) -> bool {
        self.share < WORTH_NAMING && self.expected_share < WORTH_NAMING
    }

    /// The same beside effects that were added later, too: a large one that is still missing hides what others do. `chi2`: reduced
    /// chi-squares with this effect and with all of them.
    pub fn is_small_beside_all(&self, chi2: [f64; 2]) -> bool {
        let promised = chi2[0] * ((1.0 - self.expected_share).powi(-2) - 1.0);
        let all = chi2[1].max(f64::MIN_POSITIVE);
        self.is_small() && 1.0 - (all / (all + promised)).sqrt() < WORTH_NAMING
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_effect_is_worth_naming_from_half_a_percent_on_measured_or_promised() {
        let is_small = |share, expected_share| Worth { share, expected_share }.is_small();
        assert!(is_small(0.0049, 0.0049) && is_small(-0.1, 0.0));
        assert!(!is_small(0.0051, 0.0) && !is_small(0.0, 0.0051));
    }

    #[test]
    fn an_effect_hidden_by_another_that_is_still_missing_is_not_small() {
        let worth = Worth { share: 0.001, expected_share: 0.001 };
        assert!(worth.is_small_beside_all([100.0, 100.0]) && worth.is_small_beside_all([100.0, 25.0]));
        assert!(!worth.is_small_beside_all([100.0, 1.0]));
    }

    fn judged(gains: [f64; 2], expected: f64, variance: f64) -> HeldOutGain {
        let poses = [1, 2].map(|pose| [pose; 6]).into_iter().zip(gains).collect();
        Sums { poses, expected, variance }.judged()
    }

    #[test]
    fn held_out_readings_show_or_refute_at_a_chance_of_five_percent() {
        use GainOutcome::{Open, Refuted, Shown};
        // Two poses leave one degree of freedom: the law of Cauchy of the sum over the difference.
        let chance = judged([1.0, 3.0], 0.0, 0.0).chance.unwrap();
        assert!((chance - (0.5 - 2.0_f64.atan() / std::f64::consts::PI)).abs() < 1e-9, "{chance}");
        for (gains, expected, variance, outcome) in [
            ([3.0, 4.0], 0.0, 0.0, Shown),
            ([2.0, 3.0], 0.0, 0.0, Open),
            ([-0.2, -0.3], 5.0, 9.0, Refuted),
            ([-0.2, -0.3], 5.0, 12.25, Open),
        ] {
            assert_eq!(judged(gains, expected, variance).outcome, outcome, "{gains:?} {variance}");
        }
    }

    #[test]
    fn readings_that_lean_against_an_effect_leave_it_sure_from_ninety_nine_percent_on() {
        let open = HeldOutGain { nats: -1.0, ..judged([2.0, 3.0], 5.0, 0.0) };
        assert!(open.leaves_sure(0.9975) && !open.leaves_sure(0.995));
        assert!(HeldOutGain { nats: 0.0, ..open }.leaves_sure(0.95));
        let promising_nothing = HeldOutGain { expected_nats: 1.0, ..open };
        assert!(promising_nothing.leaves_sure(0.985) && !promising_nothing.leaves_sure(0.98));
        assert!(!HeldOutGain { outcome: GainOutcome::Refuted, ..open }.leaves_sure(1.0));
    }
}
