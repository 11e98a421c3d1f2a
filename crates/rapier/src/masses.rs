//! Masses and damping with which a structure comes to rest soonest.
//!
//! A state of rest does not depend on masses, so they are chosen for the way there: modes as near to each other as a
//! scalar mass and three moments of inertia allow, the fastest of them well inside the time step, all of them
//! overdamped or critical (Rayleigh damping, critical for the fastest and the slowest mode).

use hexbench_core::{Matrix3, Matrix6, Vector6};
use hexbench_truth::{LegLaw, Setup, equilibrium::Body};

use crate::{
    law,
    modes::eigenvalues,
    parts::{Dynamics, Inertia},
};

/// Stiffness of six leg springs `k` (N/m) at the commanded pose, about the mobile origin, fixed axes.
pub fn leg_stiffness(setup: &Setup, k: &[f64; 6]) -> Matrix6 {
    let place = Body::at(&setup.pose);
    (0..6).fold(Matrix6::zeros(), |sum, i| {
        let arm = place.axes * setup.platform_joints[i];
        let direction = (place.origin + arm - setup.base_joints[i]).normalize();
        let about = arm.cross(&direction);
        let row = Vector6::new(direction.x, direction.y, direction.z, about.x, about.y, about.z);
        sum + row * row.transpose() * k[i]
    })
}

/// Mass of half a leg over that of the plate. Sweeps over the joints gain least where light bodies carry heavy ones: with 0.02 it
/// takes 200 sweeps to come as near as 40 do with 0.2.
const HALF_LEG: f64 = 0.2;

/// Masses and damping with which a structure comes to rest soonest; `phase` is the angle (rad) through which the fastest
/// mode turns in a time step of `dt` (s).
pub fn quickest(setup: &Setup, dt: f64, phase: f64) -> Dynamics {
    let of = |k: fn(&LegLaw) -> f64| leg_stiffness(setup, &std::array::from_fn(|i| k(&setup.laws[i])));
    let (stiffness, softer) = (of(law::stiffest), of(|l| 1.0 / l.compliance));
    let axes = Body::at(&setup.pose).axes;
    let shape = shape(&stiffness, &axes);
    let mass = shape.matrix(&axes);
    let fastest = phase / dt;
    let scale = eigenvalues(&stiffness, &mass)[5] / fastest.powi(2);
    let slowest = (eigenvalues(&softer, &mass)[0] / scale).sqrt();
    let plate = shape.scaled(scale);
    let base = setup.base_compliance.and_then(nalgebra::Matrix::try_inverse);
    Dynamics {
        plate,
        loaded: plate,
        base: base.map_or(plate, |k| self::shape(&k, &Matrix3::identity()).scaled(fastest.powi(-2))),
        half_leg: HALF_LEG * plate.mass,
        per_stiffness: 2.0 / (slowest + fastest) + dt,
        per_mass: 2.0 * slowest * fastest / (slowest + fastest),
    }
}

/// Inertia in proportion to a stiffness (fixed axes), as far as a scalar mass and three moments can follow.
fn shape(stiffness: &Matrix6, axes: &Matrix3) -> Inertia {
    let turning = axes.transpose() * stiffness.fixed_view::<3, 3>(3, 3) * axes;
    let mass = stiffness.fixed_view::<3, 3>(0, 0).trace() / 3.0;
    Inertia { mass, principal: std::array::from_fn(|k| turning[(k, k)]) }
}
