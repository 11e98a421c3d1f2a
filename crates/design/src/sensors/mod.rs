//! Which sensors to place, and where, for given poses and loads.
//!
//! Every candidate reads every row of a plan. With `J` the whitened columns of the parameters, `Z` those of joints, loads and axes that
//! are known to a tolerance, and `U` those of its own place and direction, a candidate tells
//!
//! ```text
//! M_i = [J Z]' (I + U U')^-1 [J Z]
//! ```
//!
//! `U` belongs to one sensor alone, so that what several tell is the sum of their `M_i`; errors of `Z` are in all of them and are
//! taken out of the sum ([`hexbench_model::estimation::nuisance`]). A [`Goal`] turns the sum into one number: a
//! [criterion](crate::Criterion) of the parameters, or how far an effect stands out of what springs explain.
//!
//! Small problems are enumerated, others are solved by exchange (Fedorov 1972) from many starts. Every candidate stands at one place,
//! so none is chosen twice.

mod candidate_file;
mod exchange;
mod goal;
mod offer;
mod search;

pub use candidate_file::{CandidateSensor, read_candidates};
pub use goal::{Goal, Sought};
pub use offer::Offer;
pub use search::{Found, Limits, SensorSearch, SensorSelection};
