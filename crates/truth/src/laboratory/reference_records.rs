//! One reference reading for every run of five rows, whatever their poses and loads.
//!
//! As where the reference is read again after every few loads. Errors are those of a reference that a pose shares, `e = (z - r) / sqrt(2)`;
//! the file numbers the references in `ref_record`, or says nothing of them.

use hexbench_core::{Dataset, Vector6};
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault, normal6};
use crate::campaign::PlanRow;

/// Rows that share a reference.
const RUN: usize = 5;

/// Its entries in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "reference-records" "one reference reading for five rows, numbered in the file", &["reference-record"]
        => ReferenceRecords { are_named: true };
    "reference-records-unnamed" "one reference reading for five rows, of which the file says nothing", &["shared-reference", "drift", "setup-error"]
        => ReferenceRecords { are_named: false };
];

/// References read now and then.
#[derive(Debug)]
struct ReferenceRecords {
    /// The file has the column.
    are_named: bool,
}

impl LaboratoryFault for ReferenceRecords {
    fn err(&self, _: &[PlanRow], sigma: &Vector6, errors: &mut [Vector6], rng: &mut Pcg64) {
        for run in errors.chunks_mut(RUN) {
            let reference = normal6(rng).component_mul(sigma);
            for error in run {
                *error = (*error - reference) * std::f64::consts::FRAC_1_SQRT_2;
            }
        }
    }

    fn write(&self, data: &mut Dataset, _: &mut Pcg64) {
        if !self.are_named || data.is_absolute() {
            return;
        }
        data.columns.reference_record = true;
        for (run, rows) in (1..).zip(data.observations.chunks_mut(RUN)) {
            for row in rows {
                row.reference_record = Some(run);
            }
        }
    }
}
