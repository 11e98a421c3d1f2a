//! The workbench: a web page that compares a model with measurements while the user ticks terms on and off.
//!
//! [`mod@bench`] computes, [`wire`] defines the messages between page and server, [`server`] carries them. This crate contains no physics; it uses the model
//! and the simulated world, as the command does.

pub mod bench;
pub mod server;
pub mod wire;
