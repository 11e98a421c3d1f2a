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
    compliances: [f64; 6],
    /// `E`, at the fixed origin, fixed axes.
    body: Symmetric6,
    /// Norm of `M` there, on the average.
    whole: f64,
}

impl LoadResponse {
    /// That of a linearized machine; what yields beside the springs counts as it does on the average of all conditions.
    pub(crate) fn of(lin: &Linearization, compliances: &Vector6) -> Self {
        let (mut body, mut whole) = (Matrix6::zeros(), Matrix6::zeros());
        for (at, motion) in lin.conditions.iter().zip(lin.motions_by_load()) {
            let back = to_fixed_origin(at, -1.0);
            body += back.transpose() * (motion - of_legs(at, compliances)) * back;
            whole += back.transpose() * motion * back;
        }
        let count = lin.conditions.len().max(1) as f64;
        let body = Symmetric6::new(&(body / count));
        Self { compliances: (*compliances).into(), body, whole: whole.norm() / count }
    }

    /// True when a machine yields nearly as another: a body that yields by rounding alone makes no difference.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        let compliances = [self, other].map(|one| Vector6::from(one.compliances));
        (compliances[0] - compliances[1]).norm() <= ALIKE * compliances[1].norm()
            && (self.body.matrix() - other.body.matrix()).norm() <= ALIKE * other.whole
    }

    /// Geometric twist of the platform at the mobile origin per component of the load.
    pub(crate) fn motion(&self, at: &Condition) -> Matrix6 {
        let carry = to_fixed_origin(at, 1.0);
        of_legs(at, &Vector6::from(self.compliances)) + carry.transpose() * self.body.matrix() * carry
    }
}

/// How loads scatter about what is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LoadScatter {
    /// By these standard deviations: of each force, N, and of each moment, N m.
    Sizes([f64; 2]),
    /// Every component by such a share of itself.
    Shares(f64),
    /// All components together by such a share.
    Factor(f64),
}

impl LoadScatter {
    /// What a load gains per standard deviation of each of up to six things.
    pub(crate) fn of(self, load: &Vector6) -> Matrix6 {
        match self {
            Self::Sizes([f, m]) => Matrix6::from_diagonal(&Vector6::new(f, f, f, m, m, m)),
            Self::Shares(share) => Matrix6::from_diagonal(&(load * share)),
            Self::Factor(share) => (load * share).fixed_resize::<6, 6>(0.0),
        }
    }
}

/// `J C J'`.
fn of_legs(at: &Condition, compliances: &Vector6) -> Matrix6 {
    let j = &at.legs.platform_jacobian;
    j * Matrix6::from_diagonal(compliances) * j.transpose()
}

/// `X`, or, with a sign of -1, its inverse.
fn to_fixed_origin(at: &Condition, sign: f64) -> Matrix6 {
    let mut carry = Matrix6::identity();
    carry.fixed_view_mut::<3, 3>(3, 0).copy_from(&(at.place.translation.cross_matrix() * sign));
    carry
}
