//! Where the fit of one more term starts: at the shapes that explain most of what the fit without it leaves.
//!
//! Of many readings, some tell which start leads to the best fit and most of the way there; all of them are fitted from there only.

use std::cell::OnceCell;
use std::sync::Arc;

use hexbench_core::spread;
use nalgebra::{DMatrix, DVector};

use crate::effects::term::Term;
use crate::error::ModelError;
use crate::estimation::basis::{orthonormal, project, take_off};
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::{Fit, TermSpec, columns, fit};
use crate::estimation::linearization::{Active, Linearization, ModelPoint};
use crate::estimation::parallel::map_through;

/// Shapes from which a fit is started.
const STARTS: usize = 3;
/// Conditions beyond which some of them are tried first, and how many then.
const MANY_CONDITIONS: usize = 1500;
const TRIED_CONDITIONS: usize = 500;
/// Chi-square per degree of freedom within which of the best fit to some readings another may be the best to all: where two fits are
/// equally good to all, the difference is within this with three standard deviations.
const CLOSE: f64 = 10.0;
/// Share of the promised drop of chi-square that a fit has to reach when its start was chosen by some of the readings.
const KEPT_PROMISE: f64 = 0.9;

/// Where a fit may start: a shape, and the drop of chi-square that the term promises there.
#[derive(Clone, Copy)]
pub(super) struct PromisingShape {
    shape: f64,
    gain: f64,
}

impl PromisingShape {
    /// Of a term without shapes: nothing is promised by the only start.
    const ONLY: Self = Self { shape: 1.0, gain: 0.0 };
}

/// The fit with one more term at its place among the others, from the best of some shapes.
pub(super) fn best_start(
    campaign: &Campaign,
    others: &[TermSpec],
    (place, next): (usize, &TermSpec),
    shapes: &[PromisingShape],
    fitted: &Fit,
) -> Result<(Vec<TermSpec>, Fit), ModelError> {
    let from = |one: &PromisingShape| {
        let mut all = others.to_vec();
        all.insert(place, TermSpec { shape: one.shape, ..next.clone() });
        (all, fitted.point.clone())
    };
    let starts: Vec<StartingPoint> = shapes.iter().map(from).collect();
    if campaign.groups.len() > MANY_CONDITIONS {
        let promised = shapes.iter().map(|one| one.gain).fold(0.0, f64::max);
        let best = best_fit(campaign, &promising(campaign, &starts));
        if let Ok(best) = best
            && fitted.chi2 - best.1.chi2 >= KEPT_PROMISE * promised
        {
            return Ok(best);
        }
    }
    best_fit(campaign, &starts)
}

/// What is fitted, and where the fit starts.
type StartingPoint = (Vec<TermSpec>, ModelPoint);

/// Starts that may lead to the best fit, carried to where the fits to some of the readings end.
fn promising(campaign: &Campaign, starts: &[StartingPoint]) -> Vec<StartingPoint> {
    let groups: Vec<usize> = spread(campaign.groups.len(), TRIED_CONDITIONS).collect();
    let (fits, _) = fits(&campaign.part(&groups), starts);
    let best = fits.iter().map(|(_, fit)| fit).min_by(|a, b| a.chi2.total_cmp(&b.chi2));
    let limit = best.map_or(f64::INFINITY, |best| best.chi2 + CLOSE * best.chi2_reduced().max(1.0));
    let is_close = |(_, fit): &(Vec<TermSpec>, Fit)| fit.chi2 <= limit;
    fits.into_iter().filter(is_close).map(|(wanted, fit)| (wanted, fit.point)).collect()
}

/// The best of the fits from some starts.
fn best_fit(campaign: &Campaign, starts: &[StartingPoint]) -> Result<(Vec<TermSpec>, Fit), ModelError> {
    let (fits, failure) = fits(campaign, starts);
    let best = fits.into_iter().min_by(|(_, a), (_, b)| a.chi2.total_cmp(&b.chi2));
    best.ok_or_else(|| failure.unwrap_or(ModelError::NotFinite { what: "the shapes of the term" }))
}

/// The fits from some starts, with the shapes that they ended at, and why the last of those that failed did.
fn fits(campaign: &Campaign, starts: &[StartingPoint]) -> (Vec<(Vec<TermSpec>, Fit)>, Option<ModelError>) {
    let (mut all, mut failure) = (Vec::with_capacity(starts.len()), None);
    for (wanted, point) in starts {
        match fit(campaign, wanted, Some(point)) {
            Ok(fit) => {
                let ended = |(one, at): (&TermSpec, &Active)| TermSpec { shape: at.shape, ..one.clone() };
                all.push((wanted.iter().zip(&fit.point.active).map(ended).collect(), fit));
            }
            Err(why) => failure = Some(why),
        }
    }
    (all, failure)
}

/// What a fit leaves, and the columns it has taken it out with.
pub(super) struct Unexplained<'a> {
    pub(super) fitted: &'a Fit,
    lin: &'a Linearization,
    left: OnceCell<(DMatrix<f64>, DVector<f64>)>,
}

impl<'a> Unexplained<'a> {
    /// `lin`: where the fit ended.
    pub(super) fn by(fitted: &'a Fit, lin: &'a Linearization) -> Self {
        Self { fitted, lin, left: OnceCell::new() }
    }

    /// Shapes from which the fit with a term starts.
    pub(super) fn starts(&self, next: &TermSpec) -> Vec<PromisingShape> {
        if next.term.info().shape.is_some() {
            return self.scan(next).starts();
        }
        vec![PromisingShape::ONLY]
    }

    /// What a term explains in each of its shapes; without shapes, in its only one.
    pub(super) fn scan(&self, next: &TermSpec) -> Scan {
        let has_shape = next.term.info().shape.is_some();
        let grid = if has_shape { next.term.shape_grid(&self.lin.conditions) } else { vec![1.0] };
        let (lin, left) = (self.lin, self.left());
        let gains = map_through(&grid, lin.conditions.len(), |&shape| gain(lin, left, next, shape));
        Scan { term: Arc::clone(&next.term), grid, gains }
    }

    /// A basis of the columns of the fit, and what it leaves.
    fn left(&self) -> &(DMatrix<f64>, DVector<f64>) {
        self.left.get_or_init(|| {
            let basis = orthonormal(columns(self.lin, &self.fitted.point));
            let mut residual = self.lin.residuals();
            project(&basis, &mut residual);
            (basis, residual)
        })
    }
}

/// Drop of chi-square by a term in one of its shapes, beside a basis of what is fitted, off what that leaves.
fn gain(
    lin: &Linearization,
    (basis, residual): &(DMatrix<f64>, DVector<f64>),
    next: &TermSpec,
    shape: f64,
) -> f64 {
    let mut block = lin.term_block(next.term.as_ref(), next.rich, shape);
    take_off(basis, &mut block);
    orthonormal(block).tr_mul(residual).norm_squared()
}

/// Shapes of a term, and the drop of chi-square by each.
pub(super) struct Scan {
    term: Arc<dyn Term>,
    grid: Vec<f64>,
    gains: Vec<f64>,
}

impl Scan {
    /// The largest drop; none at all where the term has no shape for these conditions.
    pub(super) fn gain(&self) -> f64 {
        self.gains.iter().copied().fold(f64::NEG_INFINITY, f64::max)
    }

    /// The most promising shapes.
    pub(super) fn starts(&self) -> Vec<PromisingShape> {
        if self.grid.is_empty() {
            return vec![PromisingShape::ONLY];
        }
        // No fit crosses from one stretch of shapes to another.
        let is_within_reach = |from: usize, to: usize| {
            let [low, high] = self.term.shape_bounds(self.grid[from]);
            (low..=high).contains(&self.grid[to])
        };
        let mut peaks = peaks(&self.gains, is_within_reach);
        peaks.sort_by(|&a, &b| self.gains[b].total_cmp(&self.gains[a]));
        let start = |k: usize| PromisingShape { shape: self.grid[k], gain: self.gains[k] };
        peaks.into_iter().take(STARTS).map(start).collect()
    }
}

/// Places of the values that no neighbor exceeds: two starts on the same slope would climb the same peak.
fn peaks(values: &[f64], are_neighbors: impl Fn(usize, usize) -> bool) -> Vec<usize> {
    let beside = |k: usize, other: Option<usize>| {
        let other = other.filter(|&other| other < values.len() && are_neighbors(k, other));
        other.map_or(f64::NEG_INFINITY, |other| values[other])
    };
    let is_peak = |&k: &usize| {
        values[k].is_finite()
            && values[k] >= beside(k, k.checked_sub(1))
            && values[k] > beside(k, Some(k + 1))
    };
    (0..values.len()).filter(is_peak).collect()
}

#[cfg(test)]
mod tests {
    use super::peaks;

    #[test]
    fn a_slope_has_one_peak_and_a_plateau_its_last_place() {
        let all = |values: &[f64]| peaks(values, |_, _| true);
        assert_eq!(all(&[1.0, 2.0, 3.0]), [2]);
        assert_eq!(all(&[3.0, 1.0, 2.0, 2.0, 1.0]), [0, 3]);
        assert_eq!(all(&[f64::NAN, 1.0, f64::INFINITY]), Vec::<usize>::new());
        assert_eq!(all(&[]), Vec::<usize>::new());
    }

    #[test]
    fn a_wall_in_a_slope_leaves_a_peak_on_either_side() {
        let is_same_side = |a: usize, b: usize| (a < 2) == (b < 2);
        assert_eq!(peaks(&[1.0, 2.0, 3.0, 4.0], is_same_side), [1, 3]);
    }
}
