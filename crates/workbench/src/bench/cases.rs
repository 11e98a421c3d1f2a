//! Measurements that come with the program.

use crate::wire::Choice;

/// A bundled case: its files as text.
#[derive(Debug, Clone, Copy)]
pub struct BundledCase {
    /// Name of its folder.
    pub id: &'static str,
    /// What people read.
    title: &'static str,
    /// A sentence more, which does not tell what is hidden.
    text: &'static str,
    /// hexapod.toml
    pub hexapod: &'static str,
    /// measurements.csv
    pub data: &'static str,
    /// holdout.csv
    pub holdout: &'static str,
}

macro_rules! case {
    ($id:literal, $title:literal, $text:literal) => {
        BundledCase {
            id: $id,
            title: $title,
            text: $text,
            hexapod: include_str!(concat!("../../../../data/cases/", $id, "/hexapod.toml")),
            data: include_str!(concat!("../../../../data/cases/", $id, "/measurements.csv")),
            holdout: include_str!(concat!("../../../../data/cases/", $id, "/holdout.csv")),
        }
    };
}

/// The case of the demo.
pub const FOUNDATION: BundledCase = case!(
    "mujoco-foundation",
    "A machine on a table",
    "14 poses, six loads, two readings each; generated with MuJoCo"
);

/// The case of which no catalogue knows the effect.
pub const UNLISTED: BundledCase =
    case!("not-in-catalogue", "Something unknown", "18 poses, six loads, two readings each");

/// All bundled cases.
pub const CASES: [BundledCase; 8] = [
    FOUNDATION,
    case!(
        "mujoco-clean",
        "Same model, another table",
        "14 poses, six loads, two readings each; generated with MuJoCo"
    ),
    case!("friction", "Loaded and unloaded", "18 poses, six loads, each reached from both sides"),
    case!("contact", "Hard to the touch", "18 poses, six loads, two readings each"),
    case!("two-effects", "Two things at once", "18 poses, six loads, two readings each"),
    UNLISTED,
    case!(
        "paper-protocol",
        "Three poses, one load",
        "The protocol of the paper; ten held-out validation poses"
    ),
    case!("absolute-pitch", "Where it stands", "Absolute poses: 40 poses under two loads, two readings each"),
];

/// What there is to choose from.
pub(super) fn choices() -> Vec<Choice> {
    let choice =
        |c: &BundledCase| Choice { id: c.id.to_owned(), title: c.title.to_owned(), text: c.text.to_owned() };
    CASES.iter().map(choice).collect()
}

/// The case of a name.
pub fn named(id: &str) -> Option<&'static BundledCase> {
    CASES.iter().find(|c| c.id == id)
}
