//! A body on springs that carries the whole machine or the measured targets.

use std::ops::Range;
use std::sync::Arc;

use hexbench_core::{Matrix3, Vector3, Vector6, pairs_of_six};

use crate::effects::chain::Action;
use crate::effects::term::{ParameterInfo, Scale, Term};
use crate::estimation::campaign::Condition;
use crate::machine::placement::Placement;

/// Compliances of the six springs of a body.
pub(crate) static COMPLIANCES: [ParameterInfo; 6] = [
    ParameterInfo::new("translation-x", "nm/N", 1e9, Scale::Compliance, true),
    ParameterInfo::new("translation-y", "nm/N", 1e9, Scale::Compliance, true),
    ParameterInfo::new("translation-z", "nm/N", 1e9, Scale::Compliance, true),
    ParameterInfo::new("rotation-x", "urad/(N m)", 1e6, Scale::AngularCompliance, true),
    ParameterInfo::new("rotation-y", "urad/(N m)", 1e6, Scale::AngularCompliance, true),
    ParameterInfo::new("rotation-z", "urad/(N m)", 1e6, Scale::AngularCompliance, true),
];

/// Prior share of bodies that only translate, and of those that only rotate.
const ONE_KIND: f64 = 0.15;

/// Springs of a body that yield.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Springs {
    /// All six.
    All,
    /// Those against translation: the body cannot rotate.
    Translation,
    /// Those against rotation: the body cannot translate.
    Rotation,
}

impl Springs {
    /// Their places among the six.
    pub(crate) const fn range(self) -> Range<usize> {
        match self {
            Self::All => 0..6,
            Self::Translation => 0..3,
            Self::Rotation => 3..6,
        }
    }

    /// Their compliances.
    pub(crate) const fn parameters(self) -> &'static [ParameterInfo] {
        let (translation, rotation) = COMPLIANCES.split_at(3);
        match self {
            Self::All => &COMPLIANCES,
            Self::Translation => translation,
            Self::Rotation => rotation,
        }
    }

    /// The word for a version of a term with them; none where all yield.
    pub(crate) const fn version(self) -> Option<&'static str> {
        match self {
            Self::All => None,
            Self::Translation => Some("translation"),
            Self::Rotation => Some("rotation"),
        }
    }

    /// Versions of a term that compete beside the one with all six springs, with their prior shares. A rotation that readings determine
    /// to be zero would count against the effect otherwise.
    pub(crate) fn versions(with: impl Fn(Self) -> Arc<dyn Term>) -> Vec<(f64, Arc<dyn Term>)> {
        [Self::Translation, Self::Rotation].map(|springs| (ONE_KIND, with(springs))).into()
    }
}

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

    /// Motions of the mobile origin by a unit diagonal compliance `C_kk` of each of these springs.
    pub(crate) fn direct(&self, springs: Springs) -> impl Iterator<Item = Action> {
        springs.range().map(|k| self.motion(&Vector6::ith(k, self.wrench[k])))
    }

    /// Motions by the fifteen off-diagonal compliances `C_ij = C_ji`, `i < j`, row by row.
    pub(crate) fn cross_actions(&self) -> impl Iterator<Item = Action> {
        pairs_of_six().map(|(i, j)| {
            let mut twist = Vector6::zeros();
            twist[i] = self.wrench[j];
            twist[j] = self.wrench[i];
            self.motion(&twist)
        })
    }

    /// Motion by the diagonal compliances of these springs, and by the fifteen others where there are so many values, all at once.
    pub(crate) fn together(&self, springs: Springs, compliances: &[f64]) -> Action {
        let (direct, cross) = compliances.split_at(springs.range().len());
        let mut twist = Vector6::zeros();
        for (k, compliance) in springs.range().zip(direct) {
            twist[k] = compliance * self.wrench[k];
        }
        for ((i, j), compliance) in pairs_of_six().zip(cross) {
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
