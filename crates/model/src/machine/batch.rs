//! Linear deflections of many poses at once, four poses abreast.
//!
//! ```text
//! dx = (L' diag(k) L)^-1 (W - W0)
//! ```
//!
//! The stiffness matrix is symmetric and positive definite away from singular poses, so it is factored without
//! pivoting and all four poses take the same path. Lengths are measured in units of the platform radius to keep it
//! well conditioned. This is the plain linear model at the commanded pose; [`crate::estimation::linearization`] carries terms,
//! second-order corrections and derivatives.

use hexbench_core::{Hexapod, Pose, Vector6, Wrench};
use rayon::prelude::*;
use wide::f64x4;

use crate::machine::lanes::{
    LANES, Matrix, Point, add_square, factor, jacobian_row, rotation, splat, substitute,
};

/// Poses per piece of parallel work.
const PIECE: usize = 1024;

/// A pose with the change of wrench it sees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadCase {
    /// Commanded pose.
    pub pose: Pose,
    /// Loaded minus reference wrench.
    pub change: Wrench,
}

/// Geometric deflection twists `[v; omega]` at the mobile origin, fixed axes, m and rad, of a hexapod whose legs have the
/// stiffnesses `k` (N/m). A singular pose gives values that are not finite.
pub fn deflections(hexapod: &Hexapod, stiffness: &[f64; 6], cases: &[LoadCase]) -> Vec<Vector6> {
    let machine = Lanes::new(hexapod, stiffness);
    let mut out = vec![Vector6::zeros(); cases.len()];
    out.par_chunks_mut(PIECE).zip(cases.par_chunks(PIECE)).for_each(|(out, cases)| machine.fill(out, cases));
    out
}

/// The machine, ready for four poses abreast.
struct Lanes {
    base: [Point; 6],
    platform: [Point; 6],
    stiffness: [f64; 6],
    radius: f64,
}

impl Lanes {
    fn new(hexapod: &Hexapod, stiffness: &[f64; 6]) -> Self {
        let radius = hexapod.platform_radius().max(f64::MIN_POSITIVE);
        Self {
            base: hexapod.base_joints.map(|a| splat(&(a / radius))),
            platform: hexapod.platform_joints.map(|b| splat(&(b / radius))),
            stiffness: *stiffness,
            radius,
        }
    }

    fn fill(&self, out: &mut [Vector6], cases: &[LoadCase]) {
        for (out, cases) in out.chunks_mut(LANES).zip(cases.chunks(LANES)) {
            let lane = |k: usize| &cases[k.min(cases.len() - 1)];
            let gather = |f: &dyn Fn(&LoadCase) -> f64| f64x4::from(std::array::from_fn(|k| f(lane(k))));
            let translation: Point =
                std::array::from_fn(|i| gather(&|c| c.pose.translation[i] / self.radius));
            let angles: Point = std::array::from_fn(|i| gather(&|c| c.pose.angles[i]));
            let force: Point = std::array::from_fn(|i| gather(&|c| c.change.force[i]));
            let moment: Point = std::array::from_fn(|i| gather(&|c| c.change.moment[i] / self.radius));
            let x = substitute(
                &factor(self.stiffness_matrix(&translation, &rotation(&angles))),
                [force[0], force[1], force[2], moment[0], moment[1], moment[2]],
            );
            let x = x.map(f64x4::to_array);
            for (k, twist) in out.iter_mut().enumerate() {
                *twist = Vector6::from_fn(|i, _| if i < 3 { x[i][k] } else { x[i][k] / self.radius });
            }
        }
    }

    /// Lower triangle of `L' diag(k) L`, moments in units of force.
    fn stiffness_matrix(&self, translation: &Point, rotation: &[Point; 3]) -> Matrix {
        let mut matrix = [[f64x4::ZERO; 6]; 6];
        for leg in 0..6 {
            let row = jacobian_row(&self.base[leg], &self.platform[leg], translation, rotation);
            add_square(&mut matrix, &row, f64x4::splat(self.stiffness[leg]));
        }
        matrix
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::kinematics::Legs;
    use crate::test_machine::machine;

    /// Relative difference allowed between the two routes: rounding times the squared condition of the leg Jacobian.
    const ROUTES_AGREE: f64 = 1e-10;

    fn cases(count: u32) -> Vec<LoadCase> {
        let wave = |i: u32, k: f64| (f64::from(i) * k).sin();
        let pose = |i| {
            Pose::from_array(
                [1.0, 2.0, 3.0, 5.0, 7.0, 11.0].map(|k| wave(i, k) * if k < 4.0 { 0.03 } else { 0.2 }),
            )
        };
        let load = |i| Wrench::from_array([13.0, 17.0, 19.0, 23.0, 29.0, 31.0].map(|k| wave(i, k) * 50.0));
        (1..=count).map(|i| LoadCase { pose: pose(i), change: load(i) }).collect()
    }

    #[test]
    fn four_abreast_agree_with_one_by_one() {
        let (hexapod, k) = (machine(), [4.2e6, 3.8e6, 2.7e6, 4.3e6, 3.7e6, 3.7e6]);
        // Not a multiple of four: the last lanes are padded.
        let cases = cases(1031);
        for (case, fast) in cases.iter().zip(deflections(&hexapod, &k, &cases)) {
            let legs = Legs::at(&hexapod.base_joints, &hexapod.platform_joints, &case.pose).unwrap();
            let e = legs.forces(&case.change.to_vector()).component_div(&Vector6::from(k));
            let slow = legs.platform_jacobian * e;
            let off = (fast - slow).norm() / slow.norm();
            assert!(off < ROUTES_AGREE, "off by {off:.1e}");
        }
    }
}
