//! Cases whose effects show.

use super::{CaseKind, CaseSpec, SimulatedCase};
use crate::{TruthError, laboratory};

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
        Self::draw_in(&laboratory::CAREFUL, kind, index, seed, distance)
    }

    /// The same case as a laboratory with a fault measures it.
    ///
    /// # Errors
    /// As [`SimulatedCase::draw`].
    pub fn draw_in(
        laboratory: &laboratory::FaultEntry,
        kind: CaseKind,
        index: usize,
        seed: u64,
        distance: Option<[f64; 2]>,
    ) -> Result<Self, TruthError> {
        first_made(|n| CaseSpec::draw(kind, index, seed, n, distance).build_in(laboratory))
    }

    /// A case of usual size on a machine of a family, one of [`machines::FAMILIES`](super::machines::FAMILIES).
    ///
    /// # Errors
    /// As [`SimulatedCase::draw`].
    pub fn draw_on(
        family: &'static str,
        kind: CaseKind,
        index: usize,
        seed: u64,
    ) -> Result<Self, TruthError> {
        first_made(|n| CaseSpec { family, ..CaseSpec::draw(kind, index, seed, n, None) }.build())
    }
}

/// What the first attempt gives that succeeds, else what the last one does.
fn first_made<T, E>(attempt: impl Fn(u64) -> Result<T, E>) -> Result<T, E> {
    (1..ATTEMPTS).fold(attempt(0), |made, n| made.or_else(|_| attempt(n)))
}
