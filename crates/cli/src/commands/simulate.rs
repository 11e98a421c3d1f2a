//! `hexbench simulate SCENE -o DIR`.

use std::path::{Path, PathBuf};

use clap::Args;
use hexbench_app::simulate::{self, Choices};
use hexbench_truth::scene::{Existing, PartName, VirtualBench};

use crate::failure::Failure;
use crate::output::{Progress, Screen};
use crate::page::simulated;

/// Measure a machine with hidden imperfections on the virtual bench
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench simulate scenes/paper-rich -o trial\n  \
    hexbench simulate scenes/paper-rich --seed 7 --repeats 3 -o trial\n  \
    hexbench simulate scenes/hidden-3 --balls -o trial")]
pub(crate) struct Arguments {
    /// Folder of the scene, which contains scene.toml
    scene: PathBuf,
    /// Folder for hexapod.toml, measurements.csv, holdout.csv, balls.csv, loads.csv and sealed/truth.json
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Seed of plan and noise, instead of the scene's own
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Number of training poses, for a scene whose poses are random
    #[arg(long, value_name = "N")]
    poses: Option<u64>,
    /// Readings of each training condition
    #[arg(long, value_name = "N")]
    repeats: Option<u64>,
    /// Measure ball centers, which determine a pose as precisely as the scene's instrument, and write balls.csv and loads.csv for
    /// `hexbench campaign`
    #[arg(long)]
    balls: bool,
    /// Use an instrument without errors
    #[arg(long)]
    noise_free: bool,
    /// Replace files in a folder that is not empty
    #[arg(long)]
    force: bool,
    /// Print the hidden effects
    #[arg(long)]
    reveal: bool,
}

/// Simulate and tell what was written.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let &Arguments { seed, poses, repeats, balls, .. } = arguments;
    let choices = Choices { seed, poses, repeats, balls };
    let scene = simulate::scene(&arguments.scene, choices)?;
    write(&VirtualBench::new(&scene, arguments.noise_free), &arguments.output, arguments.force)?;
    let about = simulated::Simulated {
        scene: &scene,
        folder: &arguments.output,
        noise_free: arguments.noise_free,
        reveal: arguments.reveal,
    };
    screen.show(&simulated::page(&about))
}

fn write(bench: &VirtualBench<'_>, folder: &Path, force: bool) -> Result<(), Failure> {
    let rows = [PartName::Training, PartName::Holdout].map(|part| bench.scene().part(part).len());
    let progress = Progress::of(rows.iter().sum(), "rows");
    let existing = if force { Existing::Replaced } else { Existing::Refused };
    let written = bench.write(folder, existing, &|rows| progress.advance(rows));
    progress.done();
    Ok(written?)
}
