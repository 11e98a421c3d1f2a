//! Interactions: are the numbers right when several effects are present at once?
//!
//! Every pair of the effects that deflections show, triples of them, and each alone, at usual and at ten times usual size: the
//! simulated world reads without noise, the model gets the effects that are present ([`trial`]), and every estimated number is
//! compared with the truth. [`protocol`] defines the sets, [`document`] is the page.

pub mod document;
pub mod protocol;
mod second_order;
pub mod trial;

pub use document::page;
pub use protocol::{Interactions, InteractionsProtocol, SEED, TRIPLES};
pub use trial::{InteractionRecord, LARGEST_PARAMETER_ERROR, LARGEST_STIFFNESS_ERROR};
