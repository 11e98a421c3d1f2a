//! `hexbench check HEXAPOD [DATA] [HOLDOUT]`.

use std::path::PathBuf;

use clap::Args;
use hexbench_model::results::check::check;
use hexbench_model::terms::catalogue;
use hexbench_report::charts::{drawing, sensors};
use hexbench_report::words;

use crate::failure::Failure;
use crate::input::{self, TableNames};
use crate::output::{OutFile, OutPlace, Screen, write_json};
use crate::read_as::ReadAs;

/// Check machine and files: how the program reads them, what looks wrong, what they can show
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench check hexapod.toml\n  \
    hexbench check hexapod.toml measurements.csv holdout.csv --picture machine.svg")]
pub(crate) struct Arguments {
    /// The machine: hexapod.toml
    hexapod: PathBuf,
    /// Deflections or absolute poses: measurements.csv
    data: Option<PathBuf>,
    /// Held-out readings, which no fit uses
    holdout: Option<PathBuf>,
    #[command(flatten)]
    names: TableNames,
    #[command(flatten)]
    read_as: ReadAs,
    /// Write all results to FILE, or to standard output (-) instead of the page
    #[arg(long, value_name = "FILE")]
    json: Option<OutFile>,
    /// Write a picture of the machine with its sensors to FILE (SVG)
    #[arg(long, value_name = "FILE")]
    picture: Option<OutPlace>,
}

/// Check and report; exit code 1 when something has to be put right first.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let hexapod = input::hexapod(&arguments.hexapod)?;
    let data = input::given_measurements(&hexapod, arguments.data.as_deref(), &arguments.names)?;
    let holdout = input::given_measurements(&hexapod, arguments.holdout.as_deref(), &arguments.names)?;
    let source = data.as_ref().map_or_else(|| arguments.hexapod.display().to_string(), |d| d.source.clone());
    let found = check(&hexapod, data.as_ref(), holdout.as_ref(), &catalogue(), &arguments.read_as.changes)
        .map_err(Failure::of_model(&source))?;
    write_json(screen, arguments.json.as_ref(), &found)?;
    if let Some(path) = &arguments.picture {
        screen.write_with_folder(path, &drawing(&hexapod)?)?;
    }
    screen
        .show_unless([&arguments.json], || words::check(&hexapod.name, &found).with_all(sensors(&hexapod)))?;
    if found.ready {
        Ok(())
    } else {
        Err(Failure::Check("the files seem to contain misstatements".to_owned()))
    }
}
