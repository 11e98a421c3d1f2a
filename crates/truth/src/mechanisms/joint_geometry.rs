//! Joints are not where the drawing says: `joint-geometry`.
//!
//! Manufacturing and assembly errors of the twelve joint centers.

use hexbench_core::{Hexapod, Vector3};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, normal3};
use crate::{Instant, Setup};

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

impl Registered for JointGeometry {
    const ID: &'static str = "joint-geometry";
    const TITLE: &'static str = "Joints are not where the drawing says";
    const PHYSICS: &'static str = "A_i, B_i true; leg lengths commanded from the nominal ones";
    const SHOWS: Shows = Shows::Absolute;

    fn draw(hexapod: &Hexapod, rng: &mut Pcg64) -> Self {
        const USUAL_M: f64 = 0.15e-3;
        Self::sampled(hexapod, USUAL_M, rng)
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        for i in 0..6 {
            setup.base_joints[i] += Vector3::from(self.base[i]);
            setup.platform_joints[i] += Vector3::from(self.platform[i]);
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self {
            base: self.base.map(|d| d.map(|x| x * factor)),
            platform: self.platform.map(|d| d.map(|x| x * factor)),
            ..*self
        }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![
            ("A_true", json!(sums(&self.nominal_base, &self.base))),
            ("B_true", json!(sums(&self.nominal_platform, &self.platform))),
        ]
    }
}

fn sums(nominal: &[[f64; 3]; 6], error: &[[f64; 3]; 6]) -> [[f64; 3]; 6] {
    std::array::from_fn(|i| std::array::from_fn(|k| nominal[i][k] + error[i][k]))
}
