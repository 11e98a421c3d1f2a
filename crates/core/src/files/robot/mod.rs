//! The joints of a hexapod from a model of a robot simulator: MJCF, URDF or SDF.
//!
//! A model is read as bodies at given positions with joints between them. [`legs`] then finds the hexapod in it: six sliding joints
//! between two bodies. The pose of the model becomes the zero pose.

mod legs;
mod mjcf;
mod sdf;
mod urdf;
mod xml;

use nalgebra::Isometry3;
use roxmltree::Document;
use std::path::Path;

use super::error::Fault;
use super::toml_file::read_text;
use super::{FileError, FilePlace};
use crate::Vector3;
pub use legs::MobileFrame;

/// A hexapod found in a model.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotJoints {
    /// Name of the model.
    pub name: String,
    /// `A_i`: base joints, fixed frame, m.
    pub base_joints: [Vector3; 6],
    /// `B_i`: platform joints, mobile frame, which coincides with the fixed one; m.
    pub platform_joints: [Vector3; 6],
    /// Names of the sliding joints of legs 1 to 6.
    pub legs: [String; 6],
    /// What the mobile frame is in the model.
    pub mobile: MobileFrame,
    /// Largest distance by which the axes of one joint miss their common point, m.
    pub miss: f64,
}

/// Reads the joints of a hexapod from an MJCF, URDF or SDF file; the name of the top element tells which.
///
/// A joint of several axes lies where its axes meet. Legs have the order of the numbers in the names of their sliding joints, else that
/// of the file.
///
/// # Errors
/// Text that is not XML; another format; a model in which no six sliding joints connect a base and a platform; with line and next step.
pub fn read_robot(path: &Path) -> Result<RobotJoints, FileError> {
    parse_robot(&read_text(path)?, path)
}

/// The same from text; `name` stands for the file in messages.
///
/// # Errors
/// As [`read_robot`].
pub fn parse_robot(text: &str, name: &Path) -> Result<RobotJoints, FileError> {
    joints(text).map_err(|fault| fault.in_file(name))
}

fn joints(text: &str) -> Result<RobotJoints, Fault> {
    let text = xml::without_declaration(text);
    let document = Document::parse(&text).map_err(|wrong| xml::fault_of(&wrong))?;
    let root = document.root_element();
    let robot = match root.tag_name().name() {
        "mujoco" => mjcf::read(root)?,
        "robot" => urdf::read(root)?,
        "sdf" | "gazebo" => sdf::read(root)?,
        other => {
            return Err(whole(
                format!("the file begins with <{other}>, which is no robot model known here"),
                "Give an MJCF (<mujoco>), URDF (<robot>) or SDF (<sdf>) file; expand xacro and templates first.",
            ));
        }
    };
    legs::find(&robot)
}

/// A fault of a whole file.
fn whole(rule: impl Into<String>, next: &str) -> Fault {
    Fault::rule(FilePlace::file(), rule, next)
}

/// Bodies and joints of a model, in the pose in which it stands.
#[derive(Debug, Default)]
struct Robot {
    name: String,
    bodies: Vec<Body>,
    joints: Vec<Joint>,
}

#[derive(Debug)]
struct Body {
    name: String,
    /// Body to world.
    frame: Isometry3<f64>,
}

#[derive(Debug)]
struct Joint {
    name: String,
    kind: Kind,
    /// Parent and child, places in the list of bodies.
    ends: [usize; 2],
    /// A point on every axis, world, m.
    at: Vector3,
    /// Unit vectors, world; none of a ball joint.
    axes: Vec<Vector3>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Fixed,
    Turning,
    Sliding,
}

impl Robot {
    /// Adds a body; returns its place.
    fn body(&mut self, name: &str, frame: Isometry3<f64>) -> usize {
        self.bodies.push(Body { name: name.to_owned(), frame });
        self.bodies.len() - 1
    }

    /// The place of a body.
    fn named(&self, name: &str) -> Option<usize> {
        self.bodies.iter().position(|body| body.name == name)
    }

    fn fix(&mut self, ends: [usize; 2]) {
        let joint =
            Joint { name: String::new(), kind: Kind::Fixed, ends, at: Vector3::zeros(), axes: Vec::new() };
        self.joints.push(joint);
    }
}
