//! `hexbench poses BALLS.csv --balls balls.toml`.

use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args};
use hexbench_core::files::{BallTable, CsvText, csv_words, nearest, read_ball_places};
use hexbench_core::{BallRecord, Measurand};
use hexbench_model::machine::registration::{Places, Registered, RegisteredPose, register_all};
use hexbench_report::number::significant;

use crate::csv::{self, Unit};
use crate::failure::Failure;
use crate::input::{self, BallUnit, TableNames};
use crate::output::{OutFile, Screen, report};
use crate::page::located;

/// Compute poses and their uncertainties from ball centers measured on a coordinate measuring machine
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("places").required(true))]
#[command(after_help = "Examples:\n  \
    hexbench poses balls.csv --balls balls.toml -o poses.csv\n  \
    hexbench poses balls.csv --relative-to 1")]
pub(crate) struct Arguments {
    /// Ball centers: balls.csv with the columns record, ball, `x_mm`, `y_mm`, `z_mm`, or an export of another program, as for
    /// campaign
    data: PathBuf,
    #[command(flatten)]
    names: TableNames,
    #[command(flatten)]
    unit: BallUnit,
    /// Nominal ball positions (format balls/1), for absolute poses
    #[arg(long, value_name = "FILE", group = "places")]
    balls: Option<PathBuf>,
    /// Reference record: poses are relative to it, about the center of its balls
    #[arg(long, value_name = "RECORD", group = "places")]
    relative_to: Option<String>,
    /// Standard deviation of one coordinate, um, instead of the one from the balls file or the residuals
    #[arg(long, value_name = "UM", allow_negative_numbers = true)]
    sigma_um: Option<f64>,
    /// Write the table of poses to FILE instead of standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: OutFile,
}

/// Names of the six numbers.
const NAMES: [&str; 6] = Measurand::AbsolutePose.names();
/// Most warnings told one by one.
const MOST_TOLD: usize = 5;

/// Register every record.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let names = arguments.names.read()?;
    let BallTable { records, layout, .. } = input::balls(&arguments.data, &names, arguments.unit)?;
    let (places, stated) = places(arguments, &records)?;
    let sigma = given_sigma(arguments)?.or(stated);
    let found = register_all(&records, &places, sigma).map_err(Failure::in_file(&arguments.data))?;
    warn(&arguments.data, &found);
    screen.write_to(&arguments.output, &table(&found))?;
    if arguments.output.is_stdout() {
        return Ok(());
    }
    let about =
        located::Located { found: &found, places: &places, stated: sigma, layout, output: &arguments.output };
    screen.show(&located::page(&about))
}

fn given_sigma(arguments: &Arguments) -> Result<Option<f64>, Failure> {
    match arguments.sigma_um {
        Some(sigma) if !(sigma.is_finite() && sigma > 0.0) => Err(Failure::usage(
            format!("--sigma-um {sigma}: a standard deviation must be positive"),
            "Omit it to estimate it from the residuals.",
        )),
        given => Ok(given.map(|um| um * 1e-6)),
    }
}

/// Places to compare with, and the noise stated beside them, m.
fn places(arguments: &Arguments, records: &[BallRecord]) -> Result<(Places, Option<f64>), Failure> {
    if let Some(path) = &arguments.balls {
        let places = read_ball_places(path)?;
        return Ok((Places::nominal(&places), places.sigma));
    }
    let wanted = arguments.relative_to.as_deref().unwrap_or_default();
    match records.iter().find(|record| record.id == wanted) {
        Some(record) => Ok((Places::of_record(record), None)),
        None => Err(Failure::usage(
            format!("{}: there is no record {wanted}", arguments.data.display()),
            match nearest(wanted, records.iter().map(|record| record.id.as_str())) {
                Some(near) => format!("Write --relative-to {near}."),
                None => "Name a record of the column record.".into(),
            },
        )),
    }
}

fn warn(path: &Path, found: &Registered) {
    let moved: Vec<&RegisteredPose> = found.poses.iter().filter(|pose| pose.moved).collect();
    for pose in moved.iter().take(MOST_TOLD) {
        let Some((first, second, residual)) = &pose.worst else { continue };
        let (um, side) = (residual.abs() * 1e6, if *residual > 0.0 { "farther apart" } else { "closer" });
        let message = format!(
            "{}: record {}: balls {first} and {second} are {} um {side} than they should be: a ball moved",
            path.display(),
            pose.id,
            significant(um, 3)
        );
        report::warn(&message, "Check whether a ball was knocked or badly measured; if so, omit the record.");
    }
    if moved.len() > MOST_TOLD {
        let message =
            format!("{}: the same applies to {} more records", path.display(), moved.len() - MOST_TOLD);
        report::warn(&message, "The column moved of the table marks them.");
    }
}

/// The poses as a table whose columns are those of absolute measurements, with all correlations.
fn table(found: &Registered) -> String {
    let poses = csv::names("measured_", &NAMES, [Unit::Mm, Unit::Deg]);
    let sigmas = csv::names("sigma_", &NAMES, [Unit::Um, Unit::Urad]);
    let correlations = csv::correlation_names(&NAMES);
    let rest =
        ["x_rms_um", "x_worst_first", "x_worst_second", "x_worst_distance_um", "x_moved"].map(str::to_owned);
    let header = poses.into_iter().chain(sigmas).chain(correlations).chain(rest);
    let mut text = CsvText::new(std::iter::once("record".to_owned()).chain(header));
    found.poses.iter().for_each(|pose| text.row(row(pose)));
    text.into_text()
}

fn row(pose: &RegisteredPose) -> Vec<String> {
    let sigma: [f64; 6] = std::array::from_fn(|k| pose.covariance[(k, k)].sqrt());
    let (first, second, distance) = pose.worst.clone().unwrap_or_default();
    let [first, second] = [first, second].map(|ball| csv_words(&ball).into_owned());
    let [rms, distance] = [pose.rms, distance].map(|x| format!("{:.6}", x * 1e6));
    std::iter::once(csv_words(&pose.id).into_owned())
        .chain(csv::values(&pose.pose.to_array(), [Unit::Mm, Unit::Deg]))
        .chain(csv::values(&sigma, [Unit::Um, Unit::Urad]))
        .chain(csv::correlations(&pose.covariance))
        .chain([rms, first, second, distance, u8::from(pose.moved).to_string()])
        .collect()
}
