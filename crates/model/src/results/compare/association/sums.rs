//! The tests of all questions from one pass over the conditions.
//!
//! The elongations of a look at the legs stand side by side, those of a part of the conditions below each other: one product of matrices
//! has all that they are along the fixed columns, another all their squares.

use std::convert::Infallible;
use std::ops::Range;

use hexbench_core::{Matrix6, Vector6};
use nalgebra::{DMatrix, DVector, Matrix3};

use super::questions::{Question, Values};
use crate::estimation::linearization::parts_of;
use crate::estimation::parallel::try_take_in_order;
use crate::results::compare::JudgedModel;
use crate::results::compare::added::Unexplained;

/// What every elongation of every question meets.
struct Met<'a> {
    judged: &'a JudgedModel<'a>,
    values: &'a [Values],
    readers: Vec<Matrix6>,
    /// Columns that the fit absorbs, and the residuals, as of [`Unexplained::of`].
    fixed: DMatrix<f64>,
    looks: Vec<Columns<'a>>,
}

/// Elongations of all questions about one leg, or about all: the two floating ones first, then one or two of each question.
struct Columns<'a> {
    leg: Option<usize>,
    /// Questions by their place among all, each with its first column.
    questions: Vec<(usize, &'a Question, usize)>,
    count: usize,
}

/// F and chance of every question; none where errors of readings are correlated.
pub(super) fn tests(
    judged: &JudgedModel<'_>,
    values: &[Values],
    questions: &[Question],
) -> Option<Vec<Option<(f64, f64)>>> {
    let (unexplained, fixed) = Unexplained::of(judged)?;
    let looks: Vec<Columns<'_>> =
        std::iter::once(None).chain((0..6).map(Some)).map(|leg| Columns::of(leg, questions)).collect();
    let met = Met { judged, values, readers: judged.lin.elongation_readers(), fixed, looks };
    let sums = met.sums();
    let mut found = vec![None; questions.len()];
    for (look, sums) in met.looks.iter().zip(&sums) {
        for &(place, question, first) in &look.questions {
            found[place] = met.test(&unexplained, sums, question, first);
        }
    }
    Some(found)
}

impl<'a> Columns<'a> {
    fn of(leg: Option<usize>, questions: &'a [Question]) -> Self {
        let mut all = Self { leg, questions: Vec::new(), count: 2 };
        for (place, question) in questions.iter().enumerate().filter(|(_, q)| q.leg == leg) {
            all.questions.push((place, question, all.count));
            all.count += question.powers();
        }
        all
    }

    /// Elongations under one condition.
    fn elongations(&self, force_change: &Vector6, values: &Values, mut put: impl FnMut(usize, Vector6)) {
        let carriers = [Vector6::repeat(1.0), *force_change];
        put(0, carriers[0]);
        put(1, carriers[1]);
        for &(_, question, first) in &self.questions {
            let x = question.scaled(values);
            let once = carriers[usize::from(question.compliance)].component_mul(&x);
            put(first, once);
            if question.powers() > 1 {
                put(first + 1, once.component_mul(&x));
            }
        }
    }
}

impl Met<'_> {
    /// Of every look: what its elongations are along the fixed columns, their products with each other below.
    fn sums(&self) -> Vec<DMatrix<f64>> {
        let mut total: Vec<DMatrix<f64>> = Vec::new();
        let part = |range: &Range<usize>| Ok::<_, Infallible>(self.part(range));
        let Ok(()) = try_take_in_order(&parts_of(self.readers.len()), part, |pieces| {
            if total.is_empty() {
                total = pieces;
            } else {
                total.iter_mut().zip(pieces).for_each(|(sum, piece)| *sum += piece);
            }
        });
        total
    }

    fn part(&self, range: &Range<usize>) -> Vec<DMatrix<f64>> {
        let fixed = self.fixed.rows(6 * range.start, 6 * range.len()).transpose();
        self.looks.iter().map(|look| self.part_of(look, range, &fixed)).collect()
    }

    fn part_of(&self, look: &Columns<'_>, range: &Range<usize>, fixed: &DMatrix<f64>) -> DMatrix<f64> {
        let mut readings = DMatrix::zeros(6 * range.len(), look.count);
        for (at, i) in range.clone().enumerate() {
            let reader = &self.readers[i];
            let force_change = self.judged.lin.conditions[i].force_change();
            look.elongations(&force_change, &self.values[i], |column, elongation| {
                let reading = match look.leg {
                    Some(leg) => reader.column(leg) * elongation[leg],
                    None => reader * elongation,
                };
                readings.fixed_view_mut::<6, 1>(6 * at, column).copy_from(&reading);
            });
        }
        let width = fixed.nrows();
        let mut sums = DMatrix::zeros(width + look.count, look.count);
        sums.rows_mut(0, width).gemm(1.0, fixed, &readings, 0.0);
        sums.rows_mut(width, look.count).gemm(1.0, &readings.transpose(), &readings, 0.0);
        sums
    }

    fn test(
        &self,
        unexplained: &Unexplained,
        sums: &DMatrix<f64>,
        question: &Question,
        first: usize,
    ) -> Option<(f64, f64)> {
        let width = self.fixed.ncols();
        let second = (question.powers() > 1).then_some(first + 1);
        let three = [Some(usize::from(question.compliance)), Some(first), second];
        let own = Matrix3::from_fn(|i, j| match (three[i], three[j]) {
            (Some(a), Some(b)) => sums[(width + a, b)],
            _ => 0.0,
        });
        let along = three.map(|column| {
            column.map_or_else(
                || DVector::zeros(width),
                |k| sums.view((0, k), (width, 1)).column(0).into_owned(),
            )
        });
        unexplained.f_of(&own, &along)
    }
}
