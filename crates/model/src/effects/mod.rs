//! Terms: their definition, how their action passes through the structure, and terms from a user's file. The catalogue itself
//! is [`crate::terms`].

pub(crate) mod body;
pub mod chain;
pub mod formula;
pub(crate) mod intern;
pub(crate) mod period;
pub mod sizes;
pub mod term;
pub mod untestable;
pub mod user_term;
