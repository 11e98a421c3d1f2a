//! Reading how large the effects are.

use hexbench_core::files::{Fault, Item, TomlSection};

use super::axes::{each, two_ways};
use super::points::Points;
use crate::keys::EffectSet;
use crate::keys::sizes::{FACTOR, own_size, refuse_other_unit};
use crate::sized::{SIZE_UNITS, SizeUnit};
use crate::sweep::axes::Sizes;
use crate::sweep::cells::place;

/// The sizes, in one of the ways to state them.
pub(super) fn read(t: &TomlSection<'_>, points: &Points) -> Result<Sizes, Fault> {
    let mut ways = ways().filter_map(|(key, way)| Some((key, way, t.get(key)?)));
    let Some((key, way, list)) = ways.next() else { return Ok(Sizes::Usual) };
    if let Some((_, _, other)) = ways.next() {
        return Err(two_ways(other, key));
    }
    if list.is_table() {
        return points.numbers(list, place::SIZE, true).map(way);
    }
    each(list, not_negative).map(way)
}

type Way = Box<dyn Fn(Vec<f64>) -> Sizes>;

/// Every key that states sizes, and what its numbers are.
fn ways() -> impl Iterator<Item = (&'static str, Way)> {
    let physical = |unit: SizeUnit| (unit.key, Box::new(move |sizes| Sizes::Physical(unit, sizes)) as Way);
    let relative: [(&str, Way); 2] =
        [("size_sigmas", Box::new(Sizes::Sigmas)), (FACTOR, Box::new(Sizes::Factors))];
    relative.into_iter().chain(SIZE_UNITS.map(physical))
}

fn not_negative(item: &Item<'_>) -> Result<f64, Fault> {
    match item.number()? {
        size if size >= 0.0 => Ok(size),
        _ => Err(item.breaks("a size cannot be negative", "Write the size of the effect, 0 for none.")),
    }
}

/// Sizes stand beside effects that have them, in their unit.
pub(super) fn refuse_impossible(
    t: &TomlSection<'_>,
    effects: &[EffectSet],
    sizes: &Sizes,
) -> Result<(), Fault> {
    let Some(size) = t.get(sizes.name()) else { return Ok(()) };
    let Some(list) = t.get("effect") else {
        return Err(size.breaks("a size is given but no effect", "Add effect, or remove this key."));
    };
    for (item, effect) in list.list()?.iter().zip(effects) {
        if effect.is_empty() {
            let next = "Remove it, and add 0 to the sizes: an effect of size 0 is no effect.";
            return Err(item.breaks("\"none\" has no size, but there is an axis of sizes", next));
        }
        if let Sizes::Physical(unit, _) = sizes {
            let items = if item.is_list() { item.list()? } else { vec![item.clone()] };
            items
                .iter()
                .zip(effect)
                .try_for_each(|(item, effect)| refuse_other_unit(item, effect.id, *unit))?;
        }
        let own = effect.iter().find(|effect| effect.size.is_some());
        if let Some(own) = own.filter(|_| !matches!(sizes, Sizes::Factors(_))) {
            return Err(own_size(item, own.id));
        }
    }
    Ok(())
}
