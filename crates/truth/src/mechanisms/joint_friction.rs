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
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, parsed};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "joint-friction",
    title: "Dry friction along the legs",
    physics: "a slider beside each leg spring holds up to f_c",
    shows: Shows::Deflection,
    draw,
    parse: parsed::<JointFriction>,
};

/// Dry friction along the legs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointFriction {
    /// Force `f_c` at which a slider gives way, N.
    pub slider_force: f64,
    /// Stiffness of the slider while it holds, over that of the leg spring; none: rigid.
    pub stick_ratio: Option<f64>,
}

impl Mechanism for JointFriction {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, _: &Instant<'_>, setup: &mut Setup) {
        for law in &mut setup.laws {
            law.slider_force += self.slider_force;
            law.slider_ratio = self.stick_ratio.unwrap_or(f64::INFINITY);
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { slider_force: self.slider_force * factor, ..*self })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([
            ("friction".to_owned(), json!(self.slider_force)),
            ("friction_stick_ratio".to_owned(), json!(self.stick_ratio)),
        ])
    }
}

fn draw(_: &Hexapod, _: &mut Pcg64) -> Box<dyn Mechanism> {
    Box::new(JointFriction { slider_force: 1.0, stick_ratio: Some(20.0) })
}
