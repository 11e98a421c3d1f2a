//! Recovery: what the simulated world hides, the identification finds, with honest uncertainty.
//!
//! A [`scene`] is a campaign with a known truth: a machine, a plan, hidden effects. The model is told which effects are there
//! ([`pulls::right_fit`]), so that these modules test the estimator and not the search; [`naming`] tests the search.
//!
//! - [`noiseless`]: ideal readings, errors against a bound derived from what the model linearises.
//! - [`campaign`]: noisy readings, intervals that must cover, noise levels, held-out errors.
//! - [`geometry`]: the 42 numbers of the geometry and which combinations of them absolute poses show.
//! - [`naming`]: the diagnosis of a clear effect, and its best wrong rival.
//! - [`correspondence`]: which number of the model stands for which number of the world.
//! - [`protocol`]: the trials; [`study`]: what they show; [`check`]: its bounds; [`tables`], [`document`]: its pages.
//!
//! What the tables do not hide: a shape (exponent, time constant, pitch) is fitted by its logarithm, its interval is a factor;
//! numbers that the data leave open get no interval and are not counted; a fit whose chi-square is improbable (1e-4) is not
//! believed and counted as a misfit.

pub mod campaign;
pub mod check;
pub mod correspondence;
pub mod document;
pub mod geometry;
pub mod naming;
pub mod noiseless;
pub mod protocol;
pub mod pulls;
pub mod scene;
pub mod study;
pub mod tables;
pub mod tally;
