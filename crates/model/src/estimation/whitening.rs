//! Readings that share an error: the transform after which their errors are independent again.
//!
//! Every column and every residual, already divided by the standard deviation of what a reading has for itself, is
//! multiplied by the inverse square root of its covariance. Neither kind needs a matrix:
//!
//! ```text
//! shared by a record    I + u u'        ->  x - c u (u'x) / u'u,   c = 1 - 1 / sqrt(1 + u'u)
//! drift along the file  I + u_i u_j phi^|i - j|  ->  innovations of the Kalman filter over their standard deviations
//! ```
//!
//! `u`: standard deviation of the shared part over that of the own part. The first is Woodbury's identity, the second the
//! Cholesky factor of white noise beside a process of first order.

use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

use hexbench_core::Vector6;
use nalgebra::{DMatrix, DVector};

use crate::estimation::campaign::{Campaign, ConditionReadings, rows_of};
use crate::estimation::linearization::ModelPoint;
use crate::estimation::noise::{Noise, Structure};
use crate::estimation::nuisance::{InputsAfterFit, ShownInputs};
use crate::estimation::parallel::{copied_rows, product, products, rows_without, take_product};

/// The transform of a list of conditions.
#[derive(Debug, Clone)]
pub struct Whitening {
    noise: Common,
    inputs: Option<Arc<Inexact>>,
}

/// What errors of the readings have in common.
#[derive(Debug, Clone)]
enum Common {
    /// Errors are independent.
    Nothing,
    /// Conditions of one record share an error in every coordinate.
    Shared {
        /// Record of every condition.
        records: Vec<usize>,
        /// `u` of every condition.
        shares: Vec<Vector6>,
    },
    /// Errors of neighboring rows resemble each other.
    Drift {
        /// Line of every condition in the file, ascending, and which of the blocks of numbers it has.
        rows: Vec<[usize; 2]>,
        /// `u` of every condition.
        shares: Vec<Vector6>,
        /// Correlation of neighboring lines.
        correlation: f64,
    },
}

impl Whitening {
    /// None: errors are independent, inputs exact.
    pub(crate) fn nothing() -> Self {
        Self { noise: Common::Nothing, inputs: None }
    }

    /// The transform for the groups of a campaign.
    pub fn of(campaign: &Campaign) -> Self {
        let noise = Common::of(&campaign.groups, &campaign.noise);
        Self { noise, inputs: campaign.inexact.clone() }
    }

    /// That of some of the conditions, in this order.
    #[must_use]
    pub fn choose(&self, which: impl Iterator<Item = usize> + Clone) -> Self {
        let rows = rows_of(which.clone());
        let noise = self.noise.choose(which);
        let chosen = |all: &Arc<Inexact>| {
            Inexact::whitened(&noise, all.columns.select_rows(&rows), Arc::clone(&all.machine))
        };
        Self { inputs: self.inputs.as_ref().and_then(chosen).map(Arc::new), noise }
    }

    /// The same with inputs taken as exact.
    #[must_use]
    pub(crate) fn of_noise_alone(&self) -> Self {
        Self { noise: self.noise.clone(), inputs: None }
    }

    /// True when errors of the readings are independent, but for inputs that are known to a tolerance only.
    pub(crate) fn noise_is_independent(&self) -> bool {
        matches!(self.noise, Common::Nothing)
    }

    /// Inputs that are known to a tolerance only.
    pub(crate) fn inexact(&self) -> Option<&Inexact> {
        self.inputs.as_deref()
    }

    /// Transformed columns of the inputs that are known to a tolerance only; none when all are taken as exact.
    pub fn inputs(&self) -> Option<DMatrix<f64>> {
        let mut columns = self.inputs.as_ref()?.columns.clone();
        self.apply(&mut columns);
        Some(columns)
    }

    /// `T` where the transform is symmetric, `W W = I - T T'`; none where errors of readings are correlated.
    pub fn taken_out(&self, rows: usize) -> Option<DMatrix<f64>> {
        let of_inputs = self.inputs.as_ref().map_or_else(|| DMatrix::zeros(rows, 0), |all| all.taken_out());
        matches!(self.noise, Common::Nothing).then_some(of_inputs)
    }

    /// Transforms columns with six rows per condition.
    pub fn apply(&self, columns: &mut DMatrix<f64>) {
        self.noise.apply(columns);
        if let Some(inputs) = &self.inputs {
            inputs.apply(columns);
        }
    }

    /// The same of columns that stay as they are, some rows at a time.
    pub(crate) fn rows_of<'a>(
        &'a self,
        columns: &'a DMatrix<f64>,
    ) -> impl Fn(Range<usize>) -> DMatrix<f64> + Sync + 'a {
        let own = self.free_of_noise(columns);
        let taken = self.inputs.as_deref().map(|inputs| (inputs.z(), inputs.along(&own)));
        move |rows| match &taken {
            Some((z, along)) => rows_without(&own, z, along, &rows),
            None => copied_rows(&own, &rows),
        }
    }

    /// What the readings of a fit tell of the inputs, by its `[A y]`; none where inputs count as exact.
    pub(crate) fn inputs_after_fit(&self, own: &DMatrix<f64>) -> Option<InputsAfterFit> {
        let inputs = self.inputs.as_deref()?;
        InputsAfterFit::of(&inputs.products(), &products(inputs.z(), &*self.free_of_noise(own)))
    }

    /// Columns after which the noise of readings is independent.
    fn free_of_noise<'a>(&self, columns: &'a DMatrix<f64>) -> Cow<'a, DMatrix<f64>> {
        let mut own = Cow::Borrowed(columns);
        if !self.noise_is_independent() {
            self.noise.apply(own.to_mut());
        }
        own
    }

    /// Transforms one column.
    pub fn apply_to(&self, x: &mut DVector<f64>) {
        self.noise.apply_to(x);
        if let Some(inputs) = &self.inputs {
            inputs.apply_to(x);
        }
    }
}

/// Inputs known to a tolerance only: `V = I + Z Z'`, and
///
/// ```text
/// V^-1/2 = I - Z U diag(d / s) U' Z',   V^-1 = I - Z U diag(1 / (1 + s)) U' Z',   d = 1 - 1 / sqrt(1 + s)
/// ```
///
/// with the combinations `U` of inputs that show, and the squared number `s` of standard deviations by which each moves the readings.
#[derive(Debug, Clone)]
pub struct Inexact {
    /// Reading over the standard deviation of its own noise, per standard deviation of each input.
    pub(crate) columns: DMatrix<f64>,
    /// The machine that the columns are of.
    pub(crate) machine: Arc<ModelPoint>,
    /// `Z`, where errors that readings share are whitened out; none where there are none, and `Z` is `columns`.
    whitened: Option<DMatrix<f64>>,
    /// `U diag(d / s) U'`.
    taken: DMatrix<f64>,
    /// `U diag(1 / (1 + s))^1/2`.
    known: DMatrix<f64>,
    /// `Z' Z`; none of fewer readings than inputs.
    products: Option<DMatrix<f64>>,
}

impl Inexact {
    /// Inputs of groups of readings; none when no error of them shows.
    pub(crate) fn of(
        groups: &[ConditionReadings],
        noise: &Noise,
        columns: DMatrix<f64>,
        machine: Arc<ModelPoint>,
    ) -> Option<Self> {
        Self::whitened(&Common::of(groups, noise), columns, machine)
    }

    fn whitened(noise: &Common, columns: DMatrix<f64>, machine: Arc<ModelPoint>) -> Option<Self> {
        let whitened = (!matches!(noise, Common::Nothing)).then(|| {
            let mut z = columns.clone();
            noise.apply(&mut z);
            z
        });
        let shown = ShownInputs::of(whitened.as_ref().unwrap_or(&columns));
        if shown.squares.is_empty() {
            return None;
        }
        let share = shown.squares.iter().map(|s| (1.0 - (1.0 + s).sqrt().recip()) / s);
        let share = DVector::from_iterator(shown.squares.len(), share);
        let u = &shown.combinations;
        let (taken, known) = (u * DMatrix::from_diagonal(&share) * u.transpose(), shown.known());
        Some(Self { columns, machine, whitened, taken, known, products: shown.products })
    }

    /// `Z`.
    pub(crate) fn z(&self) -> &DMatrix<f64> {
        self.whitened.as_ref().unwrap_or(&self.columns)
    }

    /// `Z' Z`.
    pub(crate) fn products(&self) -> Cow<'_, DMatrix<f64>> {
        self.products.as_ref().map_or_else(|| Cow::Owned(products(self.z(), self.z())), Cow::Borrowed)
    }

    /// `T` with which whitening twice is `I - T T'`.
    fn taken_out(&self) -> DMatrix<f64> {
        self.z() * &self.known
    }

    /// `K` with which `Z K K' Z'` is what whitening twice takes out.
    pub(crate) fn known(&self) -> &DMatrix<f64> {
        &self.known
    }

    pub(crate) fn apply(&self, columns: &mut DMatrix<f64>) {
        let along = self.along(columns);
        take_product(columns, self.z(), &along);
    }

    /// What of `Z` is taken off columns.
    fn along(&self, columns: &DMatrix<f64>) -> DMatrix<f64> {
        &self.taken * products(self.z(), columns)
    }

    fn apply_to(&self, x: &mut DVector<f64>) {
        let along = &self.taken * product(self.z(), x);
        take_product(x, self.z(), &along);
    }
}

impl Common {
    /// The transform for groups of readings under a noise model.
    fn of(groups: &[ConditionReadings], noise: &Noise) -> Self {
        match noise.structure {
            Structure::Independent
            | Structure::Setup { .. }
            | Structure::Axes { .. }
            | Structure::Loads { .. }
            | Structure::Lengths { .. } => Self::Nothing,
            Structure::Reference { .. } => Self::Shared {
                records: groups.iter().map(|g| g.record).collect(),
                shares: groups.iter().map(share).collect(),
            },
            Structure::Drift { correlation, .. } => Self::Drift {
                rows: groups
                    .iter()
                    .map(|g| [usize::try_from(g.mean.line).unwrap_or(0), g.mean.block])
                    .collect(),
                shares: groups.iter().map(share).collect(),
                correlation,
            },
        }
    }

    /// That of some of the conditions, in this order.
    #[must_use]
    fn choose(&self, which: impl Iterator<Item = usize>) -> Self {
        match self {
            Self::Nothing => Self::Nothing,
            Self::Shared { records, shares } => {
                let (records, shares) = which.map(|i| (records[i], shares[i])).unzip();
                Self::Shared { records, shares }
            }
            Self::Drift { rows, shares, correlation } => {
                let (rows, shares) = which.map(|i| (rows[i], shares[i])).unzip();
                Self::Drift { rows, shares, correlation: *correlation }
            }
        }
    }

    /// Transforms columns with six rows per condition.
    fn apply(&self, columns: &mut DMatrix<f64>) {
        if matches!(self, Self::Nothing) {
            return;
        }
        for mut column in columns.column_iter_mut() {
            let mut x: DVector<f64> = column.clone_owned();
            self.apply_to(&mut x);
            column.copy_from(&x);
        }
    }

    /// Transforms one column.
    fn apply_to(&self, x: &mut DVector<f64>) {
        match self {
            Self::Nothing => {}
            Self::Shared { records, shares } => shared(records, shares, x),
            Self::Drift { rows, shares, correlation } => drift(rows, shares, *correlation, x),
        }
    }
}

/// What a number that was not read shares with others is nothing: it says nothing of the error that they have in common.
fn share(group: &ConditionReadings) -> Vector6 {
    Vector6::from_fn(|k, _| if group.reads[k] > 0 { group.shared[k] / group.sigma[k] } else { 0.0 })
}

fn shared(records: &[usize], shares: &[Vector6], x: &mut DVector<f64>) {
    let count = records.iter().max().map_or(0, |last| last + 1);
    let (mut along, mut length) = (vec![Vector6::zeros(); count], vec![Vector6::zeros(); count]);
    for (i, (&record, u)) in records.iter().zip(shares).enumerate() {
        along[record] += u.component_mul(&x.fixed_rows::<6>(6 * i));
        length[record] += u.component_mul(u);
    }
    let factor =
        |square: f64| if square > 0.0 { (1.0 - (1.0 + square).sqrt().recip()) / square } else { 0.0 };
    for (i, (&record, u)) in records.iter().zip(shares).enumerate() {
        let taken = length[record].map(factor).component_mul(&along[record]).component_mul(u);
        let mut part = x.fixed_rows_mut::<6>(6 * i);
        part -= taken;
    }
}

fn drift(rows: &[[usize; 2]], shares: &[Vector6], correlation: f64, x: &mut DVector<f64>) {
    for k in 0..6 {
        let mut filters = Filters::<1>::default();
        for (i, &row) in rows.iter().enumerate() {
            let ([innovation], variance) = filters.step(row, [x[6 * i + k]], shares[i][k], correlation);
            x[6 * i + k] = innovation / variance.sqrt();
        }
    }
}

/// A filter for each block of numbers: those of another block look at other things, and drift by themselves.
#[derive(Default)]
pub struct Filters<const PROCESSES: usize>(Vec<(Filter<PROCESSES>, Option<usize>)>);

impl<const PROCESSES: usize> Filters<PROCESSES> {
    /// What numbers bring that is new, and the variance of each of them; they stand in a line of the file, in a block, and each has that
    /// share of its process in it.
    pub fn step(
        &mut self,
        [line, block]: [usize; 2],
        numbers: [f64; PROCESSES],
        share: f64,
        correlation: f64,
    ) -> ([f64; PROCESSES], f64) {
        while self.0.len() <= block {
            self.0.push((Filter::default(), None));
        }
        let (filter, last) = &mut self.0[block];
        let distance = last.replace(line).map_or(0, |last| line.abs_diff(last));
        filter.step(numbers, share, distance, correlation)
    }
}

/// Kalman filter of processes of first order with unit variance, alike but for their values, each seen with white noise of unit variance.
struct Filter<const PROCESSES: usize> {
    means: [f64; PROCESSES],
    variance: f64,
}

impl<const PROCESSES: usize> Default for Filter<PROCESSES> {
    fn default() -> Self {
        Self { means: [0.0; PROCESSES], variance: 1.0 }
    }
}

impl<const PROCESSES: usize> Filter<PROCESSES> {
    /// What readings bring that is new, and the variance of each of them; `share` of the process is in the reading, `distance` steps
    /// after the one before.
    fn step(
        &mut self,
        readings: [f64; PROCESSES],
        share: f64,
        distance: usize,
        correlation: f64,
    ) -> ([f64; PROCESSES], f64) {
        let kept = correlation.powi(i32::try_from(distance).unwrap_or(i32::MAX));
        let before = 1.0 + kept * kept * (self.variance - 1.0);
        let variance = 1.0 + share * share * before;
        let gain = before * share / variance;
        let mut innovations = readings;
        for (innovation, known) in innovations.iter_mut().zip(&mut self.means) {
            let mean = kept * *known;
            *innovation -= share * mean;
            *known = mean + gain * *innovation;
        }
        self.variance = before * (1.0 - gain * share);
        (innovations, variance)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

    use super::*;
    use crate::machine::geometry::Machine;
    use crate::test_machine::machine;

    /// Rounding of sums of a dozen numbers.
    const ROUNDING: f64 = 1e-12;

    /// The transform as a matrix.
    fn matrix(whitening: &Common, conditions: usize) -> DMatrix<f64> {
        let mut all = DMatrix::identity(6 * conditions, 6 * conditions);
        whitening.apply(&mut all);
        all
    }

    #[test]
    fn readings_of_one_record_become_independent() {
        let shares = vec![Vector6::repeat(0.8), Vector6::repeat(1.3), Vector6::repeat(0.5)];
        let records = vec![0, 1, 0];
        let mut covariance = DMatrix::<f64>::identity(18, 18);
        for (i, j) in [(0, 0), (0, 2), (2, 0), (2, 2), (1, 1)] {
            for k in 0..6 {
                covariance[(6 * i + k, 6 * j + k)] += shares[i][k] * shares[j][k];
            }
        }
        let w = matrix(&Common::Shared { records, shares }, 3);
        assert!((&w * covariance * w.transpose() - DMatrix::identity(18, 18)).amax() < ROUNDING);
    }

    #[test]
    fn neighbors_of_a_drift_become_independent_also_across_a_gap() {
        let lines: Vec<usize> = vec![0, 1, 4];
        let shares = vec![Vector6::repeat(0.8), Vector6::repeat(1.3), Vector6::repeat(0.5)];
        let covariance = DMatrix::from_fn(18, 18, |a, b| {
            let (i, j, same) = (a / 6, b / 6, a % 6 == b % 6);
            let distance = i32::try_from(lines[i].abs_diff(lines[j])).unwrap_or(0);
            let drift = shares[i][0] * shares[j][0] * 0.7_f64.powi(distance);
            f64::from(u8::from(a == b)) + if same { drift } else { 0.0 }
        });
        let rows = lines.iter().map(|&line| [line, 0]).collect();
        let w = matrix(&Common::Drift { rows, shares, correlation: 0.7 }, 3);
        assert!((&w * covariance * w.transpose() - DMatrix::identity(18, 18)).amax() < ROUNDING);
    }

    #[test]
    fn blocks_of_numbers_drift_by_themselves_and_an_empty_cell_tells_nothing() {
        // Lines 0 and 1 have numbers of two blocks; the first number of the last condition was not read.
        let rows: Vec<[usize; 2]> = vec![[0, 0], [0, 1], [1, 0], [1, 1]];
        let mut shares = vec![Vector6::repeat(0.8); 4];
        shares[2][0] = 0.0;
        let covariance = DMatrix::from_fn(24, 24, |a, b| {
            let (i, j, k) = (a / 6, b / 6, a % 6);
            let same = k == b % 6 && rows[i][1] == rows[j][1];
            let distance = i32::try_from(rows[i][0].abs_diff(rows[j][0])).unwrap();
            let drift = shares[i][k] * shares[j][k] * 0.7_f64.powi(distance);
            f64::from(u8::from(a == b)) + if same { drift } else { 0.0 }
        });
        let w = matrix(&Common::Drift { rows, shares, correlation: 0.7 }, 4);
        assert!((&w * covariance * w.transpose() - DMatrix::identity(24, 24)).amax() < ROUNDING);
    }

    #[test]
    fn inputs_that_are_not_exact_are_taken_out_as_far_as_they_are_known() {
        let columns = DMatrix::from_fn(12, 3, |i, k| ((i * 7 + k * 5) % 11) as f64 - 5.0);
        let covariance = DMatrix::<f64>::identity(12, 12) + &columns * columns.transpose();
        let machine = Machine::nominal(&machine());
        let point = ModelPoint { compliances: Vector6::zeros(), active: Vec::new(), machine };
        let inputs = Inexact::whitened(&Common::Nothing, columns, Arc::new(point)).unwrap();
        let mut w = DMatrix::identity(12, 12);
        inputs.apply(&mut w);
        assert!((&w * covariance * w.transpose() - DMatrix::identity(12, 12)).amax() < 100.0 * ROUNDING);
    }

    #[test]
    fn rows_some_at_a_time_are_those_of_all() {
        let machine = Machine::nominal(&machine());
        let point = Arc::new(ModelPoint { compliances: Vector6::zeros(), active: Vec::new(), machine });
        let inputs = DMatrix::from_fn(12, 3, |i, k| ((i * 7 + k * 5) % 11) as f64 - 5.0);
        let shared = Common::Shared { records: vec![0, 0], shares: vec![Vector6::repeat(0.8); 2] };
        let columns = DMatrix::from_fn(12, 4, |i, k| ((i * 5 + k * 3) % 7) as f64 - 3.0);
        for noise in [Common::Nothing, shared] {
            for inputs in [None, Inexact::whitened(&noise, inputs.clone(), Arc::clone(&point)).map(Arc::new)]
            {
                let whitening = Whitening { noise: noise.clone(), inputs };
                let mut all = columns.clone();
                whitening.apply(&mut all);
                let rows = whitening.rows_of(&columns);
                for range in [0..5, 5..12] {
                    let off = rows(range.clone()) - all.rows(range.start, range.len());
                    assert!(off.amax() < ROUNDING, "{whitening:?} {range:?}");
                }
            }
        }
    }
}
