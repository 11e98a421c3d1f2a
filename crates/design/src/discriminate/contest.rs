//! Rival effects on one machine, and how far apart readings hold them.

use std::ops::Range;
use std::sync::Arc;

use hexbench_core::{Hexapod, Observation, StatedTolerances, Vector6};
use hexbench_model::effects::sizes::{WIDEST, sizes};
use hexbench_model::effects::term::Term;
use hexbench_model::effects::untestable::{Reason, why_untestable};
use hexbench_model::error::ModelError;
use hexbench_model::estimation::fit::natural;
use hexbench_model::estimation::noise::Noise;
use hexbench_model::estimation::nuisance::{ShownInputs, marginal};
use hexbench_model::estimation::tolerances::{InputKind, input_columns};
use hexbench_model::inference::evidence::{NOTICEABLE, log_sum};
use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, Normal};

use crate::DesignError;
use crate::to_be_read::ToBeRead;

/// Shapes at which an effect of unknown shape counts.
const SHAPES: usize = 3;
/// `q` of the smooth smallest distance: pairs twice as far apart as the closest hardly count.
const SHARPNESS: f64 = 6.0;
/// Distance that counts as none, standard deviations.
const UNSEEN: f64 = 1e-4;
/// Prior width of a spring, relative to its nominal compliance.
const SPRING_WIDTH: f64 = 1.0;

/// See the module above.
pub struct Contest<'a> {
    hexapod: &'a Hexapod,
    springs: Vector6,
    noise: Noise,
    forms: Vec<Form>,
    rivals: usize,
    /// Combinations of inputs whose errors show, a row for each of [`input_columns`].
    inputs: DMatrix<f64>,
}

/// A rival at one shape, with its columns.
struct Form {
    rival: usize,
    term: Arc<dyn Term>,
    shape: f64,
    /// Natural sizes of its parameters, SI.
    sizes: Vec<f64>,
    columns: Range<usize>,
    /// Multiple of the natural sizes at which it counts.
    size: f64,
}

/// Distance of one effect from the best fit of another, in standard deviations of the noise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Distance {
    /// The effect that is there, and the one that is fitted.
    pub of: [usize; 2],
    /// `T`, at the least favorable shapes.
    pub value: f64,
}

impl Distance {
    /// Mean logarithm of the ratio of likelihoods for the truth; its standard deviation is `T`.
    pub fn log_likelihood_ratio(&self) -> f64 {
        0.5 * self.value * self.value
    }

    /// Chance that the ratio of likelihoods favors the truth.
    pub fn right(&self) -> f64 {
        Normal::standard().cdf(0.5 * self.value)
    }
}

impl<'a> Contest<'a> {
    /// Terms on springs of the given compliance (m/N); `candidate_readings` are the readings that can be taken. Each term is taken so large that
    /// `readings` of them, spread evenly, would show it beside free springs by `visible` standard deviations, as far as such a size
    /// makes physical sense.
    ///
    /// # Errors
    /// [`ModelError::Untestable`] for a term that none of the candidate readings shows; a singular pose.
    pub fn new(
        hexapod: &'a Hexapod,
        springs: Vector6,
        noise: Noise,
        terms: &[Arc<dyn Term>],
        candidate_readings: &[Observation],
        readings: usize,
        visible: f64,
    ) -> Result<Self, DesignError> {
        let inputs = DMatrix::zeros(InputKind::COLUMNS, 0);
        let mut contest = Self { hexapod, springs, noise, forms: Vec::new(), rivals: terms.len(), inputs };
        let ToBeRead { campaign, point, lin, .. } = contest.to_be_read(candidate_readings)?;
        let natural = natural(&point, &lin);
        contest.inputs =
            ShownInputs::of(&input_columns(&campaign, &point, &hexapod.tolerances)?).combinations;
        let untestable =
            |term: &Arc<dyn Term>, why: Reason| ModelError::Untestable { id: term.info().id.to_owned(), why };
        let mut at = 6;
        for (rival, term) in terms.iter().enumerate() {
            if let Some(why) = why_untestable(term.as_ref(), &campaign, &lin) {
                return Err(untestable(term, why).into());
            }
            for shape in quartiles(&term.shape_grid(&lin.conditions)) {
                let (term, sizes) = (Arc::clone(term), sizes(term.as_ref(), false, shape, &natural));
                let columns = at..at + sizes.len();
                at = columns.end;
                contest.forms.push(Form { rival, term, shape, sizes, columns, size: 1.0 });
            }
        }
        let share = readings as f64 / candidate_readings.len().max(1) as f64;
        let all = at + contest.inputs.ncols();
        let even =
            contest.informations(candidate_readings)?.iter().fold(DMatrix::zeros(all, all), |sum, m| sum + m)
                * share;
        let even = contest.with_inputs_unknown(&even);
        for k in 0..contest.forms.len() {
            let shown = distance(&even, &contest.forms[k], None);
            if WIDEST * shown <= NOTICEABLE {
                return Err(untestable(&contest.forms[k].term, Reason::TooFaintInSpace).into());
            }
            contest.forms[k].size = (visible / shown).min(WIDEST);
        }
        Ok(contest)
    }

    /// Number of rivals.
    pub fn rivals(&self) -> usize {
        self.rivals
    }

    /// How well inputs are assumed to be known; none where no error of them shows.
    pub fn tolerances(&self) -> Option<StatedTolerances> {
        (self.inputs.ncols() > 0).then(|| StatedTolerances::from(&self.hexapod.tolerances))
    }

    /// Parameters of a rival in the size at which it counts (shown units), at its middle shape.
    pub fn assumed(&self, rival: usize) -> Vec<(&'static str, f64, &'static str)> {
        let own: Vec<&Form> = self.forms.iter().filter(|f| f.rival == rival).collect();
        let Some(form) = own.get(own.len() / 2) else { return Vec::new() };
        let named = form.term.info().parameters.iter().zip(&form.sizes);
        named.map(|(p, s)| (p.name, s * form.size * p.per_si, p.unit)).collect()
    }

    /// Information of springs and effects by that of a plan: errors of the inputs are taken out.
    fn with_inputs_unknown(&self, information: &DMatrix<f64>) -> DMatrix<f64> {
        marginal(information, information.nrows() - self.inputs.ncols())
    }

    /// Information matrix of every reading: springs, effects, and the inputs that are known to a tolerance only.
    ///
    /// # Errors
    /// A singular pose.
    pub fn informations(&self, readings: &[Observation]) -> Result<Vec<DMatrix<f64>>, DesignError> {
        let read = self.to_be_read(readings)?;
        let ToBeRead { campaign, point, lin, .. } = &read;
        let parameters = self.forms.last().map_or(6, |f| f.columns.end);
        let width = parameters + self.inputs.ncols();
        let mut rows = DMatrix::zeros(lin.equations(), width);
        let springs = DMatrix::from_diagonal(&DVector::from_column_slice(self.springs.as_slice()));
        rows.columns_mut(0, 6).copy_from(&(lin.common_block() * springs));
        for form in &self.forms {
            let sizes = DMatrix::from_diagonal(&DVector::from_column_slice(&form.sizes));
            let block = lin.term_block(form.term.as_ref(), false, form.shape) * sizes;
            rows.columns_mut(form.columns.start, form.columns.len()).copy_from(&block);
        }
        let inputs = input_columns(campaign, point, &self.hexapod.tolerances)? * &self.inputs;
        rows.columns_mut(parameters, inputs.ncols()).copy_from(&inputs);
        Ok(read.informations(&rows))
    }

    fn to_be_read(&self, readings: &[Observation]) -> Result<ToBeRead, DesignError> {
        ToBeRead::of(self.hexapod, self.springs, self.noise, readings.iter().copied())
    }

    /// Distances of every effect from every other by the information of a plan.
    pub fn distances(&self, information: &DMatrix<f64>) -> Vec<Distance> {
        let pairs =
            (0..self.rivals).flat_map(|a| (0..self.rivals).filter(move |b| *b != a).map(move |b| [a, b]));
        let information = &self.with_inputs_unknown(information);
        let least = |[a, b]: [usize; 2]| {
            let of = |rival: usize| self.forms.iter().filter(move |f| f.rival == rival);
            let all = of(a).flat_map(|x| of(b).map(move |y| distance(information, x, Some(y))));
            Distance { of: [a, b], value: all.fold(f64::INFINITY, f64::min) }
        };
        pairs.map(least).collect()
    }

    /// `-ln T` of the smallest distance in smooth form, `T = (sum T^-2q)^(-1/2q)`: smaller for a better plan.
    pub(super) fn closeness(&self, information: &DMatrix<f64>) -> f64 {
        let exponents: Vec<f64> = self
            .distances(information)
            .into_iter()
            .map(|d| -SHARPNESS * (d.value * d.value + UNSEEN * UNSEEN).ln())
            .collect();
        log_sum(exponents.iter().copied()) / (2.0 * SHARPNESS)
    }
}

/// `T` of `a` when springs and `b` are fitted; without `b`, springs alone.
fn distance(m: &DMatrix<f64>, a: &Form, b: Option<&Form>) -> f64 {
    let fitted: Vec<usize> = (0..6).chain(b.map_or(0..0, |b| b.columns.clone())).collect();
    let width = |k: usize| if k < 6 { SPRING_WIDTH } else { WIDEST };
    let n = fitted.len();
    let inner = DMatrix::from_fn(n, n, |i, j| {
        m[(fitted[i], fitted[j])] + if i == j { width(fitted[i]).powi(-2) } else { 0.0 }
    });
    let cross = DMatrix::from_fn(n, a.columns.len(), |i, j| m[(fitted[i], a.columns.start + j)]);
    let whole: f64 = a.columns.clone().map(|k| m[(k, k)]).sum();
    let explained = inner.cholesky().map_or(0.0, |c| cross.dot(&c.solve(&cross)));
    a.size * (whole - explained).max(0.0).sqrt()
}

/// The middle of a list, and the middles of its halves; one without a meaning when there are no shapes.
fn quartiles(grid: &[f64]) -> Vec<f64> {
    let n = grid.len();
    if n == 0 {
        return vec![1.0];
    }
    let mut places: Vec<usize> = (1..=SHAPES).map(|q| (q * n / (SHAPES + 1)).min(n - 1)).collect();
    places.dedup();
    places.into_iter().map(|i| grid[i]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two standard deviations apart, the ratio of likelihoods has the mean 2 and the standard deviation 2.
    #[test]
    fn a_distance_tells_the_mean_ratio_and_the_chance_that_it_favors_the_truth() {
        let apart = |value: f64| Distance { of: [0, 1], value };
        for (value, ratio, right) in [(0.0, 0.0, 0.5), (2.0, 2.0, 0.841_344_746), (4.0, 8.0, 0.977_249_868)] {
            assert!((apart(value).log_likelihood_ratio() - ratio).abs() < 1e-12, "{value}");
            assert!((apart(value).right() - right).abs() < 1e-8, "{value}: {}", apart(value).right());
        }
    }
}
