//! The readings of two rows are exchanged: a note from the wrong line.
//!
//! The two rows have different loads.

use hexbench_core::{Dataset, Vector6};
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault, pick};

/// Its entry in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "rows-swapped" "readings of two rows exchanged", &["row-order", "blunder"] => RowsSwapped;
];

/// Exchanged readings.
#[derive(Debug)]
struct RowsSwapped;

impl LaboratoryFault for RowsSwapped {
    fn slip(&self, data: &mut Dataset, _: &Vector6, rng: &mut Pcg64) {
        let all = &data.observations;
        let Some(one) = pick::index(all.len(), rng) else { return };
        let others: Vec<usize> = (0..all.len()).filter(|&i| all[i].wrench != all[one].wrench).collect();
        let Some(other) = pick::index(others.len(), rng).map(|i| others[i]) else { return };
        let measured = all[one].measured;
        data.observations[one].measured = data.observations[other].measured;
        data.observations[other].measured = measured;
    }
}
