//! All records of a file: poses, their covariances, the noise of a coordinate, balls that moved.

use hexbench_core::statistics::median;
use hexbench_core::{BallPlace, BallPlaces, BallRecord, Matrix3, Matrix6, Pose, Vector3};

use super::{DistanceResidual, Rigid, distances, rigid};

/// A distance that is off by so many standard deviations tells that a ball moved.
const MOVED_SIGMAS: f64 = 5.0;

/// Places that the records are compared with.
#[derive(Debug, Clone, PartialEq)]
pub struct Places {
    /// Balls on the platform.
    pub platform: Vec<BallPlace>,
    /// Balls on the base; none: poses are given in the frame of the measuring machine.
    pub base: Vec<BallPlace>,
    /// Point of the measuring machine's frame from which translations count, m.
    pub origin: Vector3,
    /// True when the places were measured with the same noise as the records.
    pub measured: bool,
}

/// A pose with what the balls tell about it.
#[derive(Debug, Clone, PartialEq)]
pub struct RegisteredPose {
    /// Name of the record.
    pub id: String,
    /// The pose.
    pub pose: Pose,
    /// Covariance of its six numbers, m and rad.
    pub covariance: Matrix6,
    /// Root mean square residual of a coordinate after registration, m.
    pub rms: f64,
    /// Distance between two balls of the platform that differs most, by name.
    pub worst: Option<(String, String, f64)>,
    /// True when that difference is beyond the noise.
    pub moved: bool,
}

/// All poses and the noise they were given.
#[derive(Debug, Clone, PartialEq)]
pub struct Registered {
    /// One pose for each record, in file order.
    pub poses: Vec<RegisteredPose>,
    /// Standard deviation of one coordinate, m.
    pub sigma: f64,
    /// The same from the residuals; none when no coordinate is left over.
    pub estimated_sigma: Option<f64>,
}

/// Why records give no poses.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RegistrationError {
    /// A ball is not in a record.
    #[error("line {line}: record {record} lacks ball {ball}")]
    MissingBall {
        /// Line where the record begins.
        line: u64,
        /// Record.
        record: String,
        /// Ball.
        ball: String,
    },
    /// Balls that determine no pose.
    #[error(
        "line {line}: the balls of record {record} do not determine a pose: at least three that are not on a line are needed"
    )]
    Undetermined {
        /// Line where the record begins.
        line: u64,
        /// Record.
        record: String,
    },
}

impl Places {
    /// Known places.
    pub fn nominal(places: &BallPlaces) -> Self {
        Self {
            platform: places.platform.clone(),
            base: places.base.clone(),
            origin: Vector3::zeros(),
            measured: false,
        }
    }

    /// The balls of a record as the places of all: poses are relative to it, about the center of its balls, in the axes
    /// of the measuring machine.
    pub fn of_record(record: &BallRecord) -> Self {
        let count = record.balls.len().max(1) as f64;
        let centre = record.balls.iter().map(|b| b.centre).sum::<Vector3>() / count;
        let about = |b: &BallPlace| BallPlace { ball: b.ball.clone(), centre: b.centre - centre };
        Self {
            platform: record.balls.iter().map(about).collect(),
            base: Vec::new(),
            origin: centre,
            measured: true,
        }
    }

    /// Variance of a difference over that of one coordinate.
    fn noise_factor(&self) -> f64 {
        if self.measured { 2.0 } else { 1.0 }
    }
}

/// One record superposed on its places.
struct Fit {
    platform: Rigid,
    base: Option<Rigid>,
    distances: Vec<DistanceResidual>,
}

/// Registers every record; `sigma` is the noise of one coordinate (m) when it is known, else it is estimated from the
/// residuals.
///
/// # Errors
/// [`RegistrationError`].
pub fn register_all(
    records: &[BallRecord],
    places: &Places,
    sigma: Option<f64>,
) -> Result<Registered, RegistrationError> {
    let fits = records.iter().map(|record| fit(record, places)).collect::<Result<Vec<_>, _>>()?;
    let estimated_sigma = if places.measured { from_spread(&fits) } else { from_residuals(&fits) };
    let sigma = sigma.or(estimated_sigma).unwrap_or(0.0);
    let poses = records.iter().zip(&fits).map(|(record, fit)| located(record, fit, places, sigma));
    Ok(Registered { poses: poses.collect(), sigma, estimated_sigma })
}

fn fit(record: &BallRecord, places: &Places) -> Result<Fit, RegistrationError> {
    let undetermined = || RegistrationError::Undetermined { line: record.line, record: record.id.clone() };
    let (known, touched) = matched(record, &places.platform)?;
    let platform = rigid(&known, &touched).ok_or_else(undetermined)?;
    let base = if places.base.is_empty() {
        None
    } else {
        let (known, touched) = matched(record, &places.base)?;
        Some(rigid(&known, &touched).ok_or_else(undetermined)?)
    };
    Ok(Fit { platform, base, distances: distances(&known, &touched) })
}

fn matched(
    record: &BallRecord,
    places: &[BallPlace],
) -> Result<(Vec<Vector3>, Vec<Vector3>), RegistrationError> {
    let touched = places.iter().map(|place| {
        record.centre(&place.ball).ok_or_else(|| RegistrationError::MissingBall {
            line: record.line,
            record: record.id.clone(),
            ball: place.ball.clone(),
        })
    });
    Ok((places.iter().map(|place| place.centre).collect(), touched.collect::<Result<_, _>>()?))
}

/// Median over the records of their mean square residual, so that a moved ball in some does not count; corrected for the
/// median of a chi-square being below its mean (Wilson and Hilferty).
fn from_residuals(fits: &[Fit]) -> Option<f64> {
    let dof = |fit: &Fit| {
        fit.platform.degrees_of_freedom() + fit.base.as_ref().map_or(0, Rigid::degrees_of_freedom)
    };
    let squares =
        |fit: &Fit| fit.platform.sum_of_squares() + fit.base.as_ref().map_or(0.0, Rigid::sum_of_squares);
    let freedom = dof(fits.first()?) as f64;
    let middle = median(fits.iter().map(|fit| squares(fit) / freedom))?;
    let median_over_mean = (1.0 - 2.0 / (9.0 * freedom)).powi(3);
    Some((middle / median_over_mean).sqrt())
}

/// Spread of each distance over the records, which the noise of the record they are compared with does not touch: median
/// absolute deviation, root mean square over the distances.
fn from_spread(fits: &[Fit]) -> Option<f64> {
    const DEVIATION_OF_A_NORMAL: f64 = 0.674_489_750_196_081_7;
    const FEWEST_RECORDS: usize = 4;
    let pairs = fits.first().filter(|_| fits.len() >= FEWEST_RECORDS)?.distances.len();
    let spread = |pair: usize| {
        let residuals: Vec<f64> = fits.iter().map(|fit| fit.distances[pair].residual).collect();
        let middle = median(residuals.iter().copied())?;
        median(residuals.iter().map(|r| (r - middle).abs()))
    };
    let squares = (0..pairs).map(|pair| spread(pair).map(|d| (d / DEVIATION_OF_A_NORMAL).powi(2)));
    let sum: f64 = squares.sum::<Option<f64>>()?;
    // A distance has twice the variance of a coordinate.
    Some((sum / (2 * pairs) as f64).sqrt())
}

fn located(record: &BallRecord, fit: &Fit, places: &Places, sigma: f64) -> RegisteredPose {
    let (mut pose, twist) = in_frame(&fit.platform, fit.base.as_ref());
    pose.translation -= places.origin;
    let variance = sigma * sigma * places.noise_factor();
    let to_angles = angle_map(&pose);
    let covariance = to_angles * twist * to_angles.transpose() * variance;
    let worst = fit.distances.iter().max_by(|a, b| a.residual.abs().total_cmp(&b.residual.abs()));
    let name = |k: usize| places.platform[k].ball.clone();
    RegisteredPose {
        id: record.id.clone(),
        pose,
        covariance,
        rms: (fit.platform.sum_of_squares() / fit.platform.degrees_of_freedom() as f64).sqrt(),
        worst: worst.map(|w| (name(w.first), name(w.second), w.residual)),
        moved: worst.is_some_and(|w| w.residual.abs() > MOVED_SIGMAS * (2.0 * variance).sqrt()),
    }
}

/// Pose of the platform in the frame of the base, and covariance of translation and rotation vector for coordinates of unit
/// variance.
///
/// With platform `P` and base `G` in the frame of the machine, `t = G' (t_P - t_G)`: turning the base by `w` moves the platform by
/// `-w x (t_P - t_G)` as seen from it.
fn in_frame(platform: &Rigid, base: Option<&Rigid>) -> (Pose, Matrix6) {
    let Some(base) = base else {
        return (Pose::from_rotation(platform.translation, &platform.rotation), platform.cofactors);
    };
    let back = base.rotation.transpose();
    let apart = platform.translation - base.translation;
    let pose = Pose::from_rotation(back * apart, &(back * platform.rotation));
    let mut turn = Matrix6::zeros();
    turn.fixed_view_mut::<3, 3>(0, 0).copy_from(&back);
    turn.fixed_view_mut::<3, 3>(3, 3).copy_from(&back);
    let mut lever = Matrix6::identity();
    lever.fixed_view_mut::<3, 3>(0, 3).copy_from(&-apart.cross_matrix());
    let seen = platform.cofactors + lever * base.cofactors * lever.transpose();
    (pose, turn * seen * turn.transpose())
}

/// From translation and rotation vector to translation and Euler angles.
pub(super) fn angle_map(pose: &Pose) -> Matrix6 {
    let ((sb, cb), (sg, cg)) = (pose.angles.y.sin_cos(), pose.angles.z.sin_cos());
    let axes = Matrix3::new(cg * cb, -sg, 0.0, sg * cb, cg, 0.0, -sb, 0.0, 1.0);
    let mut map = Matrix6::identity();
    // Upright at beta = +-90 deg the angles are not separable, and have no covariance of their own.
    map.fixed_view_mut::<3, 3>(3, 3).copy_from(&axes.try_inverse().unwrap_or_else(Matrix3::identity));
    map
}
