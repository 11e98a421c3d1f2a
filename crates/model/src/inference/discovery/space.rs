//! What laws meet in the readings, for each kind of thing they act on.

use hexbench_core::Vector6;

use crate::effects::term::Natural;
use crate::effects::user_term::PartKind;
use crate::estimation::basis::{orthonormal, project};
use crate::estimation::linearization::{Linearization, ModelPoint, beside};
use crate::estimation::noise::NoiseLevel;
use crate::inference::candidates::target;
use crate::inference::evidence::Likelihood;
use crate::inference::leg_sums::{ElongationSpace, WhitenedTwice};

/// Spaces of everything laws act on.
pub(crate) struct Spaces {
    /// Worth of a drop of chi-square.
    pub(crate) likelihood: Likelihood,
    elongation: ElongationSpace,
    bodies: [ElongationSpace; 3],
}

impl Spaces {
    /// Of a linearized model; `point` holds what is in it beside the springs.
    pub(crate) fn new(lin: &Linearization, point: &ModelPoint, level: NoiseLevel, natural: &Natural) -> Self {
        let mut columns = vec![lin.common_block()];
        columns.extend(point.active.iter().map(|a| lin.term_block(a.term.as_ref(), a.rich, a.shape)));
        let basis = orthonormal(beside(&columns));
        let mut residual = target(lin, point);
        project(&basis, &mut residual);
        let yy = residual.norm_squared();
        let equations = lin.numbers() - basis.ncols() as f64;
        let likelihood = Likelihood { yy, equations, level };
        let twice = WhitenedTwice::of(lin, basis, residual);
        let space = |kind: PartKind| {
            let readers = lin.readers_of(|c, k| {
                let mut one = Vector6::zeros();
                one[k] = natural_unit(kind, k, natural);
                kind.action(c, &one)
            });
            ElongationSpace::of(&readers, &twice, natural.compliance * natural.force)
        };
        Self { likelihood, elongation: space(PartKind::Elongation), bodies: PartKind::BODIES.map(space) }
    }

    /// That of one kind.
    pub(crate) fn of(&self, kind: PartKind) -> &ElongationSpace {
        PartKind::BODIES.iter().position(|k| *k == kind).map_or(&self.elongation, |k| &self.bodies[k])
    }
}

/// SI units of component `k` that are natural to one meter of elongation: rad on the platform radius, N on the compliance of a leg.
pub(crate) fn natural_unit(kind: PartKind, k: usize, natural: &Natural) -> f64 {
    match (kind, k < 3) {
        (PartKind::Elongation, _) | (PartKind::BaseMotion | PartKind::PlatformMotion, true) => 1.0,
        (PartKind::BaseMotion | PartKind::PlatformMotion, false) => 1.0 / natural.radius,
        (PartKind::Wrench, true) => 1.0 / natural.compliance,
        (PartKind::Wrench, false) => natural.radius / natural.compliance,
    }
}
