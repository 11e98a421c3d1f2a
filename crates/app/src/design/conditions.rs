//! Conditions that no estimated parameter depends on stay as they are without effort.

use hexbench_core::Approach;
use hexbench_core::words::joined;
use hexbench_design::space::Conditions;
use hexbench_model::effects::term::{Need, Term};
use std::sync::Arc;

/// Keeps every condition of several values that none of these terms needs at one, and says which.
pub(super) fn settle(conditions: &mut Conditions, terms: &[Arc<dyn Term>]) -> Option<String> {
    let is_free = |need: Need| !terms.iter().any(|t| t.info().needs.contains(&need));
    let mut kept = Vec::new();
    if is_free(Need::Approach) && conditions.approaches.len() > 1 {
        let usual = Approach::default();
        let approach = if conditions.approaches.contains(&usual) { usual } else { conditions.approaches[0] };
        conditions.approaches = vec![approach];
        kept.push(format!("approach {}", approach.sign()));
    }
    if is_free(Need::DeltaT) && conditions.delta_t.len() > 1 {
        let nearest = nearest_to_zero(&conditions.delta_t);
        conditions.delta_t = vec![nearest];
        kept.push(format!("delta_T {nearest} K"));
    }
    if is_free(Need::Elapsed) && conditions.waits.len() > 1 {
        let shortest = conditions.waits.iter().copied().fold(f64::INFINITY, f64::min);
        conditions.waits = vec![shortest];
        kept.push(format!("wait {shortest} s"));
    }
    let text = || {
        format!("The same in every reading, because no estimated parameter depends on it: {}.", joined(&kept))
    };
    (!kept.is_empty()).then(text)
}

/// Zero where the values lie on both sides of it.
fn nearest_to_zero(values: &[f64]) -> f64 {
    let [low, high] =
        values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(*v), h.max(*v)]);
    0.0_f64.clamp(low, high)
}
