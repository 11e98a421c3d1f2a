//! `leg-nonlinearity`: nonlinear leg spring.

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, Natural, ParameterInfo, Rich, Scale, Shape, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

/// Force at which the extra elongation is stated, N.
const STATED_AT: f64 = 100.0;

pub(super) struct LegNonlinearity;

static INFO: TermInfo = TermInfo {
    id: "leg-nonlinearity",
    title: "Nonlinear leg spring",
    chapter: Chapter::Legs,
    physics: "Rolling contacts stiffen under load (Hertz, p = 2/3); other parts soften. The size is the extra elongation at 100 N.",
    equation: "e = e100 (sgn(f) |f / 100 N|^p - the same at f0)",
    source: "Johnson, Contact Mechanics, 1985, ch. 4; Harris and Kotzalas, Rolling Bearing Analysis, 2006",
    shows: "three or more load levels are measured",
    how_to_isolate: "apply the same direction of load at five levels, small ones included",
    parameters: &[ParameterInfo::new("elongation-at-100-N", "um", 1e6, Scale::Elongation, false)],
    shape: Some(Shape { name: "exponent", unit: "1", per_si: 1.0, bounds: [0.4, 3.0] }),
    needs: &[],
    rich: Rich::PerLeg,
};

impl Term for LegNonlinearity {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, _: &Machine, at: &Condition, shape: f64, out: &mut Vec<Action>) {
        let power = |f: f64| f.signum() * (f.abs() / STATED_AT).powf(shape);
        out.push(Action::Elongation(at.force.map(power) - at.reference_force.map(power)));
    }

    fn natural_sizes(&self, natural: &Natural, shape: f64) -> Vec<f64> {
        // The elongation at this force of what has the natural size under the forces that act.
        vec![natural.size(Scale::Elongation) * (STATED_AT / natural.force).powf(shape)]
    }

    fn shape_bounds(&self, start: f64) -> [f64; 2] {
        // Around 1 it is the spring itself.
        if start < 1.0 { [0.4, 0.9] } else { [1.15, 3.0] }
    }

    fn shape_grid(&self, _: &[Condition]) -> Vec<f64> {
        vec![0.4, 0.5, 0.6, 2.0 / 3.0, 0.75, 0.85, 1.2, 1.5, 1.75, 2.0, 2.5, 3.0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn its_natural_size_is_the_elongation_of_the_spring_under_the_forces_that_act() {
        for (force, shape) in [(5.0, 1.5), (5.0, 2.0 / 3.0), (100.0, 2.0), (2e4, 0.5)] {
            let natural = Natural { compliance: 2e-8, force, radius: 0.1, length: 0.5, elapsed: 10.0 };
            let elongation =
                LegNonlinearity.natural_sizes(&natural, shape)[0] * (force / 100.0_f64).powf(shape);
            assert!((elongation / (2e-8 * force) - 1.0).abs() < 1e-12, "{force} {shape}: {elongation}");
        }
    }
}
