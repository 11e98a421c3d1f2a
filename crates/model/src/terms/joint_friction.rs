//! `joint-friction`: dry friction in legs and joints.

use hexbench_core::Vector6;

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, Need, ParameterInfo, Rich, Scale, Shape, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

pub(super) struct JointFriction;

static INFO: TermInfo = TermInfo {
    id: "joint-friction",
    title: "Dry friction in legs and joints",
    chapter: Chapter::Joints,
    physics: "A slider in parallel with each leg spring resists motion with up to f_c, so the spring force lags behind the leg force and depends on how the load was reached.",
    equation: "e = c (play(f) - play(f0)), play(f) kept within f -+ f_c along the path 0, f0, (overshoot), f",
    source: "Visintin, Differential Models of Hysteresis, 1994 (play operator); Armstrong-Helouvry et al., Automatica 30, 1994",
    shows: "both approach directions are measured",
    how_to_isolate: "read the same load once from below and once coming back from a higher load",
    parameters: &[ParameterInfo::new("force", "N", 1.0, Scale::Force, true)],
    shape: Some(Shape { name: "limit", unit: "N", per_si: 1.0, bounds: [1e-3, 1e6] }),
    needs: &[Need::Approach],
    rich: Rich::PerLeg,
};

impl Term for JointFriction {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, _: &Machine, at: &Condition, shape: f64, out: &mut Vec<Action>) {
        let lag = |leg: usize| {
            let [rest, loaded] = at.spring_forces_under(leg, shape);
            (loaded - rest - (at.path.load[leg] - at.path.reference[leg])) / shape
        };
        out.push(Action::Force(Vector6::from_fn(|leg, _| lag(leg))));
    }

    fn shape_grid(&self, conditions: &[Condition]) -> Vec<f64> {
        // The limit decides which legs slide at all: from nearly all of them to the strongest only.
        let typical = typical_force(conditions);
        (0..9).map(|k| typical * 0.003 * 2f64.powi(k)).collect()
    }

    fn shape_is_parameter(&self) -> bool {
        true
    }

    fn calibrate(&self, values: &[f64], machine: &mut Machine) {
        let own = |leg: usize| values.get(1 + leg).copied().unwrap_or(0.0);
        machine.friction_limits += Vector6::from_fn(|leg, _| values[0] + own(leg));
    }

    fn calibrates(&self) -> bool {
        true
    }
}

/// Root mean square leg force change over all conditions, N.
fn typical_force(conditions: &[Condition]) -> f64 {
    let sum: f64 = conditions.iter().map(|c| c.force_change().norm_squared()).sum();
    (sum / (6 * conditions.len().max(1)) as f64).sqrt().max(1e-3)
}
