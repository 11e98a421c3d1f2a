//! One component of the load cell has a gain error throughout.
//!
//! `F_k -> F_k (1 + g)` in the loaded and in the reference state, `k` one of the components of the force that change.

use hexbench_core::Dataset;
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault, pick};

/// Its sizes in the registry: within the tolerance of a cheap load cell, and beyond it.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "load-gain-1" "one force component 1 % off throughout", &["tolerance"] => LoadComponent { gain: 0.01 };
    "load-gain-3" "one force component 3 % off throughout", &["tolerance"] => LoadComponent { gain: 0.03 };
];

/// A gain error of the load cell.
#[derive(Debug)]
struct LoadComponent {
    /// Relative error of what is written.
    gain: f64,
}

impl LaboratoryFault for LoadComponent {
    fn write(&self, data: &mut Dataset, rng: &mut Pcg64) {
        let all = &data.observations;
        let changes =
            |k: &usize| all.iter().any(|o| (o.wrench.force[*k] - o.reference.force[*k]).abs() > 0.0);
        let components: Vec<usize> = (0..3).filter(changes).collect();
        let Some(k) = pick::index(components.len(), rng).map(|i| components[i]) else { return };
        for o in &mut data.observations {
            o.wrench.force[k] *= 1.0 + self.gain;
            o.reference.force[k] *= 1.0 + self.gain;
        }
    }
}
