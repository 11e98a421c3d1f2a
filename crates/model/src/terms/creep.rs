//! `creep`: the legs creep under load.

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, Need, ParameterInfo, Rich, Scale, Shape, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

pub(super) struct Creep;

static INFO: TermInfo = TermInfo {
    id: "creep",
    title: "The legs creep under load",
    chapter: Chapter::Legs,
    physics: "The compliance of every leg grows while the load rests on it.",
    equation: "e = chi c_i (f - f0) (1 - exp(-elapsed / tau))",
    source: "Findley, Lai and Onaran, Creep and Relaxation of Nonlinear Viscoelastic Materials, 1976, ch. 5",
    shows: "elapsed_s varies",
    how_to_isolate: "read the same load at once and again after several minutes",
    parameters: &[ParameterInfo::new("fraction", "%", 100.0, Scale::Fixed(1.0), true)],
    shape: Some(Shape { name: "time-constant", unit: "s", per_si: 1.0, bounds: [1e-2, 1e7] }),
    needs: &[Need::Elapsed],
    rich: Rich::PerLeg,
};

impl Term for Creep {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, _: &Machine, at: &Condition, shape: f64, out: &mut Vec<Action>) {
        out.push(Action::Force(at.spring_change() * (1.0 - (-at.elapsed / shape).exp())));
    }

    fn shape_grid(&self, conditions: &[Condition]) -> Vec<f64> {
        // From a third of the shortest to three times the longest wait.
        let waits = conditions.iter().map(|c| c.elapsed).filter(|&t| t > 0.0);
        let (short, long) = waits.fold((f64::INFINITY, 0.0_f64), |(a, b), t| (a.min(t), b.max(t)));
        if long <= 0.0 {
            return Vec::new();
        }
        let (first, last) = ((short / 3.0).max(long / 300.0), 3.0 * long);
        (0..8).map(|k| first * (last / first).powf(f64::from(k) / 7.0)).collect()
    }
}
