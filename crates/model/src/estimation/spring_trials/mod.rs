//! Simulated campaigns of a machine with springs alone, fitted in closed form: as many as a study needs.
//!
//! ```text
//! y = A c + noise                        one reading, six numbers; A = E L^-1 diag(f), f = L^-T (W - W0), E = diag(I, M^-1)
//! c_fit = (sum A'S A)^-1 sum A'S y       S = diag(1 / sigma^2)
//! ```
//!
//! Every number of every reading gets its own noise, and every campaign its own weighted least squares. Four campaigns run
//! abreast. With a tolerance of the joints every campaign has its own machine, whose joints the fit knows (it is calibrated) and
//! whose regressor is made anew; without one the regressor is the same for all and its inverse is made once. With
//! `B = L E^-1 S^-1/2` and `T = B B'`, noise whitened,
//!
//! ```text
//! A'S A = diag(f) T^-1 diag(f),   A'S y = diag(f) T^-1 B y,   f = T^-1 B S^-1/2 E^-T (W - W0)
//! ```
//!
//! so that one Cholesky factor per pose serves all. Source of the model: Kalas et al. 2018, eq. 12, 13; weights as in generalised
//! least squares.

mod group;

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Hexapod, Observation, Vector3, Vector6};
use rand::distr::Distribution;
use rand_distr::StandardNormal;
use rand_pcg::Pcg64;
use rayon::prelude::*;
use wide::f64x4;

use crate::error::ModelError;
use crate::machine::lanes::{LANES, Matrix, Point, Six, add_square, dot, factor, inverse, splat, substitute};
use group::{AtPose, Group, groups};

/// Campaigns per piece of parallel work, each piece with its own stream of random numbers.
const PIECE: usize = 1024;

/// A plan for a machine of known springs. Lengths in units of the platform radius, compliances of the true ones.
#[derive(Debug, Clone)]
pub struct SpringTrials {
    stiffness: Vector6,
    joints: [[Point; 6]; 2],
    groups: Vec<Group>,
    tolerance: f64,
    fixed: Vec<Estimator>,
}

/// What a group of readings adds to the fit when the machine is the same in every campaign.
#[derive(Debug, Clone)]
struct Estimator {
    mean: Six,
    gain: Matrix,
}

impl SpringTrials {
    /// Readings of deflections (Euler differences) with the noise `sigma` of each of the six numbers (m, rad), by a machine
    /// whose legs have the stiffnesses `k` (N/m). Equal readings are repeats.
    ///
    /// # Errors
    /// [`ModelError::SingularPose`]; [`ModelError::TooFewEquations`] without readings.
    pub fn new(
        hexapod: &Hexapod,
        readings: &[Observation],
        sigma: &[f64; 6],
        stiffness: &[f64; 6],
    ) -> Result<Self, ModelError> {
        let radius = hexapod.platform_radius().max(f64::MIN_POSITIVE);
        let scaled = |joints: &[Vector3; 6]| joints.map(|j| splat(&(j / radius)));
        let mut trials = Self {
            stiffness: Vector6::from(*stiffness),
            joints: [scaled(&hexapod.base_joints), scaled(&hexapod.platform_joints)],
            groups: groups(hexapod, readings, sigma, stiffness, radius)?,
            tolerance: 0.0,
            fixed: Vec::new(),
        };
        trials.fixed = trials.estimators();
        Ok(trials)
    }

    /// The same with joints that lie off by this standard deviation (m) in each coordinate, anew in every campaign.
    #[must_use]
    pub fn with_joint_tolerance(mut self, hexapod: &Hexapod, sigma: f64) -> Self {
        self.tolerance = sigma / hexapod.platform_radius().max(f64::MIN_POSITIVE);
        self
    }

    /// Fitted stiffnesses (N/m) of `count` campaigns; equal seeds give equal ones, on any number of threads.
    pub fn run(&self, count: usize, seed: u64) -> Vec<Vector6> {
        let mut fitted = vec![Vector6::zeros(); count];
        fitted.par_chunks_mut(PIECE).enumerate().for_each(|(piece, fitted)| {
            let mut rng = stream(seed, Purpose::SpringTrials, [piece as u64]);
            for fitted in fitted.chunks_mut(LANES) {
                let relative = if self.tolerance > 0.0 {
                    self.own_machines(&mut rng)
                } else {
                    self.same_machine(&mut rng)
                };
                let relative = relative.map(f64x4::to_array);
                for (lane, k) in fitted.iter_mut().enumerate() {
                    *k = Vector6::from_fn(|leg, _| self.stiffness[leg] / relative[leg][lane]);
                }
            }
        });
        fitted
    }

    fn same_machine(&self, rng: &mut Pcg64) -> Six {
        let mut x = [f64x4::ZERO; 6];
        for (group, estimator) in self.groups.iter().zip(&self.fixed) {
            let noise = mean_noise(group.repeats, rng);
            for row in 0..6 {
                let y = estimator.mean[row] + noise[row];
                for leg in 0..6 {
                    x[leg] = estimator.gain[row][leg].mul_add(y, x[leg]);
                }
            }
        }
        x
    }

    fn own_machines(&self, rng: &mut Pcg64) -> Six {
        let mut ends = self.joints;
        ends.iter_mut().flatten().flatten().for_each(|x| *x += normal(rng) * f64x4::splat(self.tolerance));
        let (mut whole, mut right) = ([[f64x4::ZERO; 6]; 6], [f64x4::ZERO; 6]);
        for group in &self.groups {
            let at = group.at(&ends);
            let noise = mean_noise(group.repeats, rng);
            let repeats = f64x4::splat(group.repeats as f64);
            let seen = substitute(
                &at.factor,
                std::array::from_fn(|leg| at.elongations[leg] + dot(&at.legs[leg], &noise)),
            );
            let inverse = inverse(&at.factor);
            for i in 0..6 {
                let scaled = at.elongations[i] * repeats;
                right[i] += scaled * seen[i];
                for j in 0..=i {
                    whole[i][j] += scaled * inverse[i][j] * at.elongations[j];
                }
            }
        }
        substitute(&factor(whole), right)
    }

    /// `(sum n A'S A)^-1 n A'S^1/2` of each group, and its undisturbed whitened reading, for the machine as drawn.
    fn estimators(&self) -> Vec<Estimator> {
        let poses: Vec<AtPose> = self.groups.iter().map(|g| g.at(&self.joints)).collect();
        let mut whole = [[f64x4::ZERO; 6]; 6];
        let blocks: Vec<Matrix> = poses.iter().map(AtPose::whitened).collect();
        for (group, rows) in self.groups.iter().zip(&blocks) {
            for row in rows {
                add_square(&mut whole, row, f64x4::splat(group.repeats as f64));
            }
        }
        let factor = factor(whole);
        let estimator = |(group, rows): (&Group, &Matrix)| Estimator {
            mean: rows.map(|row| row.iter().fold(f64x4::ZERO, |sum, x| sum + *x)),
            gain: rows.map(|row| substitute(&factor, row.map(|a| a * f64x4::splat(group.repeats as f64)))),
        };
        self.groups.iter().zip(&blocks).map(estimator).collect()
    }
}

/// Mean of the whitened noise of `repeats` readings, four campaigns.
#[inline]
fn mean_noise(repeats: usize, rng: &mut Pcg64) -> Six {
    let mut sum = [f64x4::ZERO; 6];
    for _ in 0..repeats {
        for total in &mut sum {
            *total += normal(rng);
        }
    }
    sum.map(|total| total / f64x4::splat(repeats as f64))
}

#[inline]
fn normal(rng: &mut Pcg64) -> f64x4 {
    let mut four = [0.0; LANES];
    for x in &mut four {
        *x = StandardNormal.sample(rng);
    }
    f64x4::from(four)
}

#[cfg(test)]
mod tests {
    use hexbench_core::{Pose, Wrench};
    use nalgebra::DMatrix;

    use super::*;
    use crate::estimation::paper::block;
    use crate::test_machine::machine;

    const SIGMA: [f64; 6] = [0.8e-6, 0.8e-6, 0.8e-6, 9.6e-6, 9.6e-6, 6.8e-6];
    const STIFFNESS: [f64; 6] = [4.2e6, 3.8e6, 2.75e6, 4.3e6, 3.7e6, 3.73e6];

    fn readings() -> Vec<Observation> {
        let poses = [[2.6, 0.8, -0.7, 15.8], [10.0, -3.4, -0.8, -11.0], [-7.8, -3.2, 1.8, -11.3]];
        let down = |newtons: f64| Wrench::from_array([0.0, 0.0, -newtons, 0.0, 0.0, 0.0]);
        let of = |[a, b, c, gamma]: [f64; 4]| {
            let pose = Pose::from_array([a * 1e-3, b * 1e-3, c * 1e-3, 0.0, 0.0, gamma * 0.017]);
            Observation::unread(pose, down(338.0), down(120.0))
        };
        poses.into_iter().flat_map(|p| [of(p); 3]).collect()
    }

    /// Covariance of the compliances, (m/N)^2, from the regressor of [`crate::estimation::paper`].
    fn covariance() -> DMatrix<f64> {
        let mut normal = DMatrix::zeros(6, 6);
        for o in readings() {
            let mut a = block(&machine(), &o, hexbench_core::Measurand::DeflectionEuler).unwrap();
            a.row_iter_mut().zip(SIGMA).for_each(|(mut row, s)| row.unscale_mut(s));
            normal += a.tr_mul(&a);
        }
        normal.try_inverse().unwrap()
    }

    #[test]
    fn mean_and_spread_of_the_compliances_are_those_of_the_theory() {
        const CAMPAIGNS: usize = 20_000;
        const SIGMAS: f64 = 5.0;
        let n = CAMPAIGNS as f64;
        let covariance = covariance();
        let trials = SpringTrials::new(&machine(), &readings(), &SIGMA, &STIFFNESS).unwrap();
        for fitted in [
            trials.run(CAMPAIGNS, 1),
            // A tolerance far below the noise changes nothing but the route: every campaign has its own regressor.
            trials.with_joint_tolerance(&machine(), 1e-9).run(CAMPAIGNS, 2),
        ] {
            for leg in 0..6 {
                let errors: Vec<f64> = fitted.iter().map(|k| 1.0 / k[leg] - 1.0 / STIFFNESS[leg]).collect();
                let mean = errors.iter().sum::<f64>() / n;
                let variance = errors.iter().map(|e| e * e).sum::<f64>() / n;
                let expected = covariance[(leg, leg)];
                let off = mean / (expected / n).sqrt();
                let wide = (variance / expected - 1.0) / (2.0 / n).sqrt();
                assert!(off.abs() < SIGMAS, "leg {}: mean off by {off} sigma", leg + 1);
                assert!(wide.abs() < SIGMAS, "leg {}: variance off by {wide} sigma", leg + 1);
            }
        }
    }

    #[test]
    fn equal_seeds_give_equal_campaigns_on_any_number_of_threads() {
        let trials = SpringTrials::new(&machine(), &readings(), &SIGMA, &STIFFNESS)
            .unwrap()
            .with_joint_tolerance(&machine(), 1e-4);
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| trials.run(3000, 7))
        };
        assert_eq!(on(1), on(3));
        assert_ne!(on(1), trials.run(3000, 8));
    }

    #[test]
    fn no_readings_are_refused() {
        let none = SpringTrials::new(&machine(), &[], &SIGMA, &STIFFNESS);
        assert!(matches!(none, Err(ModelError::TooFewEquations { .. })));
    }
}
