//! Estimation: campaigns and their noise, parameters, least squares, residuals.

pub mod basis;
pub mod campaign;
mod equations;
pub mod equilibrium;
pub mod estimate;
pub mod fit;
pub mod fit_named;
pub(crate) mod folds;
pub mod foreseen;
pub(crate) mod foresight;
pub mod frames;
mod input_slopes;
pub mod linearization;
pub mod lsq;
pub mod noise;
pub mod nuisance;
pub mod paper;
pub(crate) mod parallel;
pub mod parameters;
pub mod residuals;
pub mod scatter;
pub mod spring_trials;
mod starts;
pub mod tolerances;
pub mod trust_region;
pub mod whitening;
