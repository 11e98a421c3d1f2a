//! The columns a table of measurements may have.

use super::Dimension;
use std::ops::Range;

/// What a column belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Group {
    /// `pose`, `repeat`.
    Number,
    /// Commanded pose.
    Pose,
    /// Wrench in the loaded state.
    Wrench,
    /// Wrench in the reference state.
    Reference,
    /// `approach`, `overload`, `delta_T`, `elapsed`, `ref_age`, `ref_record`, `order`.
    Covariate,
    /// Translation, loaded minus reference.
    Deflection,
    /// Rotation, loaded minus reference, as differences of the Euler angles.
    Euler,
    /// Rotation, loaded minus reference, as a rotation vector.
    RotationVector,
    /// Measured absolute pose.
    Absolute,
    /// Standard deviations.
    Sigma,
}

/// A column this program understands, and where its number goes in a [`Row`].
#[derive(Debug)]
pub(crate) struct Column {
    pub(crate) name: &'static str,
    pub(crate) kind: Dimension,
    pub(crate) group: Group,
    /// Places in the row that this column fills (three for the shorthand `sigma_translation`).
    pub(crate) places: Places,
}

/// First place and number of places.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Places {
    pub(crate) first: usize,
    pub(crate) count: usize,
}

impl Places {
    pub(crate) fn range(self) -> Range<usize> {
        self.first..self.first + self.count
    }
}

/// The numbers of one row in SI, at the places named below.
pub(crate) type Row = [f64; PLACES];

pub(crate) const POSE: usize = 0;
pub(crate) const WRENCH: usize = 6;
pub(crate) const REFERENCE: usize = 12;
pub(crate) const MEASURED: usize = 18;
pub(crate) const SIGMA: usize = 24;
pub(crate) const APPROACH: usize = 30;
pub(crate) const DELTA_T: usize = 31;
pub(crate) const ELAPSED: usize = 32;
pub(crate) const POSE_ID: usize = 33;
pub(crate) const REPEAT: usize = 34;
pub(crate) const REFERENCE_AGE: usize = 35;
pub(crate) const REFERENCE_RECORD: usize = 36;
pub(crate) const OVERLOAD: usize = 37;
pub(crate) const ORDER: usize = 38;
pub(crate) const PLACES: usize = 39;

const fn column(name: &'static str, kind: Dimension, group: Group, first: usize) -> Column {
    Column { name, kind, group, places: Places { first, count: 1 } }
}

const fn three(name: &'static str, kind: Dimension, first: usize) -> Column {
    Column { name, kind, group: Group::Sigma, places: Places { first, count: 3 } }
}

/// Every column, in the order files are written. Where two names fill one place, the first is the usual one.
pub(crate) static COLUMNS: &[Column] = &[
    column("pose", Dimension::Number, Group::Number, POSE_ID),
    column("repeat", Dimension::Number, Group::Number, REPEAT),
    column("a", Dimension::Length, Group::Pose, POSE),
    column("b", Dimension::Length, Group::Pose, POSE + 1),
    column("c", Dimension::Length, Group::Pose, POSE + 2),
    column("alpha", Dimension::Angle, Group::Pose, POSE + 3),
    column("beta", Dimension::Angle, Group::Pose, POSE + 4),
    column("gamma", Dimension::Angle, Group::Pose, POSE + 5),
    column("fx", Dimension::Force, Group::Wrench, WRENCH),
    column("fy", Dimension::Force, Group::Wrench, WRENCH + 1),
    column("fz", Dimension::Force, Group::Wrench, WRENCH + 2),
    column("mx", Dimension::Moment, Group::Wrench, WRENCH + 3),
    column("my", Dimension::Moment, Group::Wrench, WRENCH + 4),
    column("mz", Dimension::Moment, Group::Wrench, WRENCH + 5),
    column("ref_fx", Dimension::Force, Group::Reference, REFERENCE),
    column("ref_fy", Dimension::Force, Group::Reference, REFERENCE + 1),
    column("ref_fz", Dimension::Force, Group::Reference, REFERENCE + 2),
    column("ref_mx", Dimension::Moment, Group::Reference, REFERENCE + 3),
    column("ref_my", Dimension::Moment, Group::Reference, REFERENCE + 4),
    column("ref_mz", Dimension::Moment, Group::Reference, REFERENCE + 5),
    column("approach", Dimension::Number, Group::Covariate, APPROACH),
    column("overload", Dimension::Number, Group::Covariate, OVERLOAD),
    column("delta_T", Dimension::TemperatureDifference, Group::Covariate, DELTA_T),
    column("elapsed", Dimension::Time, Group::Covariate, ELAPSED),
    column("ref_age", Dimension::Time, Group::Covariate, REFERENCE_AGE),
    column("ref_record", Dimension::Number, Group::Covariate, REFERENCE_RECORD),
    column("order", Dimension::Number, Group::Covariate, ORDER),
    column("da", Dimension::Length, Group::Deflection, MEASURED),
    column("db", Dimension::Length, Group::Deflection, MEASURED + 1),
    column("dc", Dimension::Length, Group::Deflection, MEASURED + 2),
    column("dalpha", Dimension::Angle, Group::Euler, MEASURED + 3),
    column("dbeta", Dimension::Angle, Group::Euler, MEASURED + 4),
    column("dgamma", Dimension::Angle, Group::Euler, MEASURED + 5),
    column("drx", Dimension::Angle, Group::RotationVector, MEASURED + 3),
    column("dry", Dimension::Angle, Group::RotationVector, MEASURED + 4),
    column("drz", Dimension::Angle, Group::RotationVector, MEASURED + 5),
    column("measured_a", Dimension::Length, Group::Absolute, MEASURED),
    column("measured_b", Dimension::Length, Group::Absolute, MEASURED + 1),
    column("measured_c", Dimension::Length, Group::Absolute, MEASURED + 2),
    column("measured_alpha", Dimension::Angle, Group::Absolute, MEASURED + 3),
    column("measured_beta", Dimension::Angle, Group::Absolute, MEASURED + 4),
    column("measured_gamma", Dimension::Angle, Group::Absolute, MEASURED + 5),
    column("sigma_a", Dimension::Length, Group::Sigma, SIGMA),
    column("sigma_b", Dimension::Length, Group::Sigma, SIGMA + 1),
    column("sigma_c", Dimension::Length, Group::Sigma, SIGMA + 2),
    column("sigma_alpha", Dimension::Angle, Group::Sigma, SIGMA + 3),
    column("sigma_beta", Dimension::Angle, Group::Sigma, SIGMA + 4),
    column("sigma_gamma", Dimension::Angle, Group::Sigma, SIGMA + 5),
    column("sigma_da", Dimension::Length, Group::Sigma, SIGMA),
    column("sigma_db", Dimension::Length, Group::Sigma, SIGMA + 1),
    column("sigma_dc", Dimension::Length, Group::Sigma, SIGMA + 2),
    column("sigma_dalpha", Dimension::Angle, Group::Sigma, SIGMA + 3),
    column("sigma_dbeta", Dimension::Angle, Group::Sigma, SIGMA + 4),
    column("sigma_dgamma", Dimension::Angle, Group::Sigma, SIGMA + 5),
    column("sigma_drx", Dimension::Angle, Group::Sigma, SIGMA + 3),
    column("sigma_dry", Dimension::Angle, Group::Sigma, SIGMA + 4),
    column("sigma_drz", Dimension::Angle, Group::Sigma, SIGMA + 5),
    three("sigma_translation", Dimension::Length, SIGMA),
    three("sigma_rotation", Dimension::Angle, SIGMA + 3),
];

impl Column {
    /// True for a column that numbers things.
    pub(crate) fn is_whole(&self) -> bool {
        self.group == Group::Number || matches!(self.places.first, REFERENCE_RECORD | ORDER)
    }

    /// True for a column that a table may lack by itself.
    pub(crate) fn is_optional(&self) -> bool {
        matches!(self.group, Group::Number | Group::Covariate)
    }

    /// The unit files are written in: those of the format's definition.
    pub(crate) fn usual_unit(&self) -> &'static str {
        let absolute = matches!(self.group, Group::Pose | Group::Absolute);
        match self.kind {
            Dimension::Number | Dimension::Stiffness | Dimension::Mass => "",
            Dimension::Length if absolute => "mm",
            Dimension::Length => "um",
            Dimension::Angle if absolute => "deg",
            Dimension::Angle => "urad",
            Dimension::Force => "N",
            Dimension::Moment => "Nm",
            Dimension::TemperatureDifference => "K",
            Dimension::Time => "s",
        }
    }

    /// True when this is the first of the names that fill its place: the one that is written.
    pub(crate) fn is_usual_name(&self) -> bool {
        let rivals = COLUMNS.iter().filter(|other| other.group == self.group && other.places == self.places);
        self.places.count == 1 && rivals.map(|other| other.name).next() == Some(self.name)
    }

    /// Name with the usual unit, for example `fz_N`.
    pub(crate) fn usual_name(&self) -> String {
        match self.usual_unit() {
            "" => self.name.to_owned(),
            unit => format!("{}_{unit}", self.name),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_columns_fill_every_place_of_a_row() {
        let mut filled = [false; PLACES];
        for column in COLUMNS {
            column.places.range().for_each(|place| filled[place] = true);
        }
        assert_eq!(filled, [true; PLACES]);
    }

    #[test]
    fn no_name_is_listed_twice() {
        let mut names: Vec<_> = COLUMNS.iter().map(|column| column.name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), COLUMNS.len());
    }
}
