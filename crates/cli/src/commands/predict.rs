//! `hexbench predict model.toml POSES.csv`.

use std::path::PathBuf;

use clap::Args;
use hexbench_core::files::CsvText;
use hexbench_core::{Dataset, Measurand, Observation};
use hexbench_model::application::predict::{predict, predict_sensors};

use crate::coverage::Coverage;
use crate::csv::{self, Unit};
use crate::failure::Failure;
use crate::input::{self, TableNames, Trust};
use crate::output::{OutFile, Screen};

/// Predict deflections (or absolute poses) and the sensor readings of the machine, with their uncertainties
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench predict model.toml poses.csv -o predicted.csv\n  \
    hexbench predict model.toml poses.csv --coverage 95 -o predicted.csv")]
pub(crate) struct Arguments {
    /// The model that `fit` saved: model.toml
    model: PathBuf,
    #[command(flatten)]
    trust: Trust,
    /// Poses and loads: measurements.csv without the measured columns
    poses: PathBuf,
    #[command(flatten)]
    names: TableNames,
    #[command(flatten)]
    coverage: Coverage,
    /// Write to FILE instead of standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: OutFile,
}

/// Predict every row.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let model = arguments.trust.model(&arguments.model)?;
    let rows = input::conditions(&arguments.poses, &arguments.names, &model.hexapod)?;
    input::warn_of_missing_columns(&model, &rows, &arguments.poses);
    input::warn_of_stroke(&model, rows.observations.iter().map(|row| (row.line, row.pose)), &arguments.poses);
    input::warn_of_extrapolation(&model, &rows.observations, &arguments.poses);
    let failed = Failure::in_file(&arguments.poses);
    let predictions = predict(&model, &rows.observations).map_err(failed)?;
    let readings = predict_sensors(&model, &rows.observations).map_err(failed)?;
    let units = if model.is_absolute() { [Unit::Mm, Unit::Deg] } else { [Unit::Um, Unit::Urad] };
    let (factor, beginning) =
        (arguments.coverage.of(model.noise.dof_beside(model.dof)).factor, arguments.coverage.beginning());
    let names = names(model.measurand);
    let small = [Unit::Um, Unit::Urad];
    let (values, sigmas) =
        (csv::names("", &names, units), csv::names(&beginning, &sigma_names(&names), small));
    let conditions = csv::condition_columns(&rows);
    let sensors = model.sensor_columns();
    let sigmas_of_sensors = sensors.iter().map(|name| format!("{beginning}{name}"));
    let of_sensors = sensors.iter().cloned().chain(sigmas_of_sensors);
    let mut text = CsvText::new(conditions.names().chain(values).chain(sigmas).chain(of_sensors));
    let predicted =
        rows.observations.iter().zip(&predictions).map(|(row, p)| Observation { measured: p.value, ..*row });
    let predicted = Dataset { measurand: model.measurand, observations: predicted.collect(), ..rows };
    let rows = model.hexapod.angles.as_stated(&predicted);
    for ((row, p), read) in rows.observations.iter().zip(&predictions).zip(&readings) {
        let (values, sigmas) =
            (csv::values(&row.measured, units), csv::values(&p.sigma.map(|sigma| factor * sigma), small));
        let of_sensors =
            csv::micro(read.iter().map(|r| r.value)).chain(csv::micro(read.iter().map(|r| factor * r.sigma)));
        text.row(csv::condition(&conditions, row).into_iter().chain(values).chain(sigmas).chain(of_sensors));
    }
    screen.write_to(&arguments.output, &text.into_text())
}

fn names(measurand: Measurand) -> [&'static str; 6] {
    match measurand {
        Measurand::DeflectionEuler | Measurand::DeflectionRotationVector => measurand.names(),
        Measurand::AbsolutePose => [
            "predicted_a",
            "predicted_b",
            "predicted_c",
            "predicted_alpha",
            "predicted_beta",
            "predicted_gamma",
        ],
    }
}

fn sigma_names(names: &[&'static str; 6]) -> [&'static str; 6] {
    names.map(|n| n.strip_prefix("predicted_").unwrap_or(n))
}
