//! What is reported: diagnosis, comparison, next readings, runs beside each other.

pub mod answer;
pub mod check;
pub mod compare;
pub mod diagnose;
pub mod discover;
pub mod fit;
pub mod next;
pub mod runs;
pub mod stiffness;
pub mod terms;
pub mod words;
