//! SDF: links that stand in the frame of their model, joints that may close loops.

use nalgebra::Isometry3;
use roxmltree::Node;

use super::super::error::Fault;
use super::xml::{child, direction, fault, numbers, pose, text};
use super::{Joint, Kind, Robot, whole};
use crate::Vector3;

/// Name of what stands still.
const WORLD: &str = "world";

pub(super) fn read(root: Node<'_, '_>) -> Result<Robot, Fault> {
    let slides = |model: &Node<'_, '_>| joints(*model).filter(|j| is(*j, "prismatic")).count();
    let model = root.descendants().filter(|n| n.has_tag_name("model")).max_by_key(slides);
    let Some(model) = model else {
        return Err(whole(
            "the file holds no model",
            "Give the SDF file of the model, not of a world that includes it.",
        ));
    };
    let version: f64 = root.attribute("version").and_then(|v| v.parse().ok()).unwrap_or(1.5);
    let mut robot = Robot { name: model.attribute("name").unwrap_or("robot").to_owned(), ..Robot::default() };
    robot.body(WORLD, Isometry3::identity());
    for link in model.children().filter(|c| c.has_tag_name("link") || c.has_tag_name("frame")) {
        let frame = placed(&robot, link, Isometry3::identity())?;
        robot.body(link.attribute("name").unwrap_or_default(), frame);
    }
    for joint in joints(model) {
        if let Some(joint) = read_joint(&robot, joint, version)? {
            robot.joints.push(joint);
        }
    }
    Ok(robot)
}

fn joints<'a, 'i>(model: Node<'a, 'i>) -> impl Iterator<Item = Node<'a, 'i>> {
    model.children().filter(|c| c.has_tag_name("joint"))
}

fn is(joint: Node<'_, '_>, kind: &str) -> bool {
    joint.attribute("type").is_some_and(|own| own.trim() == kind)
}

/// Where an element stands: its pose in the frame it names, else in `usual`.
fn placed(robot: &Robot, node: Node<'_, '_>, usual: Isometry3<f64>) -> Result<Isometry3<f64>, Fault> {
    let attached = node.attribute("attached_to").filter(|name| !name.is_empty());
    let Some(stated) = child(node, "pose") else {
        return attached.map_or(Ok(usual), |name| frame_named(robot, node, name));
    };
    let of = stated.attribute("relative_to").filter(|name| !name.is_empty()).or(attached);
    let base = of.map_or(Ok(usual), |name| frame_named(robot, node, name))?;
    Ok(base * pose(numbers(stated, stated.text().unwrap_or("0 0 0 0 0 0"))?))
}

fn frame_named(robot: &Robot, node: Node<'_, '_>, name: &str) -> Result<Isometry3<f64>, Fault> {
    match name {
        "__model__" => Ok(Isometry3::identity()),
        _ => robot.named(name).map(|body| robot.bodies[body].frame).ok_or_else(|| {
            fault(
                node,
                format!("{name} is no link or frame that stands before this one"),
                "Name a link or a frame that comes earlier in the file.",
            )
        }),
    }
}

fn read_joint(robot: &Robot, joint: Node<'_, '_>, version: f64) -> Result<Option<Joint>, Fault> {
    let kind = match joint.attribute("type").map(str::trim) {
        Some("fixed") => Kind::Fixed,
        Some("revolute" | "continuous" | "universal" | "ball" | "revolute2" | "screw") => Kind::Turning,
        Some("prismatic") => Kind::Sliding,
        _ => return Ok(None),
    };
    let ends = [end(robot, joint, "parent")?, end(robot, joint, "child")?];
    let child_frame = robot.bodies[ends[1]].frame;
    let frame = placed(robot, joint, child_frame)?;
    let mut axes = Vec::new();
    for axis in joint.children().filter(|c| c.has_tag_name("axis") || c.has_tag_name("axis2")) {
        if kind != Kind::Fixed {
            axes.push(axis_of(robot, axis, &frame, version)?);
        }
    }
    let name = joint.attribute("name").unwrap_or_default().to_owned();
    Ok(Some(Joint { name, kind, ends, at: frame.translation.vector, axes }))
}

/// An axis in the world. Before version 1.5, and where the file says so, it is stated in the frame of the model.
fn axis_of(
    robot: &Robot,
    axis: Node<'_, '_>,
    joint: &Isometry3<f64>,
    version: f64,
) -> Result<Vector3, Fault> {
    let stated = direction(axis, text(axis, "xyz").unwrap_or("0 0 1"))?;
    let in_model = text(axis, "use_parent_model_frame").is_some_and(|told| told == "true" || told == "1");
    if version < 1.5 || in_model {
        return Ok(stated);
    }
    let expressed =
        child(axis, "xyz").and_then(|xyz| xyz.attribute("expressed_in")).filter(|n| !n.is_empty());
    let frame = expressed.map_or(Ok(*joint), |name| frame_named(robot, axis, name))?;
    Ok(frame.rotation * stated)
}

fn end(robot: &Robot, joint: Node<'_, '_>, which: &str) -> Result<usize, Fault> {
    text(joint, which).and_then(|link| robot.named(link)).ok_or_else(|| {
        fault(
            joint,
            format!("the {which} of this joint is no link of the model"),
            "Correct the name of the link.",
        )
    })
}
