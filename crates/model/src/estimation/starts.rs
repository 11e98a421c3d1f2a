//! Where the fit of one more term starts: at the shapes that explain most of what the fit without it leaves.
//!
//! Of many readings, some tell which start leads to the best fit and most of the way there; all of them are fitted from there only.

use std::ops::Range;
use std::sync::{Arc, OnceLock};

use hexbench_core::spread;
use nalgebra::{DMatrix, DVector};

use crate::effects::term::Term;
use crate::error::ModelError;
use crate::estimation::basis::{orthonormal, project, take_off};
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::{Fit, TermSpec, columns, fit_beside};
use crate::estimation::foresight;
use crate::estimation::linearization::{
    Active, Linearization, ModelPoint, beside, parameter_count, parts_of,
};
use crate::estimation::parallel::{map_through, products, sum_in_order};
use crate::estimation::whitening::Inexact;

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
/// Share of the square of a column that is left beside others, above which products of columns tell it to a millionth.
const TOLD_BY_PRODUCTS: f64 = 1e-9;

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

/// Some of the readings of a campaign, by which starts are tried; none of few.
pub(super) fn some_of(campaign: &Campaign) -> Option<Campaign> {
    (campaign.groups.len() > MANY_CONDITIONS).then(|| {
        let groups: Vec<usize> = spread(campaign.groups.len(), TRIED_CONDITIONS).collect();
        campaign.part(&groups)
    })
}

/// Readings to fit one more term to, and some of them where they are many.
#[derive(Clone, Copy)]
pub(super) struct ManyReadings<'a> {
    pub(super) all: &'a Campaign,
    pub(super) some: Option<&'a Campaign>,
}

/// Starts of the fit with one more term at its place among the others.
pub(super) struct Starts<'a> {
    readings: ManyReadings<'a>,
    all: Vec<StartingPoint>,
    promised: f64,
    carried: Option<Carried>,
}

/// What is fitted, and where the fit starts.
type StartingPoint = (Vec<TermSpec>, ModelPoint);

/// Starts that may lead to the best fit, carried to where the fits to some of the readings end.
struct Carried {
    starts: Vec<StartingPoint>,
    /// Chi-square of the best of these fits, and within what of it another may be the best to all readings.
    least: f64,
    close: f64,
}

impl<'a> Starts<'a> {
    /// At some shapes; those of many readings have been tried by some.
    pub(super) fn at(
        readings: ManyReadings<'a>,
        others: &[TermSpec],
        (place, next): (usize, &TermSpec),
        shapes: &[PromisingShape],
        fitted: &Fit,
    ) -> Self {
        let from = |one: &PromisingShape| {
            let mut all = others.to_vec();
            all.insert(place, TermSpec { shape: one.shape, ..next.clone() });
            (all, fitted.point.clone())
        };
        let all: Vec<StartingPoint> = shapes.iter().map(from).collect();
        let promised = shapes.iter().map(|one| one.gain).fold(0.0, f64::max);
        // The only start is where the others end, nearer to the best fit than what some of the readings make of it.
        let some = readings.some.filter(|_| all.len() > 1);
        let carried = some.and_then(|some| Carried::through(some, &all));
        Self { readings, all, promised, carried }
    }

    /// True where the fit to all readings may cost less than another, both with their prices, as some of the readings tell: that is a share
    /// of the difference, and chance.
    pub(super) fn may_beat(&self, price: f64, (other, its_price): (&Self, f64)) -> bool {
        let (Some(own), Some(others)) = (&self.carried, &other.carried) else { return true };
        let count = |campaign: &Campaign| campaign.groups.len() as f64;
        let share = self.readings.some.map_or(1.0, |some| count(some) / count(self.readings.all));
        own.least + share * price <= others.least + share * its_price + others.close
    }

    /// The best fit to all readings; `fitted`: without the term.
    pub(super) fn best(&self, fitted: &Fit) -> Result<(Vec<TermSpec>, Fit), ModelError> {
        if let Some(carried) = &self.carried
            && let Ok(best) = best_fit(self.readings.all, &carried.starts)
            && fitted.chi2 - best.1.chi2 >= KEPT_PROMISE * self.promised
        {
            return Ok(best);
        }
        best_fit(self.readings.all, &self.all)
    }
}

impl Carried {
    /// None where no start leads anywhere.
    fn through(some: &Campaign, starts: &[StartingPoint]) -> Option<Self> {
        // What is close here may be the best to all readings: none is given up.
        let fits: Vec<_> =
            starts.iter().filter_map(|start| fitted_from(some, start, f64::INFINITY).ok()).collect();
        let best = fits.iter().map(|(_, fit)| fit).min_by(|a, b| a.chi2.total_cmp(&b.chi2))?;
        let (least, close) = (best.chi2, CLOSE * best.chi2_reduced().max(1.0));
        let is_close = |(_, fit): &(Vec<TermSpec>, Fit)| fit.chi2 <= least + close;
        let starts = fits.into_iter().filter(is_close).map(|(wanted, fit)| (wanted, fit.point)).collect();
        Some(Self { starts, least, close })
    }
}

/// The best of the fits from some starts, the first of equal ones.
fn best_fit(campaign: &Campaign, starts: &[StartingPoint]) -> Result<(Vec<TermSpec>, Fit), ModelError> {
    let (mut best, mut failure): (Option<(Vec<TermSpec>, Fit)>, _) = (None, None);
    for start in starts {
        let least = best.as_ref().map_or(f64::INFINITY, |(_, fit)| fit.chi2);
        match fitted_from(campaign, start, least) {
            Ok(next) if best.is_none() || next.1.chi2 < least => best = Some(next),
            Ok(_) => {}
            Err(why) => failure = Some(why),
        }
    }
    best.ok_or_else(|| failure.unwrap_or(ModelError::NotFinite { what: "the shapes of the term" }))
}

/// The fit from a start, with the shapes that it ended at, beside another fit with that chi-square.
fn fitted_from(
    campaign: &Campaign,
    (wanted, point): &StartingPoint,
    rival: f64,
) -> Result<(Vec<TermSpec>, Fit), ModelError> {
    let fit = fit_beside(campaign, wanted, point, rival)?;
    let ended = |(one, at): (&TermSpec, &Active)| TermSpec { shape: at.shape, ..one.clone() };
    Ok((wanted.iter().zip(&fit.point.active).map(ended).collect(), fit))
}

/// What a fit leaves, and the columns it has taken it out with.
pub(super) struct Unexplained<'a> {
    pub(super) fitted: &'a Fit,
    lin: &'a Linearization,
    left: &'a OnceLock<Left>,
}

/// A basis of the columns of a fit, and what the fit leaves of the readings.
#[derive(Debug)]
pub(super) struct Left {
    basis: DMatrix<f64>,
    residual: DVector<f64>,
    /// Both, whitened once more: by these, products with columns that are not whitened are those with whitened ones. None where errors of
    /// readings are correlated.
    readers: Option<DMatrix<f64>>,
}

impl Left {
    fn by(fitted: &Fit, lin: &Linearization) -> Self {
        let basis = orthonormal(columns(lin, &fitted.point));
        let mut residual = lin.residuals();
        project(&basis, &mut residual);
        let readers = lin.noise_is_independent().then(|| {
            let both = beside(&[basis.clone(), DMatrix::from_columns(std::slice::from_ref(&residual))]);
            lin.whitened(both)
        });
        Self { basis, residual, readers }
    }
}

impl<'a> Unexplained<'a> {
    /// `lin`: where the fit ended; `left`: the place of what is left there.
    pub(super) fn by(fitted: &'a Fit, lin: &'a Linearization, left: &'a OnceLock<Left>) -> Self {
        Self { fitted, lin, left }
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
        let gains = self.gains(next, &grid);
        Scan { term: Arc::clone(&next.term), grid, gains }
    }

    /// Computed outside the place: a thread that waits for others there might be given a fit that asks for the same.
    fn left(&self) -> &'a Left {
        self.left.get().unwrap_or_else(|| {
            let found = Left::by(self.fitted, self.lin);
            self.left.get_or_init(|| found)
        })
    }

    /// Drop of chi-square by a term in each of some shapes.
    fn gains(&self, next: &TermSpec, grid: &[f64]) -> Vec<f64> {
        let (lin, left) = (self.lin, self.left());
        let exact = |&shape: &f64| gain(lin, left, next, shape);
        // Products lose digits that tell laws of readings without noise apart; of few readings the columns cost little.
        let readers = left.readers.as_ref().filter(|_| lin.conditions.len() > MANY_CONDITIONS);
        let Some(readers) = readers else { return map_through(grid, lin.conditions.len(), exact) };
        let sums = TermProducts::of(lin, readers, next, grid);
        let gain = |(k, shape)| {
            sums.as_ref().and_then(|sums| sums.gain(lin.inexact(), k)).unwrap_or_else(|| exact(shape))
        };
        grid.iter().enumerate().map(gain).collect()
    }
}

/// Drop of chi-square by a term in one of its shapes, beside a basis of what is fitted, off what that leaves.
fn gain(lin: &Linearization, left: &Left, next: &TermSpec, shape: f64) -> f64 {
    let mut block = lin.term_block(next.term.as_ref(), next.rich, shape);
    take_off(&left.basis, &mut block);
    orthonormal(block).tr_mul(&left.residual).norm_squared()
}

/// Products of the columns `B` of a term, not whitened, in some of its shapes, in one pass over the readings.
///
/// ```text
/// G = B'B - (K'Z'B)'(K'Z'B) - (U'WB)'(U'WB),   g = r'WB,   gain = g' G^-1 g
/// ```
///
/// with the inputs `Z` that are known to a tolerance, `W W = I - Z K K' Z'`, the basis `U` of what is fitted and what it leaves, `r`.
struct TermProducts {
    /// Columns in one shape, inputs, and columns of the basis.
    counts: [usize; 3],
    /// `Z'B`, `[U r]'WB` and `B'B`, one above the other; the shapes side by side.
    all: DMatrix<f64>,
}

impl TermProducts {
    /// None without readings or shapes.
    fn of(lin: &Linearization, readers: &DMatrix<f64>, next: &TermSpec, grid: &[f64]) -> Option<Self> {
        let (term, rich) = (next.term.as_ref(), next.rich);
        let z = lin.inexact().map(Inexact::z);
        let counts = [parameter_count(term, rich), z.map_or(0, DMatrix::ncols), readers.ncols() - 1];
        let [own, inputs, _] = counts;
        for &shape in grid {
            foresight::of_conditions(term, rich, shape, &lin.machine, &lin.conditions);
        }
        if grid.is_empty() {
            return None;
        }
        let part = |range: &Range<usize>| {
            let (first, rows) = (6 * range.start, 6 * range.len());
            let shapes = grid.iter().map(|&shape| lin.own_term_rows(term, rich, shape, range.clone()));
            let blocks = beside(&shapes.collect::<Vec<_>>());
            let mut all = DMatrix::zeros(inputs + readers.ncols() + own, blocks.ncols());
            if let Some(z) = z {
                all.rows_mut(0, inputs).copy_from(&products(z.rows(first, rows), blocks.as_view()));
            }
            let along = products(readers.rows(first, rows), blocks.as_view());
            all.rows_mut(inputs, readers.ncols()).copy_from(&along);
            for k in 0..grid.len() {
                let block = blocks.columns(k * own, own);
                let place = (inputs + readers.ncols(), k * own);
                all.view_mut(place, (own, own)).copy_from(&products(block, block));
            }
            all
        };
        sum_in_order(&parts_of(lin.conditions.len()), part).map(|all| Self { counts, all })
    }

    /// Drop of chi-square in one shape; none where products of columns do not tell it, because columns depend on each other or on
    /// those fitted.
    fn gain(&self, inputs: Option<&Inexact>, shape: usize) -> Option<f64> {
        let [own, of_inputs, of_basis] = self.counts;
        let all = self.all.columns(shape * own, own);
        let fitted = all.rows(of_inputs, of_basis);
        let square = all.rows(of_inputs + of_basis + 1, own);
        let mut left = square - fitted.tr_mul(&fitted);
        if let Some(inputs) = inputs {
            let taken = inputs.known().tr_mul(&all.rows(0, of_inputs));
            left -= taken.tr_mul(&taken);
        }
        if (0..own).any(|k| left[(k, k)] <= TOLD_BY_PRODUCTS * square[(k, k)]) {
            return None;
        }
        let lengths = left.diagonal().map(f64::sqrt);
        let cosines = DMatrix::from_fn(own, own, |i, j| left[(i, j)] / (lengths[i] * lengths[j]));
        let factor = cosines.cholesky()?.unpack();
        let shares = |k: usize| left[(k, k)] * factor[(k, k)] * factor[(k, k)];
        if (0..own).any(|k| shares(k) <= TOLD_BY_PRODUCTS * square[(k, k)]) {
            return None;
        }
        let along = all.row(of_inputs + of_basis).transpose().component_div(&lengths);
        factor.solve_lower_triangular(&along).map(|x| x.norm_squared())
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
    #![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

    use hexbench_core::Measurand;

    use super::*;
    use crate::effects::untestable::why_untestable;
    use crate::estimation::fit::fit_baseline;
    use crate::estimation::noise::Noise;
    use crate::estimation::tolerances::within_tolerances;
    use crate::terms::catalogue;
    use crate::test_machine::readings;

    #[test]
    fn products_tell_what_a_term_explains_as_its_columns_do() {
        let (hexapod, mut data) = readings(Measurand::DeflectionEuler, Vec::new());
        for (i, row) in data.observations.iter_mut().enumerate() {
            row.measured[i % 6] += 8e-8;
        }
        let exact = Campaign::with_noise(&hexapod, &data, Noise::stated(1e-7, 6e-7)).unwrap();
        for campaign in [exact.clone(), within_tolerances(exact)] {
            let fitted = fit_baseline(&campaign).unwrap();
            let (lin, place) = (Linearization::at(&campaign, &fitted.point).unwrap(), OnceLock::new());
            let left = place.get_or_init(|| Left::by(&fitted, &lin));
            let mut told = 0;
            for term in
                catalogue().into_iter().filter(|t| why_untestable(t.as_ref(), &campaign, &lin).is_none())
            {
                let id = term.info().id;
                let shape = term.shape_grid(&lin.conditions).first().copied().unwrap_or(1.0);
                let next = TermSpec { term, rich: false, shape, prior: Vec::new() };
                let grid = [shape, shape];
                let sums = TermProducts::of(&lin, left.readers.as_ref().unwrap(), &next, &grid).unwrap();
                assert!(TermProducts::of(&lin, left.readers.as_ref().unwrap(), &next, &[]).is_none());
                let Some(by_products) = sums.gain(lin.inexact(), 1) else { continue };
                let by_columns = gain(&lin, left, &next, shape);
                let off = (by_products - by_columns) / by_columns.max(1e-3);
                assert!(off.abs() < 1e-5, "{id}: {by_products} and {by_columns}");
                told += 1;
            }
            assert!(told > 5, "of {told} terms alone");
        }
    }

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
