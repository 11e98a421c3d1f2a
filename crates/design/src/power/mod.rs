//! Which effects a plan can detect, from which size on, and what they would be mistaken for, before any measurement.
//!
//! The signature of an effect is what it adds to the readings of the plan, in units of their noise. Six leg springs absorb a part
//! of it ([`hexbench_model::inference::absorption`]); the rest, of squared length `lambda`, is what a test can see:
//!
//! ```text
//! T = |U' r|^2                       r residuals of the springs, U an orthonormal basis of what the effect can leave
//! noise alone:    T ~ chi2(k)        k determined parameters of the effect; k F(k, m) with noise from repeats
//! effect present: T ~ chi2(k; lambda), lambda proportional to the square of its size
//! ```
//!
//! - *Determined* is a combination of parameters whose standard error is below half its widest sensible size.
//! - An effect with a shape (exponent, time constant) is tested with all shapes of its grid at once: the largest `T` counts, and
//!   its threshold is found by simulation, so that looking in many places is paid for. Grids too long for that (a pitch) use
//!   the bound of Bonferroni, which errs to the careful side.
//! - An effect with several parameters has many directions. It is judged by [`Example`]s: the middle one counts, the best and the
//!   worst give the range; every parameter alone is listed too.
//!
//! What an effect is taken for is answered by the evidence of the diagnosis itself, on simulated readings of the linear model.

mod alike;
mod effect;
mod planned;
mod study;
mod subject;
mod test;

pub use alike::{Alike, NOTHING};
pub use effect::{EffectPower, ParameterReach, Range, Visibility};
pub use planned::Planned;
pub use study::{PowerSettings, PowerStudy, study};
pub use subject::{EffectSizes, Example, Reference, effect_size};
pub use test::PreparedTest;
