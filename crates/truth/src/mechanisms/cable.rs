//! A cable pulls at the platform: `out:cable`.
//!
//! A stay, hose or safety rope that is tightened anew at each pose: a spring that holds the platform against the load and pulls at
//! it in both states alike.

use hexbench_core::{Hexapod, Vector3};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows, uniform};
use crate::{Instant, Setup, setup::Cable};

/// A cable pulls at the platform.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CablePull {
    /// Fixed end, fixed frame, m.
    pub anchor: [f64; 3],
    /// Platform end, mobile frame, m.
    pub attachment: [f64; 3],
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Stretch to which it is tightened at each commanded pose, m.
    pub stretch: f64,
}

impl Registered for CablePull {
    const ID: &'static str = "out:cable";
    const TITLE: &'static str = "A cable pulls at the platform";
    const PHYSICS: &'static str = "spring between a fixed point and a point of the platform";
    const SHOWS: Shows = Shows::Outside;

    fn draw(hexapod: &Hexapod, rng: &mut Pcg64) -> Self {
        let r = hexapod.platform_radius();
        let turn = uniform(rng, 0.0, std::f64::consts::TAU);
        let anchor = Vector3::new(3.0 * r * turn.cos(), 3.0 * r * turn.sin(), uniform(rng, -0.5, 1.5) * r);
        let attachment = Vector3::new(r * turn.cos(), r * turn.sin(), 0.2 * r);
        Self { anchor: anchor.into(), attachment: attachment.into(), stiffness: 2e5, stretch: 1e-4 }
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        let (anchor, attachment) = (Vector3::from(self.anchor), Vector3::from(self.attachment));
        let pose = &moment.situation.pose;
        let reach = anchor - pose.translation - pose.rotation() * attachment;
        let free_length = reach.norm() - self.stretch;
        setup.cables.push(Cable { anchor, attachment, stiffness: self.stiffness, free_length });
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { stiffness: self.stiffness * factor, ..*self }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("cable", json!((self.anchor, self.attachment, self.stiffness, self.stretch)))]
    }
}
