//! What waves in leg length explain of the residuals, for many periods at once.
//!
//! A wave is the elongation `s cos(k u)` or `s sin(k u)` of one leg or of all, with the commanded lengths `u` and a carrier `s` of 1 or of
//! the change of leg force. With the readers `H` of elongations and the whitening `W`, symmetric with `W W = I - T T'` where errors of
//! readings are independent, and an orthonormal basis `B` of what the fit absorbs, the inner products of two waves `x` and `x'` beside
//! what is absorbed, and of a wave with the whitened residuals `y`, are
//!
//! ```text
//! x' (H'H) x'' - (A' H x)' (A' H x''),   A = [W B, T]
//! x' H' W (I - B B') y
//! ```
//!
//! All are sums over readings of fixed weights times `cos(k u)`. Readings at one pose share `u`: their weights are added once, and a
//! period costs one product of matrices per leg, whatever the number of readings at a pose.

use std::collections::HashMap;
use std::f64::consts::TAU;

use hexbench_core::parallel;
use hexbench_core::{Matrix6, Vector6};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use super::JudgedModel;
use super::association::Look;
use crate::estimation::basis::project;

/// Frequencies to a product of matrices.
const AT_ONCE: usize = 32;
/// A wave of whose square less than this share is left was absorbed by the fit, or by the other waves.
const ABSORBED: f64 = 1e-11;

/// What one period explains.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WaveTest {
    /// Period in leg length, m.
    pub(crate) period: f64,
    /// F of sine and cosine against the floating mean.
    pub(crate) f: f64,
    /// Chance of such an F at this period alone.
    pub(crate) chance: f64,
}

/// Residuals of a model prepared for waves.
pub(crate) struct Waves {
    /// Commanded lengths of every pose, m.
    lengths: Vec<Vector6>,
    /// For a carrier of 1, and of the change of leg force.
    carriers: [Carried; 2],
    /// Square of the residuals.
    square: f64,
    /// Numbers less the rank of the fit.
    freedom: f64,
}

/// Weights of one carrier.
struct Carried {
    /// Of every leg: one row per pose, one column for each of `A` and a last one for the residuals.
    fixed: Vec<DMatrix<f64>>,
    /// `H'H` of every pose.
    own: Vec<Matrix6>,
}

impl Waves {
    /// Those of a model; none where errors of readings are correlated.
    pub(crate) fn of(judged: &JudgedModel<'_>) -> Option<Self> {
        let taken = judged.lin.whitened_out()?;
        let mut left = judged.white.clone();
        project(&judged.basis, &mut left);
        let fixed = [judged.lin.whitened(judged.basis.clone()), taken, judged.lin.whitened(column(left))];
        let readers = judged.lin.elongation_readers();
        let poses = Poses::of(judged);
        let carried = |is_force: bool| {
            let carrier = |i: usize| {
                if is_force { judged.lin.conditions[i].force_change() } else { Vector6::repeat(1.0) }
            };
            Carried::of(&fixed, &readers, &poses, carrier)
        };
        Some(Self {
            carriers: [carried(false), carried(true)],
            lengths: poses.lengths,
            square: judged.white.norm_squared(),
            freedom: judged.white.len() as f64 - judged.rank,
        })
    }

    /// The periods at which waves of a look have a test, in their order.
    pub(crate) fn tests(&self, look: &Look<'_>, periods: &[f64]) -> Vec<WaveTest> {
        let legs: Vec<usize> = (0..6).filter(|l| look.leg.is_none_or(|only| only == *l)).collect();
        let carried = &self.carriers[usize::from(look.compliance)];
        let floating = Floating::of(carried, &legs);
        let chunks: Vec<&[f64]> = periods.chunks(AT_ONCE).collect();
        parallel::map(&chunks, |chunk| self.chunk(carried, &legs, &floating, chunk)).concat()
    }

    fn chunk(
        &self,
        carried: &Carried,
        legs: &[usize],
        floating: &Floating,
        periods: &[f64],
    ) -> Vec<WaveTest> {
        let wave = |f: fn(f64) -> f64, leg: usize| {
            DMatrix::from_fn(self.lengths.len(), periods.len(), |p, k| {
                f(TAU * self.lengths[p][leg] / periods[k])
            })
        };
        let both = |leg: &usize| [wave(f64::cos, *leg), wave(f64::sin, *leg)];
        let waves: Vec<[DMatrix<f64>; 2]> = legs.iter().map(both).collect();
        let along = |part: usize| {
            let sums = legs.iter().zip(&waves).map(|(&leg, w)| carried.fixed[leg].tr_mul(&w[part]));
            sums.reduce(|a, b| a + b).unwrap_or_default()
        };
        let (along_cos, along_sin) = (along(0), along(1));
        let at = |(k, &period): (usize, &f64)| {
            let with = [&along_cos, &along_sin].map(|a| a.column(k).into_owned());
            let of_pose = |p: usize| {
                [0, 1].map(|part| {
                    let mut elongation = Vector6::zeros();
                    legs.iter().zip(&waves).for_each(|(&leg, w)| elongation[leg] = w[part][(p, k)]);
                    elongation
                })
            };
            let mut own = Matrix3::zeros();
            for (p, square) in carried.own.iter().enumerate() {
                let [cos, sin] = of_pose(p);
                let (by_cos, by_sin) = (square * cos, square * sin);
                own += symmetric([
                    0.0,
                    floating.legs.dot(&by_cos),
                    floating.legs.dot(&by_sin),
                    cos.dot(&by_cos),
                    cos.dot(&by_sin),
                    sin.dot(&by_sin),
                ]);
            }
            own[(0, 0)] = floating.own;
            self.test(period, &own, &[floating.along.clone(), with[0].clone(), with[1].clone()])
        };
        periods.iter().enumerate().filter_map(at).collect()
    }

    /// The test of cosine and sine beside the floating mean, from the squares of the three before anything is absorbed, and from their
    /// inner products with the fixed columns.
    fn test(&self, period: f64, own: &Matrix3<f64>, along: &[DVector<f64>; 3]) -> Option<WaveTest> {
        let last = along[0].len() - 1;
        let absorbed = |i: usize, j: usize| along[i].rows(0, last).dot(&along[j].rows(0, last));
        let mut gram = Matrix3::from_fn(|i, j| own[(i, j)] - absorbed(i, j));
        let mut with = Vector3::from_fn(|i, _| along[i][last]);
        let (mut before, mut explained, mut taken) = (self.square, 0.0, [false; 3]);
        for i in 0..3 {
            if gram[(i, i)] <= ABSORBED * own[(i, i)] {
                continue;
            }
            taken[i] = true;
            let share = with[i] * with[i] / gram[(i, i)];
            if i == 0 {
                before -= share;
            } else {
                explained += share;
            }
            let column = gram.column(i) / gram[(i, i)];
            with -= column * with[i];
            gram -= column * gram.row(i);
        }
        let gained = f64::from(u8::from(taken[1])) + f64::from(u8::from(taken[2]));
        let dof = self.freedom - gained - f64::from(u8::from(taken[0]));
        let after = before - explained;
        if gained < 1.0 || dof < 3.0 || after <= 0.0 {
            return None;
        }
        let f = explained / gained / (after / dof);
        f.is_finite().then(|| WaveTest { period, f, chance: chance(f, gained, dof) })
    }
}

/// Chance of an F this large; with two columns the law has a closed form.
fn chance(f: f64, gained: f64, dof: f64) -> f64 {
    if gained > 1.5 {
        return (-0.5 * dof * (2.0 * f / dof).ln_1p()).exp();
    }
    FisherSnedecor::new(gained, dof).map_or(1.0, |law| law.sf(f))
}

/// What belongs to a constant elongation times the carrier.
struct Floating {
    legs: Vector6,
    own: f64,
    along: DVector<f64>,
}

impl Floating {
    fn of(carried: &Carried, legs: &[usize]) -> Self {
        let ones = Vector6::from_fn(|leg, _| f64::from(u8::from(legs.contains(&leg))));
        let sums = legs.iter().map(|&leg| carried.fixed[leg].row_sum().transpose());
        Self {
            legs: ones,
            own: carried.own.iter().map(|m| ones.dot(&(m * ones))).sum(),
            along: sums.reduce(|a, b| a + b).unwrap_or_default(),
        }
    }
}

impl Carried {
    fn of(
        fixed: &[DMatrix<f64>],
        readers: &[Matrix6],
        poses: &Poses,
        carrier: impl Fn(usize) -> Vector6,
    ) -> Self {
        let columns: usize = fixed.iter().map(DMatrix::ncols).sum();
        let mut all = Self {
            fixed: vec![DMatrix::zeros(poses.lengths.len(), columns); 6],
            own: vec![Matrix6::zeros(); poses.lengths.len()],
        };
        for (i, (reader, &pose)) in readers.iter().zip(&poses.of_condition).enumerate() {
            let carried = reader * Matrix6::from_diagonal(&carrier(i));
            all.own[pose] += carried.tr_mul(&carried);
            for (k, column) in fixed.iter().flat_map(DMatrix::column_iter).enumerate() {
                let weights = carried.tr_mul(&column.fixed_rows::<6>(6 * i));
                (0..6).for_each(|leg| all.fixed[leg][(pose, k)] += weights[leg]);
            }
        }
        all
    }
}

/// Conditions of the same commanded lengths.
pub(super) struct Poses {
    /// Lengths of each, m.
    pub(super) lengths: Vec<Vector6>,
    of_condition: Vec<usize>,
}

impl Poses {
    pub(super) fn of(judged: &JudgedModel<'_>) -> Self {
        let (mut lengths, mut known) = (Vec::new(), HashMap::new());
        let of_condition = judged.lin.conditions.iter().map(|c| {
            let bits: [u64; 6] = c.commanded_lengths.map(f64::to_bits).into();
            *known.entry(bits).or_insert_with(|| {
                lengths.push(c.commanded_lengths);
                lengths.len() - 1
            })
        });
        let of_condition = of_condition.collect();
        Self { lengths, of_condition }
    }
}

fn column(values: DVector<f64>) -> DMatrix<f64> {
    DMatrix::from_columns(&[values])
}

/// Upper triangle row by row.
fn symmetric([aa, ab, ac, bb, bc, cc]: [f64; 6]) -> Matrix3<f64> {
    Matrix3::new(aa, ab, ac, ab, bb, bc, ac, bc, cc)
}
