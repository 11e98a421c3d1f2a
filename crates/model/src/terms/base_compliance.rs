//! `base-compliance`: the foundation yields.

use std::sync::Arc;

use hexbench_core::Matrix3;

use crate::effects::body::{Springs, YieldingBody};
use crate::effects::chain::Action;
use crate::effects::term::{Chapter, Rich, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

/// A body on all its springs, or on some of them.
#[derive(Clone, Copy)]
pub(super) struct BaseCompliance {
    springs: Springs,
}

/// The usual version.
pub(super) const BASE_COMPLIANCE: BaseCompliance = BaseCompliance { springs: Springs::All };

const INFO: TermInfo = TermInfo {
    id: "base-compliance",
    title: "The foundation yields",
    chapter: Chapter::Structure,
    physics: "The base with all six base joints moves as a rigid body on six springs at the center of the base-joint plane.",
    equation: "[v_P; w] = C [F; M_P], M_P = M + (t - P) x F; the platform follows",
    source: "Kalas et al. 2018, list of suspects; Wallace, TPOINT (mount and pier flexure)",
    shows: "moments and lateral loads are measured",
    how_to_isolate: "load sideways and with moments at poses high above the base",
    parameters: Springs::All.parameters(),
    shape: None,
    needs: &[],
    rich: Rich::Full,
};

const TRANSLATION: TermInfo = TermInfo {
    title: "The foundation translates",
    equation: "v_P = C F, w = 0; the platform follows",
    parameters: Springs::Translation.parameters(),
    rich: Rich::None,
    ..INFO
};

const ROTATION: TermInfo = TermInfo {
    title: "The foundation rotates",
    equation: "v_P = 0, w = C M_P, M_P = M + (t - P) x F; the platform follows",
    parameters: Springs::Rotation.parameters(),
    rich: Rich::None,
    ..INFO
};

static VERSIONS: [TermInfo; 3] = [INFO, TRANSLATION, ROTATION];

impl Term for BaseCompliance {
    fn info(&self) -> &TermInfo {
        &VERSIONS[self.springs as usize]
    }

    fn actions(&self, machine: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        let body = body(machine, at);
        out.extend(body.direct(self.springs));
    }

    fn rich_actions(&self, machine: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        out.extend(body(machine, at).cross_actions());
    }

    fn together(&self, machine: &Machine, at: &Condition, values: &[f64]) -> Option<Action> {
        Some(body(machine, at).together(self.springs, values))
    }

    fn version(&self) -> Option<&'static str> {
        self.springs.version()
    }

    fn versions(&self) -> Vec<(f64, Arc<dyn Term>)> {
        Springs::versions(|springs| Arc::new(Self { springs }))
    }
}

fn body(machine: &Machine, at: &Condition) -> YieldingBody {
    YieldingBody::new(Action::Base, at, |place| {
        (Matrix3::identity(), place.translation - machine.base_centre)
    })
}
