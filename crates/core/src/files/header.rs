//! From the names of the columns to a plan for reading rows.

use super::column_name::{Named, read_column_name};
use super::column_names::ColumnNames;
use super::columns::{COLUMNS, Column, Group, MEASURED};
use super::error::Fault;
use super::line::Line;
use super::load_columns::{LoadSource, has_masses, has_reference, load_column, refuse_incomplete};
use super::other_names::{likely, stands_for};
use super::row::no_sigma;
use super::sensor_columns::{
    SensorSource, ends_in_unit_of_reading, refuse_missing_sensors, sensor_column, unknown_sensor,
};
use super::unit_row::is_row_of_units;
use super::units::Unit;
use super::warning::Notice;
use super::{FilePlace, FileProblem, Warning};
use crate::{Channel, Columns, Hexapod, Measurand, Sensor};

/// Most columns of a table: those of some hundred sensors.
const MOST_COLUMNS: usize = 4096;

/// One column of a file that is read.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Source {
    pub(crate) column: &'static Column,
    pub(crate) unit: &'static Unit,
}

/// How the rows of a file are read.
#[derive(Debug)]
pub(crate) struct Plan {
    /// For every cell: what it is, or none when it is ignored.
    pub(crate) sources: Vec<Option<Source>>,
    /// Names as the file spells them, for messages.
    pub(crate) names: Vec<String>,
    pub(crate) measurand: Measurand,
    pub(crate) columns: Columns,
    pub(crate) has_pose: bool,
    /// True where columns of readings may be absent, and their cells empty: the machine states what the others are worth.
    pub(crate) may_lack_readings: bool,
    /// For every cell: the sensor it belongs to.
    pub(crate) of_sensors: Vec<Option<SensorSource>>,
    /// For every cell of a table of loads: what only such tables have.
    pub(crate) of_loads: Vec<Option<LoadSource>>,
    /// What the numbers of observations are.
    pub(crate) blocks: Vec<[Channel; 6]>,
    /// Standard deviations that the machine states, number by number; none where they have to be known and are not.
    pub(crate) stated: Vec<[Option<f64>; 6]>,
}

impl Plan {
    /// True for the cell of a reading, which may be empty: nothing was read.
    pub(crate) fn may_be_empty(&self, cell: usize) -> bool {
        let is_pose = |source: &Source| {
            matches!(source.column.group, Group::Deflection | Group::Euler | Group::RotationVector)
        };
        self.may_lack_readings
            && (self.of_sensors[cell].is_some() || self.sources[cell].as_ref().is_some_and(is_pose))
    }
}

impl Plan {
    /// True for a line of units below the names of the columns.
    ///
    /// # Errors
    /// As [`is_row_of_units`].
    pub(crate) fn is_row_of_units(&self, line: &Line<'_>) -> Result<bool, Fault> {
        is_row_of_units(line, &self.names, |cell| self.sources[cell].as_ref().map(|source| source.unit))
    }
}

/// What a table is read for, and what is known of it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reads<'a> {
    pub(crate) purpose: GroupPurpose,
    pub(crate) machine: Option<&'a Hexapod>,
    /// What its columns are called.
    pub(crate) names: Option<&'a ColumnNames>,
}

impl<'a> Reads<'a> {
    pub(crate) fn of(purpose: GroupPurpose, machine: Option<&'a Hexapod>) -> Self {
        Self { purpose, machine, names: None }
    }
}

/// What a table is read for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GroupPurpose {
    /// Measurements: measured values are required.
    Measurements,
    /// Conditions to predict: poses and loads; measured values are passed over.
    Conditions,
    /// Conditions to be measured: as conditions to predict, and the standard deviations of what will be read.
    Plan,
    /// Conditions of records of a measuring machine: as conditions to predict, with the names of the records, and masses.
    Loads,
}

impl GroupPurpose {
    /// What a sheet of a workbook with such a table is called.
    pub(crate) fn usual_sheet(self) -> &'static str {
        match self {
            Self::Measurements => "measurements",
            Self::Conditions => "poses",
            Self::Plan => "plan",
            Self::Loads => "loads",
        }
    }

    fn passes_over(self, group: Group) -> bool {
        use Group::{Absolute, Deflection, Euler, RotationVector, Sigma};
        match group {
            Absolute | Deflection | Euler | RotationVector => self != Self::Measurements,
            Sigma => matches!(self, Self::Conditions | Self::Loads),
            _ => false,
        }
    }
}

/// Reads the header line.
pub(crate) fn read_header(
    line: &Line<'_>,
    reads: Reads<'_>,
    warnings: &mut Vec<Warning>,
) -> Result<Plan, Fault> {
    let Reads { purpose, machine, names: known } = reads;
    if line.len() > MOST_COLUMNS {
        let problem = FileProblem::TooManyColumns { found: line.len(), limit: MOST_COLUMNS };
        return Err(Fault::new(line.whole_place(), problem));
    }
    let sensors = machine.map_or(&[][..], |m| &m.sensors);
    let mut sources = Vec::with_capacity(line.len());
    let (mut of_sensors, mut of_loads) = (vec![None; line.len()], vec![None; line.len()]);
    let mut unknown = Vec::new();
    for cell in 0..line.len() {
        let place = line.place(cell).with_name(line.text(cell));
        let text = known.map_or(line.text(cell), |names| names.here(line.text(cell)));
        if let Some(source) = sensor_column(text, sensors) {
            let source = source.map_err(|problem| Fault::new(place, problem))?;
            of_sensors[cell] = (purpose == GroupPurpose::Measurements).then_some(source);
            sources.push(None);
            continue;
        }
        if let Some(own) = load_column(text).filter(|_| purpose == GroupPurpose::Loads) {
            of_loads[cell] = Some(own.map_err(|problem| Fault::new(place, problem))?);
            sources.push(None);
            continue;
        }
        match read_column_name(text) {
            Ok(Named::Known(column, _)) if purpose.passes_over(column.group) => sources.push(None),
            Ok(Named::Known(column, unit)) => sources.push(Some(Source { column, unit })),
            Ok(Named::Private) => sources.push(None),
            Ok(Named::Unknown) => {
                unknown.push((text, place));
                sources.push(None);
            }
            Err(problem) => return Err(Fault::new(place, problem)),
        }
    }
    let names = (0..line.len()).map(|cell| line.text(cell).to_owned()).collect();
    warnings.extend(unknown_columns(&unknown, &sources, reads)?);
    refuse_duplicates(&sources, line)?;
    if purpose == GroupPurpose::Measurements {
        refuse_missing_sensors(&of_sensors, sensors, line)?;
    }
    let whole = |problem| Fault::new(line.whole_place(), problem);
    if purpose == GroupPurpose::Loads {
        refuse_incomplete(&of_loads).map_err(whole)?;
    }
    let needs_wrench = has_masses(&of_loads) == [false; 2];
    let mut plan = plan(sources, names, purpose, machine, needs_wrench).map_err(whole)?;
    if purpose == GroupPurpose::Loads && plan.columns.reference && !has_reference(&of_loads) {
        return Err(whole(FileProblem::MissingColumns { names: vec!["ref_record".into()] }));
    }
    plan.of_loads = of_loads;
    plan.of_sensors = of_sensors;
    let metrology = machine.and_then(|m| m.metrology);
    plan.stated =
        plan.blocks.iter().map(|b| b.map(|channel| channel.stated_sigma(sensors, metrology))).collect();
    let is_weighed = plan.columns.sigma || plan.stated.iter().flatten().all(Option::is_some);
    if plan.blocks != [Channel::POSE] && !is_weighed {
        return Err(Fault::new(line.whole_place(), no_sigma()));
    }
    Ok(plan)
}

/// That columns are ignored. One that seems to hold a reading is refused: it would be believed to be in use.
fn unknown_columns(
    unknown: &[(&str, FilePlace)],
    sources: &[Option<Source>],
    reads: Reads<'_>,
) -> Result<Vec<Warning>, Fault> {
    let takes_readings = reads.machine.is_some() && reads.purpose == GroupPurpose::Measurements;
    let may_have = |column: &Column| may_have(sources, column) && !reads.purpose.passes_over(column.group);
    let warning = |(text, place): &(&str, FilePlace)| {
        let meant = stands_for(text, may_have);
        if takes_readings && ends_in_unit_of_reading(text) {
            let problem = match meant {
                Some(suggestion) => {
                    let likely = likely(unknown.iter().map(|(text, _)| *text), may_have);
                    FileProblem::ForeignColumn { suggestion, likely }
                }
                None => unknown_sensor(text),
            };
            return Err(Fault::new(place.clone(), problem));
        }
        Ok(Warning::new(place.clone(), Notice::IgnoredColumn { meant }))
    };
    unknown.iter().map(warning).collect()
}

/// True for a column that a table may have besides those it has.
fn may_have(sources: &[Option<Source>], column: &Column) -> bool {
    use Group::{Absolute, Deflection, Euler, RotationVector};
    let are_rivals = |one: Group, other: Group| {
        let deflections = [Deflection, Euler, RotationVector];
        one == Absolute && deflections.contains(&other) || one == Euler && other == RotationVector
    };
    let excludes = |other: &Column| {
        collide(other, column)
            || are_rivals(other.group, column.group)
            || are_rivals(column.group, other.group)
    };
    !sources.iter().flatten().any(|source| excludes(source.column))
}

fn refuse_duplicates(sources: &[Option<Source>], line: &Line<'_>) -> Result<(), Fault> {
    for (later, source) in sources.iter().enumerate() {
        let Some(Source { column, .. }) = source else { continue };
        let same = |other: &Option<Source>| other.as_ref().is_some_and(|other| collide(other.column, column));
        if let Some(first) = sources[..later].iter().position(same) {
            let problem = FileProblem::DuplicateColumn {
                quantity: column.name.into(),
                first: first + 1,
                first_name: line.text(first).into(),
            };
            return Err(Fault::new(line.place(later).with_name(line.text(later)), problem));
        }
    }
    Ok(())
}

/// True when two columns state one quantity; the rival measured groups are told apart later, as whole groups.
fn collide(one: &Column, other: &Column) -> bool {
    one.group == other.group && one.places.range().any(|place| other.places.range().contains(&place))
}

/// Which groups a file has, and which of their columns.
struct Present<'a>(&'a [Option<Source>]);

impl Present<'_> {
    fn any(&self, group: Group) -> bool {
        self.0.iter().flatten().any(|source| source.column.group == group)
    }

    fn fills(&self, group: Group, place: usize) -> bool {
        let fills = |column: &Column| column.group == group && column.places.range().contains(&place);
        self.0.iter().flatten().any(|source| fills(source.column))
    }

    /// True when one of the six measured numbers has a column.
    fn reads_pose(&self, measurand: Measurand, number: usize) -> bool {
        measured_groups(measurand).iter().any(|group| self.fills(*group, MEASURED + number))
    }

    /// Usual names of the columns of a group that are not there.
    fn missing(&self, group: Group) -> Vec<String> {
        let columns = COLUMNS.iter().filter(|column| column.group == group && column.is_usual_name());
        columns.filter(|column| !self.fills(group, column.places.first)).map(Column::usual_name).collect()
    }

    fn complete_or_absent(&self, group: Group, beginning: &'static str) -> Result<bool, FileProblem> {
        let missing = self.missing(group);
        match self.any(group) {
            true if !missing.is_empty() => {
                Err(FileProblem::IncompleteGroup { group: beginning, names: missing })
            }
            present => Ok(present),
        }
    }
}

fn plan(
    sources: Vec<Option<Source>>,
    names: Vec<String>,
    purpose: GroupPurpose,
    machine: Option<&Hexapod>,
    needs_wrench: bool,
) -> Result<Plan, FileProblem> {
    let sensors = machine.map_or(&[][..], |m| &m.sensors);
    let present = Present(&sources);
    let (measurand, measured) = match purpose {
        GroupPurpose::Measurements => {
            let measurand = measurand(&present, sensors)?;
            let all = machine.is_none() || measurand == Measurand::AbsolutePose;
            (measurand, if all { measured_groups(measurand) } else { &[] })
        }
        GroupPurpose::Conditions | GroupPurpose::Plan | GroupPurpose::Loads => {
            (Measurand::DeflectionEuler, &[][..])
        }
    };
    let poses = (0..6).filter(|&k| present.reads_pose(measurand, k));
    let blocks = match purpose {
        GroupPurpose::Measurements => Channel::in_blocks(&Channel::all(poses, sensors)),
        GroupPurpose::Conditions | GroupPurpose::Plan | GroupPurpose::Loads => vec![Channel::POSE],
    };
    let has_wrench = needs_wrench || present.any(Group::Wrench);
    let given = [Group::Pose].into_iter().chain(has_wrench.then_some(Group::Wrench));
    let groups = given.chain(measured.iter().copied());
    let missing: Vec<String> = groups.flat_map(|group| present.missing(group)).collect();
    if !missing.is_empty() {
        let is_missing = |column: &Column| missing.contains(&column.usual_name());
        let likely = likely(names.iter().map(String::as_str), is_missing);
        return Err(if likely.is_empty() {
            FileProblem::MissingColumns { names: missing }
        } else {
            FileProblem::OtherNames { names: missing, likely }
        });
    }
    let columns = optional_columns(&present)?;
    let of_reference = columns.reference || columns.reference_age || columns.reference_record;
    if of_reference && measurand == Measurand::AbsolutePose {
        return Err(FileProblem::ReferenceOfAbsolutePose);
    }
    if columns.order && measurand == Measurand::AbsolutePose {
        return Err(order_of_absolute_poses());
    }
    let has_pose = present.fills(Group::Number, super::columns::POSE_ID);
    Ok(Plan {
        sources,
        names,
        measurand,
        columns,
        has_pose,
        may_lack_readings: machine.is_some(),
        of_sensors: Vec::new(),
        of_loads: Vec::new(),
        blocks,
        stated: Vec::new(),
    })
}

fn order_of_absolute_poses() -> FileProblem {
    FileProblem::Rule {
        rule: "a sequence of loads applies to deflections only; absolute poses are assumed to start from the unloaded machine".to_owned(),
        next: "Remove the column order, or begin its name with x_.".to_owned(),
    }
}

fn optional_columns(present: &Present<'_>) -> Result<Columns, FileProblem> {
    use super::columns::{APPROACH, DELTA_T, ELAPSED, ORDER, OVERLOAD, REFERENCE_AGE, REFERENCE_RECORD};
    Ok(Columns {
        reference: present.complete_or_absent(Group::Reference, "ref_")?,
        sigma: present.complete_or_absent(Group::Sigma, "sigma_")?,
        approach: present.fills(Group::Covariate, APPROACH),
        overload: present.fills(Group::Covariate, OVERLOAD),
        delta_t: present.fills(Group::Covariate, DELTA_T),
        elapsed: present.fills(Group::Covariate, ELAPSED),
        reference_age: present.fills(Group::Covariate, REFERENCE_AGE),
        reference_record: present.fills(Group::Covariate, REFERENCE_RECORD),
        order: present.fills(Group::Covariate, ORDER),
    })
}

fn measurand(present: &Present<'_>, sensors: &[Sensor]) -> Result<Measurand, FileProblem> {
    let euler = present.any(Group::Euler);
    let vector = present.any(Group::RotationVector);
    let deflection = present.any(Group::Deflection) || euler || vector;
    match (deflection, present.any(Group::Absolute)) {
        (true, true) => Err(FileProblem::TwoModes),
        (false, false) if sensors.is_empty() => Err(FileProblem::NothingMeasured),
        (false, true) if !sensors.is_empty() => Err(FileProblem::Rule {
            rule: "sensors read deflections, and the table holds absolute poses".to_owned(),
            next: "Remove the [[sensor]] tables from the hexapod file, or give da_um ... instead of measured_a_mm ...".to_owned(),
        }),
        (false, false) => Ok(Measurand::DeflectionRotationVector),
        (false, true) => Ok(Measurand::AbsolutePose),
        (true, false) if euler && vector => Err(FileProblem::TwoRotations),
        (true, false) if vector => Ok(Measurand::DeflectionRotationVector),
        (true, false) => Ok(Measurand::DeflectionEuler),
    }
}

/// The groups that hold the six measured values.
pub(crate) fn measured_groups(measurand: Measurand) -> &'static [Group] {
    match measurand {
        Measurand::DeflectionEuler => &[Group::Deflection, Group::Euler],
        Measurand::DeflectionRotationVector => &[Group::Deflection, Group::RotationVector],
        Measurand::AbsolutePose => &[Group::Absolute],
    }
}
