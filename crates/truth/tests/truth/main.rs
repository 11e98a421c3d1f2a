//! The world: its physics, its registry, its campaigns and scenes.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on must fail")]

mod campaigns;
mod common;
mod laboratory;
mod misstatements;
mod mjcf;
mod own_laws;
mod physics;
mod reference_cases;
mod registry;
mod scenes;
