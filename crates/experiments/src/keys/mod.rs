//! Keys that suites of challenges and studies share: what is hidden, how large it is, how noisy the instrument, what the laboratory does.
//!
//! - [`HiddenEffect`]: an effect by its name, in a size of its own, or a law of one's own; `effects` reads it.
//! - [`SizeRange`]: one of the ways to state a size; `sizes` reads it.
//! - [`ReadingNoise`]: `noise` reads it.

pub(crate) mod effects;
pub(crate) mod noise;
pub(crate) mod sizes;

use hexbench_core::files::{Fault, Item, instead_of};
use hexbench_truth::laboratory;

pub use effects::{EffectSet, HiddenEffect, set_name};
pub use noise::ReadingNoise;
pub use sizes::SizeRange;

/// Key of what the laboratory does.
pub(crate) const LABORATORY: &str = "laboratory";

/// Id of what a laboratory does to the data.
pub(crate) fn fault_of_laboratory(item: &Item<'_>) -> Result<&'static str, Fault> {
    let ids: Vec<&'static str> = laboratory::registry().map(|fault| fault.id).collect();
    one_of(item, &ids, "laboratory fault").map(|k| ids[k])
}

/// Index of the name that a string is.
pub(crate) fn one_of(item: &Item<'_>, names: &[&str], what: &str) -> Result<usize, Fault> {
    let word = item.string()?;
    names.iter().position(|name| *name == word).ok_or_else(|| unknown(item, word, names, what))
}

/// The case of a type that a string names.
pub(crate) fn named<T: Copy, const N: usize>(
    item: &Item<'_>,
    all: [T; N],
    name: fn(T) -> &'static str,
    what: &str,
) -> Result<T, Fault> {
    one_of(item, &all.map(name), what).map(|k| all[k])
}

/// What is said of a word that is none of some names; of a part of a string with the word.
pub(crate) fn unknown(item: &Item<'_>, word: &str, names: &[&str], what: &str) -> Fault {
    let is_part = item.string().is_ok_and(|whole| whole != word);
    let name = if is_part { format!("the name \"{word}\"") } else { "this name".to_owned() };
    item.breaks(format!("there is no {what} with {name}"), instead_of(word, names))
}
