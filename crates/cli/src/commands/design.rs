//! `hexbench design HEXAPOD SPACE`.

use std::path::PathBuf;
use std::sync::Arc;

use clap::{Args, ValueEnum};
use hexbench_core::{Columns, Dataset, Hexapod, Measurand, Pose, Vector6};
use hexbench_design::regressor::{ModelRegressor, PoseRegressor, SpringRegressor, Weights, reading};
use hexbench_design::space_file::read_space;
use hexbench_design::{Criterion, Problem, Search, Space};
use hexbench_model::fit_named::term_named;
use hexbench_model::noise::{Noise, NoiseSource};
use hexbench_model::term::Term;

use crate::csv;
use crate::failure::Failure;
use crate::input;
use crate::output::Screen;
use crate::page::designed::{Designed, designed};

/// Choose the poses that determine stiffnesses (and effects) best
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The machine: hexapod.toml
    hexapod: PathBuf,
    /// Where poses may lie and which loads there are: space.toml
    space: PathBuf,
    /// Number of poses
    #[arg(long, value_name = "N", default_value = "3", value_parser = clap::value_parser!(u16).range(1..=60))]
    poses: u16,
    /// Readings of each pose under each load
    #[arg(long, value_name = "N", default_value = "3", value_parser = clap::value_parser!(u16).range(1..=1000))]
    repeats: u16,
    /// What makes a plan good
    #[arg(long, value_name = "CRITERION", default_value = "o1")]
    criterion: Named,
    /// A term of the catalogue that the plan has to determine too; may be given several times
    #[arg(long = "add", value_name = "TERM")]
    terms: Vec<String>,
    /// Searches from different starts
    #[arg(long, value_name = "N", default_value = "128", value_parser = clap::value_parser!(u16).range(1..=4096))]
    starts: u16,
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
    let space = read_space(&arguments.space, &hexapod)?;
    let terms = wanted(&arguments.terms)?;
    let weights = weights(&hexapod);
    let repeats = usize::from(arguments.repeats);
    let found = if terms.is_empty() {
        let regressor = SpringRegressor::new(&hexapod, &space.loads, repeats, weights);
        search(arguments, &hexapod, &space, &regressor)?
    } else {
        let springs = Vector6::from(nominal_compliance(&hexapod));
        let noise = noise(&weights);
        let regressor = ModelRegressor::new(&hexapod, springs, noise, &terms, &space.loads, repeats)?;
        search(arguments, &hexapod, &space, &regressor)?
    };
    screen.write(&designed(&found, screen.ink()))?;
    let plan = || plan(&space, &found.poses, repeats);
    arguments.output.as_ref().map_or(Ok(()), |path| screen.write_to(path, &plan()))
}

fn search<R: PoseRegressor>(
    arguments: &Arguments,
    hexapod: &Hexapod,
    space: &Space,
    regressor: &R,
) -> Result<Designed, Failure> {
    let criterion = criterion(arguments.criterion, hexapod, space, regressor)?;
    let poses = usize::from(arguments.poses);
    let problem = Problem { hexapod, space, regressor, criterion: &criterion, poses };
    let Search { best, starts, ended, agreeing } =
        problem.search(usize::from(arguments.starts), arguments.seed)?;
    let rounded: Vec<Pose> = best.poses.iter().map(rounded).collect();
    Ok(Designed {
        criterion: criterion.name(),
        best: best.value,
        value: problem.value(&rounded),
        information: problem.information(&rounded)?,
        names: regressor.names(),
        poses: rounded,
        loads: space.loads.len(),
        repeats: usize::from(arguments.repeats),
        starts: [starts, ended, agreeing],
        weighted: hexapod.metrology.is_some(),
        seed: arguments.seed,
    })
}

/// `B` of criterion I is the mean information over the workspace.
fn criterion<R: PoseRegressor>(
    named: Named,
    hexapod: &Hexapod,
    space: &Space,
    regressor: &R,
) -> Result<Criterion, Failure> {
    Ok(match named {
        Named::O1 => Criterion::O1,
        Named::O2 => Criterion::O2,
        Named::O3 => Criterion::O3,
        Named::O4 => Criterion::O4,
        Named::O5 => Criterion::O5,
        Named::D => Criterion::D,
        Named::A => Criterion::A,
        Named::E => Criterion::E,
        Named::I => Criterion::mean_prediction(hexapod, space, regressor)?,
    })
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
        compliance: nominal_compliance(hexapod),
    }
}

/// Stated, or that of the paper's legs; m/N.
fn nominal_compliance(hexapod: &Hexapod) -> [f64; 6] {
    const USUAL_N_PER_M: f64 = 4e6;
    hexapod.nominal_stiffness.unwrap_or([USUAL_N_PER_M; 6]).map(f64::recip)
}

fn noise(weights: &Weights) -> Noise {
    Noise {
        translation: 1.0 / weights.translation,
        rotation: 1.0 / weights.rotation,
        source: NoiseSource::Metrology,
        dof: f64::INFINITY,
    }
}

/// To a micrometre and a thousandth of a degree.
fn rounded(pose: &Pose) -> Pose {
    let x = pose.to_array();
    Pose::from_array(std::array::from_fn(|k| {
        if k < 3 {
            (x[k] * 1e6).round() * 1e-6
        } else {
            ((x[k].to_degrees() * 1e3).round() * 1e-3).to_radians()
        }
    }))
}

fn plan(space: &Space, poses: &[Pose], repeats: usize) -> String {
    let mut observations = Vec::new();
    for (id, pose) in (1..).zip(poses) {
        for loading in &space.loads {
            for repeat in (1..).take(repeats) {
                let mut row = reading(*pose, loading);
                (row.pose_id, row.repeat) = (id, repeat);
                observations.push(row);
            }
        }
    }
    let rows = Dataset {
        source: String::new(),
        measurand: Measurand::DeflectionEuler,
        columns: Columns { reference: true, ..Columns::default() },
        observations,
    };
    let mut text = csv::conditions_header(&rows) + "\n";
    for row in &rows.observations {
        csv::condition(&mut text, &rows, row);
        text.push('\n');
    }
    text
}
