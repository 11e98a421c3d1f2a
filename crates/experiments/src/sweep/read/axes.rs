//! Reading `[axes]`.

use std::path::Path;

use hexbench_core::files::{Fault, Item, KeyUnit, TomlSection};
use hexbench_design::Criterion;
use hexbench_truth::campaign::{PlanKind, machines};

use super::points::Points;
use super::{effects, sizes};
use crate::keys::noise;
use crate::keys::{LABORATORY, fault_of_laboratory, named, sizes as size_keys, unknown};
use crate::sweep::axes::{Axes, Noises, PlanSource, SweepEstimator};
use crate::sweep::cells::{TOLERANCE_SCALE, place};
use crate::sweep::study::SweepTask;

/// Keys of `[axes]`.
const KEYS: &[KeyUnit] = &KeyUnit::all_plain(size_keys::names_behind::<11, { 11 + size_keys::COUNT }>([
    "geometry",
    "plan",
    "poses",
    "repeats",
    "estimator",
    "effect",
    noise::KEYS[0],
    noise::KEYS[1],
    LABORATORY,
    TOLERANCE_SCALE,
    "size_sigmas",
]));
/// Most poses of a plan.
const MOST_POSES: u64 = 200;
/// Most readings of a condition.
const MOST_REPEATS: u64 = 1000;

/// `[axes]` before the files it names are read.
pub(super) type AxesTable = Axes<GeometryName, PlanName>;

/// A family, or the name of a hexapod file.
pub(super) enum GeometryName {
    Family(&'static str),
    File(String),
}

/// A plan by name, or the name of a table or scene.
pub(super) enum PlanName {
    Known(String, PlanSource),
    Table(String),
    Scene(String),
}

impl AxesTable {
    pub(super) fn read(top: &TomlSection<'_>, task: SweepTask, seed: u64) -> Result<Self, Fault> {
        let t = top.require("axes")?.section("[axes]", KEYS)?;
        let points = Points::read(top, seed)?;
        let geometry = each(t.require("geometry")?, geometry)?;
        let plan = each(t.require("plan")?, plan)?;
        let whole = |key: &str, axis: usize, most: u64| match t.get(key) {
            None => Ok(Vec::new()),
            Some(range) if range.is_table() => points.whole(range, axis, most),
            Some(list) => each(list, |item| whole_to(item, most)),
        };
        let axes = Self {
            poses: whole("poses", place::POSES, MOST_POSES)?,
            repeats: whole("repeats", place::REPEATS, MOST_REPEATS)?,
            estimator: t.get("estimator").map_or(Ok(Vec::new()), |list| each(list, estimator))?,
            effect: t.get("effect").map_or(Ok(vec![Vec::new()]), |list| each(list, effects::set))?,
            size: sizes::read(&t, &points)?,
            noise: noises(&t, &points)?,
            laboratory: t.get(LABORATORY).map_or(Ok(Vec::new()), |list| each(list, fault_of_laboratory))?,
            tolerance: tolerances(&t, &points)?,
            points: points.of_axes(top)?,
            geometry,
            plan,
        };
        axes.refuse_impossible(&t, task)?;
        Ok(axes)
    }

    fn refuse_impossible(&self, t: &TomlSection<'_>, task: SweepTask) -> Result<(), Fault> {
        self.refuse_poses(t)?;
        if let (SweepTask::Diagnose, Some(item)) = (task, t.get("estimator")) {
            let next = "Remove this axis, or write task = \"springs\".";
            return Err(item.breaks("the diagnosis has its own estimator", next));
        }
        if let (SweepTask::Springs, Some(item)) = (task, t.get("laboratory")) {
            let next = "Remove this axis, or write task = \"diagnose\".";
            return Err(item.breaks("task = \"springs\" does not support laboratory faults", next));
        }
        sizes::refuse_impossible(t, &self.effect, &self.size)
    }

    /// The axis `poses` stands beside plans that need it, and beside none that have poses of their own.
    fn refuse_poses(&self, t: &TomlSection<'_>) -> Result<(), Fault> {
        let (items, poses) = (t.require("plan")?.list()?, t.get("poses"));
        for (item, plan) in items.iter().zip(&self.plan) {
            let (takes, needs) = match plan {
                PlanName::Known(_, source) => (source.takes_poses(), source.needs_poses()),
                PlanName::Table(_) | PlanName::Scene(_) => (false, false),
            };
            if poses.is_some() && !takes {
                let next = "Remove this plan from the list, or remove the axis poses.";
                return Err(item.breaks("this plan has its own poses, but there is an axis poses", next));
            }
            if poses.is_none() && needs {
                let next = "Add poses to [axes], for example poses = [3, 6, 12].";
                return Err(item.breaks("this plan needs a number of poses", next));
            }
        }
        Ok(())
    }
}

/// What is said of the first value in `[axes]` that sensors cannot take; none where all can.
pub(super) fn of_full_poses(item: &Item<'_>) -> Result<Option<Fault>, Fault> {
    let t = item.section("[axes]", KEYS)?;
    if let Some(pairs) = t.get("noise_um_urad") {
        let next = "Write noise_scale instead: multiples of the noise that each sensor states.";
        return Ok(Some(pairs.breaks("a geometry has sensors, whose noise this key does not state", next)));
    }
    if let Some(faults) = t.get("laboratory") {
        let next = "Remove it, or remove the sensors from the hexapod file.";
        return Ok(Some(
            faults.breaks("a geometry has sensors, but these faults apply to full poses only", next),
        ));
    }
    if let Some(scales) = t.get(TOLERANCE_SCALE) {
        let next = "Remove it, or remove the sensors from the hexapod file.";
        return Ok(Some(
            scales.breaks("a geometry has sensors, but these errors apply to full poses only", next),
        ));
    }
    let Some(list) = t.get("estimator") else { return Ok(None) };
    let papers = |item: &&Item<'_>| item.string().is_ok_and(|name| name == SweepEstimator::Paper.name());
    let next = "Remove it, or remove the sensors from the hexapod file.";
    let said =
        |item: &Item<'_>| item.breaks("a geometry has sensors, but this estimator needs full poses", next);
    Ok(list.list()?.iter().find(papers).map(said))
}

/// The members of a list that is not empty and holds nothing twice.
pub(super) fn each<T>(
    list: &Item<'_>,
    read: impl Fn(&Item<'_>) -> Result<T, Fault>,
) -> Result<Vec<T>, Fault> {
    let items = list.list()?;
    if items.is_empty() {
        let next = "Write at least one value, or remove the key if it is optional.";
        return Err(list.breaks("the list of an axis is empty", next));
    }
    refuse_twice(&items)?;
    items.iter().map(read).collect()
}

fn refuse_twice(items: &[Item<'_>]) -> Result<(), Fault> {
    let mut seen = Vec::new();
    for item in items {
        let value = bits(item)?;
        if seen.contains(&value) {
            return Err(item.breaks("this value is in the list twice", "Remove one of the two."));
        }
        seen.push(value);
    }
    Ok(())
}

/// What makes a value another one. Effects that are hidden together have no order; two numbers have one.
fn bits(item: &Item<'_>) -> Result<Vec<u64>, Fault> {
    if item.is_string() {
        return Ok(item.string()?.bytes().map(u64::from).collect());
    }
    if item.is_table() {
        let entry = |entry: &Item<'_>| {
            let key = entry.key().bytes().map(u64::from);
            Ok(key.chain([u64::MAX]).chain(bits(entry)?).collect())
        };
        let mut entries = item.entries()?.iter().map(entry).collect::<Result<Vec<Vec<u64>>, Fault>>()?;
        entries.sort_unstable();
        return Ok(entries.join(&u64::MAX));
    }
    if !item.is_list() {
        return Ok(vec![item.number()?.to_bits()]);
    }
    let members = item.list()?;
    let mut all: Vec<Vec<u64>> = members.iter().filter_map(|member| bits(member).ok()).collect();
    if members.iter().all(|member| member.is_string() || member.is_table()) {
        all.sort_unstable();
    }
    Ok(all.join(&u64::MAX))
}

fn whole_to(item: &Item<'_>, most: u64) -> Result<u64, Fault> {
    let number = item.whole(1)?;
    if number <= most {
        return Ok(number);
    }
    Err(item.breaks(format!("at most {most}"), "Write a smaller number."))
}

fn has_extension(name: &str, extension: &str) -> bool {
    Path::new(name).extension().is_some_and(|e| e.eq_ignore_ascii_case(extension))
}

fn geometry(item: &Item<'_>) -> Result<GeometryName, Fault> {
    let word = item.string()?;
    if has_extension(word, "toml") {
        return Ok(GeometryName::File(word.to_owned()));
    }
    let known = machines::FAMILIES.iter().find(|family| **family == word);
    known.map(|family| GeometryName::Family(family)).ok_or_else(|| {
        let names: Vec<&str> = machines::FAMILIES.iter().copied().chain(["FILE.toml"]).collect();
        unknown(item, word, &names, "family of machines")
    })
}

fn plan(item: &Item<'_>) -> Result<PlanName, Fault> {
    let word = item.string()?;
    if has_extension(word, "csv") {
        return Ok(PlanName::Table(word.to_owned()));
    }
    if word.contains('/') {
        return Ok(PlanName::Scene(word.to_owned()));
    }
    let known = |source| Ok(PlanName::Known(word.to_owned(), source));
    if let Some(criterion) = Criterion::ALL.into_iter().find(|c| c.name() == word) {
        return known(PlanSource::Designed(criterion));
    }
    match makes().into_iter().find(|kind| kind.name() == word) {
        Some(kind) => known(PlanSource::Make(kind)),
        None if word == "random" => known(PlanSource::Random),
        None => {
            let makes = makes();
            let criteria = Criterion::ALL.iter().map(Criterion::name);
            let names = makes.iter().map(|kind| kind.name()).chain(["random"]).chain(criteria);
            unknown_plan(item, word, &names.collect::<Vec<_>>())
        }
    }
}

fn unknown_plan(item: &Item<'_>, word: &str, names: &[&str]) -> Result<PlanName, Fault> {
    if word == "absolute" {
        let next = "Choose a plan that measures deflections.";
        return Err(item.breaks("studies measure deflections, not absolute poses", next));
    }
    let all: Vec<&str> = names.iter().copied().chain(["FILE.csv", "a folder with a / for a scene"]).collect();
    Err(unknown(item, word, &all, "plan"))
}

/// Makes of plans that measure deflections.
fn makes() -> Vec<PlanKind> {
    PlanKind::ALL.into_iter().filter(|kind| *kind != PlanKind::Absolute).collect()
}

fn estimator(item: &Item<'_>) -> Result<SweepEstimator, Fault> {
    named(item, SweepEstimator::ALL, SweepEstimator::name, "estimator")
}

/// Multiples of the stated tolerances, from zero.
fn tolerances(t: &TomlSection<'_>, points: &Points) -> Result<Vec<f64>, Fault> {
    match t.get(TOLERANCE_SCALE) {
        None => Ok(Vec::new()),
        Some(range) if range.is_table() => points.numbers(range, place::TOLERANCE, true),
        Some(list) => each(list, |item| match item.number()? {
            scale if scale >= 0.0 => Ok(scale),
            _ => Err(item.breaks(
                "a tolerance cannot be negative",
                "Write a factor on the tolerances of the file, 0 for exact inputs.",
            )),
        }),
    }
}

fn noises(t: &TomlSection<'_>, points: &Points) -> Result<Noises, Fault> {
    let [scale, sigmas] = noise::KEYS;
    match (t.get(scale), t.get(sigmas)) {
        (Some(_), Some(pairs)) => Err(two_ways(pairs, scale)),
        (Some(range), None) if range.is_table() => {
            points.numbers(range, place::NOISE, false).map(Noises::Scales)
        }
        (Some(scales), None) => each(scales, noise::scale).map(Noises::Scales),
        (None, Some(pairs)) => each(pairs, noise::sigmas).map(Noises::Sigmas),
        (None, None) => Ok(Noises::Scales(vec![1.0])),
    }
}

pub(super) fn two_ways(item: &Item<'_>, other: &str) -> Fault {
    item.breaks(format!("there is an axis {other} too"), "Keep one of the two.")
}
