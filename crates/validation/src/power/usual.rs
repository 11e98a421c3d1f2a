//! Effects of usual size, as the simulated world draws them, and as the model writes them.

use std::sync::Arc;

use hexbench_core::Hexapod;
use hexbench_design::power::{Example, Reference, Subject};
use hexbench_model::term::Term;
use hexbench_truth::Mechanism;
use hexbench_truth::mechanisms::{REGISTRY, Shows};
use rand_pcg::Pcg64;

use crate::recovery::correspondence::nearest;

/// Effects drawn of each kind; an odd number has a middle one.
const DRAWS: usize = 33;

/// A term with effects of usual size in both worlds, in the same order.
pub struct Usual {
    /// As the model sees them.
    pub subject: Subject,
    /// As the world makes them.
    pub mechanisms: Vec<Box<dyn Mechanism>>,
}

/// Effects of usual size for a term; `None` when the simulated world has no such effect.
pub fn usual(term: &Arc<dyn Term>, hexapod: &Hexapod, seed: u64) -> Option<Usual> {
    let index = REGISTRY.iter().position(|e| e.id == term.info().id && e.shows != Shows::Outside)?;
    let mut rng = Pcg64::new(u128::from(seed), index as u128);
    let mut all = Usual {
        subject: Subject { term: Arc::clone(term), examples: Vec::new(), reference: Reference::Usual },
        mechanisms: Vec::new(),
    };
    for _ in 0..DRAWS {
        let mechanism = (REGISTRY[index].draw)(hexapod, &mut rng);
        let (values, shape) = nearest(mechanism.id(), &mechanism.parameters(), hexapod)?;
        all.subject.examples.push(Example { values, shape: shape.unwrap_or(1.0) });
        all.mechanisms.push(mechanism);
    }
    Some(all)
}
