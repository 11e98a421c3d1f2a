//! Poses of a chosen plan moved to where they tell most: one after the other, the readings of each kept.

use hexbench_core::{Hexapod, Pose};
use nalgebra::DMatrix;

use crate::regressor::SettingRegressor;
use crate::{Criterion, DesignError, Problem, Space};

/// Rounds over all poses.
const MOST_ROUNDS: usize = 4;
/// Relative gain of a round that is worth another.
const WORTHWHILE: f64 = 1e-4;

/// A pose and how often it is read under each setting.
#[derive(Debug, Clone, PartialEq)]
pub struct Visit {
    /// The pose.
    pub pose: Pose,
    /// Readings under each setting of the space.
    pub counts: Vec<usize>,
}

impl Visit {
    /// Adds the information of its readings (p x p).
    ///
    /// # Errors
    /// A singular pose.
    pub fn inform<R: SettingRegressor>(
        &self,
        regressor: &R,
        information: &mut DMatrix<f64>,
    ) -> Result<(), DesignError> {
        regressor.repeated(&self.counts).inform(&self.pose, information)
    }
}

/// Sum of the information of visits (p x p).
///
/// # Errors
/// A singular pose.
pub fn information<'v, R: SettingRegressor>(
    visits: impl IntoIterator<Item = &'v Visit>,
    regressor: &R,
) -> Result<DMatrix<f64>, DesignError> {
    let p = regressor.parameters();
    let mut sum = DMatrix::zeros(p, p);
    visits.into_iter().try_for_each(|visit| visit.inform(regressor, &mut sum))?;
    Ok(sum)
}

/// Moves the poses of visits within the limits of the space; the value of the criterion never falls.
///
/// # Errors
/// A singular pose.
pub fn refine<R: SettingRegressor>(
    hexapod: &Hexapod,
    space: &Space,
    regressor: &R,
    criterion: &Criterion,
    visits: &mut [Visit],
) -> Result<(), DesignError> {
    let mut before = criterion.value(&information(&*visits, regressor)?, 1);
    for _ in 0..MOST_ROUNDS {
        for k in 0..visits.len() {
            let others = visits.iter().enumerate().filter(|(i, _)| *i != k).map(|(_, visit)| visit);
            let known = Some(&information(others, regressor)?);
            let own = &regressor.repeated(&visits[k].counts);
            let problem = Problem { hexapod, space, regressor: own, criterion, poses: 1, known };
            let here = [visits[k].pose];
            let Some(moved) = problem.climb(&here).filter(|set| set.value > problem.value(&here)) else {
                continue;
            };
            visits[k].pose = moved.poses[0];
        }
        let value = criterion.value(&information(&*visits, regressor)?, 1);
        if value <= before * (1.0 + WORTHWHILE) {
            break;
        }
        before = value;
    }
    Ok(())
}
