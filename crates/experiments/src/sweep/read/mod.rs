//! Reading `study.toml`.

mod axes;
mod effects;
mod files;
mod points;
mod question;
mod sizes;

use std::path::Path;

use hexbench_core::files::{Fault, FileError, Format, Item, KeyUnit, TomlSection, content_hash, read_toml};

use crate::keys::named;
use crate::sweep::axes::{Axes, Geometry};
use crate::sweep::question::Question;
use crate::sweep::study::{STUDY_FILE, SweepStudy, SweepTask};
use axes::AxesTable;
use files::Inputs;

const FORMAT: Format = Format {
    name: "study/1",
    keys: &KeyUnit::all_plain([
        "format", "title", "seed", "trials", "task", "space", "redraw", "starts", "indices", "question",
        "cost", "until", "design", "axes",
    ]),
};

/// Trials with the same machine unless the file says so: fits are cheap beside a machine, diagnoses are not.
fn usual_redraw(task: SweepTask) -> u64 {
    match task {
        SweepTask::Springs => 20,
        SweepTask::Diagnose => 1,
    }
}

/// Starts of a search for designed poses unless the file says so.
const USUAL_STARTS: u64 = 32;
/// Most trials of a study.
const MOST_TRIALS: u128 = 1_000_000_000;

/// The file before those it names are read.
struct Description {
    space: Option<String>,
    axes: AxesTable,
    /// What is wrong with it where sensors read.
    of_full_poses: Option<Fault>,
    /// The study, once these are.
    completed: Box<dyn FnOnce(Axes, Inputs) -> SweepStudy>,
}

impl SweepStudy {
    /// Reads a study and every file it names; names are relative to its folder.
    ///
    /// # Errors
    /// The first thing that is wrong, with line, column, value and next step.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let d = read_toml(path, FORMAT, description)?;
        let folder = path.parent().unwrap_or(Path::new("."));
        let mut inputs = Inputs::default();
        inputs.digests.insert(STUDY_FILE.to_owned(), content_hash(path)?);
        let axes = files::complete(d.axes, d.space.as_deref(), folder, &mut inputs)?;
        if let Some(fault) = d.of_full_poses.filter(|_| axes.geometry.iter().any(Geometry::has_sensors)) {
            return Err(fault.in_file(path));
        }
        Ok((d.completed)(axes, inputs))
    }
}

fn description(top: &TomlSection<'_>) -> Result<Description, Fault> {
    let whole = |key: &str, usual: u64| top.get(key).map_or(Ok(usual), |item| item.whole(1));
    let task = named(top.require("task")?, SweepTask::ALL, SweepTask::name, "task")?;
    let of_trials = top.require("trials")?;
    let seed = top.require("seed")?.whole(0)?;
    let axes = AxesTable::read(top, task, seed)?;
    let question = question::question(top, task, axes.effect.iter().any(|set| !set.is_empty()))?;
    question::refuse_ranges(top, &axes)?;
    let indices = top.get("indices").map_or(Ok(false), Item::boolean)? || question == Some(Question::Index);
    let title = top.require("title")?.string()?.to_owned();
    let trials = of_trials.whole(1)?;
    let space = top.get("space").map(|item| item.string().map(str::to_owned)).transpose()?;
    let (redraw, starts) = (whole("redraw", usual_redraw(task))?, whole("starts", USUAL_STARTS)?);
    let (until, cost) = (question::until(top, question, of_trials, task)?, question::cost(top)?);
    let of_full_poses = axes::of_full_poses(top.require("axes")?)?;
    let cells: u128 = axes.combined().map(|n| n as u128).iter().product();
    let all = cells * u128::from(trials);
    if all > MOST_TRIALS {
        let broken = format!("{cells} cells of {trials} trials are {all} trials; at most 10^9");
        return Err(of_trials.breaks(broken, "Use fewer trials, or fewer values on the axes."));
    }
    let completed = Box::new(move |axes, Inputs { digests: inputs, files }| {
        let files = files.into_iter().collect();
        SweepStudy {
            title,
            seed,
            trials,
            task,
            redraw,
            starts,
            indices,
            question,
            until,
            cost,
            axes,
            inputs,
            files,
        }
    });
    Ok(Description { space, axes, of_full_poses, completed })
}
