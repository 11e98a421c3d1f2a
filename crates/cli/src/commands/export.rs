//! `hexbench export SCENE --mjcf`.

use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args};
use hexbench_core::files::hexapod_to_toml;
use hexbench_core::{Hexapod, Pose};
use hexbench_truth::campaign::PlanRow;
use hexbench_truth::metrology::read_sensors;
use hexbench_truth::scene::{PartName, Scene};
use hexbench_truth::{TruthError, World, mjcf};

use crate::failure::Failure;
use crate::numbers;
use crate::output::{OutPlace, Screen, refuse_overlaps_of};
use crate::states::States;

/// Export the machine of a scene to another program
///
/// The model is at a commanded pose and includes all hidden effects of the scene; its keyframe `loaded` has the wrench of
/// the row. If the format cannot express an effect, an error names it.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("format").required(true))]
#[command(after_help = "Examples:\n  \
    hexbench export scenes/paper-rich --mjcf --pose 0,0,0,0,0,0 -o machine.xml\n  \
    hexbench export scenes/paper-rich --mjcf --states 5 -o states")]
pub(crate) struct Arguments {
    /// Folder of the scene
    scene: PathBuf,
    /// As a MuJoCo model (MJCF)
    #[arg(long, group = "format")]
    mjcf: bool,
    /// Model file, or `-` for standard output; with --states, the folder for models and states.csv
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: OutPlace,
    /// Row of the plan, counted from 1: its pose and its load
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    row: u64,
    /// Commanded pose instead of the row's, mm and deg
    #[arg(long, value_name = "A,B,C,ALPHA,BETA,GAMMA", value_parser = numbers::pose, allow_negative_numbers = true)]
    pose: Option<Pose>,
    /// Write models of N conditions spread over the plan, their rest states in states.csv, and the machine in
    /// hexapod.toml
    #[arg(long, value_name = "N", conflicts_with_all = ["row", "pose"], value_parser = clap::value_parser!(u32).range(1..))]
    states: Option<u32>,
}

/// Write one model, or many with their states of rest.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    refuse_overlaps_of(&files(&arguments.scene), &[&arguments.output])?;
    let scene = Scene::read(&arguments.scene)?;
    match arguments.states {
        Some(count) => states(arguments, &scene, count as usize, screen),
        None => single(arguments, &scene, screen),
    }
}

/// The files that a scene may be read from.
pub(super) fn files(scene: &Path) -> Vec<PathBuf> {
    let folders = [scene.to_owned(), scene.join("sealed")];
    let entries = folders.iter().flat_map(std::fs::read_dir).flatten().flatten().map(|entry| entry.path());
    entries.filter(|path| path.extension().is_some_and(|end| end == "toml" || end == "csv")).collect()
}

fn single(arguments: &Arguments, scene: &Scene, screen: &Screen) -> Result<(), Failure> {
    let part = scene.part(PartName::Training);
    let mut row = part.row(arguments.row - 1).ok_or_else(|| {
        Failure::usage(
            format!("the plan of this scene has no row {}", arguments.row),
            format!("Use a row from 1 to {}.", part.len()),
        )
    })?;
    if let Some(pose) = arguments.pose {
        row.situation.pose = pose;
    }
    let model = mjcf::export(&scene.world(), &row.situation)
        .map_err(|cause| failed(arguments, format!("row {}", arguments.row), cause))?;
    screen.write_to(&arguments.output, &model)
}

fn states(arguments: &Arguments, scene: &Scene, count: usize, screen: &Screen) -> Result<(), Failure> {
    let folder = folder(&arguments.output)?;
    let plan = scene.plan();
    let chosen = spread(&plan.training, &plan.holdout, count);
    let world = scene.world();
    let mut table = States::default();
    for (k, (part, row)) in chosen.iter().enumerate() {
        let in_row = |cause| failed(arguments, format!("state {}", k + 1), cause);
        let name = model_name(k);
        let model = mjcf::export(&world, &row.situation).map_err(in_row)?;
        let rest = world.reading(&row.situation).map_err(in_row)?;
        screen.write_to(&folder.join(&name), &model)?;
        let read = read(&scene.hexapod, &world, row).map_err(in_row)?;
        table.push((*part, *row), &name, &rest.equilibrium, read);
    }
    screen.write_to(&folder.join("hexapod.toml"), &hexapod_to_toml(&scene.hexapod))?;
    screen.write_to(&folder.join("states.csv"), &table.csv(&scene.hexapod, &scene.name))
}

/// Name of the model of a state, which counts from 0.
pub(super) fn model_name(state: usize) -> String {
    format!("state-{:03}.xml", state + 1)
}

/// What sensors read of a condition.
fn read(hexapod: &Hexapod, world: &World, row: &PlanRow) -> Result<Vec<f64>, TruthError> {
    if hexapod.sensors.is_empty() {
        return Ok(Vec::new());
    }
    world.before_and_after(&row.situation).map(|states| read_sensors(hexapod, &states))
}

fn failed(arguments: &Arguments, place: String, cause: TruthError) -> Failure {
    Failure::SceneState { scene: arguments.scene.clone(), place, cause }
}

fn folder(path: &Path) -> Result<&Path, Failure> {
    if path.as_os_str() == "-" {
        return Err(Failure::usage("--states needs a folder", "Name one with -o DIR."));
    }
    std::fs::create_dir_all(path).map_err(Failure::unwritable(path))?;
    Ok(path)
}

/// At most `count` conditions, evenly over both parts of a plan; repeats of a condition are one.
pub(super) fn spread<'a>(
    training: &'a [PlanRow],
    holdout: &'a [PlanRow],
    count: usize,
) -> Vec<(PartName, &'a PlanRow)> {
    let named = |name, rows: &'a [PlanRow]| rows.iter().map(move |row| (name, row));
    let mut all: Vec<(PartName, &PlanRow)> =
        named(PartName::Training, training).chain(named(PartName::Holdout, holdout)).collect();
    all.dedup_by(|later, earlier| later.0 == earlier.0 && later.1.situation == earlier.1.situation);
    let wanted = count.min(all.len());
    (0..wanted).map(|k| all[k * all.len() / wanted]).collect()
}
