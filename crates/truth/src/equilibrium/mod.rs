//! Static equilibrium at finite deflection, by damped Newton with rotation updates on SO(3).
//!
//! Unknowns, in this order, each scaled to newtons so that one tolerance serves all: `z_i` of the six leg laws; twist of
//! the plate that the legs hold; twist of the base where it yields; twist of the loaded platform where the plate yields.

mod assembly;
mod body;
mod leg;
mod newton;

pub use body::Body;
pub use newton::{Equilibrium, solve};
