//! Where poses and loads may be chosen.

mod load_range;

pub use load_range::{ChosenPart, LoadRange};

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Approach, Hexapod, Pose, Vector3, Wrench};
use hexbench_model::machine::kinematics::{Legs, euler_rate_matrix};
use nalgebra::{DMatrix, DVector};
use rand::RngExt;
use sobol_burley::sample;

use crate::{Budget, DesignError};

/// One way to load the platform: reference and load. N, N m, fixed axes, at the mobile origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loading {
    /// Wrench in the reference state.
    pub reference: Wrench,
    /// Wrench in the loaded state.
    pub load: Wrench,
}

/// Circumstances of a reading beside pose and load; every one is combined with every other.
#[derive(Debug, Clone, PartialEq)]
pub struct Conditions {
    /// Ways to reach the load.
    pub approaches: Vec<Approach>,
    /// Temperatures of the structure at the loaded reading minus at the reference reading, K.
    pub delta_t: Vec<f64>,
    /// Times from the reference reading to the loaded one, s.
    pub waits: Vec<f64>,
}

impl Default for Conditions {
    /// Loaded from below, at the same temperature, read at once.
    fn default() -> Self {
        Self { approaches: vec![Approach::default()], delta_t: vec![0.0], waits: vec![0.0] }
    }
}

/// Everything that is set for a reading but the pose. SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    /// Reference and load.
    pub loading: Loading,
    /// How the load is reached.
    pub approach: Approach,
    /// Temperature at the loaded reading minus at the reference reading, K.
    pub delta_t: f64,
    /// Time from the reference reading to the loaded one, s.
    pub elapsed: f64,
}

impl From<Loading> for Setting {
    /// Loaded from below, at the same temperature, read at once.
    fn from(loading: Loading) -> Self {
        Self { loading, approach: Approach::default(), delta_t: 0.0, elapsed: 0.0 }
    }
}

/// Travel and limits of the poses, the loads that can be applied, and under which conditions. SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Space {
    /// Lowest pose coordinates `[a, b, c, alpha, beta, gamma]`, m and rad.
    pub low: [f64; 6],
    /// Highest pose coordinates; equal to the lowest where a coordinate is fixed.
    pub high: [f64; 6],
    /// Shortest and longest leg, m.
    pub stroke: Option<[f64; 2]>,
    /// Largest angle between a leg and its direction at the zero pose, seen from the base and from the platform, rad.
    pub joint_angle: Option<f64>,
    /// Smallest dexterity: inverse condition number of the leg Jacobian, moments over the platform radius.
    pub least_dexterity: f64,
    /// Loads that can be applied; of those that are chosen, the choice so far.
    pub loads: Vec<Loading>,
    /// Which of the loads are chosen, and between which bounds.
    pub load_ranges: Vec<LoadRange>,
    /// Approaches, temperatures and waits.
    pub conditions: Conditions,
    /// What the plan may cost.
    pub budget: Budget,
}

/// A limit of a pose: negative or zero when kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseLimit {
    /// What is limited.
    pub name: &'static str,
    /// Excess over the limit, as a share of it.
    pub excess: f64,
}

impl Space {
    /// Every load under every condition: loads slowest, then approaches, temperatures, waits.
    pub fn settings(&self) -> Vec<Setting> {
        self.settings_of(&self.loads)
    }

    /// Indices of the pose coordinates that vary.
    pub fn free(&self) -> Vec<usize> {
        (0..6).filter(|&k| self.high[k] > self.low[k]).collect()
    }

    /// The `index`-th pose of a scrambled Sobol sequence over the travel; limits are not looked at.
    /// Source: Owen 1995 (scrambling); Burley 2020 (hashing).
    pub fn pose(&self, index: u32, seed: u32) -> Pose {
        let mut pose = self.low;
        for (dimension, k) in (0_u32..).zip(0..6) {
            pose[k] += f64::from(sample(index, dimension, seed)) * (self.high[k] - self.low[k]);
        }
        Pose::from_array(pose)
    }

    /// The first `count` poses of the sequence that keep all limits; a sequence that ends is scrambled anew.
    ///
    /// # Errors
    /// [`DesignError::NoPose`] when fewer than one in a thousand does.
    pub fn poses(&self, hexapod: &Hexapod, count: usize, seed: u32) -> Result<Vec<Pose>, DesignError> {
        const PATIENCE: usize = 1000;
        const SEQUENCE: u32 = 1 << 16;
        let tried = PATIENCE * count.max(10);
        let again = |number: u64| stream(seed.into(), Purpose::SobolScrambling, [number]).random();
        let scrambles = std::iter::once(seed).chain((1..).map(again));
        let sequences = scrambles.flat_map(|scramble| (0..SEQUENCE).map(move |index| (index, scramble)));
        let (mut poses, mut broken) = (Vec::with_capacity(count), "travel");
        for (index, scramble) in sequences.take(tried) {
            let pose = self.pose(index, scramble);
            match self.worst_limit(hexapod, &pose) {
                Some(limit) if limit.excess > 0.0 => broken = limit.name,
                _ => poses.push(pose),
            }
            if poses.len() == count {
                return Ok(poses);
            }
        }
        Err(DesignError::NoPose { found: poses.len(), tried, why: broken })
    }

    /// The limit that a pose comes closest to breaking, or breaks most; none when there are no limits.
    pub fn worst_limit(&self, hexapod: &Hexapod, pose: &Pose) -> Option<PoseLimit> {
        self.limits(hexapod, pose).into_iter().max_by(|a, b| a.excess.total_cmp(&b.excess))
    }

    /// All limits at a pose.
    pub fn limits(&self, hexapod: &Hexapod, pose: &Pose) -> Vec<PoseLimit> {
        let Ok(legs) = Legs::at(&hexapod.base_joints, &hexapod.platform_joints, pose) else {
            return vec![PoseLimit { name: "distance from singularity", excess: 1.0 }];
        };
        let mut limits = Vec::with_capacity(25);
        // Leg by leg and both ends at once, so that each limit is smooth: a search that follows the longest leg stalls where two
        // legs change places.
        if let Some([shortest, longest]) = self.stroke {
            let (middle, half) = (f64::midpoint(shortest, longest), 0.5 * (longest - shortest));
            for length in &legs.lengths {
                limits.push(PoseLimit { name: "stroke", excess: ((length - middle) / half).powi(2) - 1.0 });
            }
        }
        if let Some(largest) = self.joint_angle {
            let angles = joint_angles(hexapod, pose, &legs);
            limits
                .extend(angles.map(|angle| PoseLimit { name: "joint angle", excess: angle / largest - 1.0 }));
        }
        if self.least_dexterity > 0.0 {
            let dexterity = dexterity(hexapod, &legs);
            limits.push(PoseLimit {
                name: "distance from singularity",
                excess: 1.0 - dexterity / self.least_dexterity,
            });
        }
        limits
    }
}

/// Steps in which a pose is set: a micrometre, a thousandth of a degree.
const STEPS_PER_M: f64 = 1e6;
const STEPS_PER_DEG: f64 = 1e3;
/// Changes by rounding that a pose farther inside keeps from its limits, tried in this order.
const MARGINS: [f64; 6] = [0.5, 1.0, 2.0, 4.0, 8.0, 16.0];

impl Space {
    /// The nearest pose in whole micrometres and thousandths of a degree that keeps travel and limits, where there is one beside a pose
    /// that keeps them; a coordinate that does not vary stays.
    ///
    /// All corners of the cell of the grid are tried, the nearest first. Where each breaks a limit, the cell of a pose farther inside is, by
    /// the slopes of all limits that rounding could break.
    #[must_use]
    pub fn rounded(&self, hexapod: &Hexapod, pose: &Pose) -> Pose {
        let keeps = |steps: &[f64; 6]| {
            let there = self.at_steps(pose, steps);
            self.worst_limit(hexapod, &there).is_none_or(|limit| limit.excess <= 0.0)
        };
        let corners = self.corners(pose);
        let Some(nearest) = corners.first().copied() else { return *pose };
        let inside = MARGINS.into_iter().filter_map(|margin| self.farther_inside(hexapod, pose, margin));
        let kept = corners
            .into_iter()
            .find(keeps)
            .or_else(|| inside.into_iter().find_map(|there| self.corners(&there).into_iter().find(keeps)));
        self.at_steps(pose, &kept.unwrap_or(nearest))
    }

    /// A pose at which every limit that is near keeps so many times the change that rounding can make: the smallest change of the pose in
    /// steps that does so to first order.
    fn farther_inside(&self, hexapod: &Hexapod, pose: &Pose, margin: f64) -> Option<Pose> {
        let free = self.free();
        let in_steps = |slope: &[f64; 6]| free.iter().map(|&k| slope[k] * step_of(k)).collect::<Vec<f64>>();
        let near: Vec<(f64, Vec<f64>)> = self
            .limit_slopes(hexapod, pose)?
            .iter()
            .map(|(excess, slope)| (*excess, in_steps(slope)))
            .map(|(excess, slope)| (excess + margin * slope.iter().map(|x| x.abs()).sum::<f64>(), slope))
            .filter(|(beyond, _)| *beyond > 0.0)
            .collect();
        let slopes = DMatrix::from_fn(near.len(), free.len(), |i, j| near[i].1[j]);
        let back = DVector::from_fn(near.len(), |i, _| -near[i].0);
        // Columns of one row are of one size: the tolerance is that of the whole.
        let tolerance = slopes.amax() * 1e-9;
        let change = slopes.svd(true, true).solve(&back, tolerance).ok()?;
        let mut x = pose.to_array();
        free.iter().zip(&change).for_each(|(&k, steps)| x[k] += steps * step_of(k));
        Some(Pose::from_array(x)).filter(|pose| pose.to_array().iter().all(|x| x.is_finite()))
    }

    /// Steps of the corners around a pose that are within the travel, the nearest first.
    fn corners(&self, pose: &Pose) -> Vec<[f64; 6]> {
        let exact = in_steps(pose);
        let free = self.free();
        let mut corners: Vec<(f64, [f64; 6])> = (0..1_u32 << free.len())
            .map(|others| {
                let mut steps = exact.map(f64::round);
                for (_, &k) in free.iter().enumerate().filter(|(bit, _)| others >> bit & 1 == 1) {
                    steps[k] += if exact[k] >= steps[k] { 1.0 } else { -1.0 };
                }
                let far = free.iter().map(|&k| (steps[k] - exact[k]).powi(2)).sum();
                (far, steps)
            })
            .filter(|(_, steps)| self.travels_to(steps))
            .collect();
        corners.sort_by(|a, b| a.0.total_cmp(&b.0));
        corners.into_iter().map(|(_, steps)| steps).collect()
    }

    fn travels_to(&self, steps: &[f64; 6]) -> bool {
        // Limits of the travel are round numbers up to rounding of their own.
        const SLACK: f64 = 1e-6;
        let [low, high] = [&self.low, &self.high].map(|end| in_steps(&Pose::from_array(*end)));
        self.free().into_iter().all(|k| (low[k] - SLACK..=high[k] + SLACK).contains(&steps[k]))
    }

    /// The pose at whole steps; coordinates that do not vary are those of `pose`.
    fn at_steps(&self, pose: &Pose, steps: &[f64; 6]) -> Pose {
        let mut x = pose.to_array();
        for k in self.free() {
            x[k] = 0.0 + if k < 3 { steps[k] / STEPS_PER_M } else { (steps[k] / STEPS_PER_DEG).to_radians() };
        }
        Pose::from_array(x)
    }
}

fn step_of(k: usize) -> f64 {
    if k < 3 { 1.0 / STEPS_PER_M } else { (1.0 / STEPS_PER_DEG).to_radians() }
}

fn in_steps(pose: &Pose) -> [f64; 6] {
    let x = pose.to_array();
    std::array::from_fn(|k| if k < 3 { x[k] * STEPS_PER_M } else { x[k].to_degrees() * STEPS_PER_DEG })
}

/// A limit of a pose with its derivatives by the six pose coordinates.
pub type Slope = (f64, [f64; 6]);

impl Space {
    /// Excesses of all limits at a pose with their derivatives, in the order of [`Space::limits`]; none at a singular pose.
    pub fn limit_slopes(&self, hexapod: &Hexapod, pose: &Pose) -> Option<Vec<Slope>> {
        let mut slopes = Vec::with_capacity(25);
        if let Some(stroke) = self.stroke {
            slopes.extend(stroke_slopes(hexapod, pose, stroke));
        }
        if self.joint_angle.is_none() && self.least_dexterity <= 0.0 {
            return Some(slopes);
        }
        let others = |pose: &Pose| {
            Legs::at(&hexapod.base_joints, &hexapod.platform_joints, pose).ok()?;
            Some(self.limits(hexapod, pose).split_off(slopes.len()))
        };
        let differences = by_differences(others, pose)?;
        slopes.extend(differences);
        Some(slopes)
    }
}

/// Strokes of the six legs with exact derivatives.
fn stroke_slopes(hexapod: &Hexapod, pose: &Pose, [shortest, longest]: [f64; 2]) -> [Slope; 6] {
    let (middle, half) = (f64::midpoint(shortest, longest), 0.5 * (longest - shortest));
    let (rotation, euler) = (pose.rotation(), euler_rate_matrix(&pose.angles));
    std::array::from_fn(|leg| {
        let arm = rotation * hexapod.platform_joints[leg];
        let span = pose.translation + arm - hexapod.base_joints[leg];
        let length = span.norm();
        let beyond = (length - middle) / half;
        let n = span * (2.0 * beyond / (half * length));
        let turned = euler.tr_mul(&arm.cross(&n));
        (beyond * beyond - 1.0, [n.x, n.y, n.z, turned.x, turned.y, turned.z])
    })
}

fn by_differences(limits: impl Fn(&Pose) -> Option<Vec<PoseLimit>>, pose: &Pose) -> Option<Vec<Slope>> {
    const STEP: f64 = 1e-6;
    let mut slopes: Vec<Slope> = limits(pose)?.iter().map(|limit| (limit.excess, [0.0; 6])).collect();
    for k in 0..6 {
        let beside = |step: f64| {
            let mut x = pose.to_array();
            x[k] += step;
            limits(&Pose::from_array(x))
        };
        for ((slope, above), below) in slopes.iter_mut().zip(beside(STEP)?).zip(beside(-STEP)?) {
            slope.1[k] = (above.excess - below.excess) / (2.0 * STEP);
        }
    }
    Some(slopes)
}

/// Inverse condition number of the leg Jacobian with moments over the platform radius.
pub fn dexterity(hexapod: &Hexapod, legs: &Legs) -> f64 {
    let mut scaled = legs.leg_jacobian;
    scaled.fixed_columns_mut::<3>(3).unscale_mut(hexapod.platform_radius());
    let squares = (scaled.transpose() * scaled).symmetric_eigenvalues();
    (squares.min().max(0.0) / squares.max()).sqrt()
}

/// Turns of the legs against their directions at the zero pose, seen from the base and from the platform, rad.
fn joint_angles(hexapod: &Hexapod, pose: &Pose, legs: &Legs) -> [f64; 12] {
    let rotation = pose.rotation();
    let angle = |a: &Vector3, b: &Vector3| a.cross(b).norm().atan2(a.dot(b));
    std::array::from_fn(|k| {
        let (leg, from_platform) = (k / 2, k % 2 == 1);
        let home = hexapod.platform_joints[leg] - hexapod.base_joints[leg];
        let now = legs.directions[leg];
        angle(&home, &if from_platform { rotation.tr_mul(&now) } else { now })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_machine::machine;

    fn space() -> Space {
        let half = [0.012, 0.012, 0.01, 0.15, 0.15, 0.2];
        Space {
            low: half.map(|x| -x),
            high: half,
            stroke: None,
            joint_angle: None,
            least_dexterity: 0.0,
            loads: Vec::new(),
            load_ranges: Vec::new(),
            conditions: Conditions::default(),
            budget: Budget::default(),
        }
    }

    /// The same space, in which a pose has a leg at each end of its stroke, a joint as far as it turns, and the least dexterity.
    fn at_every_limit(hexapod: &Hexapod, pose: &Pose) -> Space {
        let legs = Legs::at(&hexapod.base_joints, &hexapod.platform_joints, pose).unwrap();
        let largest = joint_angles(hexapod, pose, &legs).into_iter().fold(0.0, f64::max);
        Space {
            stroke: Some([legs.lengths.min(), legs.lengths.max()]),
            joint_angle: Some(largest),
            least_dexterity: dexterity(hexapod, &legs),
            ..space()
        }
    }

    #[test]
    fn a_pose_at_all_its_limits_is_rounded_to_the_inside_of_each() {
        let hexapod = machine();
        let (mut broken, mut farthest) = (0, 0.0_f64);
        for index in 0..200 {
            let pose = space().pose(index, 7);
            let tight = at_every_limit(&hexapod, &pose);
            let rounded = tight.rounded(&hexapod, &pose);
            let limit = tight.worst_limit(&hexapod, &rounded).unwrap();
            assert!(limit.excess <= 0.0, "pose {index}: {limit:?}");
            let (steps, exact) = (in_steps(&rounded), in_steps(&pose));
            for k in 0..6 {
                assert!((steps[k] - steps[k].round()).abs() < 1e-6, "{steps:?}");
                farthest = farthest.max((steps[k] - exact[k]).abs());
            }
            let nearest = space().rounded(&hexapod, &pose);
            broken += usize::from(tight.worst_limit(&hexapod, &nearest).unwrap().excess > 0.0);
        }
        println!("the nearest breaks a limit in {broken} of 200; moved by {farthest} steps at most");
        assert!(broken > 150, "{broken}");
        assert!(farthest < 30.0, "{farthest}");
    }

    #[test]
    fn the_travel_is_kept_and_a_fixed_coordinate_stays_as_it_is() {
        let mut space = space();
        (space.high[0], space.low[0]) = (0.010_000_4, 0.010_000_4);
        space.high[1] = 0.005_000_7;
        let pose = Pose::from_array([space.low[0], space.high[1], 0.001_000_4, 0.0, 0.0, 0.0]);
        let rounded = space.rounded(&machine(), &pose).to_array();
        assert_eq!(rounded[0].to_bits(), space.low[0].to_bits());
        assert!((rounded[1] - 0.005).abs() < 1e-15 && (rounded[2] - 0.001).abs() < 1e-15, "{rounded:?}");
    }
}
