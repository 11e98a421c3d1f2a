//! How good a plan can be at most: the best approximate plan, whose readings may be fractions.
//!
//! A criterion brought to degree one, `phi(c M) = c phi(M)`, and concave lies below its tangent: with `G` its gradient at the
//! information `M` of *any* plan,
//!
//! ```text
//! phi(M*) <= trace(G M*) <= budget max_k trace(G I_k) / cost_k
//! ```
//!
//! for every plan `M*` out of the candidates `I_k`. For D this is the variance function of Kiefer and Wolfowitz 1960; at the best
//! approximate plan both sides are equal. With inputs that are known to a tolerance only `phi` is still concave but grows more than in
//! proportion; `phi(M) - trace(G M)` then comes on top, and for a share of the budget
//!
//! ```text
//! phi <= phi(M) - trace(G M) + share max_k trace(G I_k) / cost_k
//! ```
//!
//! The best approximate plan is approached by moving weight from the worst member to the best candidate (vertex
//! exchange, Böhning 1986). The smallest eigenvalue (E, O3) has no gradient where several meet, as they do at the best plan; there
//! `G` may be any matrix of trace one, and that of a smooth minimum is taken. Changes of pose count no time here, so that the bound holds for all plans.

use nalgebra::{DMatrix, DVector};

use super::Candidates;
use crate::{Criterion, Objective};

/// Moves of weight.
const MOST_MOVES: usize = 3000;
/// Relative gap at which the bound is as good as reached.
const REACHED: f64 = 1e-4;
/// Moves without a better bound after which none is expected, and the relative gain that counts.
const PATIENCE: usize = 100;
const WORTHWHILE: f64 = 1e-5;
/// Sharpness of the smooth minimum: it lies below the smallest eigenvalue of the plan by `ln p` over this, relatively.
const SHARPNESS: f64 = 300.0;
/// Steps of the search along a move.
const STEPS: usize = 30;

/// Power that brings a criterion to degree one, where it is concave; none for ratios of eigenvalues, which are not.
pub fn degree_one(criterion: &Objective) -> Option<f64> {
    match criterion.criterion() {
        Criterion::D | Criterion::A | Criterion::E | Criterion::I(_) => Some(1.0),
        Criterion::O1 | Criterion::O3 | Criterion::O5 => Some(2.0),
        Criterion::O2 | Criterion::O4 => None,
    }
}

/// Least efficiency of a plan: the share of the budget with which the best approximate plan might reach the same value of the
/// criterion. None where no bound is known.
pub fn efficiency(candidates: &Candidates, criterion: &Objective, members: &[usize]) -> Option<f64> {
    let power = degree_one(criterion)?;
    let value = criterion.value(&candidates.sum(members), 1).powf(power);
    Some(least_share(candidates, criterion, power, members, value).min(1.0))
}

/// Plane that lies above the criterion, whatever the plan.
struct Tangent {
    /// Criterion of the plan at which it touches.
    value: f64,
    /// Its height for no information at all.
    offset: f64,
    /// How much it rises when the whole budget goes to each candidate.
    slopes: Vec<f64>,
}

/// Weights of an approximate plan with its information.
struct Approximate<'a> {
    candidates: &'a Candidates,
    criterion: &'a Objective,
    power: f64,
    /// Sharpness of the smooth minimum of the eigenvalues; none when the criterion has a gradient.
    sharpness: Option<f64>,
    weights: Vec<f64>,
    information: DMatrix<f64>,
}

/// Share of the budget without which no plan reaches a value.
fn least_share(
    candidates: &Candidates,
    criterion: &Objective,
    power: f64,
    members: &[usize],
    wanted: f64,
) -> f64 {
    let mut plan = Approximate::of(candidates, criterion, power, members);
    let (mut share, mut bound, mut vain) = (0.0_f64, f64::INFINITY, 0);
    for _ in 0..MOST_MOVES {
        let Tangent { value, offset, slopes } = plan.tangent();
        let best = (0..slopes.len()).reduce(|a, b| if slopes[b] > slopes[a] { b } else { a });
        let Some(best) = best else { break };
        let highest = offset + slopes[best];
        share = share.max((wanted - offset) / slopes[best]);
        vain = if highest < bound * (1.0 - WORTHWHILE) { 0 } else { vain + 1 };
        bound = bound.min(highest);
        if vain > PATIENCE {
            break;
        }
        let worst = (0..slopes.len())
            .filter(|&k| plan.weights[k] > 0.0)
            .reduce(|a, b| if slopes[b] < slopes[a] { b } else { a });
        let Some(worst) = worst.filter(|_| bound > value * (1.0 + REACHED)) else { break };
        if !plan.shift(worst, best) {
            break;
        }
    }
    share
}

impl<'a> Approximate<'a> {
    /// The weights of an exact plan, scaled to spend the whole budget.
    fn of(candidates: &'a Candidates, criterion: &'a Objective, power: f64, members: &[usize]) -> Self {
        let mut weights = vec![0.0; candidates.information.len()];
        for &k in members {
            weights[k] += candidates.cost(k);
        }
        let spent: f64 = weights.iter().sum();
        for weight in &mut weights {
            *weight /= spent;
        }
        let n = candidates.width();
        let information = DMatrix::zeros(n, n);
        let mut plan = Self { candidates, criterion, power, sharpness: None, weights, information };
        for (k, &weight) in plan.weights.iter().enumerate().filter(|(_, w)| **w > 0.0) {
            plan.information += plan.whole(k) * weight;
        }
        if matches!(criterion.criterion(), Criterion::E | Criterion::O3) {
            let least = criterion.of_parameters(&plan.information).symmetric_eigenvalues().min();
            plan.sharpness = Some(SHARPNESS / least);
        }
        plan
    }

    /// Information when the whole budget goes to one candidate.
    fn whole(&self, k: usize) -> DMatrix<f64> {
        &self.candidates.information[k] * self.readings(k)
    }

    /// Readings of one candidate that the budget pays.
    fn readings(&self, k: usize) -> f64 {
        self.candidates.budget / self.candidates.cost(k)
    }

    fn value(&self, information: &DMatrix<f64>) -> f64 {
        match self.sharpness {
            Some(sharpness) => {
                let eigenvalues = self.criterion.of_parameters(information).symmetric_eigenvalues();
                smooth_minimum(&eigenvalues, sharpness).0
            }
            None => self.criterion.value(information, 1).powf(self.power),
        }
    }

    /// Value and gradient.
    fn gradient(&self) -> (f64, DMatrix<f64>) {
        if let Some(sharpness) = self.sharpness {
            let eigen = self.criterion.of_parameters(&self.information).symmetric_eigen();
            let (value, shares) = smooth_minimum(&eigen.eigenvalues, sharpness);
            let v = &eigen.eigenvectors;
            let slope = v * DMatrix::from_diagonal(&shares) * v.transpose();
            return (value, self.criterion.of_whole(&self.information, &slope));
        }
        let (value, slope) = self.criterion.gradient(&self.information, 1);
        (value.powf(self.power), slope * (self.power * value.powf(self.power - 1.0)))
    }

    /// The plane that touches the criterion at this plan.
    fn tangent(&self) -> Tangent {
        let (value, slope) = self.gradient();
        let towards = |(k, m): (usize, &DMatrix<f64>)| slope.dot(m) * self.readings(k);
        let slopes = self.candidates.information.iter().enumerate().map(towards).collect();
        // The gradient by the parameters alone is a part of it; of degree one, its product with their information is the height.
        let n = self.criterion.parameters(&self.information);
        let own = slope.view((0, 0), (n, n)).into_owned();
        let height = own.dot(&self.criterion.of_parameters(&self.information));
        let offset = if n == slope.nrows() { 0.0 } else { height - slope.dot(&self.information) };
        Tangent { value, offset, slopes }
    }

    /// Moves as much weight as is best; false when none helps.
    fn shift(&mut self, from: usize, to: usize) -> bool {
        let direction = self.whole(to) - self.whole(from);
        let along = |step: f64| self.value(&(&self.information + &direction * step));
        let step = highest(along, self.weights[from]);
        if step <= 0.0 {
            return false;
        }
        self.weights[from] -= step;
        self.weights[to] += step;
        self.information += direction * step;
        true
    }
}

/// `-ln(sum exp(-s l)) / s` of numbers `l`, and its derivatives, which sum to one.
fn smooth_minimum(l: &DVector<f64>, sharpness: f64) -> (f64, DVector<f64>) {
    let least = l.min();
    let weights = l.map(|x| (sharpness * (least - x)).exp());
    let total = weights.sum();
    (least - total.ln() / sharpness, weights / total)
}

/// Where a concave function is highest on `[0, most]`, by golden section.
fn highest(f: impl Fn(f64) -> f64, most: f64) -> f64 {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut low, mut high) = (0.0, most);
    for _ in 0..STEPS {
        let (left, right) = (high - golden * (high - low), low + golden * (high - low));
        if f(left) < f(right) { low = left } else { high = right }
    }
    let inside = f64::midpoint(low, high);
    let tried = [most, inside].into_iter().map(|x| (x, f(x)));
    tried.fold((0.0, f(0.0)), |a, b| if b.1 > a.1 { b } else { a }).0
}
