//! Forces do not act at the point that the file says: every force makes a moment that is not written down.
//!
//! `M -> M - R r x F` with one arm `r` in mobile axes; a plan without forces does not notice.

use hexbench_core::Dataset;
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault, normal6};

/// Its sizes in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "load-point-0.5mm" "loads act 0.5 mm beside their point", &["tolerance"] => LoadPoint { arm: 5e-4 };
    "load-point-1mm" "loads act 1 mm beside their point", &["tolerance"] => LoadPoint { arm: 1e-3 };
];

/// Another point.
#[derive(Debug)]
struct LoadPoint {
    /// Its distance from the stated one, m.
    arm: f64,
}

impl LaboratoryFault for LoadPoint {
    fn write(&self, data: &mut Dataset, rng: &mut Pcg64) {
        let arm = normal6(rng).fixed_rows::<3>(0).normalize() * self.arm;
        for o in &mut data.observations {
            let arm = o.pose.rotation() * arm;
            for load in [&mut o.wrench, &mut o.reference] {
                load.moment -= arm.cross(&load.force);
            }
        }
    }
}
