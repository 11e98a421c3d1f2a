//! What small errors of joints and loads do to a reading where the legs stay straight between their joints, in closed form.
//!
//! With the motion `m = A dW` of the platform, `A = J C J'`, a joint that is elsewhere turns its leg and lets the machine stand
//! elsewhere, so that the commanded lengths stay:
//!
//! ```text
//! dA = -J dL A - A dL' J'        dL: change of the leg Jacobian, row by row [dn; db x n + b x dn]
//! dy = dH m + H dA dW            of the joint itself, and of the twist -J (n . e) by which the pose follows it
//! ```
//!
//! with the rows `H` by which the numbers look at a motion: angles turn with the pose, points move with it, a scale beside a leg turns with
//! the leg.
//!
//! Taken halfway between reference and load. Left out is what the turn of the legs by the deflection itself does to the slope: the
//! deflection over the size of the machine, 1e-4 of a tolerance.

use hexbench_core::{Channel, Matrix6, Measurand, Sensor, SensorKind, Vector3, Vector6};
use nalgebra::{DMatrix, SMatrix};

use crate::estimation::campaign::{Campaign, Condition, ConditionReadings};
use crate::estimation::equilibrium::pose_curvature;
use crate::estimation::frames::ReadingAxes;
use crate::estimation::linearization::Linearization;
use crate::estimation::parallel::map;

/// Coordinates of joints, base and platform.
const JOINTS: usize = 36;
/// Components of loads, turns and shifts of loads.
const LOADS: usize = 12;
/// All of these.
const COLUMNS: usize = JOINTS + LOADS;
/// Turn of a pose for the derivative of what it reads, rad.
const TURN_STEP: f64 = 1e-6;

/// Reading over the standard deviation of its own noise by every coordinate of the joints (base, then platform; m), share of every
/// component of the loads, turn of the loads about each axis (rad) and shift of their point along each mobile axis (m).
type Slopes = SMatrix<f64, 6, COLUMNS>;

/// Slopes at every condition, six rows each, on legs with these compliances (m/N). Joints are no inputs of absolute poses: the legs stand
/// where they were measured.
pub(crate) fn by_springs(campaign: &Campaign, compliances: &Vector6, lin: &Linearization) -> DMatrix<f64> {
    let pairs: Vec<(&Condition, &ConditionReadings)> = lin.conditions.iter().zip(&campaign.groups).collect();
    let all = map(&pairs, |(at, group)| {
        AtCondition::of(campaign, group, at, compliances).slopes(!campaign.is_absolute())
    });
    let mut columns = DMatrix::zeros(6 * all.len(), COLUMNS);
    for (i, one) in all.iter().enumerate() {
        columns.fixed_view_mut::<6, COLUMNS>(6 * i, 0).copy_from(one);
    }
    columns
}

/// Motion by a wrench that the legs carry with these forces: of springs, or of all that yields where the point has more.
fn yielding(at: &Condition, compliances: &Vector6, wrench: &Vector6, forces: &Vector6) -> Vector6 {
    let by_legs =
        at.tangent.as_ref().map_or_else(|| compliances.component_mul(forces), |all| all.loaded * forces);
    let by_series = at.tangent.as_ref().map_or_else(Vector6::zeros, |all| all.series * wrench);
    at.legs.platform_jacobian * by_legs + by_series
}

/// One condition of a machine of springs.
struct AtCondition<'a> {
    at: &'a Condition,
    compliances: &'a Vector6,
    channels: &'a [Channel; 6],
    sensors: &'a [Sensor],
    is_euler: bool,
    /// Motion of the platform between reference and load.
    motion: Vector6,
}

impl<'a> AtCondition<'a> {
    fn of(
        campaign: &'a Campaign,
        group: &'a ConditionReadings,
        at: &'a Condition,
        compliances: &'a Vector6,
    ) -> Self {
        let change = at.wrench.to_vector() - at.reference.to_vector();
        let motion = yielding(at, compliances, &change, &at.force_change());
        let is_euler = campaign.measurand == Measurand::DeflectionEuler;
        let (channels, sensors) = (&group.channels, campaign.hexapod.sensors.as_slice());
        Self { at, compliances, channels, sensors, is_euler, motion }
    }

    /// Motion by a change of the wrench.
    fn yields(&self, wrench: &Vector6) -> Vector6 {
        yielding(self.at, self.compliances, wrench, &self.at.legs.forces(wrench))
    }

    /// Row of the leg Jacobian when the platform joint moves by `end` against the base joint, and its arm by `arm`.
    fn row(&self, leg: usize, end: &Vector3, arm: &Vector3) -> Vector6 {
        let (n, legs) = (self.at.legs.directions[leg], &self.at.legs);
        let turn = (end - n * n.dot(end)) / legs.lengths[leg];
        let moment = arm.cross(&n) + legs.arms[leg].cross(&turn);
        Vector6::new(turn.x, turn.y, turn.z, moment.x, moment.y, moment.z)
    }

    /// `dA dW` by changes of rows of the leg Jacobian.
    fn by_rows(&self, rows: impl Iterator<Item = (usize, Vector6)>) -> Vector6 {
        let (force, mut stretch, mut wrench) = (self.at.force_change(), Vector6::zeros(), Vector6::zeros());
        for (leg, row) in rows {
            stretch[leg] += row.dot(&self.motion);
            wrench += row * force[leg];
        }
        -(self.at.legs.platform_jacobian * stretch) - self.yields(&wrench)
    }

    /// Under a unit twist of the commanded pose.
    fn under_twist(&self, k: usize) -> Vector6 {
        let twist = Vector6::ith(k, 1.0);
        let [v, w] = [0, 3].map(|first| Vector3::from(twist.fixed_rows::<3>(first)));
        let row = |leg: usize| {
            let arm = w.cross(&self.at.legs.arms[leg]);
            self.row(leg, &(v + arm), &arm)
        };
        self.at.observer * self.by_rows((0..6).map(|leg| (leg, row(leg)))) + self.looked_at_anew(&twist, row)
    }

    /// What the same motion reads otherwise under a twist of the pose that changes the rows of the leg Jacobian.
    fn looked_at_anew(&self, twist: &Vector6, row: impl Fn(usize) -> Vector6) -> Vector6 {
        let [spin, w] =
            [&self.motion, twist].map(|motion| -> Vector3 { motion.fixed_rows::<3>(3).into_owned() });
        let rates =
            |share: f64| ReadingAxes::default().rates(&self.at.place.moved(twist, share).pose().to_array());
        let turns = self.is_euler
            && w != Vector3::zeros()
            && self.channels.iter().any(|c| matches!(c, Channel::Pose(3..)));
        let angles =
            if turns { (rates(TURN_STEP) - rates(0.0)) * spin / TURN_STEP } else { Vector3::zeros() };
        let shift = |point: &Vector3| spin.cross(&w.cross(&(self.at.place.rotation * point)));
        Vector6::from_fn(|k, _| match self.channels[k] {
            Channel::Pose(number @ 3..) => angles[number - 3],
            Channel::Pose(_) | Channel::Nothing => 0.0,
            Channel::Sensor { sensor, number } => {
                let Sensor { kind, gain, .. } = &self.sensors[sensor];
                gain * match kind {
                    SensorKind::Distance { point, direction, .. } => direction.dot(&shift(point)),
                    SensorKind::Point { point, .. } => shift(point)[number],
                    SensorKind::Inclination { .. } => 0.0,
                    SensorKind::LegLength { leg, .. } => row(*leg).dot(&self.motion),
                    SensorKind::Function { of, .. } => {
                        pose_curvature(of, &self.at.place, twist, &self.motion)
                    }
                }
            }
        })
    }

    /// By a coordinate of a joint; the pose follows, so that the commanded length stays. `by_pose`: numbers by a small twist of it.
    fn joint(&self, leg: usize, end: &Vector3, arm: &Vector3, by_pose: &Matrix6) -> Vector6 {
        let (legs, row) = (&self.at.legs, self.row(leg, end, arm));
        let follows = legs.platform_jacobian.column(leg) * -legs.directions[leg].dot(end);
        let mut numbers = self.at.observer * self.by_rows(std::iter::once((leg, row))) + by_pose * follows;
        for (number, channel) in numbers.iter_mut().zip(self.channels) {
            if let Channel::Sensor { sensor, .. } = *channel
                && self.sensors[sensor].kind.leg() == Some(leg)
            {
                *number += self.sensors[sensor].gain * row.dot(&self.motion);
            }
        }
        numbers
    }

    fn slopes(&self, with_joints: bool) -> Slopes {
        let mut slopes = Slopes::zeros();
        if with_joints {
            slopes.fixed_columns_mut::<JOINTS>(0).copy_from(&self.joints());
        }
        slopes.fixed_columns_mut::<LOADS>(JOINTS).copy_from(&self.loads());
        self.at.weights.of(slopes)
    }

    /// Numbers by every coordinate of the joints.
    fn joints(&self) -> SMatrix<f64, 6, JOINTS> {
        let by_pose = Matrix6::from_columns(&std::array::from_fn::<Vector6, 6, _>(|k| self.under_twist(k)));
        let numbers = |column: usize| {
            let (leg, axis) = (column % 18 / 3, Vector3::ith(column % 3, 1.0));
            if column < 18 {
                return self.joint(leg, &-axis, &Vector3::zeros(), &by_pose);
            }
            let arm = self.at.place.rotation * axis;
            self.joint(leg, &arm, &arm, &by_pose)
        };
        SMatrix::from_columns(&std::array::from_fn::<Vector6, JOINTS, _>(numbers))
    }

    /// Numbers by a share of every component of the load, its turns and its shifts.
    fn loads(&self) -> SMatrix<f64, 6, LOADS> {
        let (at, axis) = (self.at, |k: usize| Vector3::ith(k % 3, 1.0));
        let change = at.wrench.to_vector() - at.reference.to_vector();
        let [force, moment] = [0, 3].map(|first| Vector3::from(change.fixed_rows::<3>(first)));
        let both = |f: Vector3, m: Vector3| Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z);
        let wrench = |column: usize| match column {
            0..6 => Vector6::ith(column, 1.0) * change[column],
            6..9 => both(axis(column).cross(&force), axis(column).cross(&moment)),
            _ => both(Vector3::zeros(), (at.place.rotation * axis(column)).cross(&force)),
        };
        let numbers = |column: usize| at.observer * self.yields(&wrench(column));
        SMatrix::from_columns(&std::array::from_fn::<Vector6, LOADS, _>(numbers))
    }
}
