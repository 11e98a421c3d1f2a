//! URDF: a tree of links. A closed loop does not fit into it, so legs usually end open, and the platform hangs on one of them.

use nalgebra::Isometry3;
use roxmltree::Node;

use super::super::error::Fault;
use super::xml::{child, direction, fault, numbers, pose};
use super::{Joint, Kind, Robot, whole};

pub(super) fn read(root: Node<'_, '_>) -> Result<Robot, Fault> {
    let mut robot = Robot { name: root.attribute("name").unwrap_or("robot").to_owned(), ..Robot::default() };
    for link in root.children().filter(|c| c.has_tag_name("link")) {
        robot.body(link.attribute("name").unwrap_or_default(), Isometry3::identity());
    }
    let mut joints = Vec::new();
    for joint in root.children().filter(|c| c.has_tag_name("joint")) {
        let ends = [end(&robot, joint, "parent")?, end(&robot, joint, "child")?];
        joints.push((joint, ends, origin(joint)?));
    }
    place(&mut robot, &joints)?;
    for (joint, ends, _) in joints {
        let Some(kind) = kind(joint)? else { continue };
        let frame = robot.bodies[ends[1]].frame;
        let axis = child(joint, "axis").and_then(|axis| axis.attribute("xyz")).unwrap_or("1 0 0");
        let is_ball = joint.attribute("type") == Some("spherical");
        let axes = if kind == Kind::Fixed || is_ball {
            Vec::new()
        } else {
            vec![frame.rotation * direction(joint, axis)?]
        };
        let name = joint.attribute("name").unwrap_or_default().to_owned();
        robot.joints.push(Joint { name, kind, ends, at: frame.translation.vector, axes });
    }
    Ok(robot)
}

fn end(robot: &Robot, joint: Node<'_, '_>, which: &str) -> Result<usize, Fault> {
    let link = child(joint, which).and_then(|end| end.attribute("link"));
    link.and_then(|link| robot.named(link)).ok_or_else(|| {
        fault(
            joint,
            format!("the {which} of this joint is no link of the file"),
            "Correct the name of the link.",
        )
    })
}

/// Joint frame in that of its parent.
fn origin(joint: Node<'_, '_>) -> Result<Isometry3<f64>, Fault> {
    let Some(origin) = child(joint, "origin") else { return Ok(Isometry3::identity()) };
    let three = |name| numbers::<3>(origin, origin.attribute(name).unwrap_or("0 0 0"));
    let ([x, y, z], [roll, pitch, yaw]) = (three("xyz")?, three("rpy")?);
    Ok(pose([x, y, z, roll, pitch, yaw]))
}

/// Puts every link where its joint says, from the roots outward.
fn place(robot: &mut Robot, joints: &[(Node<'_, '_>, [usize; 2], Isometry3<f64>)]) -> Result<(), Fault> {
    let count = robot.bodies.len();
    let is_child = |body: usize| joints.iter().any(|(_, [_, child], _)| *child == body);
    let mut placed: Vec<usize> = (0..count).filter(|&body| !is_child(body)).collect();
    let mut next = 0;
    while next < placed.len() && placed.len() <= count {
        let parent = placed[next];
        next += 1;
        for (_, ends, origin) in joints.iter().filter(|(_, ends, _)| ends[0] == parent) {
            robot.bodies[ends[1]].frame = robot.bodies[parent].frame * origin;
            placed.push(ends[1]);
        }
    }
    if placed.len() == count {
        return Ok(());
    }
    Err(whole("the links make no tree", "Give every link but the base exactly one parent joint."))
}

fn kind(joint: Node<'_, '_>) -> Result<Option<Kind>, Fault> {
    match joint.attribute("type") {
        Some("fixed") => Ok(Some(Kind::Fixed)),
        Some("revolute" | "continuous" | "spherical") => Ok(Some(Kind::Turning)),
        Some("prismatic") => Ok(Some(Kind::Sliding)),
        Some("floating") => Ok(None),
        other => Err(fault(
            joint,
            format!("a joint of type {:?} is not known here", other.unwrap_or_default()),
            "Joints of legs are revolute, continuous, spherical, prismatic or fixed.",
        )),
    }
}
