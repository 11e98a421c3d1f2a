//! `target-offset`: the measured point is not the mobile origin.

use hexbench_core::{Matrix6, Vector3};

use crate::effects::chain::Action;
use crate::effects::term::{Chapter, ParameterInfo, Rich, Scale, Term, TermInfo};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

pub(super) struct TargetOffset;

static INFO: TermInfo = TermInfo {
    id: "target-offset",
    title: "The measured point is not the mobile origin",
    chapter: Chapter::Metrology,
    physics: "The targets are registered to a point other than the mobile origin, so rotations appear as translations.",
    equation: "dt = (R_loaded - R_ref) r'",
    source: "Kalas et al. 2018, fig. 5 (balls registered against reference holes)",
    shows: "the deflection has rotations",
    how_to_isolate: "load with moments, which rotate the platform more than they translate it",
    parameters: &[
        ParameterInfo::new("x", "mm", 1e3, Scale::Radius, false),
        ParameterInfo::new("y", "mm", 1e3, Scale::Radius, false),
        ParameterInfo::new("z", "mm", 1e3, Scale::Radius, false),
    ],
    shape: None,
    needs: &[],
    rich: Rich::None,
};

impl Term for TargetOffset {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn is_of_metrology(&self) -> bool {
        true
    }

    fn is_part_of_target_frame(&self) -> bool {
        true
    }

    fn actions(&self, _: &Machine, at: &Condition, _: f64, out: &mut Vec<Action>) {
        for k in 0..3 {
            let lever: Vector3 = at.place.rotation.column(k).into_owned();
            let mut shift = Matrix6::zeros();
            shift.fixed_view_mut::<3, 3>(0, 3).copy_from(&-lever.cross_matrix());
            out.push(Action::Target(Box::new(shift)));
        }
    }
}
