//! Interactions: are the numbers right when several effects are at work at once?
//!
//! Every pair of the effects that deflections show, triples of them, and each alone, at usual and at ten times usual size: the
//! simulated world reads without noise, the model is told which effects are there ([`trial`]), and every number it finds is
//! compared with the truth. [`protocol`] says which sets there are, [`document`] is the page.

pub mod document;
pub mod protocol;
mod second_order;
pub mod trial;

pub use document::page;
pub use protocol::{Interactions, InteractionsProtocol, SEED, TRIPLES};
pub use trial::{InteractionRecord, LARGEST_PARAMETER_ERROR, LARGEST_STIFFNESS_ERROR};
