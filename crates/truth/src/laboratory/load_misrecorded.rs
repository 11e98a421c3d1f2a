//! The load of one condition is written half as large again: 150 N for 100 N.
//!
//! `F -> W0 + 1.5 (F - W0)` of the force, in all repeats of one pose under one load.

use hexbench_core::{Dataset, Vector6};
use rand_pcg::Pcg64;

use super::{FaultEntry, LaboratoryFault, pick};

/// Written over true change of the force.
const FACTOR: f64 = 1.5;

/// Its entry in the registry.
pub(super) const FAULTS: &[FaultEntry] = entries![
    "load-1.5x" "one load of 100 N written 150 N", &["load"] => LoadMisrecorded;
];

/// A wrong load.
#[derive(Debug)]
struct LoadMisrecorded;

impl LaboratoryFault for LoadMisrecorded {
    fn slip(&self, data: &mut Dataset, _: &Vector6, rng: &mut Pcg64) {
        // A pure moment has no force to be mistaken in.
        let mut forced = data.clone();
        forced.observations.retain(|o| o.wrench.force != o.reference.force);
        let rows = pick::condition(&forced, rng);
        let Some(one) = rows.first().map(|&i| forced.observations[i]) else { return };
        for o in data.observations.iter_mut().filter(|o| pick::same_condition(o, &one)) {
            o.wrench.force = o.reference.force + (o.wrench.force - o.reference.force) * FACTOR;
        }
    }
}
