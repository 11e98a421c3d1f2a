//! What elongations of the legs, or what else has six components, do to the whitened readings, less what springs, inputs and the effects already
//! in the model take.

use hexbench_core::{Matrix6, Vector6};
use nalgebra::{DMatrix, DVector};

use crate::estimation::linearization::{Linearization, beside};

/// What columns keep beside those there already at least, as a share of their length: one that those span would keep nothing but rounding.
const RIDGE: f64 = 1e-9;

/// Values of a factor: six legs at every condition.
pub(crate) type Values = Vec<[f64; 6]>;

/// Columns of a law or a pattern: one, or two for a wave.
pub(crate) type LawColumns = Vec<Values>;

/// What stands beside any further column: residual and columns already there, each whitened once more, so that they meet a column that is not
/// whitened at all.
pub(crate) struct WhitenedTwice {
    residual: DVector<f64>,
    /// A row for each equation.
    columns: DMatrix<f64>,
}

impl WhitenedTwice {
    /// Of an orthonormal basis, and of what it leaves of the whitened residuals.
    pub(crate) fn of(lin: &Linearization, basis: DMatrix<f64>, residual: DVector<f64>) -> Self {
        let columns = [Some(lin.whitened(basis)), lin.input_block()];
        let columns = beside(&columns.into_iter().flatten().collect::<Vec<_>>());
        Self { residual: lin.whitened_column(residual), columns }
    }
}

/// A column per leg and condition as values `phi`, six per condition, gives the whitened and projected reading
/// `A phi`, and
///
/// ```text
/// A' r = share,   A' A = R' R - U' U
/// ```
///
/// with the readers `R` of the conditions. `U` has a row for every input within its tolerance and every column already in the model.
/// Errors that readings share are left out: what survives is weighed with them.
pub(crate) struct ElongationSpace {
    /// `A' r`, six per condition.
    share: Vec<Vector6>,
    /// `R' R` of every condition.
    length: Vec<Matrix6>,
    /// `U` of each leg: a row for each of its rows, a column per condition.
    taken: [DMatrix<f64>; 6],
    /// Elongation natural to the machine under these loads, m.
    elongation: f64,
}

impl ElongationSpace {
    /// By the reading per unit of six components, at every condition.
    pub(crate) fn of(readers: &[Matrix6], twice: &WhitenedTwice, elongation: f64) -> Self {
        let WhitenedTwice { residual, columns: rows } = twice;
        let share = readers.iter().enumerate().map(|(i, r)| r.tr_mul(&residual.fixed_rows::<6>(6 * i)));
        let mut taken = [(); 6].map(|()| DMatrix::zeros(rows.ncols(), readers.len()));
        for (i, reader) in readers.iter().enumerate() {
            let along = rows.fixed_rows::<6>(6 * i).tr_mul(reader);
            for (of_leg, column) in taken.iter_mut().zip(along.column_iter()) {
                of_leg.set_column(i, &column);
            }
        }
        Self {
            share: share.collect(),
            length: readers.iter().map(|r| r.tr_mul(r)).collect(),
            taken,
            elongation,
        }
    }

    /// Normal equations of some laws, one or two columns per leg each, in units of the natural elongation. Many at once share one product
    /// of matrices.
    pub(crate) fn sums(&self, laws: &[LawColumns]) -> Vec<LegSums> {
        let all: Vec<&Values> = laws.iter().flatten().collect();
        let overlaps = std::array::from_fn(|leg| {
            let of_leg = all.iter().flat_map(|column| column.iter().map(move |phi| phi[leg]));
            &self.taken[leg] * DMatrix::from_iterator(self.share.len(), all.len(), of_leg)
        });
        let mut first = 0;
        let one = |law: &LawColumns| {
            first += law.len();
            self.of_law(law, &overlaps, first - law.len())
        };
        laws.iter().map(one).collect()
    }

    /// Those of one; `first`: place of its columns among those of the overlaps.
    fn of_law(&self, law: &LawColumns, overlaps: &[DMatrix<f64>; 6], first: usize) -> LegSums {
        let mut sums = LegSums { columns: law.len(), ..LegSums::default() };
        for (w, column) in law.iter().enumerate() {
            for (phi, share) in column.iter().zip(&self.share) {
                (0..6).for_each(|leg| sums.b[6 * w + leg] += phi[leg] * share[leg]);
            }
            for (v, other) in law.iter().enumerate().take(w + 1) {
                for (i, row) in self.lengths(column, other).into_iter().enumerate() {
                    sums.g[6 * w + i][6 * v..6 * v + 6].copy_from_slice(&row);
                }
            }
        }
        let overlap = |k: usize| overlaps[k % 6].column(first + k / 6);
        for i in 0..6 * law.len() {
            sums.g[i][i] *= 1.0 + RIDGE;
            for j in 0..=i {
                sums.g[i][j] -= overlap(i).dot(&overlap(j));
                sums.g[j][i] = sums.g[i][j];
            }
        }
        let square: f64 = law.iter().flatten().flatten().map(|x| x * x).sum();
        let count = (6 * self.share.len() * law.len()).max(1) as f64;
        sums.scale = if square > 0.0 { self.elongation / (square / count).sqrt() } else { 0.0 };
        sums
    }

    /// Products of two columns, leg by leg.
    fn lengths(&self, a: &[[f64; 6]], b: &[[f64; 6]]) -> [[f64; 6]; 6] {
        let mut sums = [[0.0; 6]; 6];
        for ((x, y), length) in a.iter().zip(b).zip(&self.length) {
            // As `R' R` is symmetric, its columns are its rows; their numbers stand together.
            for ((sums, length), x) in sums.iter_mut().zip(&length.data.0).zip(x) {
                for ((sum, length), y) in sums.iter_mut().zip(length).zip(y) {
                    *sum += x * length * y;
                }
            }
        }
        sums
    }
}

/// Normal equations of the columns of six legs, leg by leg; those of any choice of legs are sums of them.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct LegSums {
    pub(crate) columns: usize,
    pub(crate) b: [f64; 12],
    pub(crate) g: [[f64; 12]; 12],
    /// Size that gives the natural elongation, SI.
    pub(crate) scale: f64,
}

impl LegSums {
    /// Drop of chi-square when the columns are added in a choice of legs.
    pub(crate) fn drop(&self, signs: [i8; 6]) -> f64 {
        let (b, g) = self.of(signs);
        let one = |b: f64, g: f64| if g > 0.0 { b * b / g } else { 0.0 };
        if self.columns < 2 || g[0] <= 0.0 {
            return one(b[0], g[0]);
        }
        // What the second column has beside the first.
        one(b[0], g[0]) + one(b[1] - g[1] / g[0] * b[0], g[2] - g[1] * g[1] / g[0])
    }

    /// Normal equations of one choice of legs: `b`, then `g` of first, mixed, second column.
    pub(crate) fn of(&self, signs: [i8; 6]) -> ([f64; 2], [f64; 3]) {
        let (mut b, mut g) = ([0.0; 2], [0.0; 3]);
        let sign = signs.map(f64::from);
        let along = |row: &[f64; 12], first: usize| -> f64 { (0..6).map(|j| row[first + j] * sign[j]).sum() };
        for i in (0..6).filter(|&leg| signs[leg] != 0) {
            b[0] += sign[i] * self.b[i];
            g[0] += sign[i] * along(&self.g[i], 0);
            if self.columns == 2 {
                b[1] += sign[i] * self.b[6 + i];
                g[1] += sign[i] * along(&self.g[6 + i], 0);
                g[2] += sign[i] * along(&self.g[6 + i], 6);
            }
        }
        (b.map(|x| x * self.scale), g.map(|x| x * self.scale * self.scale))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimation::basis::{orthonormal, project};
    use crate::inference::evidence::drop_of;

    /// Numbers without a pattern.
    fn mixed(k: usize) -> f64 {
        (k as f64 * 1.7 + 0.3).sin() + (k as f64 * 0.9).powi(2).cos()
    }

    #[test]
    fn sums_drop_chi_square_as_the_columns_of_the_legs_concerned_do() {
        let n = 20;
        let readers: Vec<Matrix6> =
            (0..n).map(|i| Matrix6::from_fn(|a, b| mixed(36 * i + 6 * a + b))).collect();
        let basis = orthonormal(DMatrix::from_fn(6 * n, 5, |i, j| mixed(1000 + 7 * i + 31 * j)));
        let mut residual = DVector::from_fn(6 * n, |i, _| mixed(5000 + i));
        project(&basis, &mut residual);
        let twice = WhitenedTwice { residual: residual.clone(), columns: basis.clone() };
        let space = ElongationSpace::of(&readers, &twice, 1e-4);
        let value = |law: usize, w: usize, i: usize, leg: usize| mixed(900 * law + 40 * i + 10 * w + leg);
        let widths = [2, 0, 1, 2];
        let column = |law: usize, w: usize| -> Values {
            (0..n).map(|i| std::array::from_fn(|leg| value(law, w, i, leg))).collect()
        };
        let laws: Vec<LawColumns> = widths
            .iter()
            .enumerate()
            .map(|(law, &width)| (0..width).map(|w| column(law, w)).collect())
            .collect();
        for ((law, sums), &width) in space.sums(&laws).iter().enumerate().zip(&widths) {
            for signs in [[1; 6], [0, 0, 1, 0, 0, 0], [1, -1, 0, 1, -1, 0]] {
                let mut columns = DMatrix::zeros(6 * n, width);
                for (i, reader) in readers.iter().enumerate() {
                    for w in 0..width {
                        let own = Vector6::from_fn(|leg, _| f64::from(signs[leg]) * value(law, w, i, leg));
                        columns.fixed_view_mut::<6, 1>(6 * i, w).copy_from(&(reader * own));
                    }
                }
                let met = basis.tr_mul(&columns);
                let expected =
                    drop_of(columns.tr_mul(&columns) - met.tr_mul(&met), &columns.tr_mul(&residual));
                let drop = sums.drop(signs);
                assert!(
                    (drop - expected).abs() < 1e-6 * expected.max(1.0),
                    "{law} {signs:?}: {drop} {expected}"
                );
                assert_eq!(drop > 0.0, width > 0);
            }
        }
    }

    #[test]
    fn a_second_column_like_the_first_adds_nothing() {
        let mut sums = LegSums { columns: 2, scale: 1.0, ..LegSums::default() };
        (sums.b[0], sums.b[6]) = (3.0, 6.0);
        (sums.g[0][0], sums.g[6][0], sums.g[0][6], sums.g[6][6]) = (4.0, 8.0, 8.0, 16.0);
        assert!((sums.drop([1, 0, 0, 0, 0, 0]) - 2.25).abs() < 1e-12);
        assert!(sums.drop([0, 1, 0, 0, 0, 0]).abs() < 1e-12);
    }
}
