//! `thermal-expansion`: the legs grow with temperature.
//!
//! The temperature of the file is that of the legs, or differs from it by the same amount in every row: a thermometer elsewhere on the
//! machine, or a zero of its own.

use std::sync::Arc;

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, Need, ParameterInfo, Rich, Scale, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

/// Prior share of temperatures that are off by the same amount in every row.
const OFF: f64 = 0.15;

const COEFFICIENT: ParameterInfo = ParameterInfo::new("coefficient", "um/(m K)", 1e6, Scale::Fixed(50e-6), false)
    .if_negative("legs shorten as they grow warm only where what holds the readings grows more: check the sign of delta_T_K");

const INFO: TermInfo = TermInfo {
    id: "thermal-expansion",
    title: "The legs grow with temperature",
    chapter: Chapter::Legs,
    physics: "Every leg expands in proportion to its length and to the temperature change.",
    equation: "e = alpha q delta_T",
    source: "Mayr et al. 2012, CIRP Annals 61 (thermal issues in machine tools)",
    shows: "delta_T_K varies",
    how_to_isolate: "repeat one load while the temperature changes by a kelvin or more",
    parameters: &[COEFFICIENT],
    shape: None,
    needs: &[Need::DeltaT],
    rich: Rich::PerLeg,
};

const OFF_INFO: TermInfo = TermInfo {
    title: "The legs grow with temperature, which is off by the same amount in every row",
    equation: "e = alpha q (delta_T + T_0); growth = alpha T_0",
    parameters: &[COEFFICIENT, ParameterInfo::new("growth", "um/m", 1e6, Scale::Fixed(50e-6), false)],
    rich: Rich::None,
    ..INFO
};

static VERSIONS: [TermInfo; 2] = [INFO, OFF_INFO];

/// Expansion by the temperature of the file, or by one that is off.
#[derive(Clone, Copy)]
pub(super) struct ThermalExpansion {
    is_off: bool,
}

/// The usual version.
pub(super) const THERMAL_EXPANSION: ThermalExpansion = ThermalExpansion { is_off: false };

impl Term for ThermalExpansion {
    fn info(&self) -> &TermInfo {
        &VERSIONS[usize::from(self.is_off)]
    }

    fn actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        out.push(Action::Elongation(at.commanded_lengths * at.delta_t));
        if self.is_off {
            out.push(Action::Elongation(at.commanded_lengths));
        }
    }

    fn version(&self) -> Option<&'static str> {
        self.is_off.then_some("offset")
    }

    fn versions(&self) -> Vec<(f64, Arc<dyn Term>)> {
        vec![(OFF, Arc::new(Self { is_off: true }))]
    }
}
