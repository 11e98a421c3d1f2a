//! A body on springs that carries the whole machine or the measured targets.

use hexbench_core::{Matrix3, Vector3, Vector6};

use crate::effects::chain::Action;
use crate::estimation::campaign::Condition;
use crate::machine::placement::Placement;

/// Rigid motion of a body under the change of the transported wrench, in its own axes at its own center.
pub(crate) struct YieldingBody {
    act: fn(Vector6) -> Action,
    axes: Matrix3,
    lever: Vector3,
    wrench: Vector6,
}

impl YieldingBody {
    /// A body whose axes (to fixed axes) and whose lever from its center to the mobile origin (fixed axes, m) follow the platform as
    /// `place` says: what it carries is taken where it is in either state. `act`: what its motion does.
    pub(crate) fn new(
        act: fn(Vector6) -> Action,
        at: &Condition,
        place: impl Fn(&Placement) -> (Matrix3, Vector3),
    ) -> Self {
        let [reference, loaded] = at.states.map(|state| {
            let (axes, lever) = place(&state.place);
            let (force, moment) = (state.wrench.fixed_rows::<3>(0), state.wrench.fixed_rows::<3>(3));
            let (f, m) = (axes.tr_mul(&force), axes.tr_mul(&(moment + lever.cross(&force))));
            Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z)
        });
        let (axes, lever) = place(&at.place);
        Self { act, axes, lever, wrench: loaded - reference }
    }

    /// Motion of the mobile origin by a unit diagonal compliance `C_kk`.
    pub(crate) fn direct(&self, k: usize) -> Action {
        self.motion(&Vector6::ith(k, self.wrench[k]))
    }

    /// Motions by the fifteen off-diagonal compliances `C_ij = C_ji`, `i < j`, row by row.
    pub(crate) fn cross_actions(&self) -> impl Iterator<Item = Action> {
        pairs().map(|(i, j)| {
            let mut twist = Vector6::zeros();
            twist[i] = self.wrench[j];
            twist[j] = self.wrench[i];
            self.motion(&twist)
        })
    }

    /// Motion by six diagonal compliances, and by the fifteen others where there are so many values, all at once.
    pub(crate) fn together(&self, compliances: &[f64]) -> Action {
        let (direct, cross) = compliances.split_at(6);
        let mut twist = Vector6::from_fn(|k, _| direct[k] * self.wrench[k]);
        for ((i, j), compliance) in pairs().zip(cross) {
            twist[i] += compliance * self.wrench[j];
            twist[j] += compliance * self.wrench[i];
        }
        self.motion(&twist)
    }

    fn motion(&self, twist: &Vector6) -> Action {
        let rotation = self.axes * twist.fixed_rows::<3>(3);
        let shift = self.axes * twist.fixed_rows::<3>(0) + rotation.cross(&self.lever);
        (self.act)(Vector6::new(shift.x, shift.y, shift.z, rotation.x, rotation.y, rotation.z))
    }
}

/// Places of the off-diagonal compliances, row by row.
fn pairs() -> impl Iterator<Item = (usize, usize)> {
    (0..6).flat_map(|i| (i + 1..6).map(move |j| (i, j)))
}
