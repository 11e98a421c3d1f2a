//! Which poses and loads to measure.
//!
//! A plan is a list of readings. With `J` the whitened regressor of all its readings (six rows each, one column per
//! parameter) its information matrix is `M = J'J`, the sum over the readings; a [`Criterion`] turns `M` into one number,
//! larger for a better plan. Poses and loads come from a [`Space`]: travel, stroke, joint angles, distance from singularity, and
//! the loads that can be applied.
//!
//! - [`regressor`]: rows of a reading for springs and terms; closed form with exact derivatives for springs.
//! - [`continuous`]: few poses, each coordinate free: many starts of sequential quadratic programming.
//! - [`exchange`]: many readings out of candidates within a [`Budget`]: exchange and excursion algorithms, and how far from the
//!   best they can be.
//! - [`discriminate`]: plans that tell rival effects apart.
//! - [`refine`]: the poses of such a plan moved to where they tell most.
//! - [`sensors`]: which sensors to place, and where, out of candidates.
//! - [`power`]: which effects a plan would see, at what size, and what they would be taken for.

pub mod budget;
pub mod continuous;
pub mod criterion;
pub mod determined;
pub mod discriminate;
pub mod error;
pub mod exchange;
pub mod nominal;
pub mod power;
pub mod refine;
pub mod regressor;
pub mod sensors;
pub mod space;
pub mod space_file;
mod to_be_read;

#[cfg(test)]
mod test_machine;

pub use budget::Budget;
pub use continuous::{PoseProblem, PoseSearch, ValuedPoses};
pub use criterion::{Criterion, Objective};
pub use error::DesignError;
pub use refine::Visit;
pub use space::Space;
pub use to_be_read::noise_to_come;
