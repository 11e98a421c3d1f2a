//! What waves in leg length explain of the residuals, for many periods at once.
//!
//! A wave is the elongation `s cos(k u)` or `s sin(k u)` of one leg or of all, with the commanded lengths `u` and a carrier `s` of 1 or of
//! the change of leg force; `added.rs` has its inner products.
//!
//! All are sums over readings of fixed weights times `cos(k u)`. Readings at one pose share `u`: their weights are added once, and a
//! period costs one product of matrices per leg, whatever the number of readings at a pose.

use std::collections::HashMap;
use std::f64::consts::TAU;

use hexbench_core::parallel;
use hexbench_core::{Matrix6, Vector6};
use nalgebra::{DMatrix, DVector, Matrix3};

use super::JudgedModel;
use super::added::Unexplained;
use super::association::Look;

/// Frequencies to a product of matrices.
const AT_ONCE: usize = 32;

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
    unexplained: Unexplained,
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
        let (unexplained, fixed) = Unexplained::of(judged)?;
        let readers = judged.lin.elongation_readers();
        let poses = Poses::of(judged);
        let carried = |is_force: bool| {
            let carrier = |i: usize| {
                if is_force { judged.lin.conditions[i].force_change() } else { Vector6::repeat(1.0) }
            };
            Carried::of(&fixed, &readers, &poses, carrier)
        };
        Some(Self { carriers: [carried(false), carried(true)], lengths: poses.lengths, unexplained })
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
            let [cos, sin] = with;
            let (f, chance) = self.unexplained.f_of(&own, &[floating.along.clone(), cos, sin])?;
            Some(WaveTest { period, f, chance })
        };
        periods.iter().enumerate().filter_map(at).collect()
    }
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
        fixed: &DMatrix<f64>,
        readers: &[Matrix6],
        poses: &Poses,
        carrier: impl Fn(usize) -> Vector6,
    ) -> Self {
        let mut all = Self {
            fixed: vec![DMatrix::zeros(poses.lengths.len(), fixed.ncols()); 6],
            own: vec![Matrix6::zeros(); poses.lengths.len()],
        };
        for (i, (reader, &pose)) in readers.iter().zip(&poses.of_condition).enumerate() {
            let carried = reader * Matrix6::from_diagonal(&carrier(i));
            all.own[pose] += carried.tr_mul(&carried);
            for (k, column) in fixed.column_iter().enumerate() {
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

/// Upper triangle row by row.
fn symmetric([aa, ab, ac, bb, bc, cc]: [f64; 6]) -> Matrix3<f64> {
    Matrix3::new(aa, ab, ac, ab, bb, bc, ac, bc, cc)
}
