//! One reference reading for each pose, shared by all its loads and repeats.
//!
//! A deflection is loaded minus reference: `e = (z - r) / sqrt(2)` with one `r` for a pose. Every value has the stated standard
//! deviation, any two of a pose correlate by one half. It is how most laboratories measure.

use std::collections::BTreeMap;

use hexbench_core::Vector6;
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault, normal6};
use crate::campaign::PlanRow;

/// Its entry in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "shared-reference" "one reference reading per pose, shared by its loads", &["shared-reference"]
        => SharedReference;
];

/// A reference read once.
#[derive(Debug)]
struct SharedReference;

impl LaboratoryFault for SharedReference {
    fn err(&self, rows: &[PlanRow], sigma: &Vector6, errors: &mut [Vector6], rng: &mut Pcg64) {
        let mut references: BTreeMap<i64, Vector6> = BTreeMap::new();
        for (row, error) in rows.iter().zip(errors) {
            let reference =
                references.entry(row.pose_id).or_insert_with(|| normal6(rng).component_mul(sigma));
            *error = (*error - *reference) * std::f64::consts::FRAC_1_SQRT_2;
        }
    }
}
