//! From the cells of a line to an observation.

use super::FileProblem;
use super::columns::{
    APPROACH, DELTA_T, ELAPSED, Group, MEASURED, ORDER, OVERLOAD, POSE, POSE_ID, REFERENCE, REFERENCE_AGE,
    REFERENCE_RECORD, REPEAT, Row, SIGMA, WRENCH,
};
use super::header::{Plan, Source};
use super::number::usable_si;
use super::sensor_columns::SensorSource;
use crate::{Approach, Channel, Measurand, Observation, Pose, UNREAD, Wrench};
use std::f64::consts::TAU;

/// Largest whole number that every smaller one is kept apart from.
const LARGEST_WHOLE: f64 = 9_007_199_254_740_992.0;

/// Largest believable angle, rad: a full turn, and a rounding.
const LARGEST_ANGLE: f64 = TAU * (1.0 + 1e-12);

/// A row while its cells are read.
pub(crate) struct FilledRow {
    row: Row,
    /// What cells of sensors hold, SI.
    sensors: Vec<(SensorSource, f64)>,
    /// Pose numbers that were not read.
    unread: [bool; 6],
}

impl FilledRow {
    /// Before any cell is read.
    pub(crate) fn new() -> Self {
        Self { row: defaults(), sensors: Vec::new(), unread: [false; 6] }
    }

    /// An empty cell of a reading.
    pub(crate) fn leave_out(&mut self, plan: &Plan, cell: usize) {
        if let Some(source) = &plan.sources[cell] {
            source.column.places.range().for_each(|place| self.unread[place - MEASURED] = true);
        }
    }

    /// Puts one number into its place, in SI, after checking it.
    pub(crate) fn fill(&mut self, source: &Source, value: f64) -> Result<(), FileProblem> {
        fill(&mut self.row, source, value)
    }

    /// The same for a column of a sensor.
    pub(crate) fn fill_sensor(&mut self, source: &SensorSource, value: f64) -> Result<(), FileProblem> {
        let si = usable_si(source.unit.to_si(value))?;
        if source.is_sigma && si <= 0.0 {
            return Err(FileProblem::Sigma);
        }
        self.sensors.push((*source, si));
        Ok(())
    }

    /// Whether loaded and reference wrench are the same.
    pub(crate) fn lacks_load(&self) -> bool {
        Wrench::from_array(six(&self.row, WRENCH)) == Wrench::from_array(six(&self.row, REFERENCE))
    }

    /// Adds the observations of the row, block by block.
    ///
    /// # Errors
    /// A number whose standard deviation has to be known and is not; a row without any reading.
    pub(crate) fn observations(
        &self,
        plan: &Plan,
        line: u64,
        running: i64,
        all: &mut Vec<Observation>,
    ) -> Result<(), FileProblem> {
        let one = observation(&self.row, plan, line, running);
        let is_full = plan.blocks == [Channel::POSE] && self.unread == [false; 6];
        if is_full || plan.measurand == Measurand::AbsolutePose {
            all.push(one);
            return Ok(());
        }
        let before = all.len();
        for (number, (block, stated)) in plan.blocks.iter().zip(&plan.stated).enumerate() {
            let (mut measured, mut sigma) = ([0.0; 6], [UNREAD; 6]);
            for k in 0..6 {
                let Some((value, own)) = self.read(plan, &one, block[k]) else { continue };
                (measured[k], sigma[k]) = (value, own.or(stated[k]).ok_or_else(no_sigma)?);
            }
            if sigma != [UNREAD; 6] {
                all.push(Observation { block: number, measured, sigma: Some(sigma), ..one });
            }
        }
        if all.len() == before {
            return Err(FileProblem::Rule {
                rule: "nothing was read in this row: all its cells of readings are empty".to_owned(),
                next: "Remove the row.".to_owned(),
            });
        }
        Ok(())
    }

    /// What a channel read, and the standard deviation the row states for it.
    fn read(&self, plan: &Plan, one: &Observation, channel: Channel) -> Option<(f64, Option<f64>)> {
        match channel {
            Channel::Nothing => None,
            Channel::Pose(k) => {
                let own = plan.columns.sigma.then(|| self.row[SIGMA + k]);
                (!self.unread[k]).then_some((one.measured[k], own))
            }
            Channel::Sensor { sensor, .. } => {
                let value = self.sensors.iter().find(|(s, _)| !s.is_sigma && s.channel == channel)?.1;
                let of_sensor = |s: &SensorSource| {
                    s.is_sigma
                        && matches!(s.channel, Channel::Sensor { sensor: other, .. } if other == sensor)
                };
                Some((value, self.sensors.iter().find(|(s, _)| of_sensor(s)).map(|(_, sigma)| *sigma)))
            }
        }
    }
}

/// Pose numbers beside sensors or empty cells need a weight.
pub(crate) fn no_sigma() -> FileProblem {
    FileProblem::Rule {
        rule: "the standard deviations of the pose numbers are not stated, and cells are empty or sensors stand beside them".to_owned(),
        next: "Fill in the numbers, or add [metrology] with sigma_translation_um and sigma_rotation_urad to the hexapod file, or sigma_ columns to this one.".to_owned(),
    }
}

/// A row before its cells are read: the values of absent columns.
fn defaults() -> Row {
    let mut row = [0.0; super::columns::PLACES];
    row[APPROACH] = Approach::default().sign();
    row[OVERLOAD] = Approach::OVERLOAD;
    row[REPEAT] = 1.0;
    row
}

/// Puts one number into its place, in SI, after checking it.
fn fill(row: &mut Row, source: &Source, value: f64) -> Result<(), FileProblem> {
    let si = source.unit.to_si(value);
    check(source, si)?;
    row[source.column.places.range()].fill(si);
    Ok(())
}

fn check(source: &Source, si: f64) -> Result<(), FileProblem> {
    use super::Dimension;
    match source.column.group {
        _ if usable_si(si).is_err() => Err(FileProblem::TooLarge),
        _ if source.column.is_whole() && (si.fract() != 0.0 || si.abs() > LARGEST_WHOLE) => {
            Err(FileProblem::NotWhole)
        }
        Group::Covariate if source.column.places.first == APPROACH && Approach::of_sign(si).is_none() => {
            Err(FileProblem::Approach)
        }
        Group::Covariate if source.column.places.first == OVERLOAD && si < 1.0 => Err(no_overload()),
        Group::Covariate if source.column.places.first == REFERENCE_AGE && si < 0.0 => Err(negative_age()),
        Group::Sigma if si <= 0.0 => Err(FileProblem::Sigma),
        Group::Sigma | Group::Number | Group::Covariate => Ok(()),
        _ if source.column.kind == Dimension::Angle && si.abs() > LARGEST_ANGLE => {
            Err(FileProblem::AngleTooLarge { turns: si.abs() / TAU })
        }
        _ => Ok(()),
    }
}

fn negative_age() -> FileProblem {
    FileProblem::Rule {
        rule: "the age of a load cannot be negative".to_owned(),
        next: "Write how long the reference load had been applied when the reference was read, zero if it had just been applied; omit the column if this is unknown.".to_owned(),
    }
}

fn no_overload() -> FileProblem {
    FileProblem::Rule {
        rule: "an overload is a factor of at least 1".to_owned(),
        next: "Write the largest change of load on the way, divided by that of the row: 1.4 for 40 % more, 1 if it was not exceeded.".to_owned(),
    }
}

/// The observation of a filled row.
fn observation(row: &Row, plan: &Plan, line: u64, running: i64) -> Observation {
    Observation {
        pose_id: if plan.has_pose { whole(row[POSE_ID]) } else { running },
        repeat: whole(row[REPEAT]),
        line,
        pose: Pose::from_array(six(row, POSE)),
        wrench: Wrench::from_array(six(row, WRENCH)),
        reference: Wrench::from_array(six(row, REFERENCE)),
        approach: Approach::of_sign(row[APPROACH]).unwrap_or_default(),
        overload: row[OVERLOAD],
        delta_t: row[DELTA_T],
        elapsed: row[ELAPSED],
        reference_age: plan.columns.reference_age.then(|| row[REFERENCE_AGE]),
        reference_record: plan.columns.reference_record.then(|| whole(row[REFERENCE_RECORD])),
        order: plan.columns.order.then(|| whole(row[ORDER])),
        block: 0,
        measured: six(row, MEASURED),
        sigma: plan.columns.sigma.then(|| six(row, SIGMA)),
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "checked to be whole and below 2^53 when it was filled in"
)]
fn whole(value: f64) -> i64 {
    value as i64
}

fn six(row: &Row, first: usize) -> [f64; 6] {
    std::array::from_fn(|i| row[first + i])
}
