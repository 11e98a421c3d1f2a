//! The hexapod in a model: six sliding joints between two bodies.

use std::collections::BTreeMap;

use nalgebra::{Isometry3, Point3, Translation3};

use super::super::error::Fault;
use super::{Joint, Kind, Robot, RobotJoints, whole};
use crate::{Matrix3, Vector3};

/// What the mobile frame of a hexapod is in its model.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum MobileFrame {
    /// The frame of this body.
    Body(String),
    /// The center of the platform joints, axes of the model: no body holds them all, or each in a body of its own.
    Centre,
}

/// Directions nearer to each other than this do not say where their lines meet; also what a lone axis leaves open is held by so little.
const PARALLEL: f64 = 1e-9;

/// One leg: its sliding joint, and the bodies at its ends, by their groups.
#[derive(Debug, Clone)]
struct Leg {
    name: String,
    ends: [usize; 2],
}

/// Where the joint of a leg lies, and which body holds it.
struct Held {
    at: Vector3,
    miss: f64,
    body: Option<usize>,
}

pub(super) fn find(robot: &Robot) -> Result<RobotJoints, Fault> {
    let rigid = joined(robot, |joint| joint.kind == Kind::Fixed);
    let parts = joined(robot, |joint| joint.kind != Kind::Sliding);
    let legs = in_order(six(robot, &parts)?);
    let sides = [0, 1].map(|side| Side {
        robot,
        rigid: &rigid,
        parts: &parts,
        ends: legs.each_ref().map(|l| l.ends[side]),
    });
    let base = sides[0].joints().ok_or_else(|| unheld("base"))?;
    let platform = sides[1].joints().ok_or_else(|| unheld("platform"))?;
    let (mobile, frame) = mobile_frame(robot, &platform);
    let is_finite = |held: &Held| held.at.iter().all(|x| x.is_finite());
    if !base.iter().chain(&platform).all(is_finite) || !frame.to_homogeneous().iter().all(|x| x.is_finite()) {
        return Err(whole(
            "joints of the legs lie nowhere",
            "Look for an axis or a rotation of length zero.",
        ));
    }
    let local = |held: &Held| frame.inverse_transform_point(&Point3::from(held.at)).coords.map(cleaned);
    Ok(RobotJoints {
        name: robot.name.clone(),
        base_joints: base.each_ref().map(local),
        platform_joints: platform.each_ref().map(local),
        legs: legs.map(|leg| leg.name),
        miss: base.iter().chain(&platform).map(|held| held.miss).fold(0.0, f64::max),
        mobile,
    })
}

/// To a picometre: digits behind it are those of rounding.
fn cleaned(x: f64) -> f64 {
    (x * 1e12).round() / 1e12 + 0.0
}

fn unheld(side: &str) -> Fault {
    whole(
        format!("no body of the {side} holds all six legs by joints of their own"),
        "Join the legs to one body on each side, by ball, universal or revolute joints; weld parts together that do not move.",
    )
}

/// A number for each body, the same for bodies that joints of a kind hold together.
fn joined(robot: &Robot, holds: impl Fn(&Joint) -> bool) -> Vec<usize> {
    let mut group: Vec<usize> = (0..robot.bodies.len()).collect();
    for joint in robot.joints.iter().filter(|joint| holds(joint)) {
        let [from, to] = joint.ends.map(|end| group[end]);
        group.iter_mut().filter(|g| **g == from).for_each(|g| *g = to);
    }
    group
}

/// The six legs: chains of sliding joints between one part and another, or from one part to six that end open.
fn six(robot: &Robot, parts: &[usize]) -> Result<[Leg; 6], Fault> {
    let chains = chains(robot, parts);
    let mut between: BTreeMap<(usize, usize), Vec<Leg>> = BTreeMap::new();
    let mut from: BTreeMap<usize, Vec<Leg>> = BTreeMap::new();
    for leg in &chains {
        let [parent, child] = leg.ends.map(|end| parts[end]);
        between.entry((parent, child)).or_default().push(leg.clone());
        from.entry(parent).or_default().push(leg.clone());
    }
    let closed = between.into_values().find(|legs| legs.len() == 6);
    let open = || from.into_values().find(|legs| legs.len() == 6);
    closed.or_else(open).and_then(|legs| legs.try_into().ok()).ok_or_else(|| {
        whole(
            format!("no six sliding joints lead from one part of the model to another; it has {} in all", chains.len()),
            "A leg is a prismatic joint (slide) with turning joints at both ends. Legs of another kind (tendons, cranks) are not read: write the joints as a table, and give it with --joints.",
        )
    })
}

/// Sliding joints, those in a row taken as one: a part that only hangs between two of them is inside a leg.
fn chains(robot: &Robot, parts: &[usize]) -> Vec<Leg> {
    let sliding = robot.joints.iter().filter(|joint| joint.kind == Kind::Sliding);
    let mut legs: Vec<Leg> = sliding.map(|j| Leg { name: j.name.clone(), ends: j.ends }).collect();
    let inner = |legs: &[Leg]| {
        let at = |part: usize| {
            let touching =
                legs.iter().enumerate().filter(move |(_, l)| l.ends.iter().any(|e| parts[*e] == part));
            touching.map(|(k, _)| k).collect::<Vec<_>>()
        };
        legs.iter().find_map(|leg| match at(parts[leg.ends[1]])[..] {
            [one, other] => Some([one, other]),
            _ => None,
        })
    };
    while let Some([one, other]) = inner(&legs) {
        let second = legs.remove(one.max(other));
        let first = &mut legs[one.min(other)];
        if parts[first.ends[1]] == parts[second.ends[0]] {
            first.ends[1] = second.ends[1];
        } else {
            first.ends[0] = second.ends[0];
        }
    }
    legs
}

/// By the first numbers in the names where they differ, else as in the file.
fn in_order(mut legs: [Leg; 6]) -> [Leg; 6] {
    let number = |leg: &Leg| {
        let digits = leg.name.split(|c: char| !c.is_ascii_digit()).find(|run| !run.is_empty());
        digits.and_then(|run| run.parse::<u64>().ok())
    };
    let mut numbers: Vec<_> = legs.iter().filter_map(number).collect();
    numbers.sort_unstable();
    numbers.dedup();
    if numbers.len() == 6 {
        legs.sort_by_key(number);
    }
    legs
}

/// One end of all legs.
struct Side<'a> {
    robot: &'a Robot,
    rigid: &'a [usize],
    parts: &'a [usize],
    ends: [usize; 6],
}

impl Side<'_> {
    /// The joint of each leg at this side.
    fn joints(&self) -> Option<[Held; 6]> {
        let mut parts = self.ends.map(|end| self.parts[end]);
        parts.sort_unstable();
        if parts.windows(2).all(|pair| pair[0] != pair[1]) {
            return Some(self.ends.map(|end| self.open(end)));
        }
        let bodies = (0..self.robot.bodies.len()).filter(|&body| self.is_first(body));
        bodies.filter(|&body| self.parts[body] == parts[0]).find_map(|hub| self.held_by(hub))
    }

    /// The first body of those that are rigid with it stands for them.
    fn is_first(&self, body: usize) -> bool {
        self.rigid.iter().position(|group| *group == self.rigid[body]) == Some(body)
    }

    /// Where a leg that ends open has its last joint: all turning joints behind its slide.
    fn open(&self, end: usize) -> Held {
        let part = self.parts[end];
        let turning = self.turning().filter(|joint| self.parts[joint.ends[0]] == part);
        meeting(&turning.collect::<Vec<_>>(), None)
    }

    fn turning(&self) -> impl Iterator<Item = &Joint> {
        self.robot.joints.iter().filter(|joint| joint.kind == Kind::Turning)
    }

    /// The joints by which a body holds the legs, if each leg has its own way to it.
    fn held_by(&self, hub: usize) -> Option<[Held; 6]> {
        let ways = self.ends.map(|end| self.way(end, self.rigid[hub]));
        let mut last = Vec::new();
        for way in &ways {
            let group = way.as_ref()?.last()?.1;
            if last.contains(&group) {
                return None;
            }
            last.push(group);
        }
        Some(ways.map(|way| {
            let joints: Vec<&Joint> = way.iter().flatten().map(|step| step.0).collect();
            let body = joints.last().map(|last| {
                let [one, other] = last.ends;
                if self.rigid[one] == self.rigid[hub] { one } else { other }
            });
            meeting(&joints, body)
        }))
    }

    /// Turning joints from the end of a leg to a group, each with the group before it.
    fn way(&self, end: usize, hub: usize) -> Option<Vec<(&Joint, usize)>> {
        let mut known: BTreeMap<usize, Vec<(&Joint, usize)>> =
            BTreeMap::from([(self.rigid[end], Vec::new())]);
        let mut open = vec![self.rigid[end]];
        while let Some(group) = open.pop() {
            if group == hub {
                return known.remove(&hub).filter(|way| !way.is_empty());
            }
            for joint in self.turning() {
                let [one, other] = joint.ends.map(|end| self.rigid[end]);
                let next = if one == group { other } else { one };
                if (one == group || other == group) && !known.contains_key(&next) {
                    let way = known[&group].iter().copied().chain([(joint, group)]).collect();
                    known.insert(next, way);
                    open.push(next);
                }
            }
        }
        None
    }
}

/// The point nearest to all axes and ball joints, and how far the farthest is from it.
fn meeting(joints: &[&Joint], body: Option<usize>) -> Held {
    let mean = joints.iter().map(|joint| joint.at).sum::<Vector3>() / joints.len().max(1) as f64;
    let lines: Vec<(Vector3, Matrix3)> = joints
        .iter()
        .flat_map(|joint| {
            let across = |axis: &Vector3| Matrix3::identity() - axis * axis.transpose();
            let balls = joint.axes.is_empty().then(Matrix3::identity);
            joint.axes.iter().map(across).chain(balls).map(|across| (joint.at - mean, across))
        })
        .collect();
    let held = Matrix3::identity() * PARALLEL;
    let all = lines.iter().map(|(_, across)| across).sum::<Matrix3>() + held;
    let pull = lines.iter().map(|(at, across)| across * at).sum::<Vector3>();
    let at = all.try_inverse().map_or_else(Vector3::zeros, |inverse| inverse * pull);
    let miss = lines.iter().map(|(p, across)| (across * (at - p)).norm()).fold(0.0, f64::max);
    Held { at: mean + at, miss, body }
}

/// The frame of the body that holds all platform joints; else their center, with the axes of the model.
fn mobile_frame(robot: &Robot, platform: &[Held; 6]) -> (MobileFrame, Isometry3<f64>) {
    let shared = platform[0].body.filter(|body| platform.iter().all(|held| held.body == Some(*body)));
    if let Some(body) = shared {
        return (MobileFrame::Body(robot.bodies[body].name.clone()), robot.bodies[body].frame);
    }
    let centre = platform.iter().map(|held| held.at).sum::<Vector3>() / 6.0;
    let frame = Isometry3::from_parts(Translation3::from(centre), nalgebra::UnitQuaternion::identity());
    (MobileFrame::Centre, frame)
}
