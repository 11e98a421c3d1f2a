//! Dry friction along the legs: `joint-friction`.
//!
//! The leg force is the spring's plus the slider's. The slider gives way at +-`f_c`, so the spring force lags behind the leg
//! force by at most `f_c`, on the side from which it came (play operator). The unloaded machine starts with all sliders
//! free of force; each row is its own path from there.
//!
//! Before it gives way a slider is an elastic bristle; the independent program behind the reference cases has it twenty
//! times as stiff as the leg spring, which its stated sizes of the effect confirm to ten digits (`tests/truth/reference_cases.rs`).

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows};
use crate::{Instant, Setup};

/// Dry friction along the legs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointFriction {
    /// Force `f_c` at which a slider gives way, N.
    pub slider_force: f64,
    /// Stiffness of the slider while it holds, over that of the leg spring; none: rigid.
    pub stick_ratio: Option<f64>,
}

impl Registered for JointFriction {
    const ID: &'static str = "joint-friction";
    const TITLE: &'static str = "Dry friction along the legs";
    const PHYSICS: &'static str = "a slider beside each leg spring holds up to f_c";
    const SHOWS: Shows = Shows::Deflection;

    fn draw(_: &Hexapod, _: &mut Pcg64) -> Self {
        Self { slider_force: 1.0, stick_ratio: Some(20.0) }
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        for law in &mut setup.laws {
            law.slider_force += self.slider_force;
            law.slider_ratio = self.stick_ratio.unwrap_or(f64::INFINITY);
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { slider_force: self.slider_force * factor, ..*self }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("friction", json!(self.slider_force)), ("friction_stick_ratio", json!(self.stick_ratio))]
    }
}
