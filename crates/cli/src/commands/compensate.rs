//! `hexbench compensate model.toml POSES.csv`.

use std::path::PathBuf;

use clap::Args;
use hexbench_core::files::CsvText;
use hexbench_core::{Dataset, Measurand, Observation};
use hexbench_model::application::compensate::compensate;

use crate::csv::{self, Unit};
use crate::failure::Failure;
use crate::input::{self, TableNames, Trust};
use crate::output::{OutFile, Screen};

/// Compute the command that brings the loaded platform to the desired pose
///
/// The pose columns are the desired poses, the wrench columns the total load. The output has the same columns with the pose to
/// command (`a_mm` ... `gamma_deg`), the desired pose, the error without correction, the remaining error as the model predicts
/// it, and the standard uncertainty of the pose reached.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench compensate model.toml wanted.csv -o commands.csv")]
pub(crate) struct Arguments {
    /// The model that `fit` saved: model.toml
    model: PathBuf,
    #[command(flatten)]
    trust: Trust,
    /// Desired poses and loads: measurements.csv without the measured columns
    poses: PathBuf,
    #[command(flatten)]
    names: TableNames,
    /// Write to FILE instead of standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: OutFile,
}

const AXES: [&str; 6] = Measurand::AbsolutePose.names();

/// Correct every row.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let model = arguments.trust.model(&arguments.model)?;
    let rows = input::conditions(&arguments.poses, &arguments.names, &model.hexapod)?;
    input::warn_of_missing_columns(&model, &rows, &arguments.poses);
    let corrections = compensate(&model, &rows.observations).map_err(Failure::in_file(&arguments.poses))?;
    let commands = rows.observations.iter().zip(&corrections).map(|(row, c)| (row.line, c.command));
    input::warn_of_stroke(&model, commands, &arguments.poses);
    input::warn_of_extrapolation(&model, &rows.observations, &arguments.poses);
    let (pose, small) = ([Unit::Mm, Unit::Deg], [Unit::Um, Unit::Urad]);
    let results = [("wanted_", pose), ("uncorrected_d", small), ("remaining_d", small), ("sigma_", small)];
    let results = results.into_iter().flat_map(|(prefix, units)| csv::names(prefix, &AXES, units));
    let conditions = csv::condition_columns(&rows);
    let mut text = CsvText::new(conditions.names().chain(results));
    let stated = |row: Observation| {
        model.hexapod.angles.as_stated(&Dataset::of_deflections("", vec![row])).observations[0]
    };
    for (row, c) in rows.observations.iter().zip(&corrections) {
        let commanded = stated(Observation { pose: c.command, ..*row });
        let [without, remaining] =
            [c.without, c.remaining].map(|measured| stated(Observation { measured, ..*row }));
        let wanted = csv::values(&without.pose.to_array(), pose);
        let errors =
            [without.measured, remaining.measured, c.sigma].into_iter().flat_map(|x| csv::values(&x, small));
        text.row(csv::condition(&conditions, &commanded).into_iter().chain(wanted).chain(errors));
    }
    screen.write_to(&arguments.output, &text.into_text())
}
