//! Flexure joints resist rotation: `joint-rotation-stiffness`.
//!
//! `n` is the leg direction and `m` the direction of the leg at the commanded pose, carried along by the base (base end) or by
//! the platform (platform end). For the small angle between them the energy is k theta^2 / 2. Twist about the leg is free.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, one_of, parsed};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "joint-rotation-stiffness",
    title: "Flexure joints resist rotation",
    physics: "energy k (1 - n.m) at each end of each leg",
    shows: Shows::Deflection,
    draw,
    parse: parsed::<JointRotationStiffness>,
};

/// Flexure joints resist rotation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointRotationStiffness {
    /// Stiffness of each base joint, N m/rad.
    pub base: f64,
    /// Stiffness of each platform joint, N m/rad.
    pub platform: f64,
}

impl Mechanism for JointRotationStiffness {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        setup.base_joint_stiffness += self.base;
        setup.platform_joint_stiffness += self.platform;
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { base: self.base * factor, platform: self.platform * factor })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("joint_rotation".to_owned(), json!([self.base, self.platform]))])
    }
}

fn draw(_: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    let share = one_of(rng, &[0.5, 0.3, 0.8]);
    Box::new(JointRotationStiffness { base: 1000.0 * share, platform: 1000.0 * (1.0 - share) })
}
