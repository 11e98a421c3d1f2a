//! Plans that separate rival effects, before any measurement.
//!
//! Rival `b` fits the readings of a machine that has effect `a` as well as it can: springs and its own parameters, within their
//! physical widths. What it cannot fit, in units of the noise, is the distance `T` of `a` from `b`; with `M` the information matrix
//! of the plan and `c` the columns of springs and `b`,
//!
//! ```text
//! T^2 = s^2 trace(M_aa - M_ac (M_cc + Lambda)^-1 M_ca)
//! ```
//!
//! on average over the parameters of `a` of size `s`. Source: Atkinson and Fedorov 1975, Biometrika 62 (T-optimal designs). The plan
//! makes the smallest distance over all ordered pairs as large as it can, in the smooth form `(sum T^-2q)^(-1/2q)` that an exchange
//! can climb. An effect of unknown shape counts at several shapes, the least favorable of both sides.
//!
//! Joints, loads and axes are known to the tolerances of the machine only: what an error of them may do to the readings tells no effect
//! from another ([`hexbench_model::estimation::nuisance`]).
//!
//! Each effect is taken so large that readings spread evenly over the space would show it beside free springs by a chosen number of
//! standard deviations.

mod candidate_readings;
mod contest;
mod search;

#[cfg(test)]
mod tests;

pub use candidate_readings::candidate_readings;
pub use contest::{Contest, Distance};
pub use search::{PlannedReading, SeparatingPlan};
