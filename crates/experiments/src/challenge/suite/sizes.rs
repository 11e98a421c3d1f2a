//! Reading how large effects are, what the laboratory does and how noisy the instrument is: the keys of studies, one value for each
//! case.

use hexbench_core::files::{Fault, Item, KeyUnit, TomlSection};
use hexbench_truth::campaign::CaseKind;
use hexbench_truth::laboratory;

use super::read::named;
use super::{CaseNoise, CasePortion, CaseSizes};
use crate::sized::{SIZE_UNITS, SizeUnit};

/// Keys of sizes relative to the usual one.
const FACTOR: &str = "size_factor";
/// Keys of the noise.
const NOISE: [&str; 2] = ["noise_scale", "noise_um_urad"];
const LABORATORY: &str = "laboratory";
/// Keys that only drawn campaigns take.
const OF_CAMPAIGNS: [&str; 3] = [NOISE[0], NOISE[1], LABORATORY];
/// Keys before those of sizes in units.
const OTHERS: usize = 13;

/// Keys of a group of cases: those of sizes in units come from the list of units.
pub(super) const PORTION: &[KeyUnit] = &KeyUnit::all_plain(keys());

const fn keys() -> [&'static str; OTHERS + SIZE_UNITS.len()] {
    let others = [
        "kind", "scene", "count", "distance", "effects", "plan", "machine", "read_by", "repeats", FACTOR,
        NOISE[0], NOISE[1], LABORATORY,
    ];
    let mut all = [""; OTHERS + SIZE_UNITS.len()];
    let mut k = 0;
    while k < all.len() {
        all[k] = if k < OTHERS { others[k] } else { SIZE_UNITS[k - OTHERS].key };
        k += 1;
    }
    all
}

/// Sizes in one of the ways to state them; none where the suite states a distance or nothing.
pub(super) fn sizes(t: &TomlSection<'_>) -> Result<Option<CaseSizes>, Fault> {
    let units = SIZE_UNITS.iter().map(|unit| (unit.key, Some(*unit)));
    let ways = std::iter::once((FACTOR, None)).chain(units);
    let mut stated = ways.filter_map(|(key, unit)| Some((key, unit, t.get(key)?)));
    let Some((key, unit, item)) = stated.next() else { return Ok(None) };
    let other = stated.next().map(|(_, _, other)| other).or(t.get("distance"));
    if let Some(other) = other {
        return Err(other.breaks(format!("there is a {key} too"), "Keep one of the two."));
    }
    let [low, high] = if item.is_list() {
        item.numbers::<2>("a smallest and a largest size")?
    } else {
        [item.number()?; 2]
    };
    if !(low > 0.0 && low <= high) {
        return Err(
            item.breaks("sizes rise and are positive", "Write for example 2, or [1, 4] to draw in between.")
        );
    }
    Ok(Some(CaseSizes { unit, bounds: [low, high] }))
}

/// Faults of laboratories that take turns.
pub(super) fn laboratories(t: &TomlSection<'_>) -> Result<Vec<&'static str>, Fault> {
    let Some(item) = t.get(LABORATORY) else { return Ok(Vec::new()) };
    let ids: Vec<&'static str> = laboratory::registry().map(|fault| fault.id).collect();
    let one = |item: &Item<'_>| named(item, "fault of a laboratory", &ids).map(|k| ids[k]);
    if !item.is_list() {
        return Ok(vec![one(item)?]);
    }
    match item.list()? {
        list if list.is_empty() => Err(item.breaks("the list is empty", "Name a fault, or remove the key.")),
        list => list.iter().map(one).collect(),
    }
}

/// Noise of the instrument; none for the usual one.
pub(super) fn noise(t: &TomlSection<'_>) -> Result<Option<CaseNoise>, Fault> {
    match NOISE.map(|key| t.get(key)) {
        [None, None] => Ok(None),
        [Some(_), Some(other)] => {
            Err(other.breaks(format!("there is a {} too", NOISE[0]), "Keep one of the two."))
        }
        [Some(scale), None] => Ok(Some(CaseNoise::Scale(scale.positive("the scale of the noise")?))),
        [None, Some(pair)] => {
            let pair = pair.exactly::<2>("two standard deviations, translation (um) and rotation (urad)")?;
            let [translation, rotation] = [
                pair[0].positive("a standard deviation")? * 1e-6,
                pair[1].positive("a standard deviation")? * 1e-6,
            ];
            Ok(Some(CaseNoise::Sigmas([translation, rotation])))
        }
    }
}

/// What contradicts itself among these keys.
pub(super) fn refuse_contradictions(t: &TomlSection<'_>, portion: &CasePortion) -> Result<(), Fault> {
    let stated = |keys: &[&'static str]| keys.iter().find_map(|key| Some((*key, t.get(key)?)));
    if let Some((key, item)) = stated(&OF_CAMPAIGNS).filter(|_| portion.kind.is_none()) {
        return Err(item.breaks(format!("the scene decides the {key}"), "Remove this key, or the key scene."));
    }
    if let Some((_, item)) = stated(&[LABORATORY]).filter(|_| portion.kind == Some(CaseKind::Absolute)) {
        return Err(
            item.breaks("these are faults of deflections", "Remove this key, or choose another kind.")
        );
    }
    let Some(sizes) = portion.sizes else { return Ok(()) };
    let Some((_, item)) = stated(&size_keys()) else { return Ok(()) };
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
    let other = portion.effects.iter().flatten().find(|id| SizeUnit::of(id) != Some(unit));
    other.map_or(Ok(()), |id| Err(of_another_unit(item, id, unit)))
}

fn size_keys() -> Vec<&'static str> {
    std::iter::once(FACTOR).chain(SIZE_UNITS.iter().map(|unit| unit.key)).collect()
}

fn of_another_unit(item: &Item<'_>, id: &str, stated: SizeUnit) -> Fault {
    match SizeUnit::of(id) {
        Some(own) => item.breaks(
            format!("the size of {id} is in {}, not in {}", own.unit, stated.unit),
            format!("Write {}, or put this effect into a group of its own.", own.key),
        ),
        None => item.breaks(
            format!("{id} is outside the catalogue and has no size in a unit"),
            "Write size_factor or distance.",
        ),
    }
}
