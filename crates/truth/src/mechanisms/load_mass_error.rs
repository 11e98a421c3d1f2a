//! A mass nobody counted hangs on the loaded platform: `out:load-mass-error`.
//!
//! A shackle or tray comes with every load but is not in the list of loads; the reference state is without it.

use hexbench_core::Hexapod;
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::{Registered, Shows};
use crate::{Instant, Setup};

/// A mass nobody counted hangs on the loaded platform.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadMassError {
    /// Mass, kg.
    pub mass: f64,
}

impl Registered for LoadMassError {
    const ID: &'static str = "out:load-mass-error";
    const TITLE: &'static str = "A mass nobody counted hangs on the loaded platform";
    const PHYSICS: &'static str = "loaded force += (0, 0, -mass g)";
    const SHOWS: Shows = Shows::Outside;

    fn draw(_: &Hexapod, _: &mut Pcg64) -> Self {
        Self { mass: 0.5 }
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        const GRAVITY_M_PER_S2: f64 = 9.81;
        if moment.is_loaded() {
            setup.wrench.force.z -= self.mass * GRAVITY_M_PER_S2;
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { mass: self.mass * factor }
    }

    fn parameters(&self) -> Vec<(&'static str, Value)> {
        vec![("load_mass_error", json!(self.mass))]
    }
}
