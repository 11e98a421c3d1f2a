//! Reading input files, with their warnings told on standard error.

use std::path::{Path, PathBuf};

use clap::Args;

use hexbench_app::input::model;
pub(crate) use hexbench_app::input::{catalogue_with, user_terms};
use hexbench_app::memory::Computation;
use hexbench_core::files::{
    BallTable, ColumnNames, Dimension, TableReading, Unit, Warning, read_balls, read_balls_records,
    read_campaign, read_campaign_named, read_campaign_records, read_column_names, read_conditions_named,
    read_hexapod, read_loads, read_loads_records, read_plan, unit_named,
};
use hexbench_core::{AngleConvention, Dataset, Hexapod, LineRange, LoadTable, Observation, Pose};
use hexbench_model::application::model_file::Model;
use hexbench_model::effects::untestable::columns_missing;
use hexbench_model::estimation::estimate::Estimate;
use hexbench_model::inference::misread::held_in;
use hexbench_model::results::check::far_from_stated;
use hexbench_model::results::diagnose::misread_findings;
use hexbench_model::terms::catalogue;
use hexbench_report::table::{is_parquet, read_parquet};
use hexbench_report::words::as_option;

use crate::failure::Failure;
use crate::output::report;
use crate::read_as::ReadAs;

/// What columns of tables are called, and how long tables may be.
#[derive(Debug, Default, Args)]
pub(crate) struct TableNames {
    /// Names of the columns in the tables, if they differ from those of hexbench (format columns/1)
    #[arg(long, value_name = "FILE")]
    columns: Option<PathBuf>,
    /// Refuse tables with more rows [default: 5000000]
    #[arg(long, value_name = "ROWS")]
    max_rows: Option<usize>,
}

impl TableNames {
    /// Reads the map; none: the names of hexbench.
    pub(crate) fn read(&self) -> Result<ColumnNames, Failure> {
        let names = self.columns.as_deref().map(read_column_names).transpose()?.unwrap_or_default();
        Ok(match self.max_rows {
            Some(most) => names.with_most_rows(most),
            None => names,
        })
    }

    /// The options as a shell takes them.
    pub(crate) fn words(&self) -> Vec<String> {
        let columns = self.columns.iter().map(|path| as_option("columns", path));
        columns.chain(self.max_rows.iter().map(|rows| format!("--max-rows {rows}"))).collect()
    }
}

/// How much memory may be used.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct MemoryLimit {
    /// Memory limit, GB; work that needs more is refused before it starts [default: the free memory]
    #[arg(long, value_name = "GB", value_parser = gigabytes)]
    max_memory: Option<f64>,
}

fn gigabytes(text: &str) -> Result<f64, String> {
    let fits = |gb: &f64| gb.is_finite() && *gb >= 0.0;
    text.parse().ok().filter(fits).ok_or_else(|| "this must be a number of gigabytes, for example 8".into())
}

impl MemoryLimit {
    /// Refuses a computation that needs more.
    pub(crate) fn refuse(self, computation: Computation, data: &Dataset) -> Result<(), Failure> {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "not negative; an absurd limit is none"
        )]
        let most = self.max_memory.map(|gigabytes| (gigabytes * 1e9) as u64);
        computation.refuse_beyond(data, most)
    }
}

/// Readings that a search uses of a long table.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct MostReadings {
    /// Use at most N readings: of a longer table, poses are drawn at random, each with all of its readings [default: 50000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(FEWEST_READINGS..))]
    most_readings: Option<u64>,
}

/// Readings that say something of a machine, however they are drawn.
const FEWEST_READINGS: u64 = 1_000;
/// Readings that take some ten seconds and less than a gigabyte.
const MOST_READINGS: u64 = 50_000;

impl MostReadings {
    /// Those readings of a table, the lines of `kept` among them.
    pub(crate) fn of(self, data: Dataset, kept: &[LineRange]) -> Dataset {
        let most = self.most_readings.unwrap_or(MOST_READINGS);
        let data = data.drawn(usize::try_from(most).unwrap_or(usize::MAX), kept);
        if let Some(all) = data.drawn_from {
            report::note(&format!(
                "{} of {all} readings are used, drawn at random by poses; `--most-readings {all}` uses all of them.",
                data.observations.len()
            ));
        }
        data
    }

    /// The option as a shell takes it.
    pub(crate) fn words(self) -> Option<String> {
        self.most_readings.map(|most| format!("--most-readings {most}"))
    }

    /// True where the number is the user's.
    pub(crate) fn is_given(self) -> bool {
        self.most_readings.is_some()
    }
}

/// The unit of coordinates that state none.
#[derive(Debug, Clone, Copy, Default, Args)]
pub(crate) struct BallUnit {
    /// Unit of the ball coordinates, if their file states none
    #[arg(long, value_name = "UNIT", value_parser = length)]
    unit: Option<&'static Unit>,
}

fn length(text: &str) -> Result<&'static Unit, String> {
    let unit = unit_named(text, Dimension::Length).filter(|unit| unit.kind == Dimension::Length);
    unit.ok_or_else(|| format!("a unit of length is one of {}", Dimension::Length.unit_names()))
}

/// Whether a model file may be other than `fit` wrote it.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct Trust {
    /// Use the model even if its file was changed after `fit` wrote it, or has no digest
    #[arg(long)]
    trust: bool,
}

impl Trust {
    /// The model of a file.
    pub(crate) fn model(self, path: &Path) -> Result<Model, Failure> {
        model(path, self.trust)
    }
}

/// The machine of a hexapod file.
pub(crate) fn hexapod(path: &Path) -> Result<Hexapod, Failure> {
    let machine = read_hexapod(path)?;
    if machine.angles != AngleConvention::default() {
        let [file, word] = [path.display().to_string(), machine.angles.word()];
        report::note(&format!(
            "{file}: tables use {word} angles; pages and JSON use angles about the fixed axes x, y, z"
        ));
    }
    Ok(machine)
}

/// The measurements of a file of a machine; what the reader noticed goes to standard error.
pub(crate) fn measurements(hexapod: &Hexapod, path: &Path, names: &TableNames) -> Result<Dataset, Failure> {
    let names = names.read()?;
    let reading = if is_parquet(path) {
        read_campaign_records(hexapod, &read_parquet(path)?, &names, path)?
    } else {
        read_campaign_named(hexapod, path, &names)?
    };
    Ok(warned(path, reading))
}

/// The same of a file that need not be given.
pub(crate) fn given_measurements(
    hexapod: &Hexapod,
    path: Option<&Path>,
    names: &TableNames,
) -> Result<Option<Dataset>, Failure> {
    path.map(|path| measurements(hexapod, path, names)).transpose()
}

/// Poses and loads that need no measurement; what was measured of them is passed over, by the sensors of `machine` too.
pub(crate) fn conditions(path: &Path, names: &TableNames, machine: &Hexapod) -> Result<Dataset, Failure> {
    Ok(warned(path, read_conditions_named(path, &names.read()?, Some(machine))?))
}

/// Poses and loads to be measured.
pub(crate) fn plan(machine: &Hexapod, path: &Path) -> Result<Dataset, Failure> {
    Ok(warned(path, read_plan(path, Some(machine))?))
}

/// The same as the sensors of a machine will read it: measurements by what was read, a plan by every sensor.
pub(crate) fn plan_of(hexapod: &Hexapod, path: &Path) -> Result<Dataset, Failure> {
    if hexapod.sensors.is_empty() {
        return plan(hexapod, path);
    }
    match read_campaign(hexapod, path) {
        Ok(measured) => Ok(warned(path, measured)),
        Err(_) => Ok(plan(hexapod, path)?.to_be_read_by(&hexapod.sensors)),
    }
}

/// Says on standard error how files are read otherwise than they say, and what they seem to mean instead.
pub(crate) fn warn_of_misread(hexapod: &Hexapod, data: &Dataset, read_as: &ReadAs) {
    let all = read_as.names();
    if !all.is_empty() {
        report::note(&format!(
            "the files are read differently from what they say, as requested: {}",
            all.join(", then ")
        ));
    }
    for finding in misread_findings(hexapod, data, &catalogue()).into_iter().take(1) {
        report::warn(&finding.text, &finding.next);
    }
}

/// Says on standard error that a model needs columns that a file of rows to predict does not have.
pub(crate) fn warn_of_missing_columns(model: &Model, rows: &Dataset, path: &Path) {
    let terms = model.point.active.iter().map(|active| active.term.as_ref());
    for (term, column) in columns_missing(terms, &rows.columns) {
        report::warn(
            &format!(
                "{}: the model has {term}, but the file has no column {column}: zero is assumed",
                path.display()
            ),
            &format!("Add the column {column}, unless it is zero in every row."),
        );
    }
}

/// Says on standard error that legs would have to be shorter or longer than they can be at poses that a file of rows leads to.
pub(crate) fn warn_of_stroke(model: &Model, poses: impl Iterator<Item = (u64, Pose)>, path: &Path) {
    let Some([shortest, longest]) = model.hexapod.stroke else { return };
    let machine = model.point.calibrated_machine();
    let beyond = |(line, pose): (u64, Pose)| {
        let lengths = machine.commanded_lengths(&pose);
        let all = (1..).zip(lengths.iter().copied());
        let far = all.filter(|(_, length)| !(shortest..=longest).contains(length));
        far.max_by(|a, b| (a.1 - longest).abs().total_cmp(&(b.1 - longest).abs()))
            .map(|(leg, l)| (line, leg, l))
    };
    let all: Vec<(u64, usize, f64)> = poses.filter_map(beyond).collect();
    let Some((line, leg, length)) = all.first() else { return };
    let more = if all.len() > 1 { format!(" (and {} lines more)", all.len() - 1) } else { String::new() };
    report::warn(
        &format!(
            "{}: line {line}: leg {leg} would have to be {:.1} mm long, but its stroke is {:.1} to {:.1} mm{more}",
            path.display(),
            length * 1e3,
            shortest * 1e3,
            longest * 1e3
        ),
        "The machine cannot take this pose: correct the pose, or the stroke in the hexapod file.",
    );
}

/// Says on standard error that rows are far beyond the readings that a model was fitted to.
pub(crate) fn warn_of_extrapolation(model: &Model, rows: &[Observation], path: &Path) {
    let Some(reach) = &model.reach else { return };
    let radius = model.hexapod.platform_radius();
    let all: Vec<(u64, String)> =
        rows.iter().filter_map(|row| Some((row.line, reach.exceeded(row, radius)?))).collect();
    let Some((line, what)) = all.first() else { return };
    let more = if all.len() > 1 { format!("; so are {} lines more", all.len() - 1) } else { String::new() };
    report::warn(
        &format!("{}: line {line} is far beyond the readings fitted: {what}{more}", path.display()),
        "The uncertainty does not cover what the model misses there. Measure there, and fit again.",
    );
}

/// Says on standard error that a file of held-out readings holds out nothing.
pub(crate) fn warn_of_holdout(data: &Dataset, holdout: Option<&Dataset>) {
    if let Some(finding) = holdout.and_then(|holdout| held_in(data, holdout)) {
        report::warn(
            &format!(
                "{} of the holdout file are readings of the measurements: it holds out nothing",
                finding.size
            ),
            &finding.next,
        );
    }
}

/// Says on standard error that a model is that of another machine.
pub(crate) fn warn_of_other_machine(model: &Model, hexapod: &Hexapod, path: &Path) {
    let (of_model, stated) = (&model.hexapod, hexapod);
    let is_same =
        of_model.base_joints == stated.base_joints && of_model.platform_joints == stated.platform_joints;
    if !is_same {
        report::warn(
            &format!(
                "{}: the model was fitted to the machine {:?} with other joints than those of {:?}",
                path.display(),
                of_model.name,
                stated.name
            ),
            "Use the hexapod file that the model was fitted with, unless the joints were measured again since.",
        );
    }
}

/// Says on standard error that the legs come out far stiffer or softer than their file states.
pub(crate) fn warn_of_stated_stiffness(hexapod: &Hexapod, found: &[Estimate]) {
    if let Some(ratio) = far_from_stated(hexapod, found) {
        report::warn(
            &format!("the fitted legs are {ratio:.3e} times as stiff as nominal_stiffness states"),
            "Check the units of the loads and of the readings, and the unit of nominal_stiffness in the hexapod file.",
        );
    }
}

/// Ball centers; what the reader noticed goes to standard error.
pub(crate) fn balls(path: &Path, names: &ColumnNames, unit: BallUnit) -> Result<BallTable, Failure> {
    let table = if is_parquet(path) {
        read_balls_records(&read_parquet(path)?, names, unit.unit, path)?
    } else {
        read_balls(path, names, unit.unit)?
    };
    warn_of_file(path, &table.warnings);
    Ok(table)
}

/// Loads and commanded poses of records.
pub(crate) fn loads(
    path: &Path,
    names: &ColumnNames,
    machine: Option<&Hexapod>,
) -> Result<LoadTable, Failure> {
    let table = if is_parquet(path) {
        read_loads_records(&read_parquet(path)?, names, machine, path)?
    } else {
        read_loads(path, names, machine)?
    };
    warn_of_file(path, &table.warnings);
    Ok(table)
}

/// Says on standard error what a reader noticed of a file.
fn warn_of_file(path: &Path, warnings: &[Warning]) {
    for warning in warnings {
        report::warn(&format!("{}: {warning}", path.display()), warning.next_step());
    }
}

fn warned(path: &Path, reading: TableReading) -> Dataset {
    warn_of_file(path, &reading.warnings);
    reading.dataset
}
