//! The machine: geometry, kinematics, leg forces, and poses from balls.

pub mod batch;
pub(crate) mod bending;
pub mod geometry;
pub mod kinematics;
pub(crate) mod lanes;
pub mod observability;
pub mod placement;
pub mod registration;
