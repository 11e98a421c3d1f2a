//! Where the fit of one more term starts: at the shapes that explain most of what the fit without it leaves.

use std::cell::OnceCell;
use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use crate::effects::term::Term;
use crate::error::ModelError;
use crate::estimation::basis::{orthonormal, project};
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::{Fit, TermSpec, columns, fit};
use crate::estimation::linearization::Linearization;

/// Shapes from which a fit is started.
const STARTS: usize = 3;

/// The fit with one more term at its place among the others, from the best of some shapes.
pub(super) fn best_start(
    campaign: &Campaign,
    others: &[TermSpec],
    (place, next): (usize, &TermSpec),
    starts: &[f64],
    fitted: &Fit,
) -> Result<(Vec<TermSpec>, Fit), ModelError> {
    let mut best: Option<(Vec<TermSpec>, Fit)> = None;
    let mut failure = None;
    for &shape in starts {
        let mut all = others.to_vec();
        all.insert(place, TermSpec { shape, ..next.clone() });
        match fit(campaign, &all, Some(&fitted.point)) {
            Ok(f) if best.as_ref().is_none_or(|(_, b)| f.chi2 < b.chi2) => best = Some((all, f)),
            Ok(_) => {}
            Err(e) => failure = Some(e),
        }
    }
    best.ok_or_else(|| failure.unwrap_or(ModelError::NotFinite { what: "the shapes of the term" }))
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
    pub(super) fn starts(&self, next: &TermSpec) -> Vec<f64> {
        if next.term.info().shape.is_none() { vec![1.0] } else { self.scan(next).starts() }
    }

    /// What a term explains in each of its shapes; without shapes, in its only one.
    pub(super) fn scan(&self, next: &TermSpec) -> Scan {
        let has_shape = next.term.info().shape.is_some();
        let grid = if has_shape { next.term.shape_grid(&self.lin.conditions) } else { vec![1.0] };
        let gains = grid.iter().map(|&shape| self.gain(next, shape)).collect();
        Scan { term: Arc::clone(&next.term), grid, gains }
    }

    /// Drop of chi-square by a term in one of its shapes.
    fn gain(&self, next: &TermSpec, shape: f64) -> f64 {
        let (basis, residual) = self.left.get_or_init(|| {
            let basis = orthonormal(&columns(self.lin, &self.fitted.point));
            let mut residual = self.lin.residuals();
            project(&basis, &mut residual);
            (basis, residual)
        });
        let mut block = self.lin.term_block(next.term.as_ref(), next.rich, shape);
        let overlap = basis.tr_mul(&block);
        block.gemm(-1.0, basis, &overlap, 1.0);
        orthonormal(&block).tr_mul(residual).norm_squared()
    }
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
    pub(super) fn starts(&self) -> Vec<f64> {
        if self.grid.is_empty() {
            return vec![1.0];
        }
        // No fit crosses from one stretch of shapes to another.
        let is_within_reach = |from: usize, to: usize| {
            let [low, high] = self.term.shape_bounds(self.grid[from]);
            (low..=high).contains(&self.grid[to])
        };
        let mut peaks = peaks(&self.gains, is_within_reach);
        peaks.sort_by(|&a, &b| self.gains[b].total_cmp(&self.gains[a]));
        peaks.into_iter().take(STARTS).map(|k| self.grid[k]).collect()
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
