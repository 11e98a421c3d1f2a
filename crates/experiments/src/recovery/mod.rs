//! Recovery: the identification finds what the simulated world hides, with correct uncertainties.
//!
//! A [`scene`] is a campaign with a known truth: a machine, a plan, hidden effects. The model knows which effects are present
//! ([`pulls::right_fit`]), so these modules test the estimator and not the search; [`naming`] tests the search.
//!
//! - [`noiseless`]: ideal readings, errors compared with a bound derived from the linearization of the model.
//! - [`campaign`]: noisy readings, intervals that must cover, noise levels, held-out errors.
//! - [`geometry`]: the 42 numbers of the geometry, and which of their combinations absolute poses determine.
//! - [`naming`]: the diagnosis of a clear effect, and its best wrong rival.
//! - [`correspondence`]: the mapping from numbers of the model to numbers of the world.
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
