//! `leg-asymmetry`: tension differs from compression.

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, ParameterInfo, Rich, Scale, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

pub(super) struct LegAsymmetry;

static INFO: TermInfo = TermInfo {
    id: "leg-asymmetry",
    title: "Tension differs from compression",
    chapter: Chapter::Legs,
    physics: "A leg is more compliant when it is pulled than when it is pushed.",
    equation: "e = c_t (max(f, 0) - max(f0, 0))",
    source: "Kalas et al. 2018, future work: legs in tension",
    shows: "some legs are pulled",
    how_to_isolate: "choose loads that pull on legs that are otherwise pushed",
    parameters: &[ParameterInfo::new("tension-compliance", "nm/N", 1e9, Scale::Compliance, false)],
    shape: None,
    needs: &[],
    rich: Rich::PerLeg,
};

impl Term for LegAsymmetry {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        out.push(Action::Elongation(at.force.map(|f| f.max(0.0)) - at.reference_force.map(|f| f.max(0.0))));
    }
}
