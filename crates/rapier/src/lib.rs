//! The second world: the hexapod as rigid bodies and joints of a dynamics engine (Rapier), brought to rest.
//!
//! It uses the machine as the mechanisms of the first world define it ([`hexbench_truth::Setup`]) and finds the rest state
//! by other means: it solves no equilibrium, but lets the machine move until it comes to rest. The two programs share no
//! equilibrium equation, so their agreement cross-checks both.
//!
//! - [`RapierStatics`]: a [`Statics`](hexbench_truth::Statics); `World { statics: Arc::new(RapierStatics::default()), .. }`.
//! - [`cross_check`]: both worlds side by side over machines, effects, poses and loads.
//! - [`transient`]: how the machine settles after a load step, with true masses.
//! - [`modes`]: natural frequencies.
//!
//! Not supported ([`TruthError::Inexpressible`]): a rigid friction slider, whose force does not follow from the positions of
//! the bodies; a yielding base or plate with rigid directions.

mod convert;
pub mod cross_check;
pub mod law;
pub mod masses;
pub mod modes;
pub mod parts;
pub mod rest;
pub mod scene;
pub mod transient;

pub use modes::Modes;
pub use rest::RapierStatics;

use hexbench_truth::TruthError;

/// A number of steps or sweeps.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // small and positive; the cast saturates
fn whole(count: f64) -> usize {
    count as usize
}

/// What the engine has no means for.
fn inexpressible(what: &'static str) -> TruthError {
    TruthError::Inexpressible { world: "the world of rigid bodies", what }
}
