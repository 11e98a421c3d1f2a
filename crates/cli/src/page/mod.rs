//! Pages of the command itself: what was simulated, located, chosen.

pub(crate) mod book_table;
pub(crate) mod campaigned;
pub(crate) mod located;
pub(crate) mod simulated;
pub(crate) mod stiffness_map;
pub(crate) mod worlds;
