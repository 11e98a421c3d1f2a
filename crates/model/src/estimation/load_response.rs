//! How the platform yields to an error of its load.

use hexbench_core::{Matrix6, Vector6};

use crate::estimation::campaign::Condition;
use crate::estimation::linearization::Linearization;
use crate::estimation::noise::Symmetric6;

/// Relative difference up to which responses count as alike.
const ALIKE: f64 = 0.05;

/// Legs of their own compliance, in series with one body that yields alike at all poses:
///
/// ```text
/// M = J C J' + X' E X,   X = [I 0; [p]x I]
/// ```
///
/// with the platform Jacobian `J`, and `X`, which moves a wrench from the mobile origin `p` to the fixed one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadResponse {
    /// `C`, m/N.
    springs: [f64; 6],
    /// `E`, at the fixed origin, fixed axes.
    body: Symmetric6,
}

impl LoadResponse {
    /// That of a linearized machine; what yields beside the springs counts as it does on the average of all conditions.
    pub(crate) fn of(lin: &Linearization, springs: &Vector6) -> Self {
        let all = lin.conditions.iter().zip(lin.motions_by_load());
        let sum: Matrix6 = all
            .map(|(at, motion)| {
                let back = to_fixed_origin(at, -1.0);
                back.transpose() * (motion - of_legs(at, springs)) * back
            })
            .sum();
        let mean = sum / lin.conditions.len().max(1) as f64;
        Self { springs: (*springs).into(), body: Symmetric6::new(&mean) }
    }

    /// True when a machine yields nearly as another.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        let near = |off: f64, whole: f64| off <= ALIKE * whole;
        let springs = [self, other].map(|one| Vector6::from(one.springs));
        let bodies = [self, other].map(|one| one.body.matrix());
        near((springs[0] - springs[1]).norm(), springs[1].norm())
            && near((bodies[0] - bodies[1]).norm(), bodies[1].norm())
    }

    /// Geometric twist of the platform at the mobile origin per component of the load.
    pub(crate) fn motion(&self, at: &Condition) -> Matrix6 {
        let carry = to_fixed_origin(at, 1.0);
        of_legs(at, &Vector6::from(self.springs)) + carry.transpose() * self.body.matrix() * carry
    }
}

/// `J C J'`.
fn of_legs(at: &Condition, springs: &Vector6) -> Matrix6 {
    let j = &at.legs.platform_jacobian;
    j * Matrix6::from_diagonal(springs) * j.transpose()
}

/// `X`, or, with a sign of -1, its inverse.
fn to_fixed_origin(at: &Condition, sign: f64) -> Matrix6 {
    let mut carry = Matrix6::identity();
    carry.fixed_view_mut::<3, 3>(3, 0).copy_from(&(at.place.translation.cross_matrix() * sign));
    carry
}
