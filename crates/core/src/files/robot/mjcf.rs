//! MJCF: bodies within bodies, joints that stand in the body they move, loops closed by equalities.

use std::collections::HashMap;

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, Unit, UnitQuaternion};
use roxmltree::Node;

use super::super::error::Fault;
use super::xml::{child, direction, fault, numbers};
use super::{Joint, Kind, Robot};
use crate::Vector3;

/// Bodies within bodies; a leg needs five.
const DEEPEST: usize = 200;

pub(super) fn read(root: Node<'_, '_>) -> Result<Robot, Fault> {
    let compiler = child(root, "compiler");
    let setting = |name| compiler.and_then(|c| c.attribute(name));
    let mut reader = Reader {
        robot: Robot { name: root.attribute("model").unwrap_or("robot").to_owned(), ..Robot::default() },
        sites: HashMap::new(),
        angle: if setting("angle") == Some("radian") { 1.0 } else { 1.0_f64.to_radians() },
        sequence: setting("eulerseq").unwrap_or("xyz").to_owned(),
        defaults: child(root, "default"),
    };
    let world = reader.robot.body("world", Isometry3::identity());
    for body in root.children().filter(|c| c.has_tag_name("worldbody")) {
        reader.inside(body, world, Isometry3::identity(), None)?;
    }
    for equality in root.children().filter(|c| c.has_tag_name("equality")).flat_map(|e| e.children()) {
        reader.closure(equality)?;
    }
    Ok(reader.robot)
}

struct Reader<'a, 'i> {
    robot: Robot,
    /// Body and place in the world.
    sites: HashMap<String, (usize, Vector3)>,
    /// rad in the unit of angles.
    angle: f64,
    /// Order of Euler angles; small letters turn about moving axes, capitals about fixed ones.
    sequence: String,
    defaults: Option<Node<'a, 'i>>,
}

impl<'a, 'i> Reader<'a, 'i> {
    /// Bodies and sites in a body, or in a frame of it.
    fn inside(
        &mut self,
        node: Node<'a, 'i>,
        body: usize,
        frame: Isometry3<f64>,
        class: Option<&'a str>,
    ) -> Result<(), Fault> {
        if node.ancestors().nth(DEEPEST).is_some() {
            return Err(fault(
                node,
                format!("bodies stand in each other {DEEPEST} deep"),
                "Give the model of a hexapod alone.",
            ));
        }
        let class = node.attribute("childclass").or(class);
        for part in node.children().filter(Node::is_element) {
            match part.tag_name().name() {
                "body" => self.body(part, body, &frame, class)?,
                "frame" => {
                    let frame = frame * self.placed(part)?;
                    self.inside(part, body, frame, class)?;
                }
                "site" => {
                    let at = frame * self.placed(part)?;
                    if let Some(name) = part.attribute("name") {
                        self.sites.insert(name.to_owned(), (body, at.translation.vector));
                    }
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn body(
        &mut self,
        node: Node<'a, 'i>,
        parent: usize,
        frame: &Isometry3<f64>,
        class: Option<&'a str>,
    ) -> Result<(), Fault> {
        let frame = frame * self.placed(node)?;
        let class_inside = node.attribute("childclass").or(class);
        let joints: Vec<_> = node.children().filter(|c| c.has_tag_name("joint")).collect();
        let free = |joint: &Node<'_, '_>| self.setting(*joint, class_inside, "type") == Some("free");
        let is_free = child(node, "freejoint").is_some() || joints.iter().any(free);
        let mut last = parent;
        for (k, joint) in joints.iter().enumerate() {
            // Several joints of a body act one after the other: nothing is between them.
            let name = if k + 1 == joints.len() { node.attribute("name").unwrap_or_default() } else { "" };
            let next = self.robot.body(name, frame);
            if !is_free {
                let joint = self.joint(*joint, class_inside, &frame, [last, next])?;
                self.robot.joints.push(joint);
            }
            last = next;
        }
        if joints.is_empty() {
            last = self.robot.body(node.attribute("name").unwrap_or_default(), frame);
            if !is_free {
                self.robot.fix([parent, last]);
            }
        }
        self.inside(node, last, frame, class)
    }

    fn joint(
        &self,
        node: Node<'a, 'i>,
        class: Option<&str>,
        frame: &Isometry3<f64>,
        ends: [usize; 2],
    ) -> Result<Joint, Fault> {
        let setting = |name| self.setting(node, class, name);
        let at = Vector3::from(numbers::<3>(node, setting("pos").unwrap_or("0 0 0"))?);
        let axis = direction(node, setting("axis").unwrap_or("0 0 1"))?;
        let (kind, axes) = match setting("type") {
            Some("slide") => (Kind::Sliding, vec![frame.rotation * axis]),
            Some("ball") => (Kind::Turning, Vec::new()),
            _ => (Kind::Turning, vec![frame.rotation * axis]),
        };
        let name = node.attribute("name").unwrap_or_default().to_owned();
        Ok(Joint { name, kind, ends, at: frame.translation.vector + frame.rotation * at, axes })
    }

    /// What an element says, else the nearest of its defaults.
    fn setting(&self, node: Node<'a, 'i>, class: Option<&str>, name: &str) -> Option<&'a str> {
        let class = node.attribute("class").or(class);
        let of_class = |class: &str| {
            let mut all = self.defaults?.descendants();
            all.find(|d| d.has_tag_name("default") && d.attribute("class") == Some(class))
        };
        let nearest = class.and_then(of_class).or(self.defaults);
        let chain = nearest.into_iter().flat_map(|default| default.ancestors());
        let told =
            |default: Node<'a, 'i>| child(default, node.tag_name().name()).and_then(|d| d.attribute(name));
        node.attribute(name).or_else(|| chain.filter(|d| d.has_tag_name("default")).find_map(told))
    }

    /// The frame of an element in the one around it.
    fn placed(&self, node: Node<'_, '_>) -> Result<Isometry3<f64>, Fault> {
        let [x, y, z] = numbers::<3>(node, node.attribute("pos").unwrap_or("0 0 0"))?;
        Ok(Isometry3::from_parts(Translation3::new(x, y, z), self.turned(node)?))
    }

    fn turned(&self, node: Node<'_, '_>) -> Result<UnitQuaternion<f64>, Fault> {
        if let Some(quaternion) = node.attribute("quat") {
            let [w, x, y, z] = numbers::<4>(node, quaternion)?;
            return Ok(UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z)));
        }
        if let Some(stated) = node.attribute("axisangle") {
            let [x, y, z, angle] = numbers::<4>(node, stated)?;
            let axis = Unit::new_normalize(Vector3::new(x, y, z));
            return Ok(UnitQuaternion::from_axis_angle(&axis, angle * self.angle));
        }
        if let Some(stated) = node.attribute("euler") {
            return self.euler(node, numbers(node, stated)?);
        }
        if let Some(stated) = node.attribute("xyaxes") {
            let [a, b, c, d, e, f] = numbers::<6>(node, stated)?;
            let x = Vector3::new(a, b, c).normalize();
            let across = Vector3::new(d, e, f);
            let y = (across - x * across.dot(&x)).normalize();
            let axes = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, x.cross(&y)]));
            return Ok(UnitQuaternion::from_rotation_matrix(&axes));
        }
        if let Some(stated) = node.attribute("zaxis") {
            let up = Vector3::from(numbers::<3>(node, stated)?);
            let half_turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
            return Ok(UnitQuaternion::rotation_between(&Vector3::z(), &up).unwrap_or(half_turn));
        }
        Ok(UnitQuaternion::identity())
    }

    fn euler(&self, node: Node<'_, '_>, angles: [f64; 3]) -> Result<UnitQuaternion<f64>, Fault> {
        let mut turn = UnitQuaternion::identity();
        for (letter, angle) in self.sequence.chars().zip(angles) {
            let axis = match letter.to_ascii_lowercase() {
                'x' => Vector3::x_axis(),
                'y' => Vector3::y_axis(),
                'z' => Vector3::z_axis(),
                _ => return Err(fault(node, "eulerseq is made of x, y, z", "Correct it in <compiler>.")),
            };
            let one = UnitQuaternion::from_axis_angle(&axis, angle * self.angle);
            turn = if letter.is_ascii_lowercase() { turn * one } else { one * turn };
        }
        Ok(turn)
    }

    /// An equality that holds two bodies together: by a point, or altogether.
    fn closure(&mut self, node: Node<'_, '_>) -> Result<(), Fault> {
        let is_weld = node.has_tag_name("weld");
        if !is_weld && !node.has_tag_name("connect") {
            return Ok(());
        }
        let unknown = || {
            fault(
                node,
                "one of the two ends of this equality is not in the model",
                "Correct the names of its ends.",
            )
        };
        let site = |name| node.attribute(name).and_then(|site| self.sites.get(site)).copied();
        let (ends, at) = if let (Some((one, at)), Some((other, _))) = (site("site1"), site("site2")) {
            ([one, other], at)
        } else {
            let named = |name: Option<&str>| name.map_or(Some(0), |n| self.robot.named(n));
            let one = node.attribute("body1").and_then(|n| self.robot.named(n)).ok_or_else(unknown)?;
            let other = named(node.attribute("body2")).ok_or_else(unknown)?;
            let [x, y, z] = numbers::<3>(node, node.attribute("anchor").unwrap_or("0 0 0"))?;
            let at = self.robot.bodies[one].frame * nalgebra::Point3::new(x, y, z);
            ([one, other], at.coords)
        };
        let kind = if is_weld { Kind::Fixed } else { Kind::Turning };
        self.robot.joints.push(Joint { name: String::new(), kind, ends, at, axes: Vec::new() });
        Ok(())
    }
}
