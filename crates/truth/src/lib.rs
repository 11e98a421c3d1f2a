//! The simulated world of the bench: a hexapod with real imperfections, loaded and measured.
//!
//! A static equilibrium at finite deflection is solved for every state of the machine. Legs run between the *true*
//! joints; their free lengths are those commanded from the *nominal* geometry; each leg carries the force its law gives
//! at its elongation. With `l_i = t + R B_i - A_i`, `q_i = |l_i|`, `n_i = l_i / q_i`:
//!
//! ```text
//! F - sum f_i n_i = 0
//! M - sum (R B_i) x f_i n_i = 0
//! q_i - q_i(commanded) = e_i(f_i)        one monotone law per leg, possibly with memory
//! ```
//!
//! A yielding base or plate adds a body with its own equilibrium. A deflection is the pose in the loaded state minus the
//! pose in the reference state, each reached along its own path from the unloaded machine.
//!
//! The result is not linearized: derivatives only steer Newton's method. If the iteration does not converge, the
//! result is an error, never a number.
//!
//! - [`World`]: a machine with its imperfections; [`World::deflection`], [`World::pose`].
//! - [`mechanisms`]: one file for each physical effect, all of them in [`mechanisms::REGISTRY`].
//! - [`own_law`]: a law that a scene states as a formula.
//! - [`metrology`]: errors of the instrument.
//! - [`laboratory`]: faults of laboratories, one file each.
//! - [`misstatements`]: misstatements of files, one file for each kind.
//! - [`mjcf`]: the structure as a MuJoCo model, so that another program can compute its rest state.
//! - [`campaign`]: machines, plans, sizes, and case folders made from them.
//! - [`scene`]: a folder that describes a machine with hidden effects, a plan and an instrument.

pub mod campaign;
pub mod equilibrium;
pub mod error;
pub mod laboratory;
pub mod law;
mod linear;
pub mod mechanisms;
pub mod metrology;
pub mod misstatements;
pub mod mjcf;
pub mod own_law;
pub mod scene;
pub mod setup;
pub mod situation;
pub mod so3;
pub mod world;

pub use equilibrium::{Newton, Statics};
pub use error::TruthError;
pub use law::{LegLaw, LegMemory};
pub use mechanisms::Mechanism;
pub use scene::Scene;
pub use setup::Setup;
pub use situation::{Instant, PastForces, Phase, Situation};
pub use world::World;
