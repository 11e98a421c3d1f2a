//! A cable pulls at the platform: `out:cable`.
//!
//! Drag chain, hose or safety rope: a spring under tension whose pull turns as the platform moves. It pulls in both states, so
//! only its change of length between them shows.

use hexbench_core::{Hexapod, Vector3};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Effect, Mechanism, Shows, parsed, uniform};
use crate::{Moment, Setup, setup::Cable};

/// Its entry in the registry.
pub(super) const EFFECT: Effect = Effect {
    id: "out:cable",
    title: "A cable pulls at the platform",
    physics: "spring between a fixed point and a point of the platform",
    shows: Shows::Outside,
    draw,
    parse: parsed::<CablePull>,
};

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
    /// Length without force, m.
    pub free_length: f64,
}

impl Mechanism for CablePull {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, _: &Moment<'_>, setup: &mut Setup) {
        setup.cables.push(Cable {
            anchor: self.anchor.into(),
            attachment: self.attachment.into(),
            stiffness: self.stiffness,
            free_length: self.free_length,
        });
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { stiffness: self.stiffness * factor, ..*self })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([(
            "cable".to_owned(),
            json!((self.anchor, self.attachment, self.stiffness, self.free_length)),
        )])
    }
}

fn draw(hexapod: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    const STRETCH: f64 = 1e-4;
    let r = hexapod.platform_radius();
    let turn = uniform(rng, 0.0, std::f64::consts::TAU);
    let anchor = Vector3::new(3.0 * r * turn.cos(), 3.0 * r * turn.sin(), uniform(rng, -0.5, 1.5) * r);
    let attachment = Vector3::new(r * turn.cos(), r * turn.sin(), 0.2 * r);
    let free_length = (anchor - attachment).norm() * (1.0 - STRETCH);
    Box::new(CablePull { anchor: anchor.into(), attachment: attachment.into(), stiffness: 2e5, free_length })
}
