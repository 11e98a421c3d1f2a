//! `load-offset`: the load acts beside the mobile origin.

use hexbench_core::{Vector3, Vector6};

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, ParameterInfo, Rich, Scale, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

pub(super) struct LoadOffset;

static INFO: TermInfo = TermInfo {
    id: "load-offset",
    title: "The load acts away from the mobile origin",
    chapter: Chapter::Load,
    physics: "The load acts at a point of the platform other than the mobile origin.",
    equation: "dM = (R r') x F, in both states",
    source: "Kalas et al. 2018, experimental setup (stacked masses)",
    shows: "lateral loads or tilts are measured",
    how_to_isolate: "tilt the platform under the load, or pull sideways",
    parameters: &[
        ParameterInfo::new("x", "mm", 1e3, Scale::Radius, false),
        ParameterInfo::new("y", "mm", 1e3, Scale::Radius, false),
        ParameterInfo::new("z", "mm", 1e3, Scale::Radius, false),
    ],
    shape: None,
    needs: &[],
    rich: Rich::None,
};

impl Term for LoadOffset {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        let (rotation, force) = (at.place.rotation, at.wrench.force - at.reference.force);
        for k in 0..3 {
            let moment = rotation.column(k).cross(&force);
            out.push(Action::Wrench(Vector6::new(0.0, 0.0, 0.0, moment.x, moment.y, moment.z)));
        }
    }

    fn calibrate(&self, values: &[f64], machine: &mut Machine) {
        machine.load_point += Vector3::from_column_slice(values);
    }

    fn calibrates(&self) -> bool {
        true
    }
}
