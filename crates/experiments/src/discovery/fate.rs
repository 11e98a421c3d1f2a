//! What a search for a law came to beside the truth.

use serde::{Deserialize, Serialize};

/// Pieces of formula of which the law of an effect must have one of each group; none for effects that no law of the grammar is.
const LAWS: [(&str, &[&[&str]]); 6] = [
    ("out:periodic-compliance", &[&["sin(2*pi*q/"], &["df"]]),
    ("out:leg-drift", &[&["elapsed"]]),
    ("out:leg-step", &[&["step(elapsed"]]),
    ("out:thermal-compliance", &[&["delta_T"], &["df", "f*"]]),
    ("out:cubic-compliance", &[&["a^3", "b^3"], &["df"]]),
    ("out:load-mass-error", &[&["size in wrench along z"]]),
];

/// A search for a law beside the truth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum LawFate {
    /// The law of the hidden effect.
    Right,
    /// Another formula that foresees held-out readings.
    Equivalent,
    /// A law that does not.
    Wrong,
    /// None is named, and there is none of the catalogue's own.
    Nothing,
    /// The catalogue explains it.
    Catalogue,
    /// A law where nothing is hidden, or where the catalogue has the effect.
    Invented,
}

hexbench_core::worded! {
    /// A word for tables.
    LawFate::word {
        Right => "right",
        Equivalent => "equivalent",
        Wrong => "wrong",
        Nothing => "nothing",
        Catalogue => "catalogue",
        Invented => "invented",
    }
}

/// How many effects a law of the grammar describes.
pub(super) fn sayable() -> usize {
    LAWS.len()
}

/// True for an effect that a law of the grammar describes.
pub(crate) fn is_sayable(effect: &str) -> bool {
    LAWS.iter().any(|(id, _)| *id == effect)
}

/// True when a formula is the law of an effect; of several readings of a law that look alike one has to be it.
pub(crate) fn is_law_of(effect: &str, formulas: &[String]) -> bool {
    let law = LAWS.iter().find(|(id, _)| *id == effect);
    let says = |formula: &String, groups: &[&[&str]]| {
        groups.iter().all(|group| group.iter().any(|piece| formula.contains(piece)))
    };
    law.is_some_and(|(_, groups)| formulas.iter().any(|formula| says(formula, groups)))
}
