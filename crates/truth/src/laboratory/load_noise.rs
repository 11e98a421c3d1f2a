//! Loads are not quite what is written: the load cell scatters, or too few digits are written down.
//!
//! `F -> F + s u`, `M -> M + s h v` under every condition, with independent standard normal `u` and `v` and an arm `h` of 100 mm; repeats share them.

use std::collections::HashMap;

use hexbench_core::{Dataset, Vector6, Wrench};
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault, normal6};

/// Its sizes in the registry.
pub(super) const FAULTS: [FaultEntry; 2] = [
    entry("load-noise-0.5", "loads scatter by 0.5 N and 0.05 N m", &LoadNoise { force: 0.5 }),
    entry("load-noise-1", "loads scatter by 1 N and 0.1 N m", &LoadNoise { force: 1.0 }),
];

/// Moments scatter by that of forces at this arm, m.
const ARM: f64 = 0.1;

const fn entry(id: &'static str, title: &'static str, fault: &'static LoadNoise) -> FaultEntry {
    FaultEntry { id, title, findings: &["load-noise"], fault }
}

/// Scatter of the loads.
#[derive(Debug)]
struct LoadNoise {
    /// Standard deviation of each force, N.
    force: f64,
}

impl LaboratoryFault for LoadNoise {
    fn write(&self, data: &mut Dataset, rng: &mut Pcg64) {
        let mut errors: HashMap<[[u64; 6]; 2], Vector6> = HashMap::new();
        for o in &mut data.observations {
            let mut written = o.wrench.to_array();
            let condition = [o.pose.bits(), written.map(f64::to_bits)];
            let error = errors.entry(condition).or_insert_with(|| normal6(rng) * self.force);
            for (k, component) in written.iter_mut().enumerate() {
                *component += error[k] * if k < 3 { 1.0 } else { ARM };
            }
            o.wrench = Wrench::from_array(written);
        }
    }
}
