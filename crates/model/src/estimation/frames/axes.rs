//! Coordinates in which rotations of readings are compared.

use hexbench_core::{Matrix3, Pose, Vector3};
use nalgebra::Isometry3;

use super::Frames;
use crate::machine::kinematics::euler_rate_matrix;

/// Coordinates of the rotation of a reading: the angles of the file where the axes of instrument and target are nearly those of the
/// machine, else the
/// angles the reading has with its frames taken away, along the axes of the instrument.
///
/// Angles of the file jump at +-180 deg and mean nothing at beta = +-90 deg, which a turned axis system makes the middle of the
/// workspace. So with `Y = M X T` the angles are those of `R_M^T R_Y R_T^T`, which are small, and a difference of them is written
/// along the axes of the instrument, to whose rotations a standard deviation belongs: `d = R_M wrap(angles_b - angles_a)`.
/// Which frames are taken away is settled before a fit and does not change with it. Shapes and units: three angles, rad.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ReadingAxes(Option<Turned>);

/// Rotations of frames that are not those of the machine.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Turned {
    metrology: Matrix3,
    target: Matrix3,
}

impl ReadingAxes {
    /// Those of an instrument with these frames.
    pub fn of(frames: &Frames) -> Self {
        let matrix = |f: &Isometry3<f64>| *f.rotation.to_rotation_matrix().matrix();
        Self(
            frames
                .are_turned()
                .then(|| Turned { metrology: matrix(&frames.metrology), target: matrix(&frames.target) }),
        )
    }

    /// `to - from` of two readings `[a, b, c, alpha, beta, gamma]` or deflections, m and rad; angles within half a turn.
    pub fn difference(&self, from: &[f64; 6], to: &[f64; 6]) -> [f64; 6] {
        let plain: [f64; 6] = std::array::from_fn(|k| to[k] - from[k]);
        let Some(turned) = &self.0 else {
            return std::array::from_fn(|k| if k < 3 { plain[k] } else { wrapped(plain[k]) });
        };
        let turn = turned.metrology * (turned.angles(to) - turned.angles(from)).map(wrapped);
        [plain[0], plain[1], plain[2], turn.x, turn.y, turn.z]
    }

    /// The reading that differs from another by so much.
    pub fn moved(&self, from: &[f64; 6], difference: &[f64; 6]) -> [f64; 6] {
        let plain: [f64; 6] = std::array::from_fn(|k| from[k] + difference[k]);
        let Some(turned) = &self.0 else { return plain };
        let turn = Vector3::new(difference[3], difference[4], difference[5]);
        let angles = turned.angles(from) + turned.metrology.tr_mul(&turn);
        let near = Pose { translation: Vector3::zeros(), angles }.rotation();
        let translation = Vector3::new(plain[0], plain[1], plain[2]);
        Pose::from_rotation(translation, &(turned.metrology * near * turned.target)).to_array()
    }

    /// The rotation of a reading in a form that neither jumps nor locks, rad: its differences are those of
    /// [`ReadingAxes::difference`] up to whole turns.
    pub fn continuous(&self, reading: &[f64; 6]) -> [f64; 6] {
        let Some(turned) = &self.0 else { return *reading };
        let turn = turned.metrology * turned.angles(reading);
        [reading[0], reading[1], reading[2], turn.x, turn.y, turn.z]
    }

    /// Rates of these coordinates from the angular velocity of the target along the axes of the instrument (3x3).
    ///
    /// Limits: singular where the platform itself stands at beta = +-90 deg; the identity there.
    pub fn rates(&self, reading: &[f64; 6]) -> Matrix3 {
        let angles = match &self.0 {
            None => Vector3::new(reading[3], reading[4], reading[5]),
            Some(turned) => turned.angles(reading),
        };
        let rates = euler_rate_matrix(&angles).try_inverse().unwrap_or_else(Matrix3::identity);
        self.0.map_or(rates, |t| t.metrology * rates * t.metrology.transpose())
    }
}

impl Turned {
    /// Angles of a reading without the turns of its frames, rad.
    fn angles(&self, reading: &[f64; 6]) -> Vector3 {
        let seen = Pose::from_array(*reading).rotation();
        let near = self.metrology.tr_mul(&seen) * self.target.transpose();
        Pose::from_rotation(Vector3::zeros(), &near).angles
    }
}

/// An angle within half a turn of zero, rad.
fn wrapped(angle: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    angle - turn * (angle / turn).round()
}
