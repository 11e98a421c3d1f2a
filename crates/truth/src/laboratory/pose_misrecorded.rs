//! The machine stands at another pose than the file says: a digit of one coordinate is wrong in all rows of the pose.

use hexbench_core::{Dataset, Vector6};
use rand::RngExt;
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault, pick};

/// Its sizes in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "pose-1mm" "one pose misrecorded by 1 mm", &["pose"] => PoseMisrecorded { by: 1e-3 };
    "pose-10mm" "one pose misrecorded by 10 mm", &["pose"] => PoseMisrecorded { by: 1e-2 };
];

/// A wrong pose.
#[derive(Debug)]
struct PoseMisrecorded {
    /// Error of one coordinate, m.
    by: f64,
}

impl LaboratoryFault for PoseMisrecorded {
    fn slip(&self, data: &mut Dataset, _: &Vector6, rng: &mut Pcg64) {
        let Some(one) = pick::index(data.observations.len(), rng) else { return };
        let (pose_id, k, by) =
            (data.observations[one].pose_id, rng.random_range(0..3), pick::side(rng) * self.by);
        for observation in data.observations.iter_mut().filter(|o| o.pose_id == pose_id) {
            observation.pose.translation[k] += by;
        }
    }
}
