//! Columns of a term that lengthens legs and does nothing else, at many of its shapes.
//!
//! With the basis `B` of what is there already, the residual `r`, readings `R_i` of leg elongations and whitening `W W = I - T T'`, a
//! term with elongations `X` takes off chi-square
//!
//! ```text
//! b' G^-1 b,   b = X' W r,   G = X'X - X'T T'X - X'W B B'W X
//! ```
//!
//! Everything but `X` is the same for all shapes. Six numbers per condition and column of `[W B, T, W r]` are kept, from which a shape
//! takes one sum; no column of it is made.

use std::ops::Range;

use hexbench_core::parallel;
use hexbench_core::{Matrix6, Vector6};
use nalgebra::{DMatrix, DVector};

use crate::effects::chain::Action;
use crate::effects::period::{TURNS, Turned};
use crate::effects::term::Term;
use crate::estimation::linearization::{Linearization, actions, beside, parts_of};
use crate::inference::evidence::drop_of;

/// Sine and cosine in each leg.
const WAVES: usize = 12;

/// What elongations of the legs meet at every condition.
pub(crate) struct Elongations<'a> {
    lin: &'a Linearization,
    /// `R'[W B, T, W r]` of every leg: one column for each condition.
    met: [DMatrix<f64>; 6],
    /// `R'R`.
    lengths: Vec<Matrix6>,
}

/// Elongation of one leg per unit of one parameter, m.
struct Share {
    parameter: usize,
    leg: usize,
    elongation: f64,
}

impl<'a> Elongations<'a> {
    /// Beside an orthonormal basis and the residual without it; none where errors of readings are correlated.
    pub(crate) fn beside(
        lin: &'a Linearization,
        basis: &DMatrix<f64>,
        residual: &DVector<f64>,
    ) -> Option<Self> {
        let rows = fixed_columns(lin, basis, residual)?;
        let readers = lin.elongation_readers();
        let mut met = std::array::from_fn(|_| DMatrix::zeros(rows.ncols(), readers.len()));
        for (i, reader) in readers.iter().enumerate() {
            let all = rows.fixed_rows::<6>(6 * i).tr_mul(reader);
            met.iter_mut().zip(all.column_iter()).for_each(|(of_leg, met)| of_leg.set_column(i, &met));
        }
        Some(Self { lin, met, lengths: readers.iter().map(|r| r.tr_mul(r)).collect() })
    }

    /// Drop of chi-square when a term in its plain form is added; none when it does not lengthen legs alone.
    pub(crate) fn drop(&self, term: &dyn Term, shape: f64) -> Option<f64> {
        let (mut found, mut shares) = (Vec::new(), Vec::new());
        let parameters = term.info().parameters.len();
        let mut met = DMatrix::zeros(self.met[0].nrows(), parameters);
        let mut lengths = DMatrix::zeros(parameters, parameters);
        for (i, at) in self.lin.conditions.iter().enumerate() {
            actions(term, false, shape, &self.lin.machine, at, &mut found);
            shares_of(&found, &mut shares)?;
            for (k, share) in shares.iter().enumerate() {
                let along = self.met[share.leg].column(i);
                met.column_mut(share.parameter).axpy(share.elongation, &along, 1.0);
                for other in &shares[..=k] {
                    let product =
                        share.elongation * other.elongation * self.lengths[i][(share.leg, other.leg)];
                    lengths[(share.parameter, other.parameter)] += product;
                    if share.leg != other.leg && share.parameter == other.parameter {
                        lengths[(share.parameter, share.parameter)] += product;
                    }
                }
            }
        }
        Some(drop_beside(lengths, &met))
    }

    /// The same at many shapes of a term that is a wave in every leg; none when it is not.
    pub(crate) fn drops_of_waves(&self, term: &dyn Term, shapes: &[f64]) -> Option<Vec<f64>> {
        term.waves(self.lin.conditions.first()?, *shapes.first()?)?;
        let chunks: Vec<&[f64]> = shapes.chunks(TURNS).collect();
        Some(parallel::map(&chunks, |chunk| self.drops_of_chunk(term, chunk)).concat())
    }

    fn drops_of_chunk(&self, term: &dyn Term, shapes: &[f64]) -> Vec<f64> {
        let width = self.met[0].nrows();
        let mut along: [_; 6] = std::array::from_fn(|_| DMatrix::zeros(width, 2 * shapes.len()));
        let mut lengths = vec![[[0.0; WAVES]; WAVES]; shapes.len()];
        for range in parts_of(self.lin.conditions.len()) {
            let waves = self.waves(term, shapes, range.clone());
            for ((sum, met), waves) in along.iter_mut().zip(&self.met).zip(&waves) {
                sum.gemm(1.0, &met.columns(range.start, range.len()), waves, 1.0);
            }
            for (k, lengths) in lengths.iter_mut().enumerate() {
                add_lengths(lengths, &self.lengths[range.clone()], &waves, 2 * k);
            }
        }
        let drop = |(k, lengths): (usize, [[f64; WAVES]; WAVES])| {
            let lengths = DMatrix::from_fn(WAVES, WAVES, |i, j| lengths[i][j]);
            let column = |c: usize| along[c / 2].column(2 * k + c % 2);
            let columns: Vec<_> = (0..WAVES).map(column).collect();
            drop_beside(lengths, &DMatrix::from_columns(&columns))
        };
        lengths.into_iter().enumerate().map(drop).collect()
    }

    /// Of every leg: sine and cosine at each shape, one row per condition.
    fn waves(&self, term: &dyn Term, shapes: &[f64], range: Range<usize>) -> [DMatrix<f64>; 6] {
        let mut all: [_; 6] = std::array::from_fn(|_| DMatrix::zeros(range.len(), 2 * shapes.len()));
        let turned = Turned::of(shapes);
        for (i, at) in self.lin.conditions[range].iter().enumerate() {
            let mut put = |k: usize, [sines, cosines]: [Vector6; 2]| {
                for (leg, of_leg) in all.iter_mut().enumerate() {
                    (of_leg[(i, 2 * k)], of_leg[(i, 2 * k + 1)]) = (sines[leg], cosines[leg]);
                }
            };
            let waves = |shape: f64| term.waves(at, shape).unwrap_or_default();
            match &turned {
                Some(turned) => turned.each(shapes.len(), waves, put),
                None => shapes.iter().enumerate().for_each(|(k, &shape)| put(k, waves(shape))),
            }
        }
        all
    }
}

/// Adds `X'X` of sines and cosines in the columns from `first` on; what is above the diagonal of legs stays as it is.
fn add_lengths(
    sums: &mut [[f64; WAVES]; WAVES],
    lengths: &[Matrix6],
    waves: &[DMatrix<f64>; 6],
    first: usize,
) {
    for (i, length) in lengths.iter().enumerate() {
        let at: [[f64; 2]; 6] = std::array::from_fn(|leg| [0, 1].map(|part| waves[leg][(i, first + part)]));
        for a in 0..6 {
            for b in 0..=a {
                let along = at[b].map(|wave| length[(a, b)] * wave);
                for (part, wave) in at[a].iter().enumerate() {
                    sums[2 * a + part][2 * b] += wave * along[0];
                    sums[2 * a + part][2 * b + 1] += wave * along[1];
                }
            }
        }
    }
}

/// `b' G^-1 b` from the lower triangle of `X'X`, and from what the columns meet, the residual last.
fn drop_beside(mut lengths: DMatrix<f64>, met: &DMatrix<f64>) -> f64 {
    lengths.fill_upper_triangle_with_lower_triangle();
    let last = met.nrows() - 1;
    let residual = met.row(last).transpose();
    let others = met.rows(0, last);
    drop_of(lengths - others.tr_mul(&others), &residual)
}

/// `[W B, T, W r]`: what an elongation meets beside an orthonormal basis `B` of what is there already, `r` what that leaves of the
/// whitened residuals; none where errors of readings are correlated.
pub(crate) fn fixed_columns(
    lin: &Linearization,
    basis: &DMatrix<f64>,
    left: &DVector<f64>,
) -> Option<DMatrix<f64>> {
    let taken = lin.whitened_out()?;
    let left = lin.whitened_column(left.clone());
    let left = DMatrix::from_column_slice(left.len(), 1, left.as_slice());
    Some(beside(&[lin.whitened(basis.clone()), taken, left]))
}

/// Elongations of single legs; none when an action does anything else.
fn shares_of(actions: &[Action], out: &mut Vec<Share>) -> Option<()> {
    out.clear();
    for (parameter, action) in actions.iter().enumerate() {
        let Action::Elongation(all) = action else { return None };
        let of_leg = |(leg, &elongation): (usize, &f64)| Share { parameter, leg, elongation };
        out.extend(all.iter().enumerate().filter(|(_, e)| **e != 0.0).map(of_leg));
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use hexbench_core::{Hexapod, Measurand, Metrology};

    use super::*;
    use crate::estimation::basis::{orthonormal, project};
    use crate::estimation::campaign::Campaign;
    use crate::estimation::linearization::ModelPoint;
    use crate::estimation::tolerances::within_tolerances;
    use crate::terms::catalogue;
    use crate::test_machine::readings;

    /// By the columns themselves.
    fn drop_of_columns(
        lin: &Linearization,
        basis: &DMatrix<f64>,
        residual: &DVector<f64>,
        term: &dyn Term,
        shape: f64,
    ) -> f64 {
        let columns = lin.term_block(term, false, shape);
        let overlap = basis.tr_mul(&columns);
        drop_of(columns.tr_mul(&columns) - overlap.tr_mul(&overlap), &columns.tr_mul(residual))
    }

    #[test]
    fn sums_over_elongations_are_those_over_columns() {
        let metrology = Some(Metrology { sigma_translation: 0.3e-6, sigma_rotation: 2e-6 });
        let (machine, mut data) = readings(Measurand::DeflectionEuler, Vec::new());
        for (o, k) in data.observations.iter_mut().zip(1_u8..) {
            o.delta_t = 0.1 * f64::from(k) * f64::from(k);
            o.measured[usize::from(k) % 6] += 2e-6;
        }
        let hexapod = Hexapod { metrology, ..machine };
        let campaign = within_tolerances(Campaign::new(&hexapod, &data).unwrap());
        let point =
            ModelPoint { compliances: hexbench_core::Vector6::repeat(1e-7), ..ModelPoint::start(&campaign) };
        let lin = Linearization::at(&campaign, &point).unwrap();
        assert!(lin.whitened_out().is_some_and(|taken| taken.ncols() > 10));
        let basis = orthonormal(lin.common_block());
        let mut residual = lin.residuals();
        project(&basis, &mut residual);
        let elongations = Elongations::beside(&lin, &basis, &residual).unwrap();
        let find = |id: &str| catalogue().into_iter().find(|term| term.info().id == id);
        for (id, shape) in [("thermal-expansion", 1.0), ("actuator-pitch", 0.004), ("actuator-pitch", 0.0311)]
        {
            let term = find(id).unwrap();
            let expected = drop_of_columns(&lin, &basis, &residual, term.as_ref(), shape);
            let found = elongations.drop(term.as_ref(), shape).unwrap();
            assert!(expected > 1.0 && (found / expected - 1.0).abs() < 1e-9, "{id}: {found} {expected}");
            let Some(many) = elongations.drops_of_waves(term.as_ref(), &[2.0 * shape, shape]) else {
                continue;
            };
            assert!(id == "actuator-pitch" && (many[1] / expected - 1.0).abs() < 1e-9, "{many:?} {expected}");
        }
        assert!(elongations.drop(find("creep").unwrap().as_ref(), 100.0).is_none());
    }
}
