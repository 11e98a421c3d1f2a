//! What is left of every reading when everything the catalogue could explain is taken out.
//!
//! Springs, frames and every testable effect in several of its forms span a space; what the readings have outside it is
//! noise, a fault of the data, or physics of which no catalogue knows. Judged here, a fault cannot pass for an effect.

use std::convert::Infallible;
use std::ops::Range;

use hexbench_core::{Dataset, Vector6};
use nalgebra::{DMatrix, DVector};

use super::slopes::Slopes;
use crate::estimation::basis::{orthonormal, project, take_off};
use crate::estimation::campaign::{Campaign, row_sigma};
use crate::estimation::linearization::{Linearization, ModelPoint, beside};
use crate::estimation::parallel::{products, try_take_in_order};
use crate::inference::candidates::{Candidate, CandidateKind, target};
use crate::inference::diagnosis::RankedSets;

/// Shapes of an effect that take part.
const SHAPES: usize = 3;
/// The catalogue may take this share of the equations; beyond it only the explanation found does.
const LARGEST_SHARE: f64 = 0.4;

/// What is taken out of readings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Beside {
    /// All that the catalogue could explain, unless that is too much.
    Catalogue,
    /// The explanation found.
    Explanation,
}

/// Readings without what the catalogue could explain.
pub(super) struct Remainder<'a> {
    /// The readings.
    pub(super) data: &'a Dataset,
    /// They averaged, with their noise.
    pub(super) campaign: &'a Campaign,
    /// The model at its explanation.
    pub(super) lin: &'a Linearization,
    /// Its values.
    pub(super) point: &'a ModelPoint,
    /// Orthonormal basis of what the catalogue could explain, per averaged number.
    pub(super) basis: DMatrix<f64>,
    /// False where so few numbers were read that only the explanation found was taken out.
    pub(super) is_complete: bool,
    /// What a standard deviation of every input of the campaign does to the averaged numbers.
    pub(super) inputs: &'a DMatrix<f64>,
    /// What they gain with every component of the commanded poses; none where a pose beside one is singular.
    pub(super) by_pose: Option<&'a DMatrix<f64>>,
    /// Degrees of freedom that errors of the inputs within their tolerances take.
    taken: f64,
    /// Averaged numbers without it, and without what the inputs' tolerances explain, over their standard deviations.
    pub(super) means: DVector<f64>,
    /// Single readings likewise, over the standard deviations of one reading; in the order of the file.
    pub(super) rows: Vec<Vector6>,
    /// Group of each row.
    pub(super) group_of: Vec<usize>,
}

impl<'a> Remainder<'a> {
    /// Takes out what a search has found, or what its candidates could explain. `campaign` must have independent errors; `lin`: at the
    /// explanation found.
    pub(super) fn new(
        data: &'a Dataset,
        campaign: &'a Campaign,
        outcome: &'a RankedSets,
        slopes: &'a Slopes,
        lin: &'a Linearization,
        beside: Beside,
    ) -> Self {
        let point = &outcome.best.point;
        let (basis, is_complete) = match beside {
            Beside::Catalogue => everything(outcome, lin, point),
            Beside::Explanation => (alone(lin, point), false),
        };
        let mut means = target(lin, point);
        project(&basis, &mut means);
        let (inputs, by_pose) = (&slopes.inputs, slopes.by_pose.as_ref());
        let taken = take_out(&basis, inputs, &mut means);
        let mut rows = vec![Vector6::zeros(); data.observations.len()];
        let mut group_of = vec![0; rows.len()];
        for (g, group) in campaign.groups.iter().enumerate() {
            for &i in &group.rows {
                let reading = &data.observations[i as usize];
                let sigma = row_sigma(reading, &campaign.noise);
                let off = campaign.axes.difference(&group.mean.measured, &reading.measured);
                rows[i as usize] =
                    Vector6::from_fn(|k, _| (means[6 * g + k] * group.sigma[k] + off[k]) / sigma[k]);
                group_of[i as usize] = g;
            }
        }
        Self { data, campaign, lin, point, basis, is_complete, inputs, by_pose, taken, means, rows, group_of }
    }

    /// Share of one averaged number that the catalogue could explain.
    pub(super) fn leverage(&self, number: usize) -> f64 {
        self.basis.row(number).norm_squared().min(1.0 - 1e-9)
    }

    /// Degrees of freedom of the averaged numbers.
    pub(super) fn freedom(&self) -> f64 {
        self.lin.numbers() - self.basis.ncols() as f64 - self.taken
    }

    /// Evidence over the noise as stated of the patterns that the best explanation has beside effects: what they explain of the rest,
    /// less their rarity and `ln n` / 2 for each of their columns (Schwarz 1978).
    pub(super) fn evidence_of_patterns(&self, outcome: &RankedSets) -> f64 {
        let members = outcome.sets.sets.first().map_or(&[][..], |best| &best.members);
        let (mut blocks, mut rarity) = (Vec::new(), 0.0);
        for candidate in members.iter().map(|&m| &outcome.candidates[m]) {
            if let CandidateKind::Pattern(pattern) = &candidate.kind {
                let range = pattern.spread(&self.lin.conditions);
                blocks.push(self.lin.block_of(pattern.width(), |at, out| pattern.actions(at, range, out)));
                rarity += candidate.log_weight;
            }
        }
        if blocks.is_empty() {
            return f64::NEG_INFINITY;
        }
        let mut columns = beside(&blocks);
        take_off(&self.basis, &mut columns);
        let columns = orthonormal(columns);
        let drop = columns.tr_mul(&self.means).norm_squared() * self.lin.numbers() / self.freedom().max(1.0);
        0.5 * (drop - columns.ncols() as f64 * (self.campaign.numbers as f64).ln()) + rarity
    }

    /// Readings of a group.
    pub(super) fn readings(&self, group: usize) -> f64 {
        self.campaign.groups[group].rows.len() as f64
    }
}

/// Takes out the most probable errors of inputs within their tolerances; the degrees of freedom that go with them.
fn take_out(basis: &DMatrix<f64>, inputs: &DMatrix<f64>, means: &mut DVector<f64>) -> f64 {
    let mut columns = inputs.clone();
    take_off(basis, &mut columns);
    let normal = products(&columns, &columns);
    let Some(factor) = (&normal + DMatrix::identity(normal.nrows(), normal.ncols())).cholesky() else {
        return 0.0;
    };
    let errors = factor.solve(&columns.tr_mul(means));
    means.gemv(-1.0, &columns, &errors, 1.0);
    factor.solve(&normal).trace()
}

/// Columns of springs, frames and the terms found.
pub(super) fn explained(lin: &Linearization, point: &ModelPoint) -> Vec<DMatrix<f64>> {
    let terms = point.active.iter().map(|a| lin.term_block(a.term.as_ref(), a.rich, a.shape));
    std::iter::once(lin.common_block()).chain(terms).collect()
}

/// A basis of all that the catalogue could explain, or, where that is too much, of the explanation found; true for all.
fn everything(outcome: &RankedSets, lin: &Linearization, point: &ModelPoint) -> (DMatrix<f64>, bool) {
    let basis = orthonormal(catalogue(outcome, lin, point));
    let most = LARGEST_SHARE * lin.numbers();
    let is_complete = basis.ncols() as f64 <= most;
    (if is_complete { basis } else { alone(lin, point) }, is_complete)
}

/// A basis of the explanation found.
fn alone(lin: &Linearization, point: &ModelPoint) -> DMatrix<f64> {
    orthonormal(beside(&explained(lin, point)))
}

/// Columns of the explanation found, and of every candidate in several of its forms; those of some conditions at a time.
fn catalogue(outcome: &RankedSets, lin: &Linearization, point: &ModelPoint) -> DMatrix<f64> {
    let some_forms = |candidate: &Candidate| {
        let forms: Vec<_> = candidate.spanning_forms(&outcome.gram.blocks).collect();
        let stride = forms.len().div_ceil(SHAPES).max(1);
        forms.into_iter().step_by(stride)
    };
    let forms: Vec<_> = outcome.candidates.iter().flat_map(some_forms).collect();
    let part = |range: &Range<usize>| {
        let part = lin.part_of_noise(range);
        let mut columns = explained(&part, point);
        columns.extend(forms.iter().map(|f| part.term_block(f.version.as_ref(), f.rich, f.shape)));
        Ok::<_, Infallible>((6 * range.start, beside(&columns)))
    };
    let mut all = DMatrix::zeros(0, 0);
    let Ok(()) = try_take_in_order(&lin.parts_of_noise(), part, |(first, columns)| {
        if all.is_empty() {
            all = DMatrix::zeros(lin.equations(), columns.ncols());
        }
        all.rows_mut(first, columns.nrows()).copy_from(&columns);
    });
    all
}
