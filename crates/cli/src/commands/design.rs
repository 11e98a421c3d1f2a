//! `hexbench design HEXAPOD SPACE`.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use hexbench_app::design::{self, Designed, SensorWish, Wish, choose_sensors, design};
use hexbench_core::Hexapod;
use hexbench_core::files::hexapod_to_toml;
use hexbench_design::Criterion;
use hexbench_report::Page;
use hexbench_report::number::significant;

use crate::csv;
use crate::failure::Failure;
use crate::input;
use crate::output::{OutFile, PageFiles, Progress, Screen, provenance, write_json};

/// Choose the poses that best determine stiffnesses (and effects)
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench design hexapod.toml space.toml --poses 6 -o plan.csv\n  \
    hexbench design hexapod.toml space.toml --hours 3 --add joint-friction -o plan.csv\n  \
    hexbench design hexapod.toml plan.csv --sensors candidates.toml --choose 6 -o gauges.toml")]
pub(crate) struct Arguments {
    /// The machine: hexapod.toml
    hexapod: PathBuf,
    /// Allowed poses and available loads: space.toml; with --sensors also a plan: plan.csv or measurements.csv
    space: PathBuf,
    /// Number of poses, each measured under every load and condition (default: 3)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=60))]
    poses: Option<u16>,
    /// Readings per pose, load and condition
    #[arg(long, value_name = "N", default_value = "3", value_parser = clap::value_parser!(u16).range(1..=1000))]
    repeats: u16,
    /// Choose this many readings, each with its own pose, load and condition, instead of poses that all share the same
    /// loads and conditions
    #[arg(long, value_name = "N", conflicts_with = "poses", value_parser = clap::value_parser!(u16).range(1..=2000))]
    readings: Option<u16>,
    /// Choose readings that fit into this many hours; the table budget of the space file states how long each takes
    #[arg(long, value_name = "H", conflicts_with_all = ["poses", "readings"], allow_negative_numbers = true)]
    hours: Option<f64>,
    /// Number of candidate poses from which to choose readings
    #[arg(long, value_name = "N", default_value = "256", value_parser = clap::value_parser!(u16).range(1..=8192))]
    candidates: u16,
    /// Criterion to optimize (default: o1 for poses, d for readings and hours)
    #[arg(long, value_name = "CRITERION", value_parser = criterion())]
    criterion: Option<Criterion>,
    /// A term of the catalogue that the plan must also determine; may be given several times
    #[arg(long = "add", value_name = "TERM")]
    terms: Vec<String>,
    /// Number of searches from different starts (default: 16; 128 for poses whose inputs are taken as exact)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    starts: Option<u16>,
    /// Seed of the starts
    #[arg(long, value_name = "S", default_value = "1")]
    seed: u32,
    /// Write the plan to FILE: measurements.csv without the measured columns; with --sensors, the machine with the chosen sensors:
    /// hexapod.toml
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutFile>,
    /// Choose the best sensors for these poses from the candidates in FILE (sensor-candidates/1)
    #[arg(long, value_name = "FILE")]
    sensors: Option<PathBuf>,
    /// How many sensors to choose; with --budget, at most this many
    #[arg(long, value_name = "N", requires = "sensors", value_parser = clap::value_parser!(u16).range(1..=500))]
    choose: Option<u16>,
    /// Highest total cost of the sensors, in the unit of `cost` in FILE
    #[arg(long, value_name = "COST", requires = "sensors", allow_negative_numbers = true)]
    budget: Option<f64>,
    /// Choose the sensors that best separate this effect from the springs, instead of using a criterion
    #[arg(long, value_name = "TERM", requires = "sensors", conflicts_with_all = ["criterion", "terms"])]
    see: Option<String>,
    /// Write the chosen sensors as JSON to FILE, or to standard output (-) instead of the page
    #[arg(long, value_name = "FILE", requires = "sensors")]
    json: Option<OutFile>,
    #[command(flatten)]
    page: PageFiles,
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
    if let Some(candidates) = &arguments.sensors {
        return sensors(arguments, &hexapod, candidates, screen);
    }
    let found = planned(arguments, &hexapod)?;
    tell(arguments, &hexapod, design::page(&found), screen)?;
    let written =
        |path: &OutFile| screen.write_to(path, &csv::conditions(&found.readings_to_take(), &hexapod));
    arguments.output.as_ref().map_or(Ok(()), written)
}

fn planned(arguments: &Arguments, hexapod: &Hexapod) -> Result<Designed, Failure> {
    design(hexapod, &arguments.space, &wish(arguments), &steps("starts"))
}

/// Progress of so many steps.
pub(super) fn steps(unit: &'static str) -> impl Fn(u64) -> Box<dyn Fn() + Sync> {
    move |count| {
        let progress = Progress::of(count, unit);
        Box::new(move || progress.advance(1))
    }
}

/// Sensors for the poses of a plan, or for those that are designed first.
fn sensors(
    arguments: &Arguments,
    hexapod: &Hexapod,
    candidates: &Path,
    screen: &Screen,
) -> Result<(), Failure> {
    let is_space = arguments.space.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"));
    let designed = is_space.then(|| planned(arguments, hexapod)).transpose()?;
    let plan = match &designed {
        Some(found) => found.readings_to_take(),
        None => input::plan(hexapod, &arguments.space)?,
    };
    let chosen = choose_sensors(hexapod, &plan, candidates, &sensor_wish(arguments), &steps("searches"))?;
    write_json(screen, arguments.json.as_ref(), &chosen.file())?;
    let poses = designed.iter().flat_map(|found| design::page(found).sections.into_iter().take(1));
    let page = chosen.page();
    tell(arguments, hexapod, Page { sections: poses.chain(page.sections).collect(), ..page }, screen)?;
    let written = |path: &OutFile| screen.write_to(path, &hexapod_to_toml(&chosen.hexapod));
    arguments.output.as_ref().map_or(Ok(()), written)
}

/// The page on the terminal, unless standard output has something else, and in the files that are wanted.
fn tell(arguments: &Arguments, hexapod: &Hexapod, page: Page, screen: &Screen) -> Result<(), Failure> {
    let page = Page { title: "Plan of an experiment".to_owned(), ..page };
    let elsewhere =
        OutFile::any_is_stdout([&arguments.json, &arguments.output]) || arguments.page.to_stdout();
    arguments.page.write(screen, || located(arguments, hexapod, page.clone()))?;
    if elsewhere { Ok(()) } else { screen.show(&Page { title: String::new(), ..page }) }
}

/// The page of a file: it says of which machine it is, and what made it.
fn located(arguments: &Arguments, hexapod: &Hexapod, page: Page) -> Result<Page, Failure> {
    let micro = |sigma: f64| significant(sigma * 1e6, 2);
    let noise = match &hexapod.metrology {
        _ if !hexapod.sensors.is_empty() => "as stated for the sensors".to_owned(),
        Some(m) => {
            format!("{} um and {} urad per reading", micro(m.sigma_translation), micro(m.sigma_rotation))
        }
        None => "not stated".to_owned(),
    };
    let files = [&arguments.hexapod, &arguments.space].into_iter().chain(&arguments.sensors);
    let from = provenance(files)?.read_section();
    Ok(page.about("machine", &hexapod.name).about("noise", noise).with(from))
}

fn sensor_wish(arguments: &Arguments) -> SensorWish {
    SensorWish {
        choose: arguments.choose,
        budget: arguments.budget,
        see: arguments.see.clone(),
        criterion: arguments.criterion,
        terms: arguments.terms.clone(),
        starts: arguments.starts,
        seed: arguments.seed,
    }
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
        shown: arguments.see.iter().cloned().collect(),
        starts: arguments.starts,
        seed: arguments.seed,
    }
}
