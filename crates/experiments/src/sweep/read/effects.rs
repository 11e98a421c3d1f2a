//! Reading what is hidden.

use hexbench_core::files::{Fault, Item};
use hexbench_truth::mechanisms::{REGISTRY, Shows};

use super::unknown;
use crate::sweep::axes::EffectSet;

/// Effects that are hidden together at most: beyond, nobody names them.
const MOST: usize = 4;

/// `"none"`, the id of an effect, or a list of ids of effects that are hidden together.
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
            Some(id) if set.contains(&id) => {
                return Err(item.breaks("this effect is in the set twice", "Remove one of the two."));
            }
            Some(id) => set.push(id),
            None => return Err(item.breaks("\"none\" is not an effect", "Remove it from the set.")),
        }
    }
    Ok(set)
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
            item.breaks("this effect shows only in absolute poses, but studies measure deflections", next)
        );
    }
    Ok(Some(entry.id))
}
