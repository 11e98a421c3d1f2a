//! Every load is off by a share of its own: a load cell whose factor changes with how it is held, a lever read off by eye.
//!
//! `(F, M) -> (1 + s u) (F, M)` under every condition, with standard normal `u`; repeats share it.

use hexbench_core::Dataset;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault, rewrite_loads};

/// Its size in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "load-share-1" "every load is off by 1 % of itself", &["load-noise"] => LoadShare { share: 0.01 };
];

/// Scatter of the loads, relative.
#[derive(Debug)]
struct LoadShare {
    /// Standard deviation.
    share: f64,
}

impl LaboratoryFault for LoadShare {
    fn write(&self, data: &mut Dataset, rng: &mut Pcg64) {
        let drawn = || -> f64 { StandardNormal.sample(rng) };
        rewrite_loads(data, drawn, |load, drawn| {
            load.map(|component| component * (1.0 + self.share * drawn))
        });
    }
}
