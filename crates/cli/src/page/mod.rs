//! Pages of the command itself: what was simulated, located, chosen.

pub(crate) mod book_table;
pub(crate) mod campaigned;
pub(crate) mod located;
pub(crate) mod simulated;
pub(crate) mod stiffness_map;
pub(crate) mod worlds;
/// In place of the balls that moved between records.
pub(crate) const NONE_MOVED: &str = "no ball by more than the noise";
