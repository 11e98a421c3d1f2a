//! `platform-compliance`: the platform plate yields.

use hexbench_core::Vector3;

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, ParameterInfo, Rich, Scale, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::body::YieldingBody;
use crate::machine::geometry::Machine;

pub(super) struct PlatformCompliance;

static INFO: TermInfo = TermInfo {
    id: "platform-compliance",
    title: "The platform plate yields",
    chapter: Chapter::Structure,
    physics: "The plate between the legs and the measured targets moves as a rigid body on six springs at the mobile origin, mobile axes.",
    equation: "[v; w] = R C R' [F; M]",
    source: "Dasgupta and Mruthyunjaya 2000, Mech. Mach. Theory 35 (platform flexibility)",
    shows: "the direction of the load varies relative to the platform",
    how_to_isolate: "rotate the platform under the same load: the plate rotates with it, the base does not",
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

impl Term for PlatformCompliance {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        let body = body(at);
        out.extend((0..6).map(|k| body.direct(k)));
    }

    fn rich_actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        out.extend(body(at).cross_actions());
    }

    fn together(&self, _: &Machine, at: &Condition, values: &[f64]) -> Option<Action> {
        Some(body(at).together(values))
    }
}

fn body(at: &Condition) -> YieldingBody {
    YieldingBody::new(Action::Plate, at, |place| (place.rotation, Vector3::zeros()))
}
