//! `hexbench design HEXAPOD SPACE`.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use hexbench_app::design::{self, Wish, design};
use hexbench_design::Criterion;

use crate::csv;
use crate::failure::Failure;
use crate::input;
use crate::output::{Progress, Screen};

/// Choose the poses that determine stiffnesses (and effects) best
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The machine: hexapod.toml
    hexapod: PathBuf,
    /// Where poses may lie and which loads there are: space.toml
    space: PathBuf,
    /// Number of poses, each read under every load and condition (default: 3)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=60))]
    poses: Option<u16>,
    /// Readings of each pose under each load and condition
    #[arg(long, value_name = "N", default_value = "3", value_parser = clap::value_parser!(u16).range(1..=1000))]
    repeats: u16,
    /// Choose so many readings, each with its pose, load and condition, instead of poses that are all read alike
    #[arg(long, value_name = "N", conflicts_with = "poses", value_parser = clap::value_parser!(u16).range(1..=2000))]
    readings: Option<u16>,
    /// Choose readings that together take so many hours; how long each takes is in the table budget of the space file
    #[arg(long, value_name = "H", conflicts_with_all = ["poses", "readings"], allow_negative_numbers = true)]
    hours: Option<f64>,
    /// Poses to choose readings from
    #[arg(long, value_name = "N", default_value = "256", value_parser = clap::value_parser!(u16).range(1..=8192))]
    candidates: u16,
    /// What makes a plan good (default: o1 for poses, d for readings and hours)
    #[arg(long, value_name = "CRITERION", value_parser = criterion())]
    criterion: Option<Criterion>,
    /// A term of the catalogue that the plan has to determine too; may be given several times
    #[arg(long = "add", value_name = "TERM")]
    terms: Vec<String>,
    /// Searches from different starts (default: 16; 128 for poses whose inputs count as exact)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    starts: Option<u16>,
    /// Seed of the starts
    #[arg(long, value_name = "S", default_value = "1")]
    seed: u32,
    /// Write the plan to FILE: the columns of measurements.csv without the measured ones
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// The criteria by their names as options, each explained in the help.
fn criterion() -> impl TypedValueParser<Value = Criterion> {
    let value = |c: Criterion| PossibleValue::new(c.option()).help(c.meaning());
    PossibleValuesParser::new(Criterion::ALL.map(value))
        .try_map(|option| Criterion::of_option(&option).ok_or("no criterion"))
}

/// Search, tell, save.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let hexapod = input::hexapod(&arguments.hexapod)?;
    let found = design(&hexapod, &arguments.space, &wish(arguments), &|starts| {
        let progress = Progress::of(starts, "starts");
        Box::new(move || progress.advance(1))
    })?;
    screen.show(&design::page(&found))?;
    let written = |path: &PathBuf| screen.write_to(path, &csv::conditions(&found.readings_to_take()));
    arguments.output.as_ref().map_or(Ok(()), written)
}

fn wish(arguments: &Arguments) -> Wish {
    Wish {
        poses: arguments.poses,
        repeats: arguments.repeats,
        readings: arguments.readings,
        hours: arguments.hours,
        candidates: arguments.candidates,
        criterion: arguments.criterion,
        terms: arguments.terms.clone(),
        starts: arguments.starts,
        seed: arguments.seed,
    }
}
