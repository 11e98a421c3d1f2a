//! Nobody wrote the temperature down: legs grow with it, and the file has no such column.
//!
//! The plan's temperature changes (0.3 K, Gaussian, from condition to condition) act as in [`ThermalExpansion`] of steel;
//! `delta_T_K` is missing. Where the hidden effect is this very expansion, no answer can be right.

use hexbench_core::Dataset;
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault};
use crate::{World, mechanisms::ThermalExpansion};

/// Expansion of steel, 1/K.
const STEEL: f64 = 1.2e-5;

/// Its entry in the registry. Repeats share the temperature of their condition.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "temperature" "temperature (0.3 K) acts on the legs, not recorded", &["setup-error"] => Temperature;
];

/// A temperature that was not recorded.
#[derive(Debug)]
struct Temperature;

impl LaboratoryFault for Temperature {
    fn alter(&self, world: &mut World, _: &mut Pcg64) {
        world.mechanisms.push(Box::new(ThermalExpansion { alpha: STEEL }));
    }

    fn write(&self, data: &mut Dataset, _: &mut Pcg64) {
        data.columns.delta_t = false;
        for observation in &mut data.observations {
            observation.delta_t = 0.0;
        }
    }
}
