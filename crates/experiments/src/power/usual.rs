//! Effects of usual size, as the simulated world draws them, and as the model writes them.

use std::sync::Arc;

use hexbench_core::Hexapod;
use hexbench_core::statistics::root_mean_square;
use hexbench_core::streams::{Purpose, stream};
use hexbench_design::power::{EffectSizes, Example, Reference};
use hexbench_model::effects::term::Term;
use hexbench_truth::Mechanism;
use hexbench_truth::mechanisms::{REGISTRY, Shows};

use crate::recovery::correspondence::{Equivalent, equivalent};

/// Effects drawn of each kind; an odd number has a middle one.
const DRAWS: usize = 33;

/// A term with effects of usual size in both worlds, in the same order.
pub struct Usual {
    /// As the model sees them.
    pub subject: EffectSizes,
    /// As the world makes them.
    pub mechanisms: Vec<Box<dyn Mechanism>>,
}

/// Effects of usual size for a term; `None` when the simulated world has no such effect.
///
/// The world draws directions, shapes and, where numbers are normal, also sizes. All are brought to one size, the root mean square
/// of those drawn, so that they differ in direction and shape only.
pub fn usual(term: &Arc<dyn Term>, hexapod: &Hexapod, seed: u64) -> Option<Usual> {
    let index = REGISTRY.iter().position(|e| e.id == term.info().id && e.shows != Shows::Outside)?;
    let mut rng = stream(seed, Purpose::PowerEffects, [index as u64]);
    let drawn: Vec<Box<dyn Mechanism>> =
        (0..DRAWS).map(|_| (REGISTRY[index].draw)(hexapod, &mut rng)).collect();
    let examples = drawn.iter().map(|m| example(m.as_ref(), hexapod)).collect::<Option<Vec<_>>>()?;
    let mut subject = EffectSizes { term: Arc::clone(term), examples, reference: Reference::Usual };
    let sizes: Vec<f64> = subject.examples.iter().map(|e| subject.size(e)).collect();
    let usual = root_mean_square(sizes.iter().copied())?;
    let factors: Vec<f64> = sizes.iter().map(|s| usual / s).collect();
    for (example, factor) in subject.examples.iter_mut().zip(&factors) {
        example.values.iter_mut().for_each(|v| *v *= factor);
    }
    let mechanisms = drawn.iter().zip(&factors).map(|(m, factor)| m.scaled(*factor)).collect();
    Some(Usual { subject, mechanisms })
}

fn example(mechanism: &dyn Mechanism, hexapod: &Hexapod) -> Option<Example> {
    let Equivalent { values, shape } = equivalent(mechanism.id(), &mechanism.parameters(), hexapod)?;
    let values = values.into_iter().collect::<Option<_>>()?;
    Some(Example { values, shape: shape.unwrap_or(1.0) })
}
