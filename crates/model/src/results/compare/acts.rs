//! Where the effects of a model act under one condition: what an eye would see of them.

use hexbench_core::{Vector3, Vector6};

use super::JudgedModel;
use crate::estimation::equilibrium::acting;

/// What all effects of a model do between reference and load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EffectMotion {
    /// Displacement of every base joint, fixed axes, m.
    pub base: [Vector3; 6],
    /// Extra elongation of every leg, m.
    pub elongation: Vector6,
}

impl EffectMotion {
    /// Under one condition of the readings; none where the effects displace nothing and stretch no leg.
    pub fn of(judged: &JudgedModel<'_>, condition: usize) -> Option<Self> {
        let at = &judged.lin.conditions[condition];
        let load = acting(&judged.lin.machine, at, &judged.point.active);
        let base = load.displacement(at).map_or([Vector3::zeros(); 6], |joints| joints.base());
        let springs = &judged.point.compliances;
        // What a displaced joint takes of a leg is seen at the joint.
        let shift = load.shift().unwrap_or_default();
        let along = Vector6::from_fn(|leg, _| at.legs.directions[leg].dot(&shift[leg]));
        let elongation = load.stretch(at, springs) - springs.component_mul(&at.spring_change()) - along;
        let is_still = elongation == Vector6::zeros() && base.iter().all(|b| *b == Vector3::zeros());
        (!is_still).then_some(Self { base, elongation })
    }
}
