//! Cases whose effects show.

use super::{CaseKind, CaseSpec, SimulatedCase};
use crate::TruthError;

/// Draws of one case before it is given up; the later ones are of an easy machine and a rich plan.
const ATTEMPTS: u64 = 12;

impl SimulatedCase {
    /// The `index`-th case of a kind, drawn from a seed and measured. Some effects do not show in some plans or machines:
    /// then the same effect is tried in others.
    ///
    /// # Errors
    /// As [`CaseSpec::build`], once every draw has failed.
    pub fn draw(
        kind: CaseKind,
        index: usize,
        seed: u64,
        distance: Option<[f64; 2]>,
    ) -> Result<Self, TruthError> {
        let attempt = |n| CaseSpec::draw(kind, index, seed, n, distance).build();
        (1..ATTEMPTS).fold(attempt(0), |made, n| made.or_else(|_| attempt(n)))
    }
}
