//! The machine under its most telling load: what each model misses of its motion, exaggerated.

use crate::number::significant;
use crate::page::{Block, Section};
use crate::plot::{Edge, Wireframe};
use hexbench_core::{Vector3, Vector6};
use hexbench_model::estimation::campaign::Condition;

use super::ReportError;
use super::data::Data;

/// Longest drawn displacement of a joint, as a share of the platform radius.
const DRAWN: f64 = 0.35;

/// The condition that the first model misses most, of those in which six numbers tell the motion.
pub(crate) fn section(data: &Data<'_>) -> Result<Option<Section>, ReportError> {
    let lin = &data.before.judged.lin;
    let miss = |i: &usize| lin.residual(*i).norm();
    let told =
        if data.campaign.blocks.len() < 2 { data.before.judged.space.determined() } else { Vec::new() };
    let Some(worst) = told.into_iter().max_by(|a, b| miss(a).total_cmp(&miss(b))) else {
        return Ok(None);
    };
    let at = &lin.conditions[worst];
    let missed: Vec<_> = data
        .models()
        .map(|(name, look, seen)| (name, look, at.motion(&(at.reading - seen.judged.lin.predicted(worst)))))
        .collect();
    let moves = |motion: &Vector6| {
        at.legs.arms.map(|arm| displacement(motion, &arm).norm()).into_iter().fold(0.0, f64::max)
    };
    let largest = missed.iter().map(|(.., motion)| moves(motion)).fold(0.0, f64::max);
    let factor = DRAWN * lin.machine.nominal.platform_radius() / largest;
    if !factor.is_finite() {
        return Ok(None);
    }
    let bodies = Bodies { at, joints: ends(at), factor };
    let mut drawing = Wireframe::new("")
        .seen("from the front, a little from above", 25.0, 22.0)
        .seen("from above", 0.0, 90.0)
        .with("base and unloaded platform", None, bodies.unloaded());
    for (name, look, motion) in missed {
        drawing = drawing.with(name, Some(look), bodies.moved(&motion));
    }
    let caption = format!(
        "The condition that {} most: force change ({}) N, moment change ({}) N m. What is \
         left of the measured motion beside each model is drawn {} times too large; a perfect model leaves the platform in place.",
        data.words.misses,
        list(&(at.wrench.force - at.reference.force)),
        list(&(at.wrench.moment - at.reference.moment)),
        significant(factor, 2)
    );
    let section = Section::new("The machine under load").id("machine");
    Ok(Some(section.with(Block::figure(drawing.to_svg()?, caption))))
}

fn list(v: &Vector3) -> String {
    v.iter().map(|x| significant(*x, 3)).collect::<Vec<_>>().join(", ")
}

fn displacement(twist: &Vector6, arm: &Vector3) -> Vector3 {
    let turn = Vector3::new(twist[3], twist[4], twist[5]);
    Vector3::new(twist[0], twist[1], twist[2]) + turn.cross(arm)
}

/// Base and platform end of every leg, fixed frame, m.
fn ends(at: &Condition) -> [[Vector3; 2]; 6] {
    std::array::from_fn(|leg| {
        let platform = at.place.translation + at.legs.arms[leg];
        [platform - at.legs.directions[leg] * at.legs.lengths[leg], platform]
    })
}

struct Bodies<'a> {
    at: &'a Condition,
    joints: [[Vector3; 2]; 6],
    factor: f64,
}

impl Bodies<'_> {
    /// Base ring, platform ring and legs.
    fn unloaded(&self) -> Vec<Edge> {
        unloaded(&self.joints)
    }

    /// Platform ring moved by a twist.
    fn moved(&self, twist: &Vector6) -> Vec<Edge> {
        let moved =
            |leg: usize| self.joints[leg][1] + displacement(twist, &self.at.legs.arms[leg]) * self.factor;
        ring(&std::array::from_fn(moved), &around(&self.joints.each_ref().map(|j| j[1])))
    }
}

/// Base ring, platform ring and legs between these joints.
pub(super) fn unloaded(joints: &[[Vector3; 2]; 6]) -> Vec<Edge> {
    let [base, platform] = [0, 1].map(|end| joints.each_ref().map(|j| j[end]));
    let rings = [base, platform].map(|joints| ring(&joints, &around(&joints)));
    rings.into_iter().flatten().chain(joints.iter().map(|[a, b]| edge(a, b))).collect()
}

/// Legs in the order of the angle of their joints about their mean.
fn around(joints: &[Vector3; 6]) -> [usize; 6] {
    let mean = joints.iter().sum::<Vector3>() / 6.0;
    let angle = |leg: usize| (joints[leg].y - mean.y).atan2(joints[leg].x - mean.x);
    let mut order = [0, 1, 2, 3, 4, 5];
    order.sort_by(|a, b| angle(*a).total_cmp(&angle(*b)));
    order
}

fn ring(joints: &[Vector3; 6], order: &[usize; 6]) -> Vec<Edge> {
    (0..6).map(|k| edge(&joints[order[k]], &joints[order[(k + 1) % 6]])).collect()
}

fn edge(a: &Vector3, b: &Vector3) -> Edge {
    [(*a).into(), (*b).into()]
}
