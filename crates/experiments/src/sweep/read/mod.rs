//! Reading `study.toml`.

mod axes;
mod effects;
mod files;
mod points;
mod question;
mod sizes;

use std::path::Path;

use hexbench_core::files::{Fault, FileError, Format, Item, KeyUnit, TomlSection, content_hash, read_toml};

use hexbench_design::Budget;

use crate::keys::one_of;
use crate::sweep::axes::Geometry;
use crate::sweep::question::Question;
use crate::sweep::study::{STUDY_FILE, SweepStudy, SweepTask};
use axes::AxesTable;

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
    title: String,
    seed: u64,
    trials: u64,
    task: SweepTask,
    space: Option<String>,
    redraw: u64,
    starts: u64,
    indices: bool,
    question: Option<Question>,
    until: Option<f64>,
    cost: Option<Budget>,
    axes: AxesTable,
    /// What is wrong with it where sensors read.
    of_full_poses: Option<Fault>,
}

impl SweepStudy {
    /// Reads a study and every file it names; names are relative to its folder.
    ///
    /// # Errors
    /// The first thing that is wrong, with line, column, value and next step.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let d = read_toml(path, FORMAT, description)?;
        let folder = path.parent().unwrap_or(Path::new("."));
        let mut inputs = files::Inputs::default();
        inputs.digests.insert(STUDY_FILE.to_owned(), content_hash(path)?);
        let axes = files::complete(d.axes, d.space.as_deref(), folder, &mut inputs)?;
        if let Some(fault) = d.of_full_poses.filter(|_| axes.geometry.iter().any(Geometry::has_sensors)) {
            return Err(fault.in_file(path));
        }
        Ok(Self {
            title: d.title,
            seed: d.seed,
            trials: d.trials,
            task: d.task,
            redraw: d.redraw,
            starts: d.starts,
            indices: d.indices,
            question: d.question,
            until: d.until,
            cost: d.cost,
            axes,
            inputs: inputs.digests,
            files: inputs.files.into_iter().collect(),
        })
    }
}

fn description(top: &TomlSection<'_>) -> Result<Description, Fault> {
    let whole = |key: &str, usual: u64| top.get(key).map_or(Ok(usual), |item| item.whole(1));
    let task = one_of(top.require("task")?, &SweepTask::ALL.map(SweepTask::name), "task")?;
    let task = SweepTask::ALL[task];
    let trials = top.require("trials")?;
    let seed = top.require("seed")?.whole(0)?;
    let axes = AxesTable::read(top, task, seed)?;
    let question = question::question(top, task, axes.effect.iter().any(|set| !set.is_empty()))?;
    question::refuse_ranges(top, &axes)?;
    let indices = top.get("indices").map_or(Ok(false), Item::boolean)?;
    let d = Description {
        title: top.require("title")?.string()?.to_owned(),
        seed,
        trials: trials.whole(1)?,
        task,
        space: top.get("space").map(|item| item.string().map(str::to_owned)).transpose()?,
        redraw: whole("redraw", usual_redraw(task))?,
        starts: whole("starts", USUAL_STARTS)?,
        indices: indices || question == Some(Question::Index),
        question,
        until: question::until(top, question, trials, task)?,
        cost: question::cost(top)?,
        axes,
        of_full_poses: axes::of_full_poses(top.require("axes")?)?,
    };
    let cells: u128 = d.axes.combined().map(|n| n as u128).iter().product();
    let all = cells * u128::from(d.trials);
    if all > MOST_TRIALS {
        let broken = format!("{cells} cells of {} trials are {all} trials; at most 10^9", d.trials);
        return Err(trials.breaks(broken, "Use fewer trials, or fewer values on the axes."));
    }
    Ok(d)
}
