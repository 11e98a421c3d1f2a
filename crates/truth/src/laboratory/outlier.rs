//! A number of a reading is far off: a probe that slipped, a truck that passed.
//!
//! `x -> x +- s sigma` in one number of one row, or of several rows.

use hexbench_core::{Dataset, Vector6};
use rand::RngExt;
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault, pick};

/// Its sizes in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "outlier-8" "one number off by 8 sigma", &["blunder"] => Outlier { sigmas: 8.0, count: 1 };
    "outlier-12" "one number off by 12 sigma", &["blunder"] => Outlier { sigmas: 12.0, count: 1 };
    "outlier-20" "one number off by 20 sigma", &["blunder"] => Outlier { sigmas: 20.0, count: 1 };
    "outlier-60" "one number off by 60 sigma", &["blunder"] => Outlier { sigmas: 60.0, count: 1 };
    "outliers-20" "three numbers off by 20 sigma", &["blunder"] => Outlier { sigmas: 20.0, count: 3 };
];

/// Numbers that are far off.
#[derive(Debug)]
struct Outlier {
    /// How far, in standard deviations.
    sigmas: f64,
    /// How many; they may fall into the same row.
    count: usize,
}

impl LaboratoryFault for Outlier {
    fn slip(&self, data: &mut Dataset, sigma: &Vector6, rng: &mut Pcg64) {
        for _ in 0..self.count {
            let Some(row) = pick::index(data.observations.len(), rng) else { return };
            let k = rng.random_range(0..6);
            data.observations[row].measured[k] += pick::side(rng) * self.sigmas * sigma[k];
        }
    }
}
