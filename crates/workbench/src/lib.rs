//! The workbench: measurements and their model on a page in a browser, where terms are ticked on and off.
//!
//! [`mod@bench`] computes, [`wire`] is what page and server say to each other, [`server`] carries it. Nothing of the physics is here: both worlds meet, as they do
//! in the command.

pub mod bench;
pub mod server;
pub mod wire;
