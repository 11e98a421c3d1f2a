//! A body on springs that carries the whole machine or the measured targets.

use hexbench_core::{Matrix3, Vector3, Vector6};

use crate::effects::chain::Action;
use crate::estimation::campaign::Condition;

/// Rigid motion of a body under the transported wrench, in its own axes at its own centre.
pub(crate) struct YieldingBody {
    axes: Matrix3,
    lever: Vector3,
    wrench: Vector6,
}

impl YieldingBody {
    /// `axes`: body axes to fixed axes; `lever`: from the centre of the body to the mobile origin, fixed axes, m.
    pub(crate) fn new(at: &Condition, axes: Matrix3, lever: Vector3) -> Self {
        let force = at.wrench.force - at.reference.force;
        let moment = at.wrench.moment - at.reference.moment + lever.cross(&force);
        let (f, m) = (axes.tr_mul(&force), axes.tr_mul(&moment));
        Self { axes, lever, wrench: Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z) }
    }

    /// Motion of the mobile origin by a unit diagonal compliance `C_kk`.
    pub(crate) fn direct(&self, k: usize) -> Action {
        self.motion(&Vector6::ith(k, self.wrench[k]))
    }

    /// Motions by the fifteen off-diagonal compliances `C_ij = C_ji`, `i < j`, row by row.
    pub(crate) fn cross_actions(&self) -> impl Iterator<Item = Action> {
        (0..6).flat_map(move |i| (i + 1..6).map(move |j| (i, j))).map(|(i, j)| {
            let mut twist = Vector6::zeros();
            twist[i] = self.wrench[j];
            twist[j] = self.wrench[i];
            self.motion(&twist)
        })
    }

    fn motion(&self, twist: &Vector6) -> Action {
        let rotation = self.axes * twist.fixed_rows::<3>(3);
        let shift = self.axes * twist.fixed_rows::<3>(0) + rotation.cross(&self.lever);
        Action::Twist(Vector6::new(shift.x, shift.y, shift.z, rotation.x, rotation.y, rotation.z))
    }
}
