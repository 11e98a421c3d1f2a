//! Indices of a plan before it is measured: what O1 to O5, D, A, E and I say of it for the six leg springs of the drawing, rows
//! weighted by the noise.

use hexbench_core::{Hexapod, Pose};
use hexbench_design::regressor::{ModelRegressor, PoseRegressor, SpringRegressor, Weights};
use hexbench_design::space::Setting;
use hexbench_design::{Criterion, DesignError, Objective, Space, noise_to_come, nominal};
use hexbench_truth::campaign::PlanRow;
use nalgebra::DMatrix;

use crate::sweep::cost::setting;

/// Number of indices.
pub const INDICES: usize = Criterion::ALL.len();

/// Beginning of the names of their columns.
pub const PREFIX: &str = "index_";

/// All criteria, ready for plans of a machine whose noise (m, rad) is stated.
///
/// # Errors
/// A space without poses, or a singular one in it.
pub fn objectives(hexapod: &Hexapod, space: &Space, noise: [f64; 2]) -> Result<Vec<Objective>, DesignError> {
    let regressor = regressor(hexapod, &space.settings(), noise)?;
    Criterion::ALL.into_iter().map(|criterion| criterion.objective(hexapod, space, &*regressor)).collect()
}

/// Values of all criteria for the rows of a plan, in the order of [`Criterion::ALL`].
///
/// # Errors
/// A singular pose.
pub fn values(
    objectives: &[Objective],
    hexapod: &Hexapod,
    rows: &[PlanRow],
    noise: [f64; 2],
) -> Result<[f64; INDICES], DesignError> {
    let mut information = DMatrix::zeros(6, 6);
    for (pose, settings) in by_pose(rows) {
        regressor(hexapod, &settings, noise)?.inform(&pose, &mut information)?;
    }
    let value = |k: usize| objectives.get(k).map_or(f64::NAN, |o| o.value(&information, rows.len()));
    Ok(std::array::from_fn(value))
}

fn by_pose(rows: &[PlanRow]) -> Vec<(Pose, Vec<Setting>)> {
    let mut poses: Vec<(Pose, Vec<Setting>)> = Vec::new();
    for row in rows {
        match poses.iter_mut().find(|(pose, _)| *pose == row.situation.pose) {
            Some((_, settings)) => settings.push(setting(row)),
            None => poses.push((row.situation.pose, vec![setting(row)])),
        }
    }
    poses
}

/// Of full poses, or of the sensors of the machine.
fn regressor<'a>(
    hexapod: &'a Hexapod,
    settings: &[Setting],
    noise: [f64; 2],
) -> Result<Box<dyn PoseRegressor + 'a>, DesignError> {
    let compliance = nominal::compliance(hexapod);
    if let Some(noise) = noise_to_come(hexapod).filter(|_| !hexapod.sensors.is_empty()) {
        return Ok(Box::new(ModelRegressor::new(hexapod, compliance, noise, &[], settings, 1)?));
    }
    let [translation, rotation] = noise.map(f64::recip);
    let weights = Weights { translation, rotation, compliance: compliance.into() };
    Ok(Box::new(SpringRegressor::new(hexapod, settings, 1, weights)))
}
