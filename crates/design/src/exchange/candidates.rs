//! Readings that a plan may choose from.

use hexbench_core::parallel;
use hexbench_core::{Hexapod, Pose};
use nalgebra::DMatrix;

use crate::budget::{Amount, Budget};
use crate::regressor::SettingRegressor;
use crate::{DesignError, Space, Visit};

/// Candidates with their information and their cost. Candidate `pose * settings + setting` is a reading of that pose under that
/// setting.
#[derive(Debug, Clone)]
pub struct Candidates {
    /// Information of each, inputs included.
    pub information: Vec<DMatrix<f64>>,
    /// Cost of the reading under each setting, in the unit of the budget.
    pub costs: Vec<f64>,
    /// Cost of going to a pose.
    pub pose_cost: f64,
    /// Most that a plan may cost.
    pub budget: f64,
}

impl Candidates {
    /// Blocks of rows (one column per parameter), each at a pose of its own, `size` of which make a plan.
    pub fn of_rows(rows: &[DMatrix<f64>], size: usize) -> Self {
        Self {
            information: rows.iter().map(|j| j.tr_mul(j)).collect(),
            costs: vec![1.0],
            pose_cost: 0.0,
            budget: size as f64,
        }
    }

    /// Poses under all settings of a space; singular poses are passed over. Gives the candidates and their poses.
    ///
    /// # Errors
    /// [`DesignError::FreeReading`].
    pub fn of_poses<R: SettingRegressor>(
        poses: &[Pose],
        space: &Space,
        regressor: &R,
        budget: &Budget,
        amount: Amount,
    ) -> Result<(Self, Vec<Pose>), DesignError> {
        let settings = space.settings();
        let (costs, pose_cost, budget) = match amount {
            Amount::Readings(n) => (vec![1.0; settings.len()], 0.0, n as f64),
            Amount::Time(time) => {
                (settings.iter().map(|s| budget.time_of(s)).collect(), budget.pose_change, time)
            }
        };
        if costs.iter().any(|c| *c <= 0.0) {
            return Err(DesignError::FreeReading);
        }
        let each: Vec<_> = parallel::map(poses, |pose| regressor.each(pose).ok());
        let usable = || each.iter().zip(poses).filter_map(|(e, pose)| e.as_ref().map(|e| (e, *pose)));
        let information = usable().flat_map(|(e, _)| e.iter().cloned()).collect();
        Ok((Self { information, costs, pose_cost, budget }, usable().map(|(_, pose)| pose).collect()))
    }

    /// The first `count` poses of an even spread over a space, as [`Candidates::of_poses`].
    ///
    /// # Errors
    /// As [`Space::poses`] and [`Candidates::of_poses`].
    pub fn spread<R: SettingRegressor>(
        hexapod: &Hexapod,
        space: &Space,
        regressor: &R,
        amount: Amount,
        count: usize,
        seed: u32,
    ) -> Result<(Self, Vec<Pose>), DesignError> {
        Self::of_poses(&space.poses(hexapod, count, seed)?, space, regressor, &space.budget, amount)
    }

    /// Members of a plan pose by pose; `poses` are those of the candidates.
    pub fn visits(&self, poses: &[Pose], members: &[usize]) -> Vec<Visit> {
        let settings = self.costs.len();
        let mut counts = vec![vec![0; settings]; poses.len()];
        for &k in members {
            counts[self.pose(k)][k % settings] += 1;
        }
        let visited = poses.iter().zip(counts).filter(|(_, counts)| counts.iter().any(|n| *n > 0));
        visited.map(|(&pose, counts)| Visit { pose, counts }).collect()
    }

    /// Adds the poses of visits to the candidates and to `poses`; gives the members that the visits are then.
    ///
    /// # Errors
    /// A singular pose.
    pub fn extend<R: SettingRegressor>(
        &mut self,
        poses: &mut Vec<Pose>,
        visits: &[Visit],
        regressor: &R,
    ) -> Result<Vec<usize>, DesignError> {
        let mut members = Vec::new();
        for visit in visits {
            for (&count, information) in visit.counts.iter().zip(regressor.each(&visit.pose)?) {
                members.extend(std::iter::repeat_n(self.information.len(), count));
                self.information.push(information);
            }
            poses.push(visit.pose);
        }
        Ok(members)
    }

    /// Rows of an information matrix: parameters and inputs.
    pub fn width(&self) -> usize {
        self.information.first().map_or(0, DMatrix::ncols)
    }

    /// Number of poses.
    pub fn poses(&self) -> usize {
        self.information.len() / self.costs.len()
    }

    /// Pose of a candidate.
    pub fn pose(&self, candidate: usize) -> usize {
        candidate / self.costs.len()
    }

    /// Cost of a candidate at a pose that is visited anyway.
    pub fn cost(&self, candidate: usize) -> f64 {
        self.costs[candidate % self.costs.len()]
    }

    /// Cost of a plan of ascending members.
    pub fn cost_of(&self, members: &[usize]) -> f64 {
        let mut poses: Vec<usize> = members.iter().map(|&k| self.pose(k)).collect();
        poses.sort_unstable();
        poses.dedup();
        self.pose_cost * poses.len() as f64 + members.iter().map(|&k| self.cost(k)).sum::<f64>()
    }

    /// Sum of the information of members.
    pub fn sum(&self, members: &[usize]) -> DMatrix<f64> {
        let n = self.width();
        members.iter().fold(DMatrix::zeros(n, n), |sum, &k| sum + &self.information[k])
    }

    /// Sum of the information of all candidates.
    pub fn whole(&self) -> DMatrix<f64> {
        let n = self.width();
        self.information.iter().fold(DMatrix::zeros(n, n), |sum, m| sum + m)
    }
}
