//! One translation is written in mm where the column has um: it is a thousand times too small.
//!
//! It hits a number of at least [`LEAST`] standard deviations; in a smaller one nobody could see it.

use hexbench_core::{Dataset, Vector6};
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault, pick};

/// Smallest number hit, standard deviations.
const LEAST: f64 = 20.0;
/// A length in mm read as one in um.
const FACTOR: f64 = 1e-3;

/// Its entry in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "unit-slip" "one number in mm instead of um", &["blunder"] => UnitSlip;
];

/// A number in another unit.
#[derive(Debug)]
struct UnitSlip;

impl LaboratoryFault for UnitSlip {
    fn slip(&self, data: &mut Dataset, sigma: &Vector6, rng: &mut Pcg64) {
        if let Some((row, k)) = pick::number(data, 0..3, LEAST, sigma, rng) {
            data.observations[row].measured[k] *= FACTOR;
        }
    }
}
