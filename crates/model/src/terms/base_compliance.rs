//! `base-compliance`: the foundation yields.

use hexbench_core::Matrix3;

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, ParameterInfo, Rich, Scale, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::body::YieldingBody;
use crate::machine::geometry::Machine;

pub(super) struct BaseCompliance;

static INFO: TermInfo = TermInfo {
    id: "base-compliance",
    title: "The foundation yields",
    chapter: Chapter::Structure,
    physics: "The base with all six base joints moves as a rigid body on six springs at the center of the base-joint plane.",
    equation: "[v_P; w] = C [F; M_P], M_P = M + (t - P) x F; the platform follows",
    source: "Kalas et al. 2018, list of suspects; Wallace, TPOINT (mount and pier flexure)",
    shows: "moments and lateral loads are measured",
    how_to_isolate: "load sideways and with moments at poses high above the base",
    parameters: &[
        ParameterInfo::new("translation-x", "nm/N", 1e9, Scale::Compliance, true),
        ParameterInfo::new("translation-y", "nm/N", 1e9, Scale::Compliance, true),
        ParameterInfo::new("translation-z", "nm/N", 1e9, Scale::Compliance, true),
        ParameterInfo::new("rotation-x", "urad/(N m)", 1e6, Scale::AngularCompliance, true),
        ParameterInfo::new("rotation-y", "urad/(N m)", 1e6, Scale::AngularCompliance, true),
        ParameterInfo::new("rotation-z", "urad/(N m)", 1e6, Scale::AngularCompliance, true),
    ],
    shape: None,
    needs: &[],
    rich: Rich::Full,
};

impl Term for BaseCompliance {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, machine: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        let body = body(machine, at);
        out.extend((0..6).map(|k| body.direct(k)));
    }

    fn rich_actions(&self, machine: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        out.extend(body(machine, at).cross_actions());
    }

    fn together(&self, machine: &Machine, at: &Condition, values: &[f64]) -> Option<Action> {
        Some(body(machine, at).together(values))
    }
}

fn body(machine: &Machine, at: &Condition) -> YieldingBody {
    YieldingBody::new(Action::Base, at, |place| {
        (Matrix3::identity(), place.translation - machine.base_centre)
    })
}
