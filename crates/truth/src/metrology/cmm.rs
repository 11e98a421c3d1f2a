//! A coordinate measuring machine that touches balls: what it writes down, and the poses found from that.
//!
//! ```text
//! seen = (1 + s delta_T) G(t) x + noise         G(t): frame of the machine, aligned once, then drifting
//! ```
//!
//! With balls on the base, each record carries a frame of its own: the base balls are superposed on their known places, and
//! the platform is expressed in that frame. Their noise then adds to the pose's.

use hexbench_core::{Matrix6, Pose, Vector3};
use nalgebra::Matrix3;
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::{Balls, InstrumentFrames, euler_axes};
use crate::TruthError;

/// The machine and the balls it touches. SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Cmm {
    /// Balls on the platform, mobile frame, and the noise of one coordinate.
    pub platform: Balls,
    /// Balls on the base, fixed frame; none: the frame of the machine is taken as the fixed frame.
    pub base: Option<Balls>,
    /// Rates at which the frame moves from the reference reading on, m/s and rad/s.
    pub drift: [f64; 6],
    /// Change of the scales with temperature, 1/K.
    pub scale_per_k: f64,
    /// Share of records of which one coordinate is wrong.
    pub blunder_share: f64,
    /// By how much it is wrong, m.
    pub blunder: f64,
}

/// Surroundings of a record.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Surroundings {
    /// Seconds since the reference reading.
    pub elapsed: f64,
    /// Temperature above the reference reading, K.
    pub delta_t: f64,
}

/// Ball centers of one state, in the frame of the measuring machine, m.
#[derive(Debug, Clone, PartialEq)]
pub struct CmmRecord {
    /// Balls on the platform.
    pub platform: Vec<Vector3>,
    /// Balls on the base.
    pub base: Vec<Vector3>,
}

/// A pose found from a record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CmmPose {
    /// The pose.
    pub pose: Pose,
    /// Covariance of its six numbers from the noise of the balls, m and rad.
    pub covariance: Matrix6,
}

impl Cmm {
    /// Touches all balls with the platform at a pose.
    pub fn record(
        &self,
        frames: &InstrumentFrames,
        pose: &Pose,
        at: Surroundings,
        rng: &mut Pcg64,
    ) -> CmmRecord {
        let frame = self.frame(frames, at.elapsed);
        let stretch = 1.0 + self.scale_per_k * at.delta_t;
        let platform = InstrumentFrames { metrology: frame, target: frames.target }.seen(pose);
        let mut touch = |balls: &Balls, pose: &Pose| balls.seen(pose, stretch, rng);
        let mut record = CmmRecord {
            platform: touch(&self.platform, &platform),
            base: self.base.as_ref().map(|base| touch(base, &frame)).unwrap_or_default(),
        };
        self.blunder(&mut record, rng);
        record
    }

    fn frame(&self, frames: &InstrumentFrames, elapsed: f64) -> Pose {
        let moved = Pose::from_array(self.drift.map(|rate| rate * elapsed));
        InstrumentFrames { metrology: frames.metrology, target: moved }.seen(&Pose::default())
    }

    fn blunder(&self, record: &mut CmmRecord, rng: &mut Pcg64) {
        if self.blunder_share > 0.0 && rng.random_bool(self.blunder_share) {
            let ball = rng.random_range(0..record.platform.len());
            let side = if rng.random_bool(0.5) { 1.0 } else { -1.0 };
            record.platform[ball][rng.random_range(0..3)] += side * self.blunder;
        }
    }

    /// The same machine without noise, drift, stretch and blunders.
    #[must_use]
    pub fn without_errors(&self) -> Self {
        let quiet = |balls: &Balls| Balls { sigma: 0.0, ..balls.clone() };
        Self {
            platform: quiet(&self.platform),
            base: self.base.as_ref().map(quiet),
            drift: [0.0; 6],
            scale_per_k: 0.0,
            blunder_share: 0.0,
            blunder: 0.0,
        }
    }

    /// Covariance of the six numbers at a pose, m and rad, the frame of the machine being the fixed one.
    ///
    /// # Errors
    /// [`TruthError::Balls`].
    pub fn covariance_at(&self, pose: &Pose) -> Result<Matrix6, TruthError> {
        let r = pose.rotation();
        let platform = self.platform.centres.iter().map(|c| pose.translation + r * c).collect();
        let base = self.base.as_ref().map(|base| base.centres.clone()).unwrap_or_default();
        self.locate(&CmmRecord { platform, base }).map(|located| located.covariance)
    }

    /// Pose of the platform in the fixed frame, or in the frame of the machine when no balls are on the base.
    ///
    /// # Errors
    /// As [`Balls::register`].
    pub fn locate(&self, record: &CmmRecord) -> Result<CmmPose, TruthError> {
        let platform = self.platform.register(&record.platform)?.pose;
        let Some(base) = &self.base else {
            let twist = self.platform.covariance(&platform)?;
            return Ok(CmmPose { pose: platform, covariance: of_angles(&platform, &twist) });
        };
        let frame = base.register(&record.base)?.pose;
        let back = frame.rotation().transpose();
        let arm = platform.translation - frame.translation;
        let pose = Pose::from_rotation(back * arm, &(back * platform.rotation()));
        let turned = block(&back, &Matrix3::zeros(), &back);
        let carried = block(&back, &(-back * arm.cross_matrix()), &back);
        let twist = turned * self.platform.covariance(&platform)? * turned.transpose()
            + carried * base.covariance(&frame)? * carried.transpose();
        Ok(CmmPose { pose, covariance: of_angles(&pose, &twist) })
    }
}

impl Balls {
    /// Touched centers, coordinates stretched by a factor, m.
    fn seen(&self, pose: &Pose, stretch: f64, rng: &mut Pcg64) -> Vec<Vector3> {
        let r = pose.rotation();
        let mut noise = || -> Vector3 { Vector3::from_fn(|_, _| StandardNormal.sample(rng)) * self.sigma };
        self.centres.iter().map(|c| (pose.translation + r * c) * stretch + noise()).collect()
    }
}

/// `[a, b; 0, d]`.
fn block(a: &Matrix3<f64>, b: &Matrix3<f64>, d: &Matrix3<f64>) -> Matrix6 {
    let mut m = Matrix6::zeros();
    m.fixed_view_mut::<3, 3>(0, 0).copy_from(a);
    m.fixed_view_mut::<3, 3>(0, 3).copy_from(b);
    m.fixed_view_mut::<3, 3>(3, 3).copy_from(d);
    m
}

/// From a rotation vector in fixed axes to the Euler angles of a pose.
fn of_angles(pose: &Pose, twist: &Matrix6) -> Matrix6 {
    let to_angles = euler_axes(pose).try_inverse().unwrap_or_else(Matrix3::identity);
    let map = block(&Matrix3::identity(), &Matrix3::zeros(), &to_angles);
    map * twist * map.transpose()
}

#[cfg(test)]
mod tests {
    use hexbench_core::Vector6;
    use hexbench_core::streams::{Purpose, stream};

    use super::*;

    const RECORDS: u32 = 3000;
    /// Standard errors a mean square may be away from what is stated.
    const STANDARD_ERRORS: f64 = 4.5;

    fn cmm(base: bool) -> Cmm {
        let points = |xyz: &[[f64; 3]]| xyz.iter().map(|p| Vector3::from(*p)).collect();
        let platform =
            points(&[[0.13, 0.02, 0.05], [-0.05, 0.11, 0.06], [-0.08, -0.1, 0.03], [0.02, 0.0, 0.12]]);
        let corners = points(&[[0.3, 0.3, -0.2], [-0.3, 0.3, -0.2], [0.0, -0.35, -0.1]]);
        Cmm {
            platform: Balls { centres: platform, sigma: 1e-6 },
            base: base.then_some(Balls { centres: corners, sigma: 0.6e-6 }),
            drift: [0.0; 6],
            scale_per_k: 0.0,
            blunder_share: 0.0,
            blunder: 0.0,
        }
    }

    fn frames() -> InstrumentFrames {
        InstrumentFrames {
            metrology: Pose::from_array([0.4, -0.2, 0.1, 0.3, -0.2, 2.0]),
            target: Pose::default(),
        }
    }

    fn pose() -> Pose {
        Pose::from_array([0.02, -0.01, 0.03, 0.1, -0.2, 0.4])
    }

    /// Whitened errors have unit covariance: mean of the chi-square and the mean square in every direction.
    fn stated_covariance_is_true(base: bool) {
        let (cmm, frames, mut rng) = (cmm(base), frames(), stream(4, Purpose::Test, [4]));
        let truth = if base { pose() } else { frames.seen(&pose()) };
        let mut squares = Vector6::zeros();
        for _ in 0..RECORDS {
            let record = cmm.record(&frames, &pose(), Surroundings::default(), &mut rng);
            let found = cmm.locate(&record).unwrap();
            let error = found.pose.to_vector() - truth.to_vector();
            let white = found.covariance.cholesky().unwrap().l().solve_lower_triangular(&error).unwrap();
            squares += white.component_mul(&white) / f64::from(RECORDS);
        }
        let bound = STANDARD_ERRORS * (2.0 / f64::from(RECORDS)).sqrt();
        println!("base {base}: mean squares {squares:.4?}, bound {bound:.4}");
        assert!(squares.iter().all(|s| (s - 1.0).abs() < bound), "{squares:?}, bound {bound}");
    }

    #[test]
    fn the_stated_covariance_is_that_of_the_errors() {
        stated_covariance_is_true(false);
    }

    #[test]
    fn noise_of_the_base_balls_is_in_the_stated_covariance() {
        stated_covariance_is_true(true);
    }

    /// 1 um on three balls at 120 mm: 0.82 um and 9.6, 9.6, 6.8 urad for a difference of two poses.
    #[test]
    fn the_stated_noise_of_a_deflection_is_the_published_one() {
        let balls = Balls::triangle(0.12, 1e-6);
        let pose = Pose::default();
        let variance = of_angles(&pose, &balls.covariance(&pose).unwrap()).diagonal() * 2.0;
        let found = variance.map(|v| v.sqrt() * 1e6);
        for (k, expected) in [0.82, 0.82, 0.82, 9.6, 9.6, 6.8].into_iter().enumerate() {
            assert!((found[k] - expected).abs() < 0.05, "{k}: {} not {expected}", found[k]);
        }
    }

    #[test]
    fn balls_on_the_base_cancel_frame_and_drift() {
        let quiet = |base: bool| {
            let mut cmm = cmm(base);
            cmm.drift = [1e-7, 0.0, 0.0, 0.0, 1e-7, 0.0];
            cmm.platform.sigma = 0.0;
            if let Some(base) = &mut cmm.base {
                base.sigma = 0.0;
            }
            let at = Surroundings { elapsed: 200.0, delta_t: 0.0 };
            let record = cmm.record(&frames(), &pose(), at, &mut stream(1, Purpose::Test, [1]));
            cmm.locate(&record).unwrap().pose.to_vector()
        };
        assert!((quiet(true) - pose().to_vector()).amax() < 1e-13);
        let drifted = quiet(false) - frames().seen(&pose()).to_vector();
        assert!(drifted.amax() > 1e-5, "{drifted}");
    }

    #[test]
    fn warm_scales_stretch_what_is_seen() {
        let cmm =
            Cmm { scale_per_k: 1e-5, platform: Balls { sigma: 0.0, ..cmm(false).platform }, ..cmm(false) };
        let at = Surroundings { elapsed: 0.0, delta_t: 2.0 };
        let see = |at| cmm.record(&frames(), &pose(), at, &mut stream(1, Purpose::Test, [1])).platform[0];
        let ratio = see(at).norm() / see(Surroundings::default()).norm();
        assert!((ratio - 1.0 - 2e-5).abs() < 1e-12, "{ratio}");
    }
}
