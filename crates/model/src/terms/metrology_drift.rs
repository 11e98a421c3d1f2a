//! `metrology-drift`: the measurement drifts with time.
//!
//! What drifts are the numbers as the file states them: three coordinates, and three Euler angles or a rotation vector. Read with sensors,
//! the frame on which they stand drifts: three coordinates and a rotation vector.

use hexbench_core::Vector6;

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, Need, ParameterInfo, Rich, Scale, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

pub(super) struct MetrologyDrift;

static INFO: TermInfo = TermInfo {
    id: "metrology-drift",
    title: "The measurement drifts with time",
    chapter: Chapter::Metrology,
    physics: "The measuring machine drifts steadily between the reference and the loaded reading; each coordinate has a rate of its own.",
    equation: "dX = rates * elapsed",
    source: "Wallace, TPOINT; JCGM 100:2008 (GUM), F.1.1.2 (drift between observations)",
    shows: "elapsed_s varies",
    how_to_isolate: "repeat one load after a short and after a long wait",
    parameters: &[
        ParameterInfo::new("translation-rate-x", "nm/s", 1e9, Scale::PerElapsed(20e-6), false),
        ParameterInfo::new("translation-rate-y", "nm/s", 1e9, Scale::PerElapsed(20e-6), false),
        ParameterInfo::new("translation-rate-z", "nm/s", 1e9, Scale::PerElapsed(20e-6), false),
        ParameterInfo::new("rotation-rate-x", "nrad/s", 1e9, Scale::PerElapsed(200e-6), false),
        ParameterInfo::new("rotation-rate-y", "nrad/s", 1e9, Scale::PerElapsed(200e-6), false),
        ParameterInfo::new("rotation-rate-z", "nrad/s", 1e9, Scale::PerElapsed(200e-6), false),
    ],
    shape: None,
    needs: &[Need::Elapsed],
    rich: Rich::None,
};

impl Term for MetrologyDrift {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn is_of_metrology(&self) -> bool {
        true
    }

    fn actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        out.extend((0..6).map(|k| Action::Reading(at.as_read(&Vector6::ith(k, at.elapsed)))));
    }
}
