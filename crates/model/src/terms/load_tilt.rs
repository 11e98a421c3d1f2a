//! `load-tilt`: the load is not quite aligned.

use hexbench_core::{Vector3, Vector6};

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, ParameterInfo, Rich, Scale, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

pub(super) struct LoadTilt;

static INFO: TermInfo = TermInfo {
    id: "load-tilt",
    title: "The load is not quite aligned",
    chapter: Chapter::Load,
    physics: "All forces are rotated by two small angles, about the x and the y axis of the fixed frame; moments are not.",
    equation: "dF = [theta_x, theta_y, 0] x F, in both states",
    source: "JCGM 100:2008 (GUM), F.2.4 (misalignment of a quantity)",
    shows: "the leg forces are more sensitive to the tilt than to the size of the load",
    how_to_isolate: "load along several directions",
    parameters: &[
        ParameterInfo::new("about-x", "mrad", 1e3, Scale::Fixed(0.1), false),
        ParameterInfo::new("about-y", "mrad", 1e3, Scale::Fixed(0.1), false),
    ],
    shape: None,
    needs: &[],
    rich: Rich::None,
};

impl Term for LoadTilt {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        let force = at.wrench.force - at.reference.force;
        for axis in [Vector3::x(), Vector3::y()] {
            let turned = axis.cross(&force);
            out.push(Action::Wrench(Vector6::new(turned.x, turned.y, turned.z, 0.0, 0.0, 0.0)));
        }
    }

    fn calibrate(&self, values: &[f64], machine: &mut Machine) {
        machine.load_tilt += Vector3::new(values[0], values[1], 0.0);
    }

    fn calibrates(&self) -> bool {
        true
    }
}
