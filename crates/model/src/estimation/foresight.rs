//! Terms that are dear to ask, asked for all conditions at once.
//!
//! Where a condition comes to rest depends on what the terms do there, so what a term will be asked is not known beforehand. Such a term
//! notes what it cannot answer yet, which then is no number; it finds all of that at once, and the conditions are gone through again until
//! nothing new is asked. What is computed afterwards meets answers that are known, and is what it would be without this.

use std::ops::Range;
use std::sync::Arc;

use hexbench_core::Observation;

use crate::effects::term::Term;
use crate::estimation::campaign::{Campaign, Condition};
use crate::estimation::equilibrium::{LegsOfPose, Tangents, YieldingMachine};
use crate::estimation::linearization::{Active, ModelPoint, actions};
use crate::estimation::parallel::map;
use crate::machine::geometry::Machine;

/// Rounds at most, one for each step from the commanded pose to the derivatives there; what is unknown after them is asked one by one.
const MOST_ROUNDS: usize = 16;

/// What the active terms will be asked where these groups of a campaign come to rest; `inputs` of a group, by its number.
pub(crate) fn of_campaign(
    campaign: &Campaign,
    point: &ModelPoint,
    tangents: Tangents,
    groups: Range<usize>,
    inputs: impl Fn(usize, &Observation) -> Observation + Sync,
) {
    let noting: Vec<_> = point.active.iter().map(|a| a.term.noting()).collect();
    if noting.iter().all(Option::is_none) {
        return;
    }
    let active = point.active.iter().zip(&noting);
    let active = active.map(|(a, noting)| match noting {
        Some(term) => Active { term: Arc::clone(term), ..a.clone() },
        None => a.clone(),
    });
    let there = ModelPoint { active: active.collect(), ..point.clone() };
    let machine = there.calibrated_machine();
    let structure = YieldingMachine::of(&machine, &there.compliances, &there.active, tangents);
    let which: Vec<usize> = groups.collect();
    for _ in 0..MOST_ROUNDS {
        // A condition that fails for want of a number is gone through again.
        map(&which, |&i| {
            let group = &campaign.groups[i];
            let none = &mut LegsOfPose::default();
            campaign.condition(&structure, group, &inputs(i, &group.mean), none).is_ok()
        });
        if !answered(&noting) {
            return;
        }
    }
}

/// What a term will be asked at conditions in hand.
pub(crate) fn of_conditions(
    term: &dyn Term,
    rich: bool,
    shape: f64,
    machine: &Machine,
    conditions: &[Condition],
) {
    let Some(noting) = term.noting() else { return };
    let mut out = Vec::new();
    for at in conditions {
        actions(noting.as_ref(), rich, shape, machine, at, &mut out);
    }
    noting.answer();
}

/// Lets all terms find what they noted; true when there was something.
fn answered(noting: &[Option<Arc<dyn Term>>]) -> bool {
    noting.iter().flatten().filter(|term| term.answer()).count() > 0
}
