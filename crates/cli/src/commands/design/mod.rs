//! `hexbench design HEXAPOD SPACE`.

mod plan;
mod search;

use std::path::PathBuf;
use std::sync::Arc;

use clap::{Args, ValueEnum};
use hexbench_core::Hexapod;
use hexbench_design::budget::Amount;
use hexbench_design::nominal;
use hexbench_design::regressor::{ModelRegressor, SpringRegressor, Weights};
use hexbench_design::space_file::read_space;
use hexbench_model::fit_named::term_named;
use hexbench_model::noise::Noise;
use hexbench_model::term::Term;
use search::Bench;

use crate::failure::Failure;
use crate::input;
use crate::output::Screen;
use crate::page::designed::{Quantity, designed};

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
    #[arg(long, value_name = "CRITERION")]
    criterion: Option<Named>,
    /// A term of the catalogue that the plan has to determine too; may be given several times
    #[arg(long = "add", value_name = "TERM")]
    terms: Vec<String>,
    /// Searches from different starts (default: 128 for poses, 16 for readings and hours)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    starts: Option<u16>,
    /// Seed of the starts
    #[arg(long, value_name = "S", default_value = "1")]
    seed: u32,
    /// Write the plan to FILE: the columns of measurements.csv without the measured ones
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Names of the criteria.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Named {
    /// Geometric mean of the singular values, as in the paper
    O1,
    /// Inverse condition number
    O2,
    /// Smallest singular value
    O3,
    /// Smallest singular value times the inverse condition number
    O4,
    /// Inverse sum of the inverse singular values
    O5,
    /// Volume of the confidence ellipsoid
    D,
    /// Mean variance of the parameters
    A,
    /// Longest axis of the confidence ellipsoid
    E,
    /// Mean variance of a prediction over the workspace
    I,
}

/// Search, tell, save.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let hexapod = input::hexapod(&arguments.hexapod)?;
    let mut space = read_space(&arguments.space, &hexapod)?;
    if arguments.poses.is_some() {
        space.budget.limit = None;
    }
    space.budget.limit = asked(arguments)?.or(space.budget.limit);
    let terms = wanted(&arguments.terms)?;
    let weights = weights(&hexapod);
    let settings = space.settings();
    let bench = Bench { arguments, hexapod: &hexapod, space: &space };
    let found = if terms.is_empty() {
        let regressor = SpringRegressor::new(&hexapod, &settings, 1, weights);
        bench.design(&regressor, springs(&hexapod))?
    } else {
        let noise = Noise::stated(1.0 / weights.translation, 1.0 / weights.rotation);
        let nominal = nominal::compliance(&hexapod);
        let regressor = ModelRegressor::new(&hexapod, nominal, noise, &terms, &settings, 1)?;
        bench.design(
            &regressor,
            springs(&hexapod).into_iter().chain(sized(&terms, regressor.sizes())).collect(),
        )?
    };
    screen.write(&designed(&found, screen.ink()))?;
    arguments
        .output
        .as_ref()
        .map_or(Ok(()), |path| screen.write_to(path, &plan::table(&space, &found.visits)))
}

/// The budget of the arguments.
fn asked(arguments: &Arguments) -> Result<Option<Amount>, Failure> {
    const SECONDS: f64 = 3600.0;
    match arguments.hours {
        Some(hours) if !(hours.is_finite() && hours > 0.0) => Err(Failure::Usage {
            message: format!("--hours {hours}: a budget must be positive"),
            next: "Give the hours that may be spent, for example --hours 3.".into(),
        }),
        Some(hours) => Ok(Some(Amount::Time(hours * SECONDS))),
        None => Ok(arguments.readings.map(|n| Amount::Readings(usize::from(n)))),
    }
}

/// The stiffnesses of the legs.
fn springs(hexapod: &Hexapod) -> Vec<Quantity> {
    let stiffness = nominal::stiffness(hexapod).map(|k| 1e-6 * k);
    (1..)
        .zip(stiffness)
        .map(|(leg, size)| Quantity { name: format!("leg-{leg}.stiffness"), unit: "N/um", size })
        .collect()
}

/// The parameters of terms in their natural sizes (SI).
fn sized(terms: &[Arc<dyn Term>], sizes: impl Iterator<Item = f64>) -> Vec<Quantity> {
    let own = |t: &Arc<dyn Term>| {
        let info = t.info();
        info.parameters
            .iter()
            .map(|p| (format!("{}.{}", info.id, p.name), p.unit, p.per_si))
            .collect::<Vec<_>>()
    };
    let all = terms.iter().flat_map(own).zip(sizes);
    all.map(|((name, unit, per_si), size)| Quantity { name, unit, size: size * per_si }).collect()
}

fn wanted(ids: &[String]) -> Result<Vec<Arc<dyn Term>>, Failure> {
    let catalogue = input::catalogue_with(&[]);
    let unknown = |cause| Failure::Model { cause, data: String::new() };
    ids.iter().map(|id| term_named(id, &catalogue).map_err(unknown)).collect()
}

/// Rows in units of the stated noise, columns in relative changes of the nominal compliance; without a stated noise as in
/// the paper.
fn weights(hexapod: &Hexapod) -> Weights {
    let Some(metrology) = hexapod.metrology else { return Weights::UNWEIGHTED };
    Weights {
        translation: 1.0 / metrology.sigma_translation,
        rotation: 1.0 / metrology.sigma_rotation,
        compliance: nominal::compliance(hexapod).into(),
    }
}
