//! The ways in which a file may mean something else than it says.

use std::f64::consts::PI;

use hexbench_core::{Dataset, Hexapod, Vector3};

use super::change::{Change, Group, JointCoordinate, ReferencePoint, Signed, Target};
use super::row_order::RowOrder;
use super::turn::{AngleOrder, SignedAxes};

/// Ratios of units of length: inches, powers of ten.
pub(super) const LENGTHS: [f64; 5] = [10.0, 100.0, 1e3, 1e6, 25.4];
/// Of angles: degrees and seconds of arc, radians and their thousandths and millionths.
pub(super) const ANGLES: [f64; 8] =
    [1e3, 1e6, 180.0 / PI, 3600.0, PI / 0.648, PI * 1e3 / 180.0, PI * 1e6 / 180.0, 648.0 / PI];
/// Of forces and moments: kilograms, pounds, powers of ten.
const LOADS: [f64; 5] = [1e3, 1e6, 9.806_65, 4.448_222, 9_806.65];
/// Of readings or noise as a whole: a smaller ratio is for the noise level to tell.
const WHOLE: [f64; 3] = [25.4, 1e3, 1e6];
/// Of joints: those of lengths, and a diameter taken for a radius.
const JOINTS: [f64; 6] = [10.0, 100.0, 1e3, 1e6, 25.4, 2.0];
/// Turns of the platform against the base that a drawing may mean otherwise, degrees.
const PLATFORM_TURNS: [f64; 6] = [30.0, -30.0, 60.0, -60.0, 120.0, -120.0];
/// Ratios closer to each other than this, relative, are one.
const SAME_RATIO: f64 = 1e-4;
/// Points closer to each other than this are one, m.
const ONE_POINT: f64 = 1e-3;

/// Everything that is tried at first.
pub(super) fn singles(hexapod: &Hexapod, data: &Dataset) -> Vec<Change> {
    let mut all = cheap(hexapod, data);
    all.extend(machines(hexapod));
    all.extend(leg_orders().into_iter().map(Change::LegOrder));
    all.extend(origins(hexapod, data).into_iter().map(|(origin, at)| Change::Origin(origin, at)));
    all
}

/// What is tried beside another mistake: signs, units, frames, axes, angles.
pub(super) fn cheap(hexapod: &Hexapod, data: &Dataset) -> Vec<Change> {
    let mut all = signs();
    all.extend(units());
    let targets = [Target::Readings, Target::ReadingColumns, Target::Wrench, Target::Joints, Target::Poses];
    // All three reversed are a sign.
    let axes: Vec<SignedAxes> = SignedAxes::all().into_iter().filter(|a| a.axes() != [-1, -2, -3]).collect();
    all.extend(targets.iter().flat_map(|&t| axes.iter().map(move |&a| Change::Renamed(t, a))));
    // Right-handed columns are vectors.
    let left = axes.iter().filter(|a| a.handedness() < 0.0);
    all.extend(left.map(|&a| Change::Renamed(Target::WrenchColumns, a)));
    let orders = || axes.iter().filter(|a| a.axes().iter().all(|axis| *axis > 0));
    let columns = [
        Target::TranslationColumns,
        Target::RotationColumns,
        Target::ForceColumns,
        Target::MomentColumns,
        Target::PosePositionColumns,
        Target::PoseAngleColumns,
    ];
    all.extend(columns.into_iter().flat_map(|t| orders().map(move |&a| Change::Renamed(t, a))));
    all.extend([
        Change::WrenchMobile,
        Change::MomentsMobile,
        Change::DeflectionMobile,
        Change::OtherRotations,
    ]);
    // What the machine states already is no other reading.
    let orders = AngleOrder::ALL.into_iter().filter(|order| order.convention() != Some(hexapod.angles));
    all.extend(orders.flat_map(|order| [Change::Angles(order), Change::PoseAngles(order)]));
    if data.columns.reference {
        all.push(Change::Reversed(Signed::Reference));
        all.extend([Change::StatesExchanged, Change::LoadIsChange, Change::LoadHoldsReference]);
    }
    all
}

/// Rows in another order.
pub(super) fn row_orders() -> impl Iterator<Item = Change> {
    RowOrder::ALL.into_iter().map(Change::Rows)
}

fn signs() -> Vec<Change> {
    let groups = [
        Signed::Readings,
        Signed::Wrench,
        Signed::Rotations,
        Signed::Moments,
        Signed::Translations,
        Signed::Forces,
    ];
    let single = (0..6).flat_map(|k| [Signed::Reading(k), Signed::Load(k)]);
    groups.into_iter().chain(single).map(Change::Reversed).collect()
}

fn units() -> Vec<Change> {
    let groups = [
        Group::Translations,
        Group::Rotations,
        Group::Readings,
        Group::Forces,
        Group::Moments,
        Group::PosePositions,
        Group::PoseAngles,
        Group::BaseJoints,
        Group::PlatformJoints,
        Group::Joints,
        Group::Noise,
    ];
    let columns = (0..6).flat_map(|k| [Group::Reading(k), Group::Load(k)]);
    let each = |group| {
        factors_of(group)
            .iter()
            .flat_map(move |f| [Change::Scaled(group, *f), Change::Scaled(group, f.recip())])
    };
    groups.into_iter().chain(columns).flat_map(each).collect()
}

/// Ratios of units in which numbers of a group may be written.
pub(super) fn factors_of(group: Group) -> &'static [f64] {
    match group {
        Group::Translations | Group::PosePositions | Group::Reading(0..=2) => &LENGTHS,
        Group::Rotations | Group::PoseAngles | Group::Reading(_) => &ANGLES,
        Group::Forces | Group::Moments | Group::Loads | Group::Load(_) => &LOADS,
        Group::BaseJoints | Group::PlatformJoints | Group::Joints => &JOINTS,
        Group::Readings | Group::Noise => &WHOLE,
    }
}

/// True for one of these ratios, either way.
pub(super) fn is_ratio(of: &[f64], factor: f64) -> bool {
    of.iter().any(|ratio| [*ratio, ratio.recip()].iter().any(|r| (factor / r - 1.0).abs() < SAME_RATIO))
}

/// Joints in other axes, exchanged, or with a sign lost.
fn machines(hexapod: &Hexapod) -> Vec<Change> {
    let mut all = vec![Change::JointsExchanged];
    all.extend(
        PLATFORM_TURNS
            .iter()
            .map(|deg| Change::Turned(Target::PlatformJoints, Vector3::new(0.0, 0.0, deg.to_radians()))),
    );
    let upright: Vec<SignedAxes> = SignedAxes::all().into_iter().filter(|a| a.keeps_vertical()).collect();
    for target in [Target::BaseJoints, Target::PlatformJoints] {
        all.extend(upright.iter().map(|&axes| Change::Renamed(target, axes)));
    }
    let lost = |coordinate: JointCoordinate| {
        let off = -2.0 * coordinate.of(hexapod);
        (off.abs() > ONE_POINT).then_some(Change::Joint(coordinate, off))
    };
    all.extend(JointCoordinate::all().filter_map(lost));
    all
}

/// All orders of six legs but the one of the file.
fn leg_orders() -> Vec<[u8; 6]> {
    fn grow(order: &mut Vec<u8>, all: &mut Vec<[u8; 6]>) {
        if let Ok(full) = <[u8; 6]>::try_from(order.as_slice()) {
            all.push(full);
            return;
        }
        for leg in (0..6).filter(|l| !order.contains(l)).collect::<Vec<_>>() {
            order.push(leg);
            grow(order, all);
            order.pop();
        }
    }
    let mut all = Vec::with_capacity(720);
    grow(&mut Vec::new(), &mut all);
    all.retain(|order| *order != [0, 1, 2, 3, 4, 5]);
    all
}

/// Points to which moments may refer, and heights that may be counted twice or not at all.
fn origins(hexapod: &Hexapod, data: &Dataset) -> Vec<(ReferencePoint, Vector3)> {
    let base = hexapod.base_centre();
    let platform = hexapod.platform_joints.iter().sum::<Vector3>() / 6.0;
    let rows = data.observations.len().max(1) as f64;
    let position = data.observations.iter().map(|o| o.pose.translation).sum::<Vector3>() / rows;
    let mut all =
        vec![(ReferencePoint::MomentsFixed, Vector3::zeros()), (ReferencePoint::MomentsFixed, base)];
    let mut heights = vec![platform.z - base.z, platform.z, base.z, position.z];
    heights.retain(|h| h.abs() > ONE_POINT);
    for height in heights.iter().flat_map(|h| [*h, -h]) {
        let up = Vector3::new(0.0, 0.0, height);
        all.extend([(ReferencePoint::Poses, up), (ReferencePoint::PlatformJoints, up)]);
    }
    if position.norm() > ONE_POINT {
        all.push((ReferencePoint::Poses, position));
    }
    all
}

#[cfg(test)]
mod tests {
    use hexbench_core::Measurand;

    use super::*;
    use crate::test_machine::{machine, readings};

    #[test]
    fn a_joint_has_lost_its_sign_where_that_moves_it_by_a_millimeter() {
        for (height, heights) in [(0.49e-3, 0), (0.51e-3, 1)] {
            let mut hexapod = machine();
            hexapod.platform_joints[0].z = height;
            let is_lost = |c: &Change| matches!(c, Change::Joint(at, _) if at.platform && at.axis == 2);
            assert_eq!(machines(&hexapod).iter().filter(|c| is_lost(c)).count(), heights, "{height}");
        }
    }

    #[test]
    fn a_reference_state_may_be_wrong_where_the_file_has_one() {
        let (hexapod, mut data) = readings(Measurand::DeflectionRotationVector, Vec::new());
        let mut asks = |reference| {
            data.columns.reference = reference;
            cheap(&hexapod, &data).contains(&Change::StatesExchanged)
        };
        assert_eq!([false, true].map(&mut asks), [false, true]);
    }
}
