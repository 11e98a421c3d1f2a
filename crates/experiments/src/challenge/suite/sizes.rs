//! Reading how large effects are, what the laboratory does and how noisy the instrument is: the keys of studies, one value for each
//! case.

use hexbench_core::files::{Fault, KeyUnit, TomlSection};
use hexbench_truth::Scene;
use hexbench_truth::campaign::CaseKind;
use hexbench_truth::scene::Instrument;

use super::CasePortion;
use crate::keys::noise::{self, ReadingNoise};
use crate::keys::sizes::{self, SizeRange, own_size, refuse_other_unit, two_ways};
use crate::keys::{LABORATORY, fault_of_laboratory};

/// Keys of a group of cases.
pub(super) const PORTION: &[KeyUnit] =
    &KeyUnit::all_plain(sizes::names_behind::<12, { 12 + sizes::COUNT }>([
        "kind",
        "scene",
        "count",
        "distance",
        "effects",
        "plan",
        "machine",
        "read_by",
        "repeats",
        noise::KEYS[0],
        noise::KEYS[1],
        LABORATORY,
    ]));

/// Sizes in one of the ways to state them; none where the suite states a distance or nothing.
pub(super) fn sizes(t: &TomlSection<'_>) -> Result<Option<SizeRange>, Fault> {
    match (sizes::read(|key| t.get(key))?, t.get("distance")) {
        (Some((_, item)), Some(distance)) => Err(two_ways(distance, item.key())),
        (size, _) => Ok(size.map(|(size, _)| size)),
    }
}

/// Faults of laboratories that take turns.
pub(super) fn laboratories(t: &TomlSection<'_>) -> Result<Vec<&'static str>, Fault> {
    let Some(item) = t.get(LABORATORY) else { return Ok(Vec::new()) };
    if !item.is_list() {
        return Ok(vec![fault_of_laboratory(item)?]);
    }
    match item.list()? {
        list if list.is_empty() => Err(item.breaks("the list is empty", "Name a fault, or remove the key.")),
        list => list.iter().map(fault_of_laboratory).collect(),
    }
}

/// Noise of the instrument; none for the usual one.
pub(super) fn noise(t: &TomlSection<'_>) -> Result<Option<ReadingNoise>, Fault> {
    let [scale, sigmas] = noise::KEYS;
    match [t.get(scale), t.get(sigmas)] {
        [None, None] => Ok(None),
        [Some(_), Some(other)] => Err(two_ways(other, scale)),
        [Some(factor), None] => noise::scale(factor).map(ReadingNoise::Scale).map(Some),
        [None, Some(pair)] => noise::sigmas(pair).map(ReadingNoise::Sigmas).map(Some),
    }
}

/// What contradicts itself among these keys.
pub(super) fn refuse_contradictions(t: &TomlSection<'_>, portion: &CasePortion) -> Result<(), Fault> {
    if t.get(noise::KEYS[1]).or(t.get(LABORATORY)).is_some() {
        // What is wrong with a scene is said when its cases are made.
        let one = |scene: Scene| refuse_in_scene(t, portion, &scene);
        portion.scenes.iter().try_for_each(|folder| Scene::read(folder).map_or(Ok(()), one))?;
    }
    let absolute = portion.kind == Some(CaseKind::Absolute);
    if let Some(item) = t.get(LABORATORY).filter(|_| absolute) {
        return Err(
            item.breaks("these are faults of deflections", "Remove this key, or choose another kind.")
        );
    }
    refuse_own_sizes(t, portion)?;
    let (Some(sizes), Some((_, item))) = (portion.sizes, sizes::read(|key| t.get(key))?) else {
        return Ok(());
    };
    if matches!(portion.kind, Some(CaseKind::Clean | CaseKind::Absolute)) {
        let broken = "the effects of this kind have no size to be stated";
        return Err(item.breaks(broken, "Remove this key."));
    }
    let named = !portion.effects.is_empty();
    if portion.kind.is_none() && !named {
        let next = "Remove this key, or name effects of the catalogue in the key effects.";
        return Err(item.breaks("the effects of the scene have their own sizes", next));
    }
    let Some(unit) = sizes.unit else { return Ok(()) };
    if !named {
        let next = format!("Name effects whose size is in {} in the key effects.", unit.unit);
        return Err(item.breaks("effects that are drawn have sizes in different units", next));
    }
    portion.effects.iter().flatten().try_for_each(|effect| refuse_other_unit(item, effect.id, unit))
}

/// A distance, or a size in a unit, beside an effect that has a size of its own.
fn refuse_own_sizes(t: &TomlSection<'_>, portion: &CasePortion) -> Result<(), Fault> {
    let Some(own) = portion.effects.iter().flatten().find(|effect| effect.size.is_some()) else {
        return Ok(());
    };
    let in_unit = sizes::keys().find_map(|(key, unit)| unit.and(t.get(key)));
    match t.get("distance").or(in_unit) {
        Some(item) => Err(own_size(item, own.id)),
        None => Ok(()),
    }
}

/// What the readings of a scene cannot take.
fn refuse_in_scene(t: &TomlSection<'_>, portion: &CasePortion, scene: &Scene) -> Result<(), Fault> {
    let reads_numbers = matches!(scene.instrument, Instrument::Numbers(_));
    if let Some(item) = t.get(noise::KEYS[1]).filter(|_| !reads_numbers) {
        let next = "Write noise_scale instead: multiples of the noise that the instrument of the scene has.";
        return Err(item.breaks("balls or sensors have a noise that this key does not tell", next));
    }
    let faulty = !portion.laboratory.is_empty() && !scene.takes_laboratories();
    match t.get(LABORATORY).filter(|_| faulty) {
        Some(item) => Err(item.breaks(
            "these are faults of deflections that are read in numbers, each with a reference of its own",
            "Remove this key, or give the scene an instrument of the kind \"numbers\".",
        )),
        None => Ok(()),
    }
}
