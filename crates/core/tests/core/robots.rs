//! Models of robot simulators: one machine in three formats, and what no machine is.

use std::fs;
use std::path::Path;

use hexbench_core::Vector3;
use hexbench_core::files::parse_robot;
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion};

/// Models have six digits, m.
const DIGITS: f64 = 1e-6;

fn model(file: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus/robot");
    fs::read_to_string(folder.join(file)).unwrap()
}

/// Joints on a circle: radius and height in m.
fn ring(radius: f64, degrees: [f64; 6], z: f64) -> [Vector3; 6] {
    degrees.map(|d| {
        let (sine, cosine) = d.to_radians().sin_cos();
        Vector3::new(radius * cosine, radius * sine, z)
    })
}

#[test]
fn one_machine_has_the_same_joints_in_three_formats() {
    let base = ring(0.16, [-10.0, 10.0, 110.0, 130.0, 230.0, 250.0], -0.165);
    let platform = ring(0.12, [-50.0, 50.0, 70.0, 170.0, 190.0, 290.0], 0.0);
    // In one of them the platform stands elsewhere; the mobile frame is where it stands.
    let turned = UnitQuaternion::from_euler_angles(0.1, 0.0, 0.2);
    let elsewhere = Isometry3::from_parts(Translation3::new(0.0, 0.0, 0.1), turned);
    for (file, at) in [
        ("export.xml", Isometry3::identity()),
        ("rings.urdf", Isometry3::identity()),
        ("rings.sdf", elsewhere),
    ] {
        let found = parse_robot(&model(file), file.as_ref()).unwrap();
        for leg in 0..6 {
            let expected = at.inverse_transform_point(&Point3::from(base[leg])).coords;
            assert!((found.base_joints[leg] - expected).amax() < DIGITS, "{file} {leg}: {found:?}");
            assert!((found.platform_joints[leg] - platform[leg]).amax() < DIGITS, "{file} {leg}: {found:?}");
            assert!(found.legs[leg].contains(char::from(b'1' + u8::try_from(leg).unwrap())), "{found:?}");
        }
        assert!(found.miss < DIGITS, "{file}: {}", found.miss);
    }
}

#[test]
fn positions_that_no_machine_has_and_legs_that_are_missing_are_refused() {
    let sdf = model("rings.sdf");
    for (from, to, told) in [
        ("0.0771345 0.0919253 0 0 0 0", "0.0771345 0.0919253 -1e308 0 0 0", "too large"),
        ("0.0771345 0.0919253 0 0 0 0", "0.0771345 0.0919253 nan 0 0 0", "is not 6 numbers"),
        ("name=\"s6\" type=\"prismatic\"", "name=\"s6\" type=\"ball\"", "no six sliding joints"),
    ] {
        assert!(sdf.contains(from), "{from}");
        let refused = parse_robot(&sdf.replacen(from, to, 1), "rings.sdf".as_ref()).unwrap_err();
        assert!(refused.to_string().contains(told), "{refused}");
    }
}
