//! Few poses, every free coordinate of each chosen at will: many starts of sequential quadratic programming.
//!
//! Minimises `-ln value` of a criterion over the free coordinates of all poses, each scaled to 0..1 over its travel, within the
//! limits of the space. Starts come from a scrambled Sobol sequence; each runs on its own, so that the answer does not
//! depend on the number of threads. Source: Kraft 1988 (SLSQP).

mod ascent;

use hexbench_core::{Hexapod, Pose};
use nalgebra::DMatrix;
use rayon::prelude::*;

use self::ascent::Ascent;
use crate::determined::require_determined;
use crate::regressor::PoseRegressor;
use crate::space::Slope;
use crate::{DesignError, Objective, Space};

/// Values this close, relatively, count as the same optimum.
const SAME: f64 = 1e-4;
/// Excess over a limit that rounding excuses.
const SLACK: f64 = 1e-6;

/// Poses to be found.
pub struct PoseProblem<'a, R> {
    /// The machine.
    pub hexapod: &'a Hexapod,
    /// Where poses may lie.
    pub space: &'a Space,
    /// What a pose tells.
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
    /// Value of the criterion for poses; zero when one is singular.
    pub fn value(&self, poses: &[Pose]) -> f64 {
        self.information(poses).map_or(0.0, |m| self.criterion.value(&m, self.readings(poses)))
    }

    fn readings(&self, poses: &[Pose]) -> usize {
        poses.len() * self.regressor.readings()
    }

    /// Sum of what is known and of the information of poses, inputs included.
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
        require_determined(&self.information(&drawn)?, &self.regressor.names())?;
        let end = |start: &[Pose]| {
            let set = self.climb(start);
            done();
            set
        };
        let ends: Vec<Option<ValuedPoses>> = drawn.par_chunks(self.poses).map(end).collect();
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

    /// The nearest optimum from a start that keeps the limits; none when it determines nothing.
    ///
    /// What little the last step breaks of a limit is undone on the way back to the start.
    pub fn climb(&self, start: &[Pose]) -> Option<ValuedPoses> {
        let free = self.space.free();
        let from: Vec<f64> = start.iter().flat_map(|p| self.scaled(p, &free)).collect();
        let end = Ascent::new(self, &free, &from).end(&from);
        let poses = self.poses_of(&self.pulled_back(&from, &end, &free), &free);
        let value = self.value(&poses);
        (value > 0.0).then_some(ValuedPoses { poses, value })
    }

    /// Limits of one pose with derivatives by its scaled free coordinates.
    fn limits_of(&self, part: &[f64], free: &[usize]) -> Option<Vec<Slope>> {
        let mut limits = self.space.limit_slopes(self.hexapod, &self.poses_of(part, free)[0])?;
        for (_, slope) in &mut limits {
            *slope = std::array::from_fn(|j| {
                free.get(j).map_or(0.0, |&k| slope[k] * (self.space.high[k] - self.space.low[k]))
            });
        }
        Some(limits)
    }

    /// The point nearest to `end` on the way back to the feasible `start` that keeps all limits, to a millionth of the way.
    fn pulled_back(&self, start: &[f64], end: &[f64], free: &[usize]) -> Vec<f64> {
        const HALVINGS: usize = 40;
        let at =
            |share: f64| -> Vec<f64> { start.iter().zip(end).map(|(s, e)| s + share * (e - s)).collect() };
        let keeps = |x: &[f64]| {
            let kept = |p: &Pose| self.space.worst_limit(self.hexapod, p).is_none_or(|l| l.excess <= SLACK);
            self.poses_of(x, free).iter().all(kept)
        };
        if keeps(end) {
            return end.to_vec();
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            if keeps(&at(middle)) { low = middle } else { high = middle }
        }
        at(low)
    }

    /// `-ln value` and its gradient; none where the value is zero.
    fn logarithm(&self, x: &[f64], gradient: Option<&mut [f64]>, free: &[usize]) -> Option<f64> {
        let poses = self.poses_of(x, free);
        let information = self.information(&poses).ok()?;
        let Some(gradient) = gradient else {
            let value = self.criterion.value(&information, self.readings(&poses));
            return (value > 0.0).then(|| -value.ln());
        };
        gradient.fill(0.0);
        let (value, g) = self.criterion.gradient(&information, self.readings(&poses));
        if value <= 0.0 {
            return None;
        }
        for (pose, part) in poses.iter().zip(gradient.chunks_mut(free.len())) {
            let slopes = self.regressor.slopes(pose, &g).ok()?;
            for (slope, &k) in part.iter_mut().zip(free) {
                *slope = -slopes[k] * (self.space.high[k] - self.space.low[k]) / value;
            }
        }
        Some(-value.ln())
    }

    fn scaled(&self, pose: &Pose, free: &[usize]) -> Vec<f64> {
        let (x, low, high) = (pose.to_array(), self.space.low, self.space.high);
        free.iter().map(|&k| (x[k] - low[k]) / (high[k] - low[k])).collect()
    }

    fn poses_of(&self, x: &[f64], free: &[usize]) -> Vec<Pose> {
        let pose = |part: &[f64]| {
            let mut pose = self.space.low;
            for (share, &k) in part.iter().zip(free) {
                pose[k] += share * (self.space.high[k] - self.space.low[k]);
            }
            Pose::from_array(pose)
        };
        x.chunks(free.len()).map(pose).collect()
    }
}

#[cfg(test)]
mod tests {
    use hexbench_core::Wrench;

    use super::*;
    use crate::Budget;
    use crate::Criterion;
    use crate::regressor::{SpringRegressor, Weights};
    use crate::space::{Conditions, Loading};
    use crate::test_machine::machine;

    /// Level poses under a weight, as in the paper.
    fn space() -> Space {
        let weight = |n: f64| Wrench::from_array([0.0, 0.0, -n, 0.0, 0.0, 0.0]);
        let reach = [0.04, 0.04, 0.02, 0.0, 0.0, 0.5];
        Space {
            low: reach.map(|x| -x),
            high: reach,
            stroke: Some([0.178, 0.211]),
            joint_angle: None,
            least_dexterity: 0.0,
            loads: vec![Loading { reference: weight(119.7), load: weight(338.4) }],
            conditions: Conditions::default(),
            budget: Budget::default(),
        }
    }

    #[test]
    fn no_set_of_thousand_drawn_ones_beats_the_search_and_the_limits_are_kept() {
        let (hexapod, space) = (machine(), space());
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
        assert!(found.best.value > best_drawn, "{} {best_drawn}", found.best.value);
        for pose in &found.best.poses {
            let worst = space.worst_limit(&hexapod, pose).unwrap();
            assert!(worst.excess <= SLACK, "{worst:?}");
        }
    }

    #[test]
    fn the_answer_does_not_depend_on_the_number_of_threads() {
        let (hexapod, space) = (machine(), space());
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
        let space = Space { stroke: Some([0.5, 0.6]), ..space() };
        let why = space.poses(&hexapod, 3, 1).unwrap_err().to_string();
        assert!(why.contains("stroke") && why.contains("only 0 of"), "{why}");
    }
}
