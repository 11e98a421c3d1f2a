//! Proper scores of the stated probabilities.
//!
//! A forecast spreads its probability over the effects of the catalogue, `outside` and `none`; exactly one of them is the case where at
//! most one effect is hidden, and only there a forecast is scored. With `p` the stated and `o` the true distribution:
//!
//! ```text
//! log   = -ln p(true)             0 is perfect; ln(K) says nothing about K alternatives
//! Brier = sum over k (p_k - o_k)^2     0 is perfect, 2 is certain of something false
//! ```
//!
//! Both are strictly proper: in expectation nobody does better than by stating what he believes (Gneiting and Raftery 2007,
//! Journal of the American Statistical Association 102).

use hexbench_model::inference::explanation::Explanation;
use hexbench_truth::mechanisms::is_outside;
use serde::Serialize;

use crate::challenge::answer::StatedCandidate;

/// Least probability that is taken at its word in the logarithmic score: one rash zero shall not outweigh all else.
pub(super) const FLOOR: f64 = 1e-6;

/// Scores of one stated distribution.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Forecast {
    /// Probability stated for what was the case.
    pub stated: f64,
    /// Logarithmic score, nats.
    pub log: f64,
    /// Brier score.
    pub brier: f64,
}

impl Forecast {
    /// Scores a distribution, which sums to 1, against what is hidden; none without a distribution, or when two things are hidden.
    pub(super) fn of(hidden: &[String], candidates: &[StatedCandidate]) -> Option<Self> {
        if candidates.is_empty() {
            return None;
        }
        let truth = match hidden {
            [] => Explanation::Nothing,
            [only] if is_outside(only) => Explanation::Outside,
            [only] => only.as_str().into(),
            _ => return None,
        };
        let stated = candidates.iter().find(|c| c.term == truth).map_or(0.0, |c| c.probability);
        let others: f64 = candidates.iter().filter(|c| c.term != truth).map(|c| c.probability.powi(2)).sum();
        Some(Self { stated, log: -stated.max(FLOOR).ln(), brier: (1.0 - stated).powi(2) + others })
    }
}

#[cfg(test)]
mod tests {
    use hexbench_core::streams::{Purpose, stream};
    use rand::RngExt;

    use super::*;

    fn stated(probabilities: [f64; 3]) -> Vec<StatedCandidate> {
        let named =
            ["creep".into(), Explanation::Outside, Explanation::Nothing].into_iter().zip(probabilities);
        named.map(|(term, probability)| StatedCandidate { term, probability }).collect()
    }

    fn hidden(k: usize) -> Vec<String> {
        [vec!["creep".to_owned()], vec!["out:cable".to_owned()], Vec::new()][k].clone()
    }

    /// Mean scores of a forecast over many simulated truths.
    fn mean(forecast: [f64; 3], truths: &[usize]) -> [f64; 2] {
        let scores = truths.iter().map(|&k| Forecast::of(&hidden(k), &stated(forecast)).unwrap());
        let sum = scores.fold([0.0, 0.0], |s, f| [s[0] + f.log, s[1] + f.brier]);
        sum.map(|s| s / truths.len() as f64)
    }

    #[test]
    fn in_the_long_run_nobody_does_better_than_by_stating_the_true_chances() {
        const TRUE: [f64; 3] = [0.6, 0.1, 0.3];
        const SCATTER: f64 = 0.02;
        let mut rng = stream(7, Purpose::Test, []);
        let mut draw = || {
            let x: f64 = rng.random();
            usize::from(x > TRUE[0]) + usize::from(x > TRUE[0] + TRUE[1])
        };
        let truths: Vec<usize> = (0..40_000).map(|_| draw()).collect();
        let best = mean(TRUE, &truths);
        for rival in
            [[0.7, 0.1, 0.2], [0.5, 0.15, 0.35], [0.9, 0.05, 0.05], [0.34, 0.33, 0.33], [0.6, 0.3, 0.1]]
        {
            let other = mean(rival, &truths);
            assert!(best[0] < other[0] && best[1] < other[1], "{rival:?}: {other:?}, the truth {best:?}");
        }
        // -sum p ln p and 1 - sum p^2, within the scatter of so many draws.
        let entropy: f64 = -TRUE.iter().map(|p| p * p.ln()).sum::<f64>();
        let gini = 1.0 - TRUE.iter().map(|p| p * p).sum::<f64>();
        assert!((best[0] - entropy).abs() < SCATTER && (best[1] - gini).abs() < SCATTER, "{best:?}");
    }

    #[test]
    fn certainty_is_best_when_true_and_worst_when_false() {
        let right = Forecast::of(&hidden(0), &stated([1.0, 0.0, 0.0])).unwrap();
        assert_eq!((right.log.abs(), right.brier), (0.0, 0.0));
        let wrong = Forecast::of(&hidden(2), &stated([1.0, 0.0, 0.0])).unwrap();
        assert!((wrong.log + FLOOR.ln()).abs() < 1e-12 && (wrong.brier - 2.0).abs() < 1e-12, "{wrong:?}");
    }

    #[test]
    fn two_hidden_effects_are_no_single_alternative() {
        let two = ["creep".to_owned(), "load-tilt".to_owned()];
        assert_eq!(Forecast::of(&two, &stated([0.5, 0.2, 0.3])), None);
        assert_eq!(Forecast::of(&hidden(0), &[]), None);
    }
}
