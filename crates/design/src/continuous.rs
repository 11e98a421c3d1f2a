//! Few poses, every free coordinate of each chosen at will, and with them the loads of ranges: many starts of sequential quadratic
//! programming.
//!
//! Minimizes `-ln value` of a criterion over the free coordinates of all poses and the chosen parts of all loads, each scaled to 0..1 over its
//! range, within the limits of the space. A load that is chosen is one load for all poses, as the force variable of the paper. Starts come from a scrambled Sobol sequence; each runs on its own, so that the answer does not
//! depend on the number of threads. Source: Kraft 1988 (SLSQP).

mod ascent;
mod climb;

use hexbench_core::parallel;
use hexbench_core::{Hexapod, Pose};
use nalgebra::DMatrix;

pub(crate) use self::climb::Climb;
use crate::determined::require_determined;
use crate::regressor::PoseRegressor;
use crate::space::Loading;
use crate::{DesignError, Objective, Space};

/// Values this close, relatively, count as the same optimum.
const SAME: f64 = 1e-4;

/// Poses to be found.
pub struct PoseProblem<'a, R> {
    /// The machine.
    pub hexapod: &'a Hexapod,
    /// Where poses and loads may lie.
    pub space: &'a Space,
    /// What a pose tells, under the loads of the space.
    pub regressor: &'a R,
    /// What makes a set of poses good.
    pub criterion: &'a Objective,
    /// Number of poses.
    pub poses: usize,
    /// Information that is there without them, inputs included.
    pub known: Option<&'a DMatrix<f64>>,
}

/// A set of poses with the value of the criterion.
#[derive(Debug, Clone, PartialEq)]
pub struct ValuedPoses {
    /// The poses.
    pub poses: Vec<Pose>,
    /// The loads, in the order of the space.
    pub loads: Vec<Loading>,
    /// Value of the criterion.
    pub value: f64,
}

/// Outcome of all starts.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseSearch {
    /// The best set found.
    pub best: ValuedPoses,
    /// Number of starts.
    pub starts: usize,
    /// Starts that ended at a set within the limits.
    pub ended: usize,
    /// Starts whose value agrees with the best to four digits.
    pub agreeing: usize,
}

impl<R: PoseRegressor> PoseProblem<'_, R> {
    /// Value of the criterion for poses under the loads of the space; zero when one is singular.
    pub fn value(&self, poses: &[Pose]) -> f64 {
        self.information(poses).map_or(0.0, |m| self.criterion.value(&m, self.readings(poses)))
    }

    fn readings(&self, poses: &[Pose]) -> usize {
        poses.len() * self.regressor.readings()
    }

    /// Sum of what is known and of the information of poses under the loads of the space, inputs included.
    ///
    /// # Errors
    /// A singular pose.
    pub fn information(&self, poses: &[Pose]) -> Result<DMatrix<f64>, DesignError> {
        let n = self.regressor.width();
        let mut information = self.known.cloned().unwrap_or_else(|| DMatrix::zeros(n, n));
        poses.iter().try_for_each(|pose| self.regressor.inform(pose, &mut information))?;
        Ok(information)
    }

    /// The best of many starts; `done` is called after each.
    ///
    /// # Errors
    /// [`DesignError::NoPose`] when the space is empty, [`DesignError::NeverDetermined`], [`DesignError::NotDetermined`] when no start ends at poses that
    /// determine all parameters.
    pub fn search(
        &self,
        starts: usize,
        seed: u32,
        done: &(dyn Fn() + Sync),
    ) -> Result<PoseSearch, DesignError> {
        let drawn = self.space.poses(self.hexapod, starts * self.poses, seed)?;
        let drawn: Vec<(u32, &[Pose])> = (0..).zip(drawn.chunks(self.poses)).collect();
        require_determined(&self.everything(&drawn, seed)?, &self.regressor.names())?;
        let end = |&(index, start): &(u32, &[Pose])| {
            let set = self.climb_from(start, self.space.loads_of_start(index, seed));
            done();
            set
        };
        let ends: Vec<Option<ValuedPoses>> = parallel::map(&drawn, end);
        let ended: Vec<&ValuedPoses> = ends.iter().flatten().collect();
        // The first of equals, so that the order of threads does not matter.
        let best = ended.iter().copied().reduce(|a, b| if b.value > a.value { b } else { a });
        let Some(best) = best else {
            return Err(DesignError::NotDetermined {
                parameters: self.regressor.parameters(),
                hint: "allow more poses, turns or load directions",
            });
        };
        let agrees = |set: &&&ValuedPoses| set.value >= (1.0 - SAME) * best.value;
        Ok(PoseSearch {
            best: best.clone(),
            starts,
            ended: ended.len(),
            agreeing: ended.iter().filter(agrees).count(),
        })
    }

    /// Information of all starts together.
    fn everything(&self, drawn: &[(u32, &[Pose])], seed: u32) -> Result<DMatrix<f64>, DesignError> {
        let mut information = self.information(&[])?;
        for (index, poses) in drawn {
            let loads = self.space.loads_of_start(*index, seed);
            let regressor = self.regressor.under(&self.space.settings_of(&loads));
            poses.iter().try_for_each(|pose| regressor.inform(pose, &mut information))?;
        }
        Ok(information)
    }

    /// The nearest optimum from poses that keep the limits and the loads of the space; none when it determines nothing.
    pub fn climb(&self, start: &[Pose]) -> Option<ValuedPoses> {
        self.climb_from(start, self.space.loads.clone())
    }

    fn climb_from(&self, start: &[Pose], loads: Vec<Loading>) -> Option<ValuedPoses> {
        let space = self.space.under(loads);
        let regressors = vec![self.regressor; start.len()];
        let climb = Climb::new(self.hexapod, &space, self.criterion, regressors, start).beside(self.known);
        climb.end().map(|end| ValuedPoses { poses: end.poses, loads: end.loads, value: end.value })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Criterion;
    use crate::continuous::climb::SLACK;
    use crate::regressor::{SpringRegressor, Weights};
    use crate::test_machine::{level_space, machine};

    #[test]
    fn no_set_of_thousand_drawn_ones_beats_the_search_and_the_limits_are_kept() {
        let (hexapod, space) = (machine(), level_space());
        let regressor = SpringRegressor::new(&hexapod, &space.settings(), 1, Weights::UNWEIGHTED);
        let problem = PoseProblem {
            hexapod: &hexapod,
            space: &space,
            regressor: &regressor,
            criterion: &Objective::from(Criterion::O1),
            poses: 3,
            known: None,
        };
        let found = problem.search(24, 1, &|| ()).unwrap();
        let drawn = space.poses(&hexapod, 3000, 7).unwrap();
        let best_drawn = drawn.chunks(3).map(|set| problem.value(set)).fold(0.0, f64::max);
        assert!(found.best.value > best_drawn && best_drawn > 0.0, "{} {best_drawn}", found.best.value);
        for pose in &found.best.poses {
            let worst = space.worst_limit(&hexapod, pose).unwrap();
            assert!(worst.excess <= SLACK, "{worst:?}");
        }
    }

    #[test]
    fn the_answer_does_not_depend_on_the_number_of_threads() {
        let (hexapod, space) = (machine(), level_space());
        let regressor = SpringRegressor::new(&hexapod, &space.settings(), 1, Weights::UNWEIGHTED);
        let problem = PoseProblem {
            hexapod: &hexapod,
            space: &space,
            regressor: &regressor,
            criterion: &Objective::from(Criterion::O5),
            poses: 3,
            known: None,
        };
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| problem.search(6, 3, &|| ()).unwrap())
        };
        assert_eq!(on(1), on(3));
    }

    #[test]
    fn limits_that_no_pose_keeps_are_told() {
        let hexapod = machine();
        let space = Space { stroke: Some([0.5, 0.6]), ..level_space() };
        let why = space.poses(&hexapod, 3, 1).unwrap_err().to_string();
        assert!(why.contains("stroke") && why.contains("none of 10000"), "{why}");
    }
}
