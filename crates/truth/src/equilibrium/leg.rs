//! One leg between two bodies: where it is, what it pulls.

use hexbench_core::{Matrix3, Vector3};

use super::Body;
use crate::{Setup, law::LawPoint};

/// A leg in the present state of Newton's iteration. Fixed axes, SI units.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leg {
    /// Point of its law.
    pub point: LawPoint,
    /// Length between the joints, m.
    pub length: f64,
    /// From base to platform, unit length.
    pub direction: Vector3,
    /// Platform joint from the origin of its plate, m.
    pub upper_arm: Vector3,
    /// Base joint from the origin of the base, m.
    pub lower_arm: Vector3,
    /// Force of the leg on its platform joint, N.
    pub upper_force: Vector3,
    /// Force of the leg on its base joint, N.
    pub lower_force: Vector3,
    /// Moment of the bent joint on the plate, N m.
    pub upper_moment: Vector3,
    /// Moment of the bent joint on the base, N m.
    pub lower_moment: Vector3,
    /// Commanded direction carried along by the base.
    pub base_rest: Vector3,
    /// Commanded direction carried along by the plate.
    pub platform_rest: Vector3,
}

impl Leg {
    /// `I - n n'`.
    pub(super) fn across(&self) -> Matrix3 {
        Matrix3::identity() - self.direction * self.direction.transpose()
    }

    fn bend(&mut self, setup: &Setup) {
        let across = self.across();
        let shear = across
            * (self.base_rest * setup.base_joint_stiffness
                + self.platform_rest * setup.platform_joint_stiffness)
            / self.length;
        self.upper_force += shear;
        self.lower_force -= shear;
        self.lower_moment = self.base_rest.cross(&self.direction) * setup.base_joint_stiffness;
        self.upper_moment = self.platform_rest.cross(&self.direction) * setup.platform_joint_stiffness;
    }
}

/// The six legs at given places of plate and base.
///
/// Joint bending has the energy `k (1 - n . m)`, `m` the commanded direction carried along by the body at that end: equal
/// to `k theta^2 / 2` up to fourth order.
pub(super) fn legs(setup: &Setup, plate: &Body, base: &Body, points: &[LawPoint; 6]) -> [Leg; 6] {
    let moved = bracket_shifts(setup, plate, base, points);
    let rests = setup.has_stiff_joints().then(|| rest_directions(setup));
    std::array::from_fn(|i| {
        let upper_arm = plate.axes * setup.platform_joints[i];
        let lower_arm = base.axes * (setup.base_joints[i] - setup.base_centre) + moved[i];
        let vector = plate.origin + upper_arm - base.origin - lower_arm;
        let length = vector.norm();
        let direction = vector / length;
        let pull = direction * points[i].force;
        let mut leg = Leg {
            point: points[i],
            length,
            direction,
            upper_arm,
            lower_arm,
            upper_force: setup.joint_weights[i] - pull,
            lower_force: setup.joint_weights[i] + pull,
            upper_moment: Vector3::zeros(),
            lower_moment: Vector3::zeros(),
            base_rest: direction,
            platform_rest: direction,
        };
        if let Some(rests) = &rests {
            leg.base_rest = base.axes * rests[i].0;
            leg.platform_rest = plate.axes * rests[i].1;
            leg.bend(setup);
        }
        leg
    })
}

impl Setup {
    /// True when joints resist bending.
    pub(super) fn has_stiff_joints(&self) -> bool {
        self.base_joint_stiffness != 0.0 || self.platform_joint_stiffness != 0.0
    }
}

/// Commanded leg directions: in fixed axes, and in mobile axes.
fn rest_directions(setup: &Setup) -> [(Vector3, Vector3); 6] {
    let commanded = Body::at(&setup.pose);
    std::array::from_fn(|i| {
        let upper = commanded.origin + commanded.axes * setup.platform_joints[i];
        let direction = (upper - setup.base_joints[i]).normalize();
        (direction, commanded.axes.tr_mul(&direction))
    })
}

/// How far each base joint is pulled along by the leg forces. The leg directions depend on that shift in turn, by the
/// ratio of shift to leg length (1e-4): each pass gains four digits.
fn bracket_shifts(setup: &Setup, plate: &Body, base: &Body, points: &[LawPoint; 6]) -> [Vector3; 6] {
    const PASSES: usize = 5;
    let mut shifts = [Vector3::zeros(); 6];
    if setup.brackets.is_empty() {
        return shifts;
    }
    for _ in 0..PASSES {
        let pulls: [Vector3; 6] = std::array::from_fn(|i| {
            let lower = base.origin + base.axes * (setup.base_joints[i] - setup.base_centre) + shifts[i];
            (plate.origin + plate.axes * setup.platform_joints[i] - lower).normalize() * points[i].force
        });
        shifts = [Vector3::zeros(); 6];
        for bracket in &setup.brackets {
            shifts[bracket.displaced] += bracket.compliance * pulls[bracket.pulled];
        }
    }
    shifts
}
