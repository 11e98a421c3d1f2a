//! Reading `[axes]`.

use std::path::Path;

use hexbench_core::files::{Fault, Item, KeyUnit, TomlSection};
use hexbench_design::Criterion;
use hexbench_truth::campaign::{PlanKind, machines};
use hexbench_truth::laboratory;
use hexbench_truth::mechanisms::{REGISTRY, Shows};

use super::{one_of, sizes, unknown};
use crate::sized::SIZE_UNITS;
use crate::sweep::axes::{Axes, Noises, PlanSource, SweepEstimator};
use crate::sweep::study::SweepTask;

const KEYS: &[KeyUnit] = &KeyUnit::all_plain(keys());

/// Keys of `[axes]`: those of sizes in units come from the list of units.
const fn keys() -> [&'static str; 11 + SIZE_UNITS.len()] {
    let others = [
        "geometry",
        "plan",
        "poses",
        "repeats",
        "estimator",
        "effect",
        "noise_scale",
        "noise_um_urad",
        "laboratory",
        "size_sigmas",
        "size_factor",
    ];
    let mut all = [""; 11 + SIZE_UNITS.len()];
    let mut k = 0;
    while k < all.len() {
        all[k] = if k < others.len() { others[k] } else { SIZE_UNITS[k - others.len()].key };
        k += 1;
    }
    all
}
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
    pub(super) fn read(item: &Item<'_>, task: SweepTask) -> Result<Self, Fault> {
        let t = item.section("[axes]", KEYS)?;
        let geometry = each(t.require("geometry")?, geometry)?;
        let plan = each(t.require("plan")?, plan)?;
        let whole = |key: &str, most: u64| {
            let one = |item: &Item<'_>| whole_to(item, most);
            t.get(key).map_or(Ok(Vec::new()), |list| each(list, one))
        };
        let axes = Self {
            poses: whole("poses", MOST_POSES)?,
            repeats: whole("repeats", MOST_REPEATS)?,
            estimator: t.get("estimator").map_or(Ok(Vec::new()), |list| each(list, estimator))?,
            effect: t.get("effect").map_or(Ok(vec![None]), |list| each(list, effect))?,
            size: sizes::read(&t)?,
            noise: noises(&t)?,
            laboratory: t.get("laboratory").map_or(Ok(Vec::new()), |list| each(list, laboratory))?,
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
            return Err(item.breaks("the diagnosis has an estimator of its own", next));
        }
        if let (SweepTask::Springs, Some(item)) = (task, t.get("laboratory")) {
            let next = "Remove this axis, or write task = \"diagnose\".";
            return Err(item.breaks("the fast fit of stiffnesses knows careful laboratories only", next));
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
                let next = "Take this plan out of the list, or remove the axis poses.";
                return Err(item.breaks("this plan has poses of its own, but there is an axis poses", next));
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
        return Ok(Some(pairs.breaks("a geometry has sensors, whose noise this key does not tell", next)));
    }
    if let Some(faults) = t.get("laboratory") {
        let next = "Remove it, or remove the sensors from the hexapod file.";
        return Ok(Some(faults.breaks("a geometry has sensors, and these are faults of full poses", next)));
    }
    let Some(list) = t.get("estimator") else { return Ok(None) };
    let papers = |item: &&Item<'_>| item.string().is_ok_and(|name| name == SweepEstimator::Paper.name());
    let next = "Remove it, or remove the sensors from the hexapod file.";
    let said =
        |item: &Item<'_>| item.breaks("a geometry has sensors, and this estimator takes full poses", next);
    Ok(list.list()?.iter().find(papers).map(said))
}

/// The members of a list that is not empty and holds nothing twice.
pub(super) fn each<T>(
    list: &Item<'_>,
    read: impl Fn(&Item<'_>) -> Result<T, Fault>,
) -> Result<Vec<T>, Fault> {
    let items = list.list()?;
    if items.is_empty() {
        let next = "Write at least one value, or remove the key where it may be left out.";
        return Err(list.breaks("the list of an axis is empty", next));
    }
    refuse_twice(&items)?;
    items.iter().map(read).collect()
}

fn refuse_twice(items: &[Item<'_>]) -> Result<(), Fault> {
    let value = |item: &Item<'_>| -> Result<Vec<u64>, Fault> {
        if item.is_string() {
            return Ok(item.string()?.bytes().map(u64::from).collect());
        }
        if item.is_list() {
            return Ok(item.list()?.iter().filter_map(|n| n.number().ok()).map(f64::to_bits).collect());
        }
        Ok(vec![item.number()?.to_bits()])
    };
    let mut seen = Vec::new();
    for item in items {
        let value = value(item)?;
        if seen.contains(&value) {
            return Err(item.breaks("this value is in the list twice", "Remove one of the two."));
        }
        seen.push(value);
    }
    Ok(())
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

fn laboratory(item: &Item<'_>) -> Result<&'static str, Fault> {
    let ids: Vec<&'static str> = laboratory::registry().map(|fault| fault.id).collect();
    one_of(item, &ids, "fault of a laboratory").map(|k| ids[k])
}

fn estimator(item: &Item<'_>) -> Result<SweepEstimator, Fault> {
    one_of(item, &SweepEstimator::ALL.map(SweepEstimator::name), "estimator").map(|k| SweepEstimator::ALL[k])
}

fn effect(item: &Item<'_>) -> Result<Option<&'static str>, Fault> {
    let word = item.string()?;
    if word == "none" {
        return Ok(None);
    }
    let names: Vec<&str> =
        REGISTRY.iter().filter(|e| e.shows != Shows::Absolute).map(|e| e.id).chain(["none"]).collect();
    let entry =
        REGISTRY.iter().find(|e| e.id == word).ok_or_else(|| unknown(item, word, &names, "effect"))?;
    if entry.shows == Shows::Absolute {
        let next = "Choose an effect that shows in deflections.";
        return Err(
            item.breaks("this effect shows in absolute poses only, and studies measure deflections", next)
        );
    }
    Ok(Some(entry.id))
}

fn noises(t: &TomlSection<'_>) -> Result<Noises, Fault> {
    let scale = |item: &Item<'_>| item.positive("the scale of the noise");
    let pair = |item: &Item<'_>| {
        let pair = item.exactly::<2>("two standard deviations, translation (um) and rotation (urad)")?;
        Ok([
            pair[0].positive("a standard deviation")? * 1e-6,
            pair[1].positive("a standard deviation")? * 1e-6,
        ])
    };
    match (t.get("noise_scale"), t.get("noise_um_urad")) {
        (Some(_), Some(pairs)) => Err(two_ways(pairs, "noise_scale")),
        (Some(scales), None) => each(scales, scale).map(Noises::Scales),
        (None, Some(pairs)) => each(pairs, pair).map(Noises::Sigmas),
        (None, None) => Ok(Noises::Scales(vec![1.0])),
    }
}

pub(super) fn two_ways(item: &Item<'_>, other: &str) -> Fault {
    item.breaks(format!("there is an axis {other} too"), "Keep one of the two.")
}
