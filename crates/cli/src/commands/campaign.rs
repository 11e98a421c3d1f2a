//! `hexbench campaign BALLS.csv LOADS.csv -o DIR`.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::Args;
use hexbench_core::files::{
    BallTable, campaign_to_csv, hexapod_to_commented_toml, measurements_to_csv, read_ball_places,
};
use hexbench_core::{AngleConvention, Hexapod, Measurand};
use hexbench_model::machine::registration::{
    BallCampaign, MovedBall, RecordsRead, STANDARD_GRAVITY, campaign_of_balls,
};
use hexbench_report::number::significant;

use crate::csv;
use crate::failure::Failure;
use crate::input::{self, BallUnit, TableNames};
use crate::output::{OutFile, Screen, report, write_json};
use crate::page::campaigned;

/// Compute measurements.csv from ball centers, loads and commanded poses
///
/// Each row of the loads names the records of its loaded state and its reference state. Masses are converted to wrenches. Without
/// --balls, the commanded poses of the reference records determine where the balls are on the platform.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench campaign balls.csv loads.csv --balls balls.toml -o campaign\n  \
    hexbench campaign balls.csv loads.csv --gravity 9.8072 -o campaign\n  \
    hexbench campaign balls.csv loads.csv --points hexapod.toml -o campaign\n  \
    hexbench campaign points.txt loads.csv --unit mm -o campaign\n\n\
    Ball centers may have one row per record (columns P1_x_mm ...), or be an export of Zeiss Calypso (table of \
    characteristics), PC-DMIS (text of a report) or SpatialAnalyzer (points as ASCII). The readers of these exports follow \
    public descriptions; the page says which one was used.\n\n\
    loads.csv has the columns record, ref_record, a_mm ... gamma_deg, and either fx_N ... mz_Nm with ref_fx_N ... ref_mz_Nm \
    or mass_kg with ref_mass_kg, load_x_mm ..., pull_x ...")]
pub(crate) struct Arguments {
    /// Ball centers: balls.csv with the columns record, ball, `x_mm`, `y_mm`, `z_mm`, or a file of another program
    data: PathBuf,
    /// Loads and commanded poses: loads.csv, one row per loaded record
    loads: PathBuf,
    #[command(flatten)]
    names: TableNames,
    #[command(flatten)]
    unit: BallUnit,
    /// Nominal ball positions (format balls/1)
    #[arg(long, value_name = "FILE")]
    balls: Option<PathBuf>,
    /// Standard deviation of one coordinate, um, instead of the one from the balls file or the residuals
    #[arg(long, value_name = "UM", allow_negative_numbers = true)]
    sigma_um: Option<f64>,
    /// Local gravitational acceleration, m/s^2
    #[arg(long, value_name = "M_PER_S2", default_value_t = STANDARD_GRAVITY, allow_negative_numbers = true)]
    gravity: f64,
    /// Rotate the axes of the measuring machine to those of the hexapod, as determined by its commanded poses
    #[arg(long)]
    align: bool,
    /// Keep the balls themselves as readings, without computing poses, and write this machine with one sensor
    /// per ball
    #[arg(long, value_name = "HEXAPOD")]
    points: Option<PathBuf>,
    /// Read and write angles by the [conventions] of this machine; --points does so too
    #[arg(long, value_name = "HEXAPOD", conflicts_with = "points")]
    hexapod: Option<PathBuf>,
    /// Write the content of the page as campaign.json to FILE, or to standard output (-) instead of the page
    #[arg(long, value_name = "FILE")]
    json: Option<OutFile>,
    /// Folder for measurements.csv; an existing file is never replaced
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
}

/// Names of the six numbers.
const NAMES: [&str; 6] = Measurand::DeflectionEuler.names();
/// Most warnings of a kind told one by one.
const MOST_TOLD: usize = 5;
/// Axes that stand farther apart are told, rad: five times what drawings are usually good for.
const ASIDE: f64 = 1.7e-3;

impl Arguments {
    /// The machine whose files they are, where it is given.
    fn machine(&self) -> Result<Option<Hexapod>, Failure> {
        self.points.as_deref().or(self.hexapod.as_deref()).map(input::hexapod).transpose()
    }
}

/// Register, pair and write.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let names = arguments.names.read()?;
    let BallTable { records, layout, .. } = input::balls(&arguments.data, &names, arguments.unit)?;
    let machine = arguments.machine()?;
    let loads = input::loads(&arguments.loads, &names, machine.as_ref())?;
    let places = arguments.balls.as_deref().map(read_ball_places).transpose()?;
    let how = RecordsRead {
        places: places.as_ref(),
        sigma: positive("--sigma-um", arguments.sigma_um)?.map(|um| um * 1e-6),
        gravity: positive("--gravity", Some(arguments.gravity))?.unwrap_or(STANDARD_GRAVITY),
        align: arguments.align,
    };
    let found = campaign_of_balls(&records, &loads, &how).map_err(Failure::in_file(&arguments.data))?;
    warn(arguments, &found);
    let files = match &machine {
        Some(hexapod) if arguments.points.is_some() => points(hexapod, &found)?,
        _ => vec![("measurements.csv", table(&found, machine.map_or_else(Default::default, |m| m.angles))?)],
    };
    for (name, _) in &files {
        Screen::refuse_existing(
            &arguments.output.join(name),
            "Name another folder with -o, or remove this file.",
        )?;
    }
    for (name, text) in &files {
        screen.write_into(&arguments.output, name, text)?;
    }
    let about =
        campaigned::Campaigned { found: &found, how: &how, layout, folder: &arguments.output, files: &files };
    write_json(screen, arguments.json.as_ref(), &campaigned::json(&about))?;
    screen.show_unless([&arguments.json], || campaigned::page(&about))
}

fn positive(name: &str, given: Option<f64>) -> Result<Option<f64>, Failure> {
    match given {
        Some(value) if !(value.is_finite() && value > 0.0) => {
            Err(Failure::usage(format!("{name} {value}: this number is positive"), "Omit or correct it."))
        }
        given => Ok(given),
    }
}

fn warn(arguments: &Arguments, found: &BallCampaign) {
    let file = arguments.data.display();
    for moved in found.moved.iter().take(MOST_TOLD) {
        report::warn(
            &format!("{file}: {}", moved_in_words(moved)),
            "Check whether a ball was knocked or badly measured; if so, remove the row from the loads.",
        );
    }
    if found.moved.len() > MOST_TOLD {
        let more = found.moved.len() - MOST_TOLD;
        report::warn(&format!("{file}: the same applies to {more} more rows"), "The page lists them.");
    }
    let turned = found.axes.filter(|axes| axes.angle > ASIDE + 5.0 * axes.uncertainty);
    if let Some(axes) = turned.filter(|_| !arguments.align && !found.dataset.is_absolute()) {
        let degrees = significant(axes.angle.to_degrees(), 3);
        report::warn(
            &format!(
                "{file}: the axes of the measuring machine are turned by {degrees} deg against those of the hexapod"
            ),
            "Add --align to rotate them back using the commanded poses; otherwise deflections are in the wrong axes.",
        );
    }
    if !found.unused.is_empty() {
        let (count, first) = (found.unused.len(), &found.unused[0]);
        report::warn(
            &format!("{file}: {count} of the records are in no row of the loads, record {first} the first"),
            "Nothing, if they are meant to be left out.",
        );
    }
}

pub(crate) fn moved_in_words(moved: &MovedBall) -> String {
    let [reference, loaded] = &moved.records;
    let um = significant(moved.change.abs() * 1e6, 3);
    let which = moved.balls.join(" or ");
    format!("ball {which} moved on the platform between records {reference} and {loaded}, by {um} um or more")
}

/// The readings, and the correlations of the six numbers of each row beside them.
fn table(found: &BallCampaign, angles: AngleConvention) -> Result<String, Failure> {
    let text = written(|out| measurements_to_csv(out, &angles.as_stated(&found.dataset)))?;
    let mut lines = text.lines();
    let header = csv::correlation_names(&NAMES).join(",");
    let mut all = format!("{},{header}\n", lines.next().unwrap_or_default());
    for (line, covariance) in lines.zip(&found.covariances) {
        all.extend([line, ",", &csv::correlations(covariance).join(","), "\n"]);
    }
    Ok(all)
}

/// The machine with its balls, and what they read.
fn points(hexapod: &Hexapod, found: &BallCampaign) -> Result<Vec<(&'static str, String)>, Failure> {
    if found.dataset.is_absolute() {
        let message = "--points: absolute poses have no displacement of a ball".to_owned();
        return Err(Failure::usage(message, "Omit --points, or name reference records in ref_record."));
    }
    if found.sigma <= 0.0 {
        let message = "--points: the noise of a coordinate is not known".to_owned();
        return Err(Failure::usage(message, "Add --sigma-um, or sigma_um in the balls file."));
    }
    let (machine, dataset) = found.as_points(hexapod);
    let table = written(|out| campaign_to_csv(out, &machine, &dataset))?;
    Ok(vec![("hexapod.toml", hexapod_to_commented_toml(&machine)), ("measurements.csv", table)])
}

fn written(table: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<String, Failure> {
    let mut text = Vec::new();
    table(&mut text).map_err(Failure::unwritable(Path::new("measurements.csv")))?;
    Ok(String::from_utf8_lossy(&text).into_owned())
}
