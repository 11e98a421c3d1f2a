//! A mass nobody counted hangs on the loaded platform: `out:load-mass-error`.
//!
//! A shackle or tray comes with every load but is not in the list of loads; the reference state is without it.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::{Mechanism, MechanismEntry, Shows, parsed};
use crate::{Instant, Setup};

/// Its entry in the registry.
pub(super) const EFFECT: MechanismEntry = MechanismEntry {
    id: "out:load-mass-error",
    title: "A mass nobody counted hangs on the loaded platform",
    physics: "loaded force += (0, 0, -mass g)",
    shows: Shows::Outside,
    draw,
    parse: parsed::<LoadMassError>,
};

/// A mass nobody counted hangs on the loaded platform.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadMassError {
    /// Mass, kg.
    pub mass: f64,
}

impl Mechanism for LoadMassError {
    fn id(&self) -> &'static str {
        EFFECT.id
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        const GRAVITY_M_PER_S2: f64 = 9.81;
        if moment.is_loaded() {
            setup.wrench.force.z -= self.mass * GRAVITY_M_PER_S2;
        }
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Self { mass: self.mass * factor })
    }

    fn parameters(&self) -> Map<String, Value> {
        Map::from_iter([("load_mass_error".to_owned(), json!(self.mass))])
    }
}

fn draw(_: &Hexapod, _: &mut Pcg64) -> Box<dyn Mechanism> {
    Box::new(LoadMassError { mass: 0.5 })
}
