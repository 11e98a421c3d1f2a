//! `platform-compliance`: the platform plate yields.

use std::sync::Arc;

use hexbench_core::Vector3;

use crate::effects::body::{Springs, YieldingBody};
use crate::effects::chain::Action;
use crate::effects::term::{Chapter, Rich, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

/// A body on all its springs, or on some of them.
#[derive(Clone, Copy)]
pub(super) struct PlatformCompliance {
    springs: Springs,
}

/// The usual version.
pub(super) const PLATFORM_COMPLIANCE: PlatformCompliance = PlatformCompliance { springs: Springs::All };

const INFO: TermInfo = TermInfo {
    id: "platform-compliance",
    title: "The platform plate yields",
    chapter: Chapter::Structure,
    physics: "The plate between the legs and the measured targets moves as a rigid body on six springs at the mobile origin, mobile axes.",
    equation: "[v; w] = R C R' [F; M]",
    source: "Dasgupta and Mruthyunjaya 2000, Mech. Mach. Theory 35 (platform flexibility)",
    shows: "the direction of the load varies relative to the platform",
    how_to_isolate: "rotate the platform under the same load: the plate rotates with it, the base does not",
    parameters: Springs::All.parameters(),
    shape: None,
    needs: &[],
    rich: Rich::Full,
};

const TRANSLATION: TermInfo = TermInfo {
    title: "The platform plate translates",
    equation: "v = R C R' F, w = 0",
    parameters: Springs::Translation.parameters(),
    rich: Rich::None,
    ..INFO
};

const ROTATION: TermInfo = TermInfo {
    title: "The platform plate rotates",
    equation: "v = 0, w = R C R' M",
    parameters: Springs::Rotation.parameters(),
    rich: Rich::None,
    ..INFO
};

static VERSIONS: [TermInfo; 3] = [INFO, TRANSLATION, ROTATION];

impl Term for PlatformCompliance {
    fn info(&self) -> &TermInfo {
        &VERSIONS[self.springs as usize]
    }

    fn actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        let body = body(at);
        out.extend(body.direct(self.springs));
    }

    fn rich_actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        out.extend(body(at).cross_actions());
    }

    fn together(&self, _: &Machine, at: &Condition, values: &[f64]) -> Option<Action> {
        Some(body(at).together(self.springs, values))
    }

    fn version(&self) -> Option<&'static str> {
        self.springs.version()
    }

    fn versions(&self) -> Vec<(f64, Arc<dyn Term>)> {
        Springs::versions(|springs| Arc::new(Self { springs }))
    }
}

fn body(at: &Condition) -> YieldingBody {
    YieldingBody::new(Action::Plate, at, |place| (place.rotation, Vector3::zeros()))
}
