//! What waves in leg length explain of the residuals, for many periods at once.
//!
//! A wave is the elongation `s cos(k u)` or `s sin(k u)` of one leg or of all, with the commanded lengths `u` and a carrier `s` of 1 or of
//! the change of leg force; `added.rs` has its inner products.
//!
//! All are sums over readings of fixed weights times `cos(k u)`. Readings at one pose share `u`: their weights are added once, and a
//! period costs one product of matrices per leg, whatever the number of readings at a pose.

use std::cell::OnceCell;
use std::collections::HashMap;
use std::ops::Range;

use hexbench_core::parallel;
use hexbench_core::{Matrix6, Vector6};
use nalgebra::{DMatrix, DVector, Matrix3};

use super::JudgedModel;
use super::added::Unexplained;
use super::association::Look;
use crate::effects::period::{TURNS, Turned, waves};

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

/// Cosine and sine in each leg: one row per pose, one column per period.
type Waved = [[DMatrix<f64>; 2]; 6];

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

    /// The periods at which waves of each look have a test, in their order.
    pub(crate) fn tests(&self, looks: &[Look<'_>], periods: &[f64]) -> Vec<Vec<WaveTest>> {
        let asked: Vec<Asked<'_>> = looks.iter().map(|look| Asked::of(look, &self.carriers)).collect();
        let chunks: Vec<&[f64]> = periods.chunks(TURNS).collect();
        let mut all = vec![Vec::with_capacity(periods.len()); looks.len()];
        for found in parallel::map(&chunks, |chunk| self.chunk(&asked, chunk)) {
            all.iter_mut().zip(found).for_each(|(tests, more)| tests.extend(more));
        }
        all
    }

    fn chunk(&self, asked: &[Asked<'_>], periods: &[f64]) -> Vec<Vec<WaveTest>> {
        let waves = self.waves(periods);
        let along = self.carriers.each_ref().map(|carried| Along {
            carried,
            waves: &waves,
            legs: Default::default(),
        });
        asked.iter().map(|a| self.tests_of(a, &along[usize::from(a.is_force)], periods)).collect()
    }

    /// Cosine and sine in each leg: one row per pose, one column per period.
    fn waves(&self, periods: &[f64]) -> Waved {
        let zeros = || DMatrix::zeros(self.lengths.len(), periods.len());
        let mut all: [_; 6] = std::array::from_fn(|_| [zeros(), zeros()]);
        let turned = Turned::of(periods);
        for (p, lengths) in self.lengths.iter().enumerate() {
            let mut put = |k: usize, [sine, cosine]: [Vector6; 2]| {
                for (leg, of_leg) in all.iter_mut().enumerate() {
                    (of_leg[0][(p, k)], of_leg[1][(p, k)]) = (cosine[leg], sine[leg]);
                }
            };
            match &turned {
                Some(turned) => turned.each(periods.len(), |period| waves(lengths, period), put),
                None => periods.iter().enumerate().for_each(|(k, &period)| put(k, waves(lengths, period))),
            }
        }
        all
    }

    fn tests_of(&self, asked: &Asked<'_>, along: &Along<'_>, periods: &[f64]) -> Vec<WaveTest> {
        let sums = along.of(&asked.legs);
        let at = |(k, &period): (usize, &f64)| {
            let [cos, sin] = sums.each_ref().map(|part| part.column(k).into_owned());
            let own = asked.own(along.waves, k);
            let (f, chance) = self.unexplained.f_of(&own, &[asked.floating.along.clone(), cos, sin])?;
            Some(WaveTest { period, f, chance })
        };
        periods.iter().enumerate().filter_map(at).collect()
    }
}

/// Sums of the weights of one carrier times waves, which several looks share.
struct Along<'a> {
    carried: &'a Carried,
    /// Cosine and sine in each leg.
    waves: &'a Waved,
    /// Sums of each leg, once they were asked for.
    legs: [OnceCell<[DMatrix<f64>; 2]>; 6],
}

impl Along<'_> {
    /// Over some of the legs: of cosines and of sines, one column per period.
    fn of(&self, legs: &Range<usize>) -> [DMatrix<f64>; 2] {
        let mut all = legs.clone().map(|leg| self.of_leg(leg));
        let first = all.next().cloned().unwrap_or_default();
        all.fold(first, |[cos, sin], [a, b]| [cos + a, sin + b])
    }

    fn of_leg(&self, leg: usize) -> &[DMatrix<f64>; 2] {
        let sums = || self.waves[leg].each_ref().map(|part| self.carried.fixed[leg].tr_mul(part));
        self.legs[leg].get_or_init(sums)
    }
}

/// One look at the residuals.
struct Asked<'a> {
    legs: Range<usize>,
    is_force: bool,
    carried: &'a Carried,
    floating: Floating,
}

impl<'a> Asked<'a> {
    fn of(look: &Look<'_>, carriers: &'a [Carried; 2]) -> Self {
        let legs = look.leg.map_or(0..6, |only| only..only + 1);
        let is_force = look.compliance;
        let carried = &carriers[usize::from(is_force)];
        let floating = Floating::of(carried, legs.clone());
        Self { legs, is_force, carried, floating }
    }

    /// Products of the floating elongation, the cosine and the sine of one period with each other.
    fn own(&self, waves: &Waved, period: usize) -> Matrix3<f64> {
        let columns = waves.each_ref().map(|leg| leg.each_ref().map(|part| part.column(period)));
        let mut own = [0.0; 6];
        for (p, (square, ones)) in self.carried.own.iter().zip(&self.floating.by_pose).enumerate() {
            let [mut cos, mut sin] = [[0.0; 6]; 2];
            for leg in self.legs.clone() {
                (cos[leg], sin[leg]) = (columns[leg][0][p], columns[leg][1][p]);
            }
            for a in self.legs.clone() {
                let (mut by_cos, mut by_sin) = (0.0, 0.0);
                for b in self.legs.clone() {
                    by_cos += square[(b, a)] * cos[b];
                    by_sin += square[(b, a)] * sin[b];
                }
                own[1] += cos[a] * ones[a];
                own[2] += sin[a] * ones[a];
                own[3] += cos[a] * by_cos;
                own[4] += cos[a] * by_sin;
                own[5] += sin[a] * by_sin;
            }
        }
        own[0] = self.floating.own;
        symmetric(own)
    }
}

/// What belongs to a constant elongation times the carrier.
struct Floating {
    own: f64,
    /// Products of its part in each leg with all of it, at every pose.
    by_pose: Vec<Vector6>,
    along: DVector<f64>,
}

impl Floating {
    fn of(carried: &Carried, legs: Range<usize>) -> Self {
        let sums = legs.clone().map(|leg| carried.fixed[leg].row_sum().transpose());
        let square = |m: &Matrix6| m.view((legs.start, legs.start), (legs.len(), legs.len())).sum();
        let with_all = |m: &Matrix6, a: usize| legs.clone().fold(0.0, |sum, b| sum + m[(b, a)]);
        let by_leg =
            |m: &Matrix6| Vector6::from_fn(|a, _| if legs.contains(&a) { with_all(m, a) } else { 0.0 });
        Self {
            own: carried.own.iter().map(square).sum(),
            by_pose: carried.own.iter().map(by_leg).collect(),
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
