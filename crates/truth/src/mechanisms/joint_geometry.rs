//! Joints are not where the drawing says: `joint-geometry`.
//!
//! Manufacturing and assembly errors of the twelve joint centers.

use hexbench_core::{Hexapod, Vector3};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, normal3, parsed};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "joint-geometry",
    title: "Joints are not where the drawing says",
    physics: "A_i, B_i true; leg lengths commanded from the nominal ones",
    shows: Shows::Absolute,
    draw,
    parse: parsed::<JointGeometry>,
};

/// Joints are not where the drawing says.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointGeometry {
    /// True minus nominal base joints, fixed frame, m.
    pub base: [[f64; 3]; 6],
    /// True minus nominal platform joints, mobile frame, m.
    pub platform: [[f64; 3]; 6],
    /// Nominal base joints, fixed frame, m.
    pub nominal_base: [[f64; 3]; 6],
    /// Nominal platform joints, mobile frame, m.
    pub nominal_platform: [[f64; 3]; 6],
}

impl JointGeometry {
    /// Gaussian errors of every coordinate with a standard deviation in m.
    pub fn sampled(hexapod: &Hexapod, sigma: f64, rng: &mut Pcg64) -> Self {
        Self {
            base: std::array::from_fn(|_| normal3(rng, sigma)),
            platform: std::array::from_fn(|_| normal3(rng, sigma)),
            nominal_base: hexapod.base_joints.map(Into::into),
            nominal_platform: hexapod.platform_joints.map(Into::into),
        }
    }
}

impl Mechanism for JointGeometry {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        for i in 0..6 {
            setup.base_joints[i] += Vector3::from(self.base[i]);
            setup.platform_joints[i] += Vector3::from(self.platform[i]);
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self {
            base: self.base.map(|d| d.map(|x| x * factor)),
            platform: self.platform.map(|d| d.map(|x| x * factor)),
            ..*self
        })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([
            ("A_true".to_owned(), json!(sums(&self.nominal_base, &self.base))),
            ("B_true".to_owned(), json!(sums(&self.nominal_platform, &self.platform))),
        ])
    }
}

fn draw(hexapod: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    const USUAL_M: f64 = 0.15e-3;
    Box::new(JointGeometry::sampled(hexapod, USUAL_M, rng))
}

fn sums(nominal: &[[f64; 3]; 6], error: &[[f64; 3]; 6]) -> [[f64; 3]; 6] {
    std::array::from_fn(|i| std::array::from_fn(|k| nominal[i][k] + error[i][k]))
}
