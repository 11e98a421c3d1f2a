//! `hexbench demo`: the whole story on measurements that come with the program.

use clap::Args;
use hexbench_core::files::{parse_hexapod, read_measurements_from};
use hexbench_model::terms::catalogue;
use hexbench_pages::Subject;

use crate::commands::diagnose::study;
use crate::failure::Failure;
use crate::output::Screen;

const HEXAPOD: &str = include_str!("../../../../data/cases/mujoco-foundation/hexapod.toml");
const MEASUREMENTS: &str = include_str!("../../../../data/cases/mujoco-foundation/measurements.csv");
const HOLDOUT: &str = include_str!("../../../../data/cases/mujoco-foundation/holdout.csv");

/// The whole story on bundled measurements: springs fail, the missing effect is named, the error falls
#[derive(Debug, Args)]
pub(crate) struct Arguments {}

/// Tell the story.
pub(crate) fn run(_: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let hexapod = parse_hexapod(HEXAPOD, "hexapod.toml")?;
    let data = read_measurements_from(MEASUREMENTS.as_bytes(), "measurements.csv")?.dataset;
    let holdout = read_measurements_from(HOLDOUT.as_bytes(), "holdout.csv")?.dataset;
    let study = study(&hexapod, &data, Some(&holdout), &catalogue())?;
    let subject = Subject { hexapod: &hexapod, data: &data, holdout: Some(&holdout), study: &study };
    let failed = |cause| Failure::Model { cause, data: data.source.clone() };
    screen.write(&hexbench_pages::demo(&subject, screen.ink()).map_err(failed)?)
}
