//! Many readings out of candidates: exchange, then excursions.
//!
//! A candidate is a block of rows (a reading, or a pose with all its loads). From a random plan every member is exchanged for
//! the candidate that helps most until nothing helps (Fedorov 1972, in the form of Cook and Nachtsheim 1980); then excursions
//! of the size of the plan lead out of poor optima (DETMAX, Mitchell 1974). The whole is repeated from several starts.

use nalgebra::DMatrix;
use rand::RngExt;
use rand_pcg::Pcg64;
use rayon::prelude::*;

use crate::{Criterion, DesignError};

/// Largest excursion: members added before as many are taken away.
const LONGEST_EXCURSION: usize = 4;
/// Relative gain below which an exchange is rounding.
const LEAST_GAIN: f64 = 1e-12;
/// Share of the mean information that keeps a start invertible until it determines everything.
const RIDGE: f64 = 1e-9;

/// Candidates of an exchange with their information.
pub struct Exchange<'a> {
    information: Vec<DMatrix<f64>>,
    criterion: &'a Criterion,
    ridge: DMatrix<f64>,
}

/// A plan found.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Indices of the candidates, ascending; one that occurs twice is repeated.
    pub members: Vec<usize>,
    /// Value of the criterion.
    pub value: f64,
    /// Starts that ended at this value.
    pub agreeing: usize,
}

impl<'a> Exchange<'a> {
    /// Candidates by their rows (any number of rows, one column per parameter).
    pub fn new(rows: &[DMatrix<f64>], criterion: &'a Criterion) -> Self {
        let information: Vec<DMatrix<f64>> = rows.iter().map(|j| j.tr_mul(j)).collect();
        let p = information.first().map_or(0, DMatrix::ncols);
        let sum = information.iter().fold(DMatrix::zeros(p, p), |sum, m| sum + m);
        let size = RIDGE / information.len().max(1) as f64;
        Self { ridge: DMatrix::from_diagonal(&(sum.diagonal() * size)), information, criterion }
    }

    /// The best plan of `size` members out of several starts; `poses` counts for O1.
    ///
    /// # Errors
    /// [`DesignError::NotDetermined`].
    pub fn search(&self, size: usize, starts: usize, seed: u64) -> Result<Plan, DesignError> {
        let ends: Vec<Plan> = (0..starts as u128)
            .into_par_iter()
            .map(|start| self.climb(self.start(size, &mut Pcg64::new(u128::from(seed), start))))
            .collect();
        let best = ends.iter().cloned().reduce(|a, b| if b.value > a.value { b } else { a });
        let Some(mut best) = best.filter(|b| self.determined(&b.members)) else {
            return Err(DesignError::NotDetermined {
                readings: size,
                parameters: self.ridge.ncols(),
                hint: ": allow more readings, turns or load directions",
            });
        };
        best.agreeing = ends.iter().filter(|e| e.value >= (1.0 - 1e-6) * best.value).count();
        Ok(best)
    }

    fn start(&self, size: usize, rng: &mut Pcg64) -> Vec<usize> {
        (0..size).map(|_| rng.random_range(0..self.information.len())).collect()
    }

    /// Exchanges and excursions until neither helps.
    fn climb(&self, mut members: Vec<usize>) -> Plan {
        let mut value = self.value(&self.sum(&members));
        loop {
            let before = value;
            while self.exchange_all(&mut members, &mut value) {}
            for length in 1..=LONGEST_EXCURSION {
                if self.excursion(&mut members, &mut value, length) {
                    break;
                }
            }
            if value <= before * (1.0 + LEAST_GAIN) {
                members.sort_unstable();
                return Plan { members, value, agreeing: 1 };
            }
        }
    }

    /// Exchanges each member for its best replacement; true when one helped.
    fn exchange_all(&self, members: &mut [usize], value: &mut f64) -> bool {
        let mut helped = false;
        for k in 0..members.len() {
            let rest = self.sum(members) - &self.information[members[k]];
            let (candidate, best) = self.best_addition(&rest);
            if best > *value * (1.0 + LEAST_GAIN) {
                (members[k], *value) = (candidate, best);
                helped = true;
            }
        }
        helped
    }

    /// Adds the best `length` candidates, then takes the least useful away again; keeps what is better.
    fn excursion(&self, members: &mut Vec<usize>, value: &mut f64, length: usize) -> bool {
        let (size, mut trial) = (members.len(), members.clone());
        for _ in 0..length {
            trial.push(self.best_addition(&self.sum(&trial)).0);
        }
        let mut now = *value;
        while trial.len() > size {
            let whole = self.sum(&trial);
            let without = |k: usize| self.value(&(&whole - &self.information[trial[k]]));
            let least =
                (0..trial.len()).map(|k| (k, without(k))).reduce(|a, b| if b.1 > a.1 { b } else { a });
            let Some((k, after)) = least else { return false };
            trial.remove(k);
            now = after;
        }
        if now > *value * (1.0 + LEAST_GAIN) {
            (*members, *value) = (trial, now);
            return true;
        }
        false
    }

    fn best_addition(&self, rest: &DMatrix<f64>) -> (usize, f64) {
        let with = |(k, m): (usize, &DMatrix<f64>)| (k, self.value(&(rest + m)));
        let best = self.information.iter().enumerate().map(with);
        best.reduce(|a, b| if b.1 > a.1 { b } else { a }).unwrap_or((0, 0.0))
    }

    fn sum(&self, members: &[usize]) -> DMatrix<f64> {
        members.iter().fold(self.ridge.clone(), |sum, &k| sum + &self.information[k])
    }

    fn value(&self, information: &DMatrix<f64>) -> f64 {
        self.criterion.value(information, 1)
    }

    fn determined(&self, members: &[usize]) -> bool {
        let information = self.sum(members) - &self.ridge;
        let eigen = information.symmetric_eigenvalues();
        eigen.min() > 1e-7 * RIDGE.sqrt() * eigen.max()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows `1, x, x^2, ...` of points.
    fn rows(points: &[f64], degree: usize) -> Vec<DMatrix<f64>> {
        let powers = |x: f64| std::iter::successors(Some(1.0), move |p| Some(p * x)).take(degree + 1);
        points.iter().map(|&x| DMatrix::from_iterator(1, degree + 1, powers(x))).collect()
    }

    /// Exact D-optimal designs of a quadratic on {-1, 0, 1}: det X'X for 3 to 7 points.
    /// Source: classical theory (Kiefer and Wolfowitz 1960), recomputed by enumeration.
    #[test]
    fn quadratics_on_three_points_reach_the_known_determinants() {
        let candidates = rows(&[-1.0, 0.0, 1.0], 2);
        let exchange = Exchange::new(&candidates, &Criterion::D);
        for (n, det) in [(3, 4.0), (4, 8.0), (5, 16.0), (6, 32.0), (7, 48.0_f64)] {
            let found = exchange.search(n, 4, 1).unwrap().value.powi(3);
            assert!((found / det - 1.0).abs() < 1e-6, "{n} points: {found}, not {det}");
        }
    }

    /// Guest 1958: the D-optimal points of a polynomial are the extrema of the Legendre polynomial.
    #[test]
    fn polynomials_take_the_legendre_points() {
        let points: Vec<f64> = (-1000..=1000).map(|i| f64::from(i) * 1e-3).collect();
        for (degree, inner) in [(3, 0.447_213_595_5), (4, 0.654_653_670_7), (5, 0.765_055_323_9)] {
            let candidates = rows(&points, degree);
            let plan = Exchange::new(&candidates, &Criterion::D).search(degree + 1, 4, 2).unwrap();
            let second = points[plan.members[1]];
            assert!((second + inner).abs() <= 1e-3, "degree {degree}: {second}");
        }
    }

    /// Hotelling 1944: eight weighings of eight objects with signs reach det X'X = 8^8.
    #[test]
    fn weighings_reach_the_hadamard_determinant() {
        let sign = |code: usize, k: usize| if code >> k & 1 == 1 { 1.0 } else { -1.0 };
        let candidates: Vec<DMatrix<f64>> =
            (0..256).map(|code| DMatrix::from_fn(1, 8, |_, k| sign(code, k))).collect();
        let plan = Exchange::new(&candidates, &Criterion::D).search(8, 12, 3).unwrap();
        assert!((plan.value - 8.0).abs() < 1e-6, "{}", plan.value);
    }

    #[test]
    fn too_few_readings_are_refused() {
        let candidates = rows(&[-1.0, 0.0, 1.0], 2);
        let exchange = Exchange::new(&candidates, &Criterion::D);
        assert!(matches!(exchange.search(2, 4, 1), Err(DesignError::NotDetermined { .. })));
    }
}
