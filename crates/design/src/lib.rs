//! Which poses and loads to measure.
//!
//! A plan is a list of readings. With `J` the whitened regressor of all its readings (six rows each, one column per
//! parameter) its information matrix is `M = J'J`, the sum over the readings; a [`Criterion`] turns `M` into one number,
//! larger for a better plan. Poses and loads come from a [`Space`]: travel, stroke, joint angles, distance from singularity, and
//! the loads that can be applied.
//!
//! - [`regressor`]: rows of a reading for springs and terms; closed form with exact derivatives for springs.
//! - [`continuous`]: few poses, each coordinate free: many starts of sequential quadratic programming.
//! - [`exchange`]: many readings from candidates within a [`Budget`]: exchange and excursion algorithms, with a bound on the
//!   distance from the optimum.
//! - [`discriminate`]: plans that separate rival effects.
//! - [`refine`]: moves the poses of such a plan to the most informative positions.
//! - [`sensors`]: which sensors to choose from candidates, and where to place them.
//! - [`power`]: which effects a plan can detect, from which size on, and what they would be mistaken for.

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
