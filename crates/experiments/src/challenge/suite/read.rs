//! Reading a suite file.

use std::path::{Path, PathBuf};

use hexbench_core::files::{Fault, FileError, Format, Item, KeyUnit, TomlSection, read_toml_text};
use hexbench_truth::campaign::{CaseKind, PlanKind, SensorSet, machines};

use super::sizes::{self, PORTION};
use super::{CasePortion, ChallengeSuite};
use crate::keys::{EffectSet, HiddenEffect, effects, named, one_of};

const FORMAT: Format = Format {
    name: "challenge-suite/1",
    keys: &KeyUnit::all_plain(["format", "name", "version", "title", "seed", "cases"]),
};

/// Keys that a scene answers itself.
const OF_THE_SCENE: [&str; 4] = ["kind", "plan", "machine", "read_by"];
/// What makes a folder a scene.
const SCENE_FILE: &str = "scene.toml";

/// Most cases of a suite: each is a folder, and its name has three digits or four.
const MOST_CASES: usize = 5000;
/// Distances beyond are another machine, not an effect.
const MOST_DISTANCE: f64 = 1000.0;

pub(super) fn suite(text: &str, file: &Path) -> Result<ChallengeSuite, FileError> {
    let folder = file.parent().unwrap_or(Path::new(""));
    read_toml_text(text, file, FORMAT, |top| whole(top, folder))
}

fn whole(top: &TomlSection<'_>, folder: &Path) -> Result<ChallengeSuite, Fault> {
    let name = top.require("name")?;
    let list = top.require("cases")?;
    let portions = list.entries()?.iter().map(|item| portion(item, folder)).collect::<Result<Vec<_>, _>>()?;
    let suite = ChallengeSuite {
        name: plain_name(name)?,
        version: top.require("version")?.whole(1)?,
        title: top.require("title")?.string()?.to_owned(),
        seed: top.require("seed")?.whole(0)?,
        seed_sha256: None,
        sha256: String::new(),
        portions,
    };
    match suite.cases() {
        0 => Err(list.breaks("a suite has a case at least", "Add a table such as [cases.clean].")),
        n if n > MOST_CASES => {
            Err(list.breaks(format!("{n} cases; at most {MOST_CASES}"), "Lower the counts."))
        }
        _ => Ok(suite),
    }
}

/// A name that is safe as a file's.
fn plain_name(item: &Item<'_>) -> Result<String, Fault> {
    let name = item.string()?;
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    if name.is_empty() || !name.chars().all(plain) {
        return Err(
            item.breaks("a name has small letters, digits and hyphens", "Write for example \"my-suite\".")
        );
    }
    Ok(name.to_owned())
}

fn portion(item: &Item<'_>, folder: &Path) -> Result<CasePortion, Fault> {
    let t = item.section("[cases.GROUP]", PORTION)?;
    let scenes = t.get("scene").map_or(Ok(Vec::new()), |item| scenes(item, folder))?;
    let kind = if scenes.is_empty() {
        Some(named(t.require("kind")?, CaseKind::ALL, CaseKind::name, "kind")?)
    } else {
        None
    };
    let portion = CasePortion {
        group: item.key().to_owned(),
        kind,
        scenes,
        count: usize::try_from(t.require("count")?.whole(1)?).unwrap_or(usize::MAX),
        distance: t.get("distance").map(distance).transpose()?,
        sizes: sizes::sizes(&t)?,
        laboratory: sizes::laboratories(&t)?,
        noise: sizes::noise(&t)?,
        effects: t.get("effects").map_or(Ok(Vec::new()), turns)?,
        plan: t.get("plan").map(plan).transpose()?,
        machine: t.get("machine").map(machine).transpose()?,
        read_by: t.get("read_by").map(read_by).transpose()?,
        repeats: t.get("repeats").map(|n| n.whole(1)).transpose()?,
    };
    refuse_contradictions(&t, &portion)?;
    sizes::refuse_contradictions(&t, &portion)?;
    Ok(portion)
}

/// What the generator would pass over in silence is said instead.
fn refuse_contradictions(t: &TomlSection<'_>, portion: &CasePortion) -> Result<(), Fault> {
    let Some(kind) = portion.kind else { return refuse_beside_a_scene(t, portion) };
    let absolute = kind == CaseKind::Absolute;
    let without_size = absolute || kind == CaseKind::Clean;
    if let Some(item) = t.get("distance").filter(|_| without_size) {
        let broken = "the effects of this kind have no distance to be scaled to";
        return Err(item.breaks(broken, "Remove this key."));
    }
    if let Some(item) = t.get("effects").filter(|_| kind == CaseKind::Clean) {
        return Err(item.breaks("a clean case has no effect", "Remove this key, or write kind = \"single\"."));
    }
    if let Some(item) = t.get("read_by").filter(|_| absolute) {
        return Err(item.breaks("absolute poses are read whole", "Remove this key, or choose another kind."));
    }
    let other_plan = portion.plan.is_some_and(|p| (p == PlanKind::Absolute) != absolute);
    match t.get("plan").filter(|_| other_plan) {
        Some(item) => Err(item.breaks(
            "absolute poses belong to the kind \"absolute\", and to no other",
            "Remove this key, or choose another plan.",
        )),
        None => Ok(()),
    }
}

fn refuse_beside_a_scene(t: &TomlSection<'_>, portion: &CasePortion) -> Result<(), Fault> {
    if let Some((key, item)) = OF_THE_SCENE.iter().find_map(|key| Some((key, t.get(key)?))) {
        return Err(item.breaks(format!("the scene decides the {key}"), "Remove this key, or the key scene."));
    }
    match t.get("distance").filter(|_| portion.effects.is_empty()) {
        Some(item) => Err(item.breaks(
            "the effects of the scene have their own sizes",
            "Remove this key, or name effects of the catalogue in the key effects.",
        )),
        None => Ok(()),
    }
}

/// A folder or several, from that of the suite's file.
fn scenes(item: &Item<'_>, folder: &Path) -> Result<Vec<PathBuf>, Fault> {
    let one = |item: &Item<'_>| {
        let path = folder.join(item.string()?);
        if path.join(SCENE_FILE).is_file() {
            return Ok(path);
        }
        let broken = format!("there is no {SCENE_FILE} in the folder {}", path.display());
        Err(item.breaks(broken, "Write the path of a scene's folder, from that of the suite's file."))
    };
    if !item.is_list() {
        return Ok(vec![one(item)?]);
    }
    let list = item.list()?;
    if list.is_empty() {
        return Err(item.breaks("the list is empty", "Name a scene, or remove the key."));
    }
    list.iter().map(one).collect()
}

fn distance(item: &Item<'_>) -> Result<[f64; 2], Fault> {
    let [low, high] = if item.is_list() {
        item.numbers::<2>("a smallest and a largest distance")?
    } else {
        [item.number()?; 2]
    };
    if low > 0.0 && low <= high && high <= MOST_DISTANCE {
        return Ok([low, high]);
    }
    Err(item.breaks(
        format!("distances rise, are positive and at most {MOST_DISTANCE}"),
        "Write for example [8, 60]: the least and the greatest visibility in standard deviations.",
    ))
}

/// Effects that take turns.
fn turns(item: &Item<'_>) -> Result<Vec<EffectSet>, Fault> {
    let list = item.list()?;
    if list.is_empty() {
        return Err(item.breaks("the list is empty", "Name an effect, or remove the key."));
    }
    list.iter().map(together).collect()
}

/// One effect, or several joined by `+` or in a list.
fn together(item: &Item<'_>) -> Result<EffectSet, Fault> {
    if item.is_list() {
        return item.list()?.iter().map(effects::read).collect();
    }
    if item.is_table() {
        return Ok(vec![effects::read(item)?]);
    }
    let one = |word: &str| effects::known(item, word.trim()).map(HiddenEffect::usual);
    item.string()?.split('+').map(one).collect()
}

fn plan(item: &Item<'_>) -> Result<PlanKind, Fault> {
    named(item, PlanKind::ALL, PlanKind::name, "plan")
}

fn machine(item: &Item<'_>) -> Result<&'static str, Fault> {
    Ok(machines::FAMILIES[one_of(item, machines::FAMILIES, "family of machines")?])
}

fn read_by(item: &Item<'_>) -> Result<SensorSet, Fault> {
    named(item, SensorSet::ALL, SensorSet::word, "set of sensors")
}
