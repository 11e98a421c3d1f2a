//! `init --robot`: machines from models for robot simulators.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Output;

use hexbench_core::files::read_hexapod;
use hexbench_core::{Hexapod, JointCircle, Pose, Vector3};

use crate::support::{complaint, hexbench, root, text};

/// Joints agree to what six decimals of a meter leave.
const ROUNDING_M: f64 = 1e-9;

fn machine() -> Hexapod {
    let base = JointCircle::base_pairs(0.16, 0.35).joints(-0.165);
    Hexapod::of_joints("rings", base, JointCircle::platform_pairs(0.12, 0.5).joints(0.0))
}

fn init(folder: &Path, model: &str) -> Output {
    hexbench().current_dir(folder).args(["init", "--robot", model, "-o", "hexapod.toml"]).output().unwrap()
}

fn made(folder: &Path, name: &str, model: &str) -> Hexapod {
    fs::write(folder.join(name), model).unwrap();
    let _ = fs::remove_file(folder.join("hexapod.toml"));
    text(init(folder, name));
    read_hexapod(&folder.join("hexapod.toml")).unwrap()
}

fn refused(model: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("m.xml"), model).unwrap();
    let output = init(folder.path(), "m.xml");
    assert_eq!(output.status.code(), Some(3));
    assert!(!folder.path().join("hexapod.toml").exists());
    complaint(&output)
}

fn assert_same(made: &Hexapod, expected: &Hexapod, what: &str) {
    let pairs = made.base_joints.iter().zip(&expected.base_joints);
    let pairs = pairs.chain(made.platform_joints.iter().zip(&expected.platform_joints));
    let off = pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    assert!(off < ROUNDING_M, "{what}: {off}");
}

fn words(v: &Vector3) -> String {
    format!("{} {} {}", v.x, v.y, v.z)
}

/// Legs with universal joints at both ends; nothing closes them but the eye, as URDF has it.
fn urdf(machine: &Hexapod) -> String {
    let mut links = String::from("<link name=\"base\"/>\n<link name=\"top\"/>\n");
    let mut joints = String::new();
    let mut joint = |name: String, kind: &str, [parent, child]: [&str; 2], at: &Vector3, axis: &Vector3| {
        let _ = writeln!(
            joints,
            "<joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>\
             <origin xyz=\"{}\" rpy=\"0 0 0\"/><axis xyz=\"{}\"/></joint>",
            words(at),
            words(axis)
        );
    };
    let none = Vector3::zeros();
    // The last leg first: the numbers in the names tell the order.
    for leg in (0..6).rev() {
        let n = leg + 1;
        let along = machine.platform_joints[leg] - machine.base_joints[leg];
        let [foot, cylinder, rod, fork, end] =
            ["foot", "cylinder", "rod", "fork", "end"].map(|part| format!("{part}{n}"));
        for link in [&foot, &cylinder, &rod, &fork, &end] {
            let _ = writeln!(links, "<link name=\"{link}\"/>");
        }
        joint(format!("a{n}"), "revolute", ["base", &foot], &machine.base_joints[leg], &Vector3::x());
        joint(format!("b{n}"), "revolute", [&foot, &cylinder], &none, &Vector3::y());
        joint(format!("slide{n}"), "prismatic", [&cylinder, &rod], &(0.4 * along), &along);
        joint(format!("c{n}"), "continuous", [&rod, &fork], &(0.6 * along), &Vector3::y());
        // This joint stands off the point in which the axes meet.
        joint(format!("d{n}"), "revolute", [&fork, &end], &(0.02 * Vector3::x()), &Vector3::x());
    }
    joint("plate".into(), "fixed", ["end1", "top"], &none, &none);
    format!("<?xml version=\"1.0\"?>\n<robot name=\"rings\">\n{links}{joints}</robot>\n")
}

/// Legs between ball joints, closed, in a model whose platform is turned and shifted as `pose` says.
fn sdf(machine: &Hexapod, pose: &Pose) -> String {
    let mut text = String::from("<sdf version=\"1.9\"><model name=\"rings\"><link name=\"base\"/>\n");
    let [a, b, c, alpha, beta, gamma] = pose.to_array();
    let _ = writeln!(text, "<link name=\"top\"><pose>{a} {b} {c} {alpha} {beta} {gamma}</pose></link>");
    for leg in 0..6 {
        let foot = pose.translation + pose.rotation() * machine.base_joints[leg];
        let n = leg + 1;
        let _ = writeln!(text, "<link name=\"low{n}\"><pose>{} 0 0 0</pose></link>", words(&foot));
        let _ = writeln!(
            text,
            "<link name=\"high{n}\"><pose relative_to=\"top\">{} 0 0 0</pose></link>",
            words(&machine.platform_joints[leg])
        );
    }
    for n in 1..=6 {
        for [kind, parent, child] in
            [["ball", "base", "low"], ["prismatic", "low", "high"], ["ball", "top", "high"]]
        {
            let parent = if kind == "prismatic" { format!("{parent}{n}") } else { parent.to_owned() };
            let _ = writeln!(
                text,
                "<joint name=\"{kind}{n}{child}\" type=\"{kind}\"><parent>{parent}</parent><child>{child}{n}</child></joint>"
            );
        }
    }
    text + "</model></sdf>\n"
}

#[test]
fn the_export_of_a_scene_at_its_zero_pose_is_its_machine_again() {
    let mut count = 0;
    for scene in fs::read_dir(root().join("scenes")).unwrap().map(|entry| entry.unwrap().path()) {
        if !scene.join("scene.toml").is_file() {
            continue;
        }
        let folder = tempfile::tempdir().unwrap();
        let zero = ["--mjcf", "--pose", "0,0,0,0,0,0"];
        let export = hexbench().arg("export").arg(&scene).args(zero).output().unwrap();
        if !export.status.success() {
            continue;
        }
        let model = String::from_utf8(export.stdout).unwrap();
        let expected = read_hexapod(&scene.join("hexapod.toml")).unwrap();
        assert_same(&made(folder.path(), "m.xml", &model), &expected, &scene.display().to_string());
        count += 1;
    }
    assert!(count >= 8, "{count}");
}

#[test]
fn legs_of_a_urdf_end_where_their_axes_meet() {
    let folder = tempfile::tempdir().unwrap();
    assert_same(&made(folder.path(), "m.urdf", &urdf(&machine())), &machine(), "urdf");
}

#[test]
fn a_model_that_stands_tilted_has_its_zero_pose_there() {
    let folder = tempfile::tempdir().unwrap();
    let pose = Pose::from_array([0.01, -0.02, 0.4, 0.1, -0.2, 0.3]);
    assert_same(&made(folder.path(), "m.sdf", &sdf(&machine(), &pose)), &machine(), "sdf");
}

#[test]
fn what_was_taken_for_what_is_told() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("m.urdf"), urdf(&machine())).unwrap();
    let output = init(folder.path(), "m.urdf");
    let said = complaint(&output);
    for part in ["slide1, slide2, slide3, slide4, slide5, slide6", "center of the platform joints"] {
        assert!(said.contains(part), "{said}");
    }
}

#[test]
fn models_without_six_legs_and_files_that_are_no_models_are_refused() {
    let five = urdf(&machine()).replace("\"slide6\" type=\"prismatic\"", "\"slide6\" type=\"revolute\"");
    for (model, part) in [
        (five.as_str(), "no six sliding joints"),
        (
            "<robot name=\"x\">\n<joint name=\"j\" type=\"revolute\"><parent link=\"a\"/></joint></robot>",
            "line 2",
        ),
        ("<svg/>", "no robot model"),
        ("<robot name=\"x\"><link name=\"a\">\n</robot>", "this is not XML"),
        ("solid ascii stl", "this is not XML"),
    ] {
        let said = refused(model);
        assert!(said.contains(part) && said.contains("next:"), "{part}: {said}");
    }
}
