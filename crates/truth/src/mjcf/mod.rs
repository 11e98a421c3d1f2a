//! The structure as a MuJoCo model: a cross-check that shares only the drawing with the solver of this crate.
//!
//! Written from a [`World`](crate::World) at one commanded pose; MuJoCo finds the rest. The geometry is that of the *true* machine at the
//! commanded pose, the springs are relaxed at the commanded leg lengths:
//!
//! - a leg is a chain of uniform rods on a universal joint at the base; between the rods slide joints with springs, in
//!   series as stiff as the leg. Its upper end is closed onto the platform by a `connect` constraint;
//! - joints that resist bending are hinges with springs; a leg whose platform joint does so ends in a head that is welded
//!   to the platform, with a free hinge for the twist;
//! - a yielding foundation or plate is a body on three slides and three hinges with springs;
//! - the load is set by six motors `fx` ... `mz` (N, N m) in fixed axes; the keyframe `loaded` holds the wrench;
//! - points at which sensors look are sites `sensor-NAME` of the platform;
//! - legs with weight are true masses under gravity; all other bodies have their weight taken away (`gravcomp`). Without
//!   leg weight there is no gravity, and no state of rest depends on a mass.
//!
//! Sensors: `leg-N-force-J` (z: axial force between two rods of leg N, *compression* positive as MuJoCo counts it),
//! `position` and `orientation` of the mobile origin.
//!
//! What MJCF or this writer lacks is [`TruthError::Inexpressible`], never left out silently. What only the instrument does
//! (drift, offset of the target) is no part of the machine.

mod document;
mod element;
mod leg;
mod load;
mod part;
mod scenery;
mod yielding;

pub use document::export;

use crate::TruthError;

/// Name of the format in errors.
const FORMAT: &str = "MJCF";

fn inexpressible(what: &'static str) -> TruthError {
    TruthError::Inexpressible { world: FORMAT, what }
}
