//! `joint-geometry`: joints are not where the drawing says.
//!
//! With the joints the directions of the legs change, and with them the leg forces under the load: a rigid rotation of all
//! joints shows in no unloaded pose, but it turns the load against the legs, and the stiffnesses are as uncertain as it is.

use hexbench_core::{Vector3, Vector6};

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, Need, Rich, Scale, Term, TermInfo, each};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

const JOINTS: [&str; 36] = [
    "base-1-x",
    "base-1-y",
    "base-1-z",
    "base-2-x",
    "base-2-y",
    "base-2-z",
    "base-3-x",
    "base-3-y",
    "base-3-z",
    "base-4-x",
    "base-4-y",
    "base-4-z",
    "base-5-x",
    "base-5-y",
    "base-5-z",
    "base-6-x",
    "base-6-y",
    "base-6-z",
    "platform-1-x",
    "platform-1-y",
    "platform-1-z",
    "platform-2-x",
    "platform-2-y",
    "platform-2-z",
    "platform-3-x",
    "platform-3-y",
    "platform-3-z",
    "platform-4-x",
    "platform-4-y",
    "platform-4-z",
    "platform-5-x",
    "platform-5-y",
    "platform-5-z",
    "platform-6-x",
    "platform-6-y",
    "platform-6-z",
];

pub(super) struct JointGeometry;

static INFO: TermInfo = TermInfo {
    id: "joint-geometry",
    title: "Joints are not where the drawing says",
    chapter: Chapter::AbsolutePoses,
    physics: "Base and platform joints deviate from their nominal places (36 coordinates). Twelve combinations are equivalent to moving the metrology and target frames and cannot be separated from that.",
    equation: "e = n . dA - (R' n) . dB",
    source: "Merlet, Parallel Robots, 2nd ed. 2006, ch. 7; Daney 2003, Mech. Mach. Theory 38 (calibration of a Gough platform)",
    shows: "poses are measured absolutely",
    how_to_isolate: "measure absolute poses over the whole workspace",
    parameters: &each(&JOINTS, "um", 1e6, Scale::Fixed(1e-3), false),
    shape: None,
    needs: &[Need::Absolute],
    rich: Rich::None,
};

impl Term for JointGeometry {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        let rotation = at.place.rotation;
        for leg in 0..6 {
            out.extend((0..3).map(|k| moved(at, leg, -Vector3::ith(k, 1.0), Vector3::zeros())));
        }
        for leg in 0..6 {
            let axes = rotation.column_iter().map(nalgebra::Matrix::into_owned);
            out.extend(axes.map(|axis| moved(at, leg, axis, axis)));
        }
    }

    fn calibrate(&self, values: &[f64], machine: &mut Machine) {
        for leg in 0..6 {
            machine.base_joints[leg] += Vector3::from_column_slice(&values[3 * leg..3 * leg + 3]);
            machine.platform_joints[leg] += Vector3::from_column_slice(&values[18 + 3 * leg..21 + 3 * leg]);
        }
    }

    fn calibrates(&self) -> bool {
        true
    }
}

/// The platform end of a leg is elsewhere by `end` against its base end, and its arm by `arm`. At a measured pose the leg is
/// then commanded that much too short.
fn moved(at: &Condition, leg: usize, end: Vector3, arm: Vector3) -> Action {
    let elongation = Vector6::ith(leg, -at.legs.directions[leg].dot(&end));
    Action::Joint { elongation, force: at.force_response(leg, &end, &arm) }
}
