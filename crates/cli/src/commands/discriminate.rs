//! `hexbench discriminate HEXAPOD SPACE --between TERM --between TERM`.

use std::path::PathBuf;

use clap::Args;
use hexbench_app::discriminate::{SeparationWish, new_plan, next_readings, rivals};
use hexbench_design::space_file::read_space;

use super::design::steps;
use crate::csv;
use crate::failure::Failure;
use crate::input::{self, TableNames};
use crate::output::{OutFile, Screen, write_json};

/// Choose the readings that separate effects: a new plan, or the next readings to add to existing data
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench discriminate hexapod.toml space.toml --between base-compliance --between leg-coupling -o next.csv")]
pub(crate) struct Arguments {
    /// The machine: hexapod.toml
    hexapod: PathBuf,
    /// Allowed poses, and available loads and conditions: space.toml
    space: PathBuf,
    /// An effect to separate from the others; two or more
    #[arg(long, value_name = "TERM", required = true)]
    between: Vec<String>,
    /// A term file of your own (term/1) whose term `--between` may name
    #[arg(long = "term", value_name = "FILE")]
    terms: Vec<PathBuf>,
    /// Readings to choose (default: 12 for a new plan, 6 to add to existing data)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=200))]
    readings: Option<u16>,
    /// Existing measurements, to which the next readings are added
    #[arg(long, value_name = "FILE")]
    data: Option<PathBuf>,
    /// A plan to compare the new one with: poses and loads as in measurements.csv
    #[arg(long, value_name = "FILE", conflicts_with = "data")]
    against: Option<PathBuf>,
    /// Assumed effect size in a new plan: how many standard deviations each effect would stand out in evenly spread
    /// readings (5 is just visible)
    #[arg(long, value_name = "D", default_value = "20", conflicts_with = "data", value_parser = visibility)]
    visible: f64,
    /// Seed of the candidate poses
    #[arg(long, value_name = "S", default_value = "1")]
    seed: u32,
    /// Write the readings to FILE: measurements.csv without the measured columns
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutFile>,
    /// Write the result as JSON to FILE, or to standard output (-) instead of the page
    #[arg(long, value_name = "FILE")]
    json: Option<OutFile>,
}

fn visibility(text: &str) -> Result<f64, String> {
    let known = text.parse().ok().filter(|d: &f64| (0.1..=1e3).contains(d));
    known.ok_or_else(|| "a number from 0.1 to 1000".to_owned())
}

/// Choose, tell, save.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let hexapod = input::hexapod(&arguments.hexapod)?;
    let space = read_space(&arguments.space, &hexapod)?.at_corners().with_loads_fixed();
    let own = input::user_terms(&arguments.terms)?;
    let terms = rivals(&arguments.between, &input::catalogue_with(&own))?;
    let &Arguments { readings, visible, seed, .. } = arguments;
    let wish = SeparationWish { readings, visible, seed };
    let found = if let Some(path) = &arguments.data {
        let data = input::measurements(&hexapod, path, &TableNames::default())?;
        next_readings(&hexapod, &space, &terms, &wish, (&data, &path.display().to_string()))?
    } else {
        let other = arguments.against.as_deref();
        let against =
            other.map(|path| input::conditions(path, &TableNames::default(), &hexapod)).transpose()?;
        new_plan(&hexapod, &space, &terms, &wish, against.as_ref(), &steps("readings"))?
    };
    write_json(screen, arguments.json.as_ref(), &found.json())?;
    screen.show_unless([&arguments.json], || found.page())?;
    let written =
        |path: &OutFile| screen.write_to(path, &csv::conditions(&found.readings_to_take(), &hexapod));
    arguments.output.as_ref().map_or(Ok(()), written)
}
