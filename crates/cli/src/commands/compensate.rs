//! `hexbench compensate model.toml POSES.csv`.

use std::path::PathBuf;

use clap::Args;
use hexbench_model::compensate::compensate;

use crate::csv::{self, Unit};
use crate::failure::Failure;
use crate::input;
use crate::output::Screen;

/// Find the command that brings the loaded platform to the wanted pose
///
/// The pose columns are the wanted poses, the wrench columns the total load. Out come the same columns with the pose to
/// command, the wanted pose, the error without correction, what remains by the model's own
/// prediction, and the standard uncertainty of the pose reached.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The model that `fit` saved: model.toml
    model: PathBuf,
    /// Wanted poses and loads: the columns of measurements.csv without the measured ones
    poses: PathBuf,
    /// Write to FILE instead of standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
}

const AXES: [&str; 6] = ["a", "b", "c", "alpha", "beta", "gamma"];

/// Correct every row.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let model = input::model(&arguments.model)?;
    let rows = input::conditions(&arguments.poses)?;
    let corrections = compensate(&model, &rows.observations)
        .map_err(|cause| Failure::Row { path: arguments.poses.clone(), cause: Box::new(cause) })?;
    let (pose, small) = ([Unit::Mm, Unit::Deg], [Unit::Um, Unit::Urad]);
    let mut text = csv::conditions_header(&rows);
    csv::names(&mut text, "wanted_", &AXES, pose);
    csv::names(&mut text, "uncorrected_d", &AXES, small);
    csv::names(&mut text, "remaining_d", &AXES, small);
    csv::names(&mut text, "sigma_", &AXES, small);
    text.push('\n');
    for (row, c) in rows.observations.iter().zip(&corrections) {
        let commanded = hexbench_core::Observation { pose: c.command, ..*row };
        csv::condition(&mut text, &rows, &commanded);
        csv::values(&mut text, &row.pose.to_array(), pose);
        csv::values(&mut text, &c.without, small);
        csv::values(&mut text, &c.remaining, small);
        csv::values(&mut text, &c.sigma, small);
        text.push('\n');
    }
    screen.write_to(&arguments.output, &text)
}
