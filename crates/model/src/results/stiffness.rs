//! Cartesian stiffness as programs receive it: `stiffness/1`.

use hexbench_core::{Matrix6, Observation};
use serde::Serialize;

use crate::application::stiffness::{CartesianStiffness, PrincipalStiffness, StiffnessPoint};

/// Stiffness at poses and loads.
#[derive(Debug, Clone, Serialize)]
pub struct StiffnessList {
    /// `stiffness/1`.
    pub format: &'static str,
    /// Of everything below: SI, wrenches `[fx, fy, fz, mx, my, mz]`, motions `[x, y, z, rx, ry, rz]`.
    pub units: &'static str,
    /// Point of the platform, mobile frame, m.
    pub point: [f64; 3],
    /// `fixed` or `mobile`.
    pub axes: &'static str,
    /// In the order asked for.
    pub states: Vec<StiffnessEntry>,
}

/// Stiffness at one pose and load.
#[derive(Debug, Clone, Serialize)]
pub struct StiffnessEntry {
    /// Translation (m) and angles (rad).
    pub pose: [f64; 6],
    /// Load at the mobile origin, fixed axes.
    pub load: [f64; 6],
    /// `K`, row by row: wrench per motion.
    pub stiffness: [[f64; 6]; 6],
    /// Standard uncertainty of each number.
    pub stiffness_std: [[f64; 6]; 6],
    /// `C`, row by row: motion per wrench.
    pub compliance: [[f64; 6]; 6],
    /// Standard uncertainty of each number.
    pub compliance_std: [[f64; 6]; 6],
    /// Forces with the platform free to turn, the softest direction first.
    pub of_forces: [PrincipalEntry; 3],
    /// Moments with the platform free to shift, the softest direction first.
    pub of_moments: [PrincipalEntry; 3],
}

/// One principal stiffness.
#[derive(Debug, Clone, Serialize)]
pub struct PrincipalEntry {
    /// N/m or N m/rad.
    pub stiffness: f64,
    /// Its standard uncertainty (k = 1).
    pub std: f64,
    /// Unit vector.
    pub direction: [f64; 3],
}

impl StiffnessList {
    /// Of rows and what was found for them.
    pub fn of(rows: &[Observation], found: &[CartesianStiffness], at: &StiffnessPoint) -> Self {
        let states = rows.iter().zip(found).map(|(row, k)| StiffnessEntry::of(row, k)).collect();
        Self {
            format: "stiffness/1",
            units: "m, rad, N, N m",
            point: at.point.into(),
            axes: at.axes.word(),
            states,
        }
    }
}

impl StiffnessEntry {
    fn of(row: &Observation, k: &CartesianStiffness) -> Self {
        Self {
            pose: row.pose.to_array(),
            load: row.wrench.to_array(),
            stiffness: by_rows(&k.stiffness),
            stiffness_std: by_rows(&k.stiffness_std),
            compliance: by_rows(&k.compliance),
            compliance_std: by_rows(&k.compliance_std),
            of_forces: k.of_forces.map(PrincipalEntry::of),
            of_moments: k.of_moments.map(PrincipalEntry::of),
        }
    }
}

impl PrincipalEntry {
    fn of(p: PrincipalStiffness) -> Self {
        Self { stiffness: p.stiffness, std: p.std, direction: p.direction.into() }
    }
}

fn by_rows(matrix: &Matrix6) -> [[f64; 6]; 6] {
    std::array::from_fn(|i| std::array::from_fn(|j| matrix[(i, j)]))
}
