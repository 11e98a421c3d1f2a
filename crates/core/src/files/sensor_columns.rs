//! Columns that the sensors of a machine fill.

use super::column_name::without_brackets;
use super::columns::{COLUMNS, Column};
use super::error::Fault;
use super::line::Line;
use super::stated_unit::stated_unit;
use super::units::{Unit, unit_named};
use super::{Dimension, FileProblem};
use crate::{Channel, Sensor, SensorKind};

/// A column of a sensor.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SensorSource {
    /// What it reads.
    pub(crate) channel: Channel,
    /// True when it holds standard deviations, of all numbers of the sensor.
    pub(crate) is_sigma: bool,
    pub(crate) unit: &'static Unit,
}

/// The column of a sensor that `text` names; none when it names no sensor.
pub(crate) fn sensor_column(text: &str, sensors: &[Sensor]) -> Option<Result<SensorSource, FileProblem>> {
    let (base, bracketed) = without_brackets(text.trim());
    let base = base.trim().replace([' ', '-'], "_").to_lowercase();
    let rest_of = |sensor: &Sensor| {
        let rest = base.strip_prefix(&sensor.name)?;
        (rest.is_empty() || rest.starts_with('_')).then(|| rest.trim_start_matches('_').to_owned())
    };
    let named = sensors.iter().enumerate().filter_map(|(i, s)| Some((i, s, rest_of(s)?)));
    let (index, sensor, rest) = named.max_by_key(|(_, s, _)| s.name.len())?;
    Some(source(index, sensor, &rest, bracketed))
}

fn source(
    index: usize,
    sensor: &Sensor,
    rest: &str,
    bracketed: Option<&str>,
) -> Result<SensorSource, FileProblem> {
    let (is_sigma, rest) = rest.strip_prefix("sigma").map_or((false, rest), |r| (true, r.trim_matches('_')));
    let has_axis = !is_sigma && matches!(sensor.kind, SensorKind::Point { .. });
    let (axis, unit) = if has_axis { rest.split_once('_').unwrap_or((rest, "")) } else { ("", rest) };
    let Some(number) = (if has_axis { ["x", "y", "z"].iter().position(|a| *a == axis) } else { Some(0) })
    else {
        let rule = format!("{} is a point: its columns are {}", sensor.name, usual_names(sensor).join(", "));
        return Err(FileProblem::Rule { rule, next: "Name the axis in the column.".to_owned() });
    };
    let kind = if sensor.kind.is_angle() { Dimension::Angle } else { Dimension::Length };
    let usual = usual_names(sensor)[number].clone();
    let unit = bracketed.or(Some(unit).filter(|u| !u.is_empty()));
    let unit = stated_unit(&sensor.column(number), kind, usual, unit)?;
    Ok(SensorSource { channel: Channel::Sensor { sensor: index, number }, is_sigma, unit })
}

/// The column of something else that a sensor of this name would be taken to have.
pub(crate) fn column_taken_by(name: &str) -> Option<String> {
    let is_taken = |column: &&Column| {
        let lower = column.name.to_lowercase();
        lower.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
    };
    COLUMNS.iter().find(is_taken).map(Column::usual_name)
}

/// Names of the columns of a sensor with their usual units.
pub(crate) fn usual_names(sensor: &Sensor) -> Vec<String> {
    let unit = if sensor.kind.is_angle() { "urad" } else { "um" };
    (0..sensor.kind.numbers()).map(|number| format!("{}_{unit}", sensor.column(number))).collect()
}

/// True for a name that ends in a unit of length or of angle: those of readings.
pub(crate) fn ends_in_unit_of_reading(text: &str) -> bool {
    let (_, unit) = stem_and_unit(text);
    let of_kind = |kind| unit_named(unit, kind).is_some_and(|u| u.kind == kind);
    of_kind(Dimension::Length) || of_kind(Dimension::Angle)
}

/// What is wrong with an unknown column that looks like that of a sensor.
pub(crate) fn unknown_sensor(text: &str) -> FileProblem {
    let rule =
        format!("no sensor of the hexapod file is called \"{}\"", stem_and_unit(text).0.to_lowercase());
    let next = "Add a [[sensor]] of that name to the hexapod file, or begin the name of the column with x_ to have it ignored.";
    FileProblem::Rule { rule, next: next.to_owned() }
}

fn stem_and_unit(text: &str) -> (&str, &str) {
    match without_brackets(text.trim()) {
        (base, Some(unit)) => (base.trim(), unit),
        (base, None) => base.trim().rsplit_once('_').unwrap_or((base, "")),
    }
}

/// Every number of every sensor has one column, and no column of standard deviations comes twice.
pub(crate) fn refuse_missing_sensors(
    cells: &[Option<SensorSource>],
    sensors: &[Sensor],
    line: &Line<'_>,
) -> Result<(), Fault> {
    for (later, source) in cells.iter().enumerate() {
        let Some(source) = source else { continue };
        let is_same = |s: &SensorSource| (s.channel, s.is_sigma) == (source.channel, source.is_sigma);
        if let Some(first) = cells[..later].iter().position(|other| other.as_ref().is_some_and(is_same)) {
            let problem = FileProblem::DuplicateColumn {
                quantity: source.quantity(sensors),
                first: first + 1,
                first_name: line.text(first).into(),
            };
            return Err(Fault::new(line.place(later).with_name(line.text(later)), problem));
        }
    }
    let has_column = |channel: &Channel| cells.iter().flatten().any(|s| !s.is_sigma && s.channel == *channel);
    let absent = Channel::all([], sensors).into_iter().find(|channel| !has_column(channel));
    let Some(Channel::Sensor { sensor, .. }) = absent else { return Ok(()) };
    let sensor = &sensors[sensor];
    let rule = format!("sensor \"{}\" of the hexapod file has no column", sensor.name);
    let names = usual_names(sensor).join(", ");
    let next = format!("Add {names}, with empty cells where nothing was read, or remove the sensor.");
    Err(Fault::rule(line.whole_place(), rule, next))
}

impl SensorSource {
    /// What its column is called, without unit.
    fn quantity(&self, sensors: &[Sensor]) -> String {
        match self.channel {
            Channel::Sensor { sensor, number } => sensors[sensor].column(number),
            Channel::Pose(_) | Channel::Nothing => String::new(),
        }
    }
}
