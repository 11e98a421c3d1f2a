//! Joints are not where the drawing has them.
//!
//! Every coordinate of the twelve joint centers is off by a Gaussian error; legs are commanded, and readings evaluated, with the
//! drawing. The machine is that of [`JointGeometry`].

use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault};
use crate::{World, mechanisms::JointGeometry};

/// Its sizes in the registry: from a machine that was measured after assembly to one that was not.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "joints-0.05mm" "joints 0.05 mm rms off the drawing", &["tolerance"] => Joints { rms: 5e-5 };
    "joints-0.1mm" "joints 0.1 mm rms off the drawing", &["tolerance"] => Joints { rms: 1e-4 };
    "joints-0.2mm" "joints 0.2 mm rms off the drawing", &["tolerance"] => Joints { rms: 2e-4 };
    "joints-0.5mm" "joints 0.5 mm rms off the drawing", &["tolerance"] => Joints { rms: 5e-4 };
];

/// Joints off the drawing.
#[derive(Debug)]
struct Joints {
    /// Of each coordinate, m.
    rms: f64,
}

impl LaboratoryFault for Joints {
    fn alter(&self, world: &mut World, rng: &mut Pcg64) {
        let errors = JointGeometry::sampled(&world.hexapod, self.rms, rng);
        // What the effects do starts from where the joints are.
        world.mechanisms.insert(0, Box::new(errors));
    }
}
