//! Loads are not quite what is written: the load cell scatters, or too few digits are written down.
//!
//! `F -> F + s u`, `M -> M + s h v` under every condition, with independent standard normal `u` and `v` and an arm `h` of 100 mm; repeats share them.

use hexbench_core::Dataset;
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault, normal6, rewrite_loads};

/// Its sizes in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "load-noise-0.5" "loads scatter by 0.5 N and 0.05 N m", &["load-noise"] => LoadNoise { force: 0.5 };
    "load-noise-1" "loads scatter by 1 N and 0.1 N m", &["load-noise"] => LoadNoise { force: 1.0 };
];

/// Moments scatter by that of forces at this arm, m.
const ARM: f64 = 0.1;

/// Scatter of the loads.
#[derive(Debug)]
struct LoadNoise {
    /// Standard deviation of each force, N.
    force: f64,
}

impl LaboratoryFault for LoadNoise {
    fn write(&self, data: &mut Dataset, rng: &mut Pcg64) {
        let of_component = |k: usize| if k < 3 { 1.0 } else { ARM };
        rewrite_loads(
            data,
            || normal6(rng) * self.force,
            |load, error| std::array::from_fn(|k| load[k] + error[k] * of_component(k)),
        );
    }
}
