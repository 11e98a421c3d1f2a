//! Flexure joints resist rotation: `joint-rotation-stiffness`.
//!
//! `n` is the leg direction and `m` the direction of the leg at the commanded pose, carried along by the base (base end) or by
//! the platform (platform end). For the small angle between them the energy is k theta^2 / 2. Twist about the leg is free.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, one_of};
use crate::{Instant, Setup};

/// Flexure joints resist rotation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointRotationStiffness {
    /// Stiffness of each base joint, N m/rad.
    pub base: f64,
    /// Stiffness of each platform joint, N m/rad.
    pub platform: f64,
}

impl Registered for JointRotationStiffness {
    const ID: &'static str = "joint-rotation-stiffness";
    const TITLE: &'static str = "Flexure joints resist rotation";
    const PHYSICS: &'static str = "energy k (1 - n.m) at each end of each leg";
    const SHOWS: Shows = Shows::Deflection;

    fn draw(_: &Hexapod, rng: &mut Pcg64) -> Self {
        let share = one_of(rng, &[0.5, 0.3, 0.8]);
        Self { base: 1000.0 * share, platform: 1000.0 * (1.0 - share) }
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        setup.base_joint_stiffness += self.base;
        setup.platform_joint_stiffness += self.platform;
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { base: self.base * factor, platform: self.platform * factor }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("joint_rotation", json!([self.base, self.platform]))]
    }
}
