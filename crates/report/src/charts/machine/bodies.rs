//! Base, legs and platform as edges.

use crate::body::{around, displacements, ends, joints};
use crate::plot::{Edge, Wireframe};
use hexbench_core::{Vector3, Vector6};
use hexbench_model::estimation::campaign::Condition;
use hexbench_model::results::compare::acts::EffectMotion;

/// Motions below this are not drawn, um.
pub(super) const LEAST_UM: f64 = 0.01;
/// Share of the largest elongation from which a leg is drawn as one that changes.
const WORTH: f64 = 1.0 / 3.0;

/// The machine at a condition.
pub(super) struct Bodies<'a> {
    pub(super) at: &'a Condition,
    /// Base and platform end of every leg, fixed frame, m.
    joints: [[Vector3; 2]; 6],
}

impl<'a> Bodies<'a> {
    pub(super) fn at(at: &'a Condition) -> Self {
        Self { at, joints: joints(at) }
    }

    /// Base ring, platform ring and legs.
    pub(super) fn unloaded(&self) -> Vec<Edge> {
        unloaded(&self.joints)
    }

    /// Platform ring moved by a twist, `factor` times too far.
    pub(super) fn moved(&self, twist: &Vector6, factor: f64) -> Vec<Edge> {
        self.ring_moved(1, &displacements(self.at, twist), factor)
    }

    /// What effects do below the platform: the base ring where it moves, legs that change their length.
    pub(super) fn acted(&self, acts: &EffectMotion, factor: f64) -> Vec<Edge> {
        let moves = acts.base.iter().any(|b| b.norm() * 1e6 > LEAST_UM);
        let mut edges = if moves { self.ring_moved(0, &acts.base, factor) } else { Vec::new() };
        let most = acts.elongation.amax();
        let changes = |leg: &usize| most * 1e6 > LEAST_UM && acts.elongation[*leg].abs() >= WORTH * most;
        edges.extend((0..6).filter(changes).map(|leg| edge(&self.joints[leg][0], &self.joints[leg][1])));
        edges
    }

    /// The drawing with the numbers of the legs at their base joints.
    pub(super) fn numbered(&self, drawing: Wireframe) -> Wireframe {
        self.joints
            .iter()
            .enumerate()
            .fold(drawing, |d, (leg, ends)| d.marked(format!("{}", leg + 1), ends[0].into()))
    }

    /// The ring of one end of the legs with its joints displaced.
    fn ring_moved(&self, end: usize, by: &[Vector3; 6], factor: f64) -> Vec<Edge> {
        let joints = ends(&self.joints, end);
        ring(&std::array::from_fn(|leg| joints[leg] + by[leg] * factor), &around(&joints))
    }
}

/// Base ring, platform ring and legs between these joints.
pub(in super::super) fn unloaded(joints: &[[Vector3; 2]; 6]) -> Vec<Edge> {
    let rings = [0, 1].map(|end| ends(joints, end)).map(|joints| ring(&joints, &around(&joints)));
    rings.into_iter().flatten().chain(joints.iter().map(|[a, b]| edge(a, b))).collect()
}

fn ring(joints: &[Vector3; 6], order: &[usize; 6]) -> Vec<Edge> {
    (0..6).map(|k| edge(&joints[order[k]], &joints[order[(k + 1) % 6]])).collect()
}

fn edge(a: &Vector3, b: &Vector3) -> Edge {
    [(*a).into(), (*b).into()]
}
