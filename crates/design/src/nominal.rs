//! What a plan assumes of a machine that has not been measured yet.

use hexbench_core::{Hexapod, Vector6};

/// A leg of the paper's machine, N/m.
const USUAL_N_PER_M: f64 = 4e6;

/// Stiffness of the legs, N/m: as the hexapod file states, else that of the paper's legs.
pub fn stiffness(hexapod: &Hexapod) -> [f64; 6] {
    hexapod.nominal_stiffness.unwrap_or([USUAL_N_PER_M; 6])
}

/// Its inverse, m/N.
pub fn compliance(hexapod: &Hexapod) -> Vector6 {
    Vector6::from(stiffness(hexapod).map(f64::recip))
}
