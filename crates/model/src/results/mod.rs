//! Results: diagnosis, comparison, next readings, comparison of runs, campaign books.

pub mod answer;
pub mod book;
pub mod check;
pub mod compare;
pub mod diagnose;
pub mod discover;
pub mod fit;
pub mod next;
pub mod outliers;
pub mod runs;
pub mod stiffness;
pub mod terms;
