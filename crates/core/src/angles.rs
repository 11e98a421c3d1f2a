//! How three angles of a file state an attitude.

use std::borrow::Cow;

use nalgebra::{Rotation3, UnitQuaternion};

use crate::{Channel, Dataset, Matrix3, Measurand, Observation, Pose, Vector3};

/// What the columns alpha, beta, gamma of a machine's files mean. Inside, angles are always extrinsic X-Y-Z ([`Pose`]); files are read and
/// written by the convention that `hexapod.toml` states.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum AngleConvention {
    /// About fixed axes x, then y, then z: `Rz Ry Rx`, the format's own.
    #[default]
    FixedXyz,
    /// About fixed axes x, z, y.
    FixedXzy,
    /// About fixed axes y, x, z.
    FixedYxz,
    /// About fixed axes y, z, x.
    FixedYzx,
    /// About fixed axes z, x, y.
    FixedZxy,
    /// About fixed axes z, y, x, which is x, y, z about axes that move with the platform: `Rx Ry Rz`.
    FixedZyx,
    /// The components of a rotation vector, fixed axes.
    RotationVector,
}

impl AngleConvention {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::FixedXyz,
        Self::FixedXzy,
        Self::FixedYxz,
        Self::FixedYzx,
        Self::FixedZxy,
        Self::FixedZyx,
        Self::RotationVector,
    ];

    /// Axes in the order in which the angles turn about them, from zero; none of a rotation vector.
    fn order(self) -> Option<[usize; 3]> {
        match self {
            Self::FixedXyz => Some([0, 1, 2]),
            Self::FixedXzy => Some([0, 2, 1]),
            Self::FixedYxz => Some([1, 0, 2]),
            Self::FixedYzx => Some([1, 2, 0]),
            Self::FixedZxy => Some([2, 0, 1]),
            Self::FixedZyx => Some([2, 1, 0]),
            Self::RotationVector => None,
        }
    }

    /// Both words of a file for it: about fixed axes, and the same about axes that move with the platform, in the other order.
    pub fn words(self) -> [String; 2] {
        const VECTOR: &str = "rotation-vector";
        let letters = |order: [usize; 3]| order.map(|axis| ["x", "y", "z"][axis]).concat();
        self.order().map_or([VECTOR, VECTOR].map(str::to_owned), |[first, second, third]| {
            let fixed = format!("extrinsic-{}", letters([first, second, third]));
            [fixed, format!("intrinsic-{}", letters([third, second, first]))]
        })
    }

    /// The word that is written: the format's own as `extrinsic-xyz`, others as makers state them, about moving axes.
    pub fn word(self) -> String {
        let [fixed, moving] = self.words();
        if self == Self::default() { fixed } else { moving }
    }

    /// The convention a word of a file names.
    pub fn of_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|convention| convention.words().iter().any(|own| own == word))
    }

    /// Mobile axes to fixed axes, of three stated angles (about x, y, z), rad.
    pub fn rotation(self, stated: &Vector3) -> Matrix3 {
        let Some(order) = self.order() else { return *Rotation3::new(*stated).matrix() };
        let (axes, handedness) = renamed(order);
        let angles = handedness * axes.transpose() * stated;
        axes * Pose { translation: Vector3::zeros(), angles }.rotation() * axes.transpose()
    }

    /// The three angles that state a rotation, rad.
    ///
    /// Limits: where two of the axes fall together, one of their angles is zero.
    pub fn of_rotation(self, rotation: &Matrix3) -> Vector3 {
        let Some(order) = self.order() else {
            let turn = Rotation3::from_matrix_unchecked(*rotation);
            return UnitQuaternion::from_rotation_matrix(&turn).scaled_axis();
        };
        let (axes, handedness) = renamed(order);
        let turned = axes.transpose() * rotation * axes;
        handedness * axes * Pose::from_rotation(Vector3::zeros(), &turned).angles
    }

    /// Extrinsic X-Y-Z angles of stated ones, rad.
    pub fn to_fixed_xyz(self, stated: &Vector3) -> Vector3 {
        if self == Self::default() { *stated } else { Self::default().of_rotation(&self.rotation(stated)) }
    }

    /// The angles to state for extrinsic X-Y-Z ones, rad.
    pub fn from_fixed_xyz(self, angles: &Vector3) -> Vector3 {
        if self == Self::default() { *angles } else { self.of_rotation(&Self::default().rotation(angles)) }
    }

    /// Puts the angles of a row as the file states them into those used inside: pose, and what was measured of a pose or as differences of
    /// its angles, with their standard deviations.
    pub(crate) fn read(self, row: &mut Observation, channels: &[Channel; 6], measurand: Measurand) {
        let stated = row.pose.angles;
        row.pose.angles = self.to_fixed_xyz(&stated);
        let how =
            Restated { angles: &|at| self.to_fixed_xyz(at), variances: &|slopes, v| squared(slopes) * v };
        restate(row, channels, measurand, &how, &stated);
    }

    /// The rows as the files of a machine of this convention state them.
    pub fn as_stated(self, data: &Dataset) -> Cow<'_, Dataset> {
        if self == Self::default() {
            return Cow::Borrowed(data);
        }
        let mut stated = data.clone();
        for row in &mut stated.observations {
            let (channels, inside) = (data.channels(row), row.pose.angles);
            row.pose.angles = self.from_fixed_xyz(&inside);
            let how = Restated { angles: &|at| self.from_fixed_xyz(at), variances: &variances_before };
            restate(row, &channels, data.measurand, &how, &inside);
        }
        Cow::Owned(stated)
    }

    /// The first row, by its line, whose differences of angles another convention could not state: some but not all three were read.
    pub(crate) fn lacks_an_angle(self, data: &Dataset) -> Option<u64> {
        if self == Self::default() || data.measurand != Measurand::DeflectionEuler {
            return None;
        }
        let lacks = |row: &&Observation| matches!(rotations(row, &data.channels(row)), Read::Some);
        data.observations.iter().find(lacks).map(|row| row.line)
    }
}

/// Columns: the axes of an order, and 1 where they are right-handed, -1 where they are left-handed, which turns angles round.
fn renamed(order: [usize; 3]) -> (Matrix3, f64) {
    let axes = Matrix3::from_fn(|axis, k| if order[k] == axis { 1.0 } else { 0.0 });
    (axes, axes.determinant())
}

/// Which of the three rotations of a row were read.
enum Read {
    None,
    Some,
    /// All, at these places.
    All([usize; 3]),
}

fn rotations(row: &Observation, channels: &[Channel; 6]) -> Read {
    let place = |k: usize| channels.iter().position(|c| *c == Channel::Pose(k)).filter(|p| row.is_read(*p));
    match [3, 4, 5].map(place) {
        [Some(x), Some(y), Some(z)] => Read::All([x, y, z]),
        [None, None, None] => Read::None,
        _ => Read::Some,
    }
}

/// How angles and their variances become those of another convention.
struct Restated<'a> {
    angles: &'a dyn Fn(&Vector3) -> Vector3,
    /// Of the slopes of the new angles by the old ones, and the old variances.
    variances: &'a dyn Fn(&Matrix3, &Vector3) -> Vector3,
}

/// What was measured about angles `at`, restated.
fn restate(
    row: &mut Observation,
    channels: &[Channel; 6],
    measurand: Measurand,
    how: &Restated<'_>,
    at: &Vector3,
) {
    let Read::All(places) = rotations(row, channels) else { return };
    let measured = Vector3::from(places.map(|place| row.measured[place]));
    let (restated, there) = match measurand {
        Measurand::AbsolutePose => ((how.angles)(&measured), measured),
        Measurand::DeflectionEuler => ((how.angles)(&(at + measured)) - (how.angles)(at), *at),
        Measurand::DeflectionRotationVector => return,
    };
    for (place, value) in places.into_iter().zip(&restated) {
        row.measured[place] = *value;
    }
    let Some(sigma) = &mut row.sigma else { return };
    let variances = Vector3::from(places.map(|place| sigma[place] * sigma[place]));
    let restated = (how.variances)(&slopes(how.angles, &there), &variances);
    for (place, variance) in places.into_iter().zip(&restated) {
        sigma[place] = variance.sqrt();
    }
}

/// Slopes of three angles by three others, by central differences.
fn slopes(angles: &dyn Fn(&Vector3) -> Vector3, at: &Vector3) -> Matrix3 {
    const STEP: f64 = 1e-6;
    let column = |k: usize| {
        let step = Vector3::ith(k, STEP);
        (angles(&(at + step)) - angles(&(at - step))) / (2.0 * STEP)
    };
    Matrix3::from_columns(&[column(0), column(1), column(2)])
}

fn squared(slopes: &Matrix3) -> Matrix3 {
    slopes.component_mul(slopes)
}

/// The variances of independent angles before they were restated, of those after it; `slopes` lead back. Where correlations that nobody
/// stated would be needed for that, those after it count as independent.
fn variances_before(slopes: &Matrix3, after: &Vector3) -> Vector3 {
    let forth = slopes.try_inverse().map(|forth| squared(&forth));
    let before = forth.and_then(|forth| forth.lu().solve(after));
    before.filter(|v| v.iter().all(|x| x.is_finite() && *x > 0.0)).unwrap_or_else(|| squared(slopes) * after)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Wrench;

    const ANGLES: [f64; 3] = [0.3, -0.2, 0.5];

    fn turn(axis: usize, angle: f64) -> Matrix3 {
        let axes = [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()];
        *Rotation3::from_axis_angle(&axes[axis], angle).matrix()
    }

    #[test]
    fn every_word_names_the_turns_it_spells() {
        for convention in AngleConvention::ALL.into_iter().filter(|c| c.order().is_some()) {
            for word in convention.words() {
                let (kind, letters) = word.split_once('-').unwrap();
                let turns = letters.bytes().map(|l| usize::from(l - b'x')).map(|k| turn(k, ANGLES[k]));
                // A turn about a fixed axis comes from the left, one about an axis of the platform from the right.
                let all =
                    turns.fold(Matrix3::identity(), |r, t| if kind == "extrinsic" { t * r } else { r * t });
                assert!((convention.rotation(&ANGLES.into()) - all).amax() < 1e-15, "{word}");
                assert_eq!(AngleConvention::of_word(&word), Some(convention));
            }
        }
        assert_eq!(AngleConvention::of_word("rotation-vector"), Some(AngleConvention::RotationVector));
        assert_eq!(AngleConvention::of_word("intrinsic-zyx"), Some(AngleConvention::default()));
        assert_eq!(AngleConvention::FixedZyx.word(), "intrinsic-xyz");
    }

    #[test]
    fn stated_angles_come_back_from_those_inside() {
        for convention in AngleConvention::ALL {
            for angles in [ANGLES, [1e-9, -2e-9, 3e-9], [0.0; 3], [-1.2, 1.1, 2.9]].map(Vector3::from) {
                let inside = convention.to_fixed_xyz(&angles);
                assert!(
                    (convention.rotation(&angles) - AngleConvention::default().rotation(&inside)).amax()
                        < 1e-14
                );
                let back = convention.from_fixed_xyz(&inside);
                let same = (convention.rotation(&back) - convention.rotation(&angles)).amax();
                assert!(same < 1e-14, "{convention:?} {angles}: {same}");
            }
        }
    }

    #[test]
    fn what_is_read_is_what_is_written_to_rounding() {
        let pose = Pose::from_array([0.0, 0.0, 0.0, 0.3, -0.2, 0.5]);
        for measurand in
            [Measurand::DeflectionEuler, Measurand::DeflectionRotationVector, Measurand::AbsolutePose]
        {
            for convention in AngleConvention::ALL {
                let row = Observation {
                    measured: [1e-6, 2e-6, 3e-6, 4e-6, -5e-6, 6e-6],
                    sigma: Some([1e-6, 1e-6, 2e-6, 3e-6, 2e-6, 5e-6]),
                    ..Observation::unread(pose, Wrench::default(), Wrench::default())
                };
                let mut read = row;
                convention.read(&mut read, &Channel::POSE, measurand);
                let data = Dataset::of_poses("", measurand, crate::Columns::default(), vec![read]);
                let back = convention.as_stated(&data).observations[0];
                assert!((back.pose.to_vector() - pose.to_vector()).amax() < 1e-15, "{convention:?}");
                let off = (0..6).map(|k| (back.measured[k] - row.measured[k]).abs()).fold(0.0, f64::max);
                assert!(off < 1e-15, "{convention:?} {measurand:?}: {off}");
                let [sigma, expected] = [back.sigma.unwrap(), row.sigma.unwrap()];
                let near = (0..6).all(|k| (sigma[k] / expected[k] - 1.0).abs() < 1e-6);
                assert!(near, "{convention:?} {measurand:?}: {sigma:?}");
            }
        }
    }

    /// About moving axes the third angle is one about the axis that the platform carries: seen from fixed axes its error is a turn about that.
    #[test]
    fn standard_deviations_are_turned_with_their_angles() {
        let at = Vector3::from(ANGLES);
        let sigma = [1e-9, 1e-9, 1e-9, 1e-12, 1e-12, 6e-6];
        let row = Observation {
            sigma: Some(sigma),
            ..Observation::unread(
                Pose { translation: Vector3::zeros(), angles: at },
                Wrench::default(),
                Wrench::default(),
            )
        };
        let mut read = row;
        AngleConvention::FixedZyx.read(&mut read, &Channel::POSE, Measurand::DeflectionEuler);
        let moved = at + Vector3::new(0.0, 0.0, 6e-6);
        let inside = |angles: &Vector3| AngleConvention::FixedZyx.to_fixed_xyz(angles);
        let expected = (inside(&moved) - inside(&at)).abs();
        let found = read.sigma.unwrap();
        assert!((0..3).all(|k| (found[3 + k] - expected[k]).abs() < 1e-10), "{found:?} {expected}");
        assert!(found[3] > 1e-7, "{found:?}");
    }

    #[test]
    fn differences_of_angles_are_the_same_small_turn() {
        let at = Vector3::from(ANGLES);
        let change = Vector3::new(4e-7, -5e-7, 6e-7);
        let convention = AngleConvention::FixedZyx;
        let mut row = Observation {
            measured: [0.0, 0.0, 0.0, change.x, change.y, change.z],
            ..Observation::unread(
                Pose { translation: Vector3::zeros(), angles: at },
                Wrench::default(),
                Wrench::default(),
            )
        };
        convention.read(&mut row, &Channel::POSE, Measurand::DeflectionEuler);
        let inside = Vector3::new(row.measured[3], row.measured[4], row.measured[5]);
        let fixed = AngleConvention::default();
        let turns = [
            convention.rotation(&(at + change)) * convention.rotation(&at).transpose(),
            fixed.rotation(&(row.pose.angles + inside)) * fixed.rotation(&row.pose.angles).transpose(),
        ];
        assert!((turns[0] - turns[1]).amax() < 1e-15);
    }
}
