//! Files about a machine and what may be done with it.

use std::path::Path;

use hexbench_core::Hexapod;
use hexbench_core::files::{hexapod_to_toml, parse_hexapod, parse_robot, read_ball_places};
use hexbench_design::sensors::read_candidates;
use hexbench_design::space_file::read_space;

use super::simulations::HEXAPOD;
use crate::scratch;

/// The machine of a bundled scene.
pub(super) fn bundled() -> Hexapod {
    parse_hexapod(HEXAPOD, "hexapod.toml").expect("a machine of this program")
}

/// What is read is written as the same machine, after units have been changed once.
pub(super) fn hexapod(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    let Ok(read) = parse_hexapod(text, "hexapod.toml") else { return false };
    let written = hexapod_to_toml(&read);
    let again = parse_hexapod(&written, "again.toml").unwrap_or_else(|e| panic!("{e:?}\n{written}"));
    let near = |one: f64, other: f64| (one - other).abs() <= 1e-12 * one.abs().max(other.abs());
    let joints = |h: &Hexapod| [h.base_joints, h.platform_joints].concat();
    for (one, other) in joints(&read).iter().zip(joints(&again)) {
        assert!(one.iter().zip(&other).all(|(a, b)| near(*a, *b)), "{one:?} {other:?}");
    }
    assert_eq!(read.sensors.len(), again.sensors.len(), "{written}");
    true
}

pub(super) fn ball_places(bytes: &[u8]) -> bool {
    scratch::file("balls.toml", bytes, read_ball_places).is_ok()
}

pub(super) fn sensors(bytes: &[u8]) -> bool {
    scratch::file("sensors.toml", bytes, read_candidates).is_ok()
}

pub(super) fn space(bytes: &[u8]) -> bool {
    let hexapod = bundled();
    scratch::file("space.toml", bytes, |path: &Path| read_space(path, &hexapod)).is_ok()
}

/// Models for robot simulators; what is found is a machine that can be written down.
pub(super) fn robot(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    let Ok(found) = parse_robot(text, "robot.xml".as_ref()) else { return false };
    let mut joints = found.base_joints.iter().chain(&found.platform_joints);
    assert!(joints.all(|joint| joint.iter().all(|x| x.is_finite())), "{found:?}");
    assert!(found.miss.is_finite(), "{}", found.miss);
    true
}
