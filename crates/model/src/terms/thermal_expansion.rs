//! `thermal-expansion`: the legs grow with temperature.

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, Need, ParameterInfo, Rich, Scale, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

pub(super) struct ThermalExpansion;

static INFO: TermInfo = TermInfo {
    id: "thermal-expansion",
    title: "The legs grow with temperature",
    chapter: Chapter::Legs,
    physics: "Every leg expands in proportion to its length and to the temperature change.",
    equation: "e = alpha q delta_T",
    source: "Mayr et al. 2012, CIRP Annals 61 (thermal issues in machine tools)",
    shows: "delta_T_K varies",
    how_to_isolate: "repeat one load while the temperature changes by a kelvin or more",
    parameters: &[ParameterInfo::new("coefficient", "um/(m K)", 1e6, Scale::Fixed(50e-6), false).if_negative(
        "legs shorten as they grow warm only where what holds the readings grows more: check the sign of delta_T_K",
    )],
    shape: None,
    needs: &[Need::DeltaT],
    rich: Rich::PerLeg,
};

impl Term for ThermalExpansion {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        out.push(Action::Elongation(at.commanded_lengths * at.delta_t));
    }
}
