//! Reading what is hidden.

use hexbench_core::files::{Fault, Item};
use hexbench_truth::mechanisms::{REGISTRY, Shows};

use crate::keys::{EffectSet, HiddenEffect, effects};

/// Effects that are hidden together at most: beyond, nobody names them.
const MOST: usize = 4;

/// `"none"`, an effect, or a list of effects that are hidden together.
pub(super) fn set(item: &Item<'_>) -> Result<EffectSet, Fault> {
    if !item.is_list() {
        return Ok(effect(item)?.into_iter().collect());
    }
    let items = item.list()?;
    if !(2..=MOST).contains(&items.len()) {
        let next = "Write one effect as a name, several as [\"base-compliance\", \"creep\"].";
        return Err(item.breaks(format!("2 to {MOST} effects can be hidden together"), next));
    }
    let mut set = EffectSet::new();
    for item in &items {
        match effect(item)? {
            Some(effect) if set.iter().any(|other| other.id == effect.id) => {
                return Err(item.breaks("this effect is in the set twice", "Remove one of the two."));
            }
            Some(effect) => set.push(effect),
            None => return Err(item.breaks("\"none\" is not an effect", "Remove it from the set.")),
        }
    }
    Ok(set)
}

fn effect(item: &Item<'_>) -> Result<Option<HiddenEffect>, Fault> {
    if item.is_string() && item.string()? == "none" {
        return Ok(None);
    }
    let effect = effects::read(item)?;
    let shows = REGISTRY.iter().find(|entry| entry.id == effect.id).map(|entry| entry.shows);
    if shows == Some(Shows::Absolute) {
        let next = "Choose an effect that shows in deflections.";
        return Err(
            item.breaks("this effect shows only in absolute poses, but studies measure deflections", next)
        );
    }
    Ok(Some(effect))
}
