//! Readings that stand out from what a fit leaves of the others.

use hexbench_core::Dataset;
use serde::Serialize;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::estimation::residuals::{Residual, typical_square};

/// Chance that a clean file of any size has one.
const OUTLIER_CHANCE: f64 = 0.01;

/// A suspicious reading.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct SuspiciousReading {
    /// Line of the file.
    pub row: u64,
    /// Largest whitened residual.
    pub z: f64,
}

/// Readings whose chi-square over six coordinates is beyond chance for a file of this size.
pub fn outliers(rows: &[Residual], data: &Dataset) -> Vec<SuspiciousReading> {
    let limit = |freedom: usize| {
        let law = ChiSquared::new(freedom as f64).ok();
        law.map_or(f64::INFINITY, |law| law.inverse_cdf(1.0 - OUTLIER_CHANCE / rows.len().max(1) as f64))
    };
    let limits: Vec<f64> = (0..=6).map(limit).collect();
    let scale = typical_square(rows).max(1.0);
    let far = rows.iter().filter(|r| r.whitened.norm_squared() > limits[r.numbers()] * scale);
    far.map(|r| SuspiciousReading { row: data.observations[r.row].line, z: r.whitened.amax() }).collect()
}
