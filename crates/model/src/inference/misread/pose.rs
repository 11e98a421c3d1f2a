//! What a pose may mean otherwise than it says: one that was commanded, or one that an instrument measured.

use std::fmt;

use hexbench_core::{AngleConvention, Dataset, Pose};

use super::change::{halves, joined};
use super::name::{scaled, short};
use super::text::multiple;
use super::turn::{AngleOrder, SignedAxes};

/// Which of the two poses of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PoseOf {
    /// The one that was commanded.
    Command,
    /// The one that an instrument measured.
    Instrument,
}

/// Numbers of a pose that share a sign or a unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PoseNumbers {
    /// The three positions.
    Positions,
    /// The three angles.
    Angles,
    /// One of the six, from zero.
    One(u8),
}

/// What a pose means instead.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PoseMistake {
    /// Numbers with the other sign.
    Reversed(PoseNumbers),
    /// Numbers times a factor.
    Scaled(PoseNumbers, f64),
    /// The columns of the positions named otherwise, those of the angles as they are.
    Positions(SignedAxes),
    /// The columns of the angles named otherwise, those of the positions as they are.
    Angles(SignedAxes),
    /// Axes of which one points the other way, so that they are left-handed.
    LeftHanded,
    /// The fixed frame seen from the platform.
    Inverse,
    /// Angles that turn in another order.
    Order(AngleOrder),
}

/// Left-handed axes; which of them points the other way, a turn of the frame makes up for.
const LEFT_HANDED: [i8; 3] = [-1, 2, 3];
/// Words of the six numbers.
const NUMBERS: [&str; 6] = ["a", "b", "c", "alpha", "beta", "gamma"];

impl PoseOf {
    /// Word of the kind of mistake.
    pub const fn kind(self) -> &'static str {
        match self {
            Self::Command => "commanded-pose",
            Self::Instrument => "measured-pose",
        }
    }

    fn word(self) -> &'static str {
        match self {
            Self::Command => "commanded",
            Self::Instrument => "measured",
        }
    }

    fn column(self, number: u8) -> String {
        let name = NUMBERS[usize::from(number)];
        if self == Self::Command { format!("the commanded {name}") } else { format!("measured_{name}") }
    }

    fn numbers(self, numbers: PoseNumbers) -> String {
        match numbers {
            PoseNumbers::Positions => format!("the {} positions", self.word()),
            PoseNumbers::Angles => format!("the {} angles", self.word()),
            PoseNumbers::One(k) => self.column(k),
        }
    }
}

impl PoseNumbers {
    /// All of them.
    pub(super) fn all() -> impl Iterator<Item = Self> {
        [Self::Positions, Self::Angles].into_iter().chain((0..6).map(Self::One))
    }

    fn contains(self, number: usize) -> bool {
        match self {
            Self::Positions => number < 3,
            Self::Angles => number >= 3,
            Self::One(k) => usize::from(k) == number,
        }
    }

    /// True for angles.
    pub(super) fn are_angles(self) -> bool {
        matches!(self, Self::Angles | Self::One(3..))
    }

    fn word(self) -> &'static str {
        match self {
            Self::Positions => "positions",
            Self::Angles => "angles",
            Self::One(k) => NUMBERS[usize::from(k)],
        }
    }

    fn parsed(word: &str) -> Option<Self> {
        Self::all().find(|numbers| numbers.word() == word)
    }
}

impl PoseMistake {
    /// Reads the poses of a file that way; `convention`: what the machine says of their angles.
    pub(super) fn apply(self, of: PoseOf, convention: AngleConvention, data: &mut Dataset) {
        for row in &mut data.observations {
            match of {
                PoseOf::Command => row.pose = Pose::from_array(self.meant(row.pose.to_array(), convention)),
                PoseOf::Instrument => {
                    row.measured = self.meant(row.measured, convention);
                    row.sigma = row.sigma.map(|sigma| self.sigma_meant(sigma));
                }
            }
        }
    }

    /// The pose that is meant; m and rad.
    fn meant(self, pose: [f64; 6], convention: AngleConvention) -> [f64; 6] {
        let is_of_angles = match self {
            Self::Reversed(numbers) | Self::Scaled(numbers, _) => numbers.are_angles(),
            Self::Angles(_) | Self::Order(_) => true,
            Self::Positions(_) | Self::LeftHanded | Self::Inverse => false,
        };
        if !is_of_angles || convention == AngleConvention::default() {
            return self.of_numbers(pose);
        }
        // What is wrong with angles is wrong with those of the file.
        let read = Pose::from_array(pose);
        let stated = Pose { angles: convention.from_fixed_xyz(&read.angles), ..read };
        let meant = self.of_numbers(stated.to_array());
        if matches!(self, Self::Order(_)) {
            return meant;
        }
        let numbers = Pose::from_array(meant);
        Pose::from_rotation(numbers.translation, &convention.rotation(&numbers.angles)).to_array()
    }

    fn of_numbers(self, numbers: [f64; 6]) -> [f64; 6] {
        let pose = Pose::from_array(numbers);
        let times = |which: PoseNumbers, factor: f64| {
            std::array::from_fn(|k| if which.contains(k) { numbers[k] * factor } else { numbers[k] })
        };
        match self {
            Self::Reversed(which) => times(which, -1.0),
            Self::Scaled(which, factor) => times(which, factor),
            Self::Positions(axes) => Pose { translation: axes.renamed(&pose.translation), ..pose }.to_array(),
            Self::Angles(axes) => Pose { angles: axes.renamed(&pose.angles), ..pose }.to_array(),
            Self::LeftHanded => {
                SignedAxes::new(LEFT_HANDED).map_or(numbers, |axes| axes.pose(&pose).to_array())
            }
            Self::Inverse => {
                let back = pose.rotation().transpose();
                Pose::from_rotation(-(back * pose.translation), &back).to_array()
            }
            Self::Order(order) => order.pose(&pose).to_array(),
        }
    }

    fn sigma_meant(self, sigma: [f64; 6]) -> [f64; 6] {
        let (shift, turn) = halves(&sigma);
        match self {
            Self::Positions(axes) => joined(&axes.renamed(&shift).abs(), &turn),
            Self::Angles(axes) => joined(&shift, &axes.renamed(&turn).abs()),
            _ => sigma,
        }
    }

    /// True for what may begin or end within a file: it is written in each row by itself.
    pub(super) fn is_of_rows(self) -> bool {
        !matches!(self, Self::LeftHanded | Self::Inverse | Self::Order(_))
    }

    /// What the author of the file meant, if this is the mistake.
    pub(super) fn meaning(self, of: PoseOf) -> String {
        let word = of.word();
        match self {
            Self::Reversed(which) => {
                format!("{} seem{} to have the other sign", of.numbers(which), verb(which))
            }
            Self::Scaled(which, factor) => {
                format!(
                    "{} seem{} to be in {} the unit the file states",
                    of.numbers(which),
                    verb(which),
                    multiple(factor)
                )
            }
            Self::Positions(axes) => format!(
                "the columns of the {word} positions seem to be in other axes: x, y, z are {axes} of the file"
            ),
            Self::Angles(axes) => format!(
                "the columns of the {word} angles seem to be about other axes: those about x, y, z are {axes} of the file"
            ),
            Self::LeftHanded => format!(
                "the {word} poses seem to be written in left-handed axes, or their positions with the other sign"
            ),
            Self::Inverse => {
                format!("the {word} poses seem to be those of the fixed frame, seen from the platform")
            }
            Self::Order(order) => format!("{}, it seems, in the {word} poses", order.text()),
        }
    }

    /// What `--read-as` takes behind the kind.
    pub(super) fn parsed(text: &str, axes: impl Fn(&str) -> Option<SignedAxes>) -> Option<Self> {
        if let Some(word) = text.strip_prefix('-') {
            return PoseNumbers::parsed(word).map(Self::Reversed);
        }
        if text.contains('*') {
            let (word, factor) = scaled(text)?;
            return Some(Self::Scaled(PoseNumbers::parsed(word)?, factor));
        }
        match text.split_once(':') {
            Some(("positions", columns)) => axes(columns).map(Self::Positions),
            Some(("angles", columns)) => axes(columns).map(Self::Angles),
            Some(_) => None,
            None if text == "left-handed" => Some(Self::LeftHanded),
            None if text == "inverse" => Some(Self::Inverse),
            None => AngleOrder::named(text).map(Self::Order),
        }
    }
}

/// Ending of the verb behind some numbers.
fn verb(which: PoseNumbers) -> &'static str {
    if matches!(which, PoseNumbers::One(_)) { "s" } else { "" }
}

impl fmt::Display for PoseMistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Reversed(which) => write!(f, "-{}", which.word()),
            Self::Scaled(which, factor) => write!(f, "{}*{}", which.word(), short(*factor)),
            Self::Positions(axes) => write!(f, "positions:{axes}"),
            Self::Angles(axes) => write!(f, "angles:{axes}"),
            Self::LeftHanded => f.write_str("left-handed"),
            Self::Inverse => f.write_str("inverse"),
            Self::Order(order) => f.write_str(order.word()),
        }
    }
}

#[cfg(test)]
mod tests {
    use hexbench_core::Vector3;

    use super::*;

    const STATED: [f64; 3] = [0.1, -0.2, 0.3];

    fn pose(rotation: &hexbench_core::Matrix3) -> [f64; 6] {
        Pose::from_rotation(Vector3::new(0.01, 0.02, 0.03), rotation).to_array()
    }

    #[test]
    fn what_is_wrong_with_angles_is_wrong_with_those_that_the_file_states() {
        let close = |a: [f64; 6], b: [f64; 6]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        let stated = Vector3::from(STATED);
        for convention in AngleConvention::ALL {
            let read = pose(&convention.rotation(&stated));
            let found = PoseMistake::Reversed(PoseNumbers::One(4)).meant(read, convention);
            assert!(close(found, pose(&convention.rotation(&Vector3::new(0.1, 0.2, 0.3)))), "{convention:?}");
            for order in AngleOrder::ALL {
                let found = PoseMistake::Order(order).meant(read, convention);
                assert!(close(found, pose(&order.rotation(&stated))), "{convention:?} {}", order.word());
            }
        }
    }

    #[test]
    fn positions_and_angles_are_told_apart_and_so_is_what_rows_have_by_themselves() {
        let angles: Vec<bool> = PoseNumbers::all().map(PoseNumbers::are_angles).collect();
        assert_eq!(angles, [false, true, false, false, false, true, true, true]);
        let mistakes =
            [PoseMistake::Reversed(PoseNumbers::Angles), PoseMistake::Inverse, PoseMistake::LeftHanded];
        assert_eq!(mistakes.map(PoseMistake::is_of_rows), [true, false, false]);
    }
}
