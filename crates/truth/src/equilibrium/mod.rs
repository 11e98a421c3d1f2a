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

use std::fmt::Debug;

use crate::{LegMemory, Setup, TruthError};

/// A way to find the state of rest of a structure. Worlds that share the mechanisms differ in it.
pub trait Statics: Debug + Send + Sync {
    /// State of rest, given what the legs remember of the last one.
    ///
    /// # Errors
    /// [`TruthError`]: a structure it cannot express, or no state of rest; never a number that is not a solution.
    fn rest(&self, setup: &Setup, remembered: &[LegMemory; 6]) -> Result<Equilibrium, TruthError>;
}

/// [`solve`]: damped Newton.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Newton;

impl Statics for Newton {
    fn rest(&self, setup: &Setup, remembered: &[LegMemory; 6]) -> Result<Equilibrium, TruthError> {
        solve(setup, remembered)
    }
}
