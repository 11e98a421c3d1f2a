//! What is asked of the residual elongations.

use hexbench_core::Vector6;
use hexbench_core::statistics::{mean, root_mean_square};

use crate::results::compare::JudgedModel;
use crate::results::compare::follows::{Follows, VARIABLES};

/// Different values a variable must take before anything can be said to follow it.
const FEWEST_VALUES: usize = 6;

/// Values of all variables under one condition, one for each leg.
pub(super) type Values = [Vector6; VARIABLES.len()];

/// One leg, or all, and what its length or its compliance may follow.
pub(super) struct Question {
    pub(super) leg: Option<usize>,
    pub(super) compliance: bool,
    /// Which of the variables.
    number: usize,
    centre: f64,
    spread: f64,
}

impl Question {
    /// What is followed.
    pub(super) fn variable(&self) -> Follows {
        VARIABLES[self.number]
    }

    /// Highest power of the variable: two values of the approach make no parabola.
    pub(super) fn powers(&self) -> usize {
        if self.variable() == Follows::Approach { 1 } else { 2 }
    }

    /// The variable about its mean, in units of its spread.
    pub(super) fn scaled(&self, values: &Values) -> Vector6 {
        values[self.number].map(|v| (v - self.centre) / self.spread)
    }
}

/// Values under every condition.
pub(super) fn values(judged: &JudgedModel<'_>) -> Vec<Values> {
    judged.lin.conditions.iter().map(Follows::values).collect()
}

/// Everything that can be asked of these readings.
pub(super) fn questions(judged: &JudgedModel<'_>, values: &[Values]) -> Vec<Question> {
    let determined = judged.space.determined();
    let mut all = Vec::new();
    for leg in std::iter::once(None).chain((0..6).map(Some)) {
        for (number, variable) in VARIABLES.into_iter().enumerate() {
            let legs = leg.map_or(0..6, |only| only..only + 1);
            let of = |&i: &usize| legs.clone().map(move |l| values[i][number][l]);
            let x: Vec<f64> = determined.iter().flat_map(of).collect();
            if !has_values(&x) && variable != Follows::Approach {
                continue;
            }
            let Some((centre, spread)) = centre_and_spread(&x) else { continue };
            for compliance in [false, true] {
                // Elongation per force change against force change is the same question as elongation against its square.
                if !(compliance && variable == Follows::ForceChange) {
                    all.push(Question { leg, compliance, number, centre, spread });
                }
            }
        }
    }
    all
}

/// True when there are different values enough.
fn has_values(x: &[f64]) -> bool {
    let mut seen: Vec<u64> = Vec::with_capacity(FEWEST_VALUES);
    for bits in x.iter().map(|v| (v + 0.0).to_bits()) {
        if !seen.contains(&bits) {
            seen.push(bits);
        }
        if seen.len() == FEWEST_VALUES {
            return true;
        }
    }
    false
}

/// Mean and root mean square deviation; `None` when the values do not vary.
fn centre_and_spread(x: &[f64]) -> Option<(f64, f64)> {
    let mean = mean(x.iter().copied())?;
    let spread = root_mean_square(x.iter().map(|v| v - mean))?;
    let varies = spread > 1e-9 * x.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    varies.then_some((mean, spread))
}
