//! One start of the search: sequential quadratic programming within the bounds and limits.

use std::convert::Infallible;

use basin::{
    BoxBounds, ConstraintDescription, ConstraintJacobian, ConstraintSet, ConstraintSolveError, Constraints,
    CostFunction, DenseMatrix, Executor, Gradient, NoLinearConstraints, NoNonlinearBlock, NonlinearBlock,
    NonlinearBlocks, NonlinearInequalityValues, SelectedFirstOrderState, Slsqp, State,
};

use super::PoseProblem;
use crate::regressor::PoseRegressor;
use crate::space::Slope;

/// Steps of one start before it is taken as it is.
const MOST_STEPS: u64 = 150;
/// Change of `-ln value` at which an ascent ends.
const SETTLED: f64 = 1e-9;

/// Every free coordinate within its travel, every pose within its limits.
type Within = ConstraintSet<
    BoxBounds<Vec<f64>>,
    NoLinearConstraints,
    NonlinearBlocks<NoNonlinearBlock, NonlinearBlock>,
>;
type Excesses<T> = Result<T, ConstraintSolveError<Infallible>>;

/// The problem in the scaled free coordinates of all poses, each 0..1 over its travel.
pub(super) struct Ascent<'p, 'a, R> {
    problem: &'p PoseProblem<'a, R>,
    free: &'p [usize],
    /// Limits of one pose.
    limits: usize,
    within: Within,
}

impl<'p, 'a, R: PoseRegressor> Ascent<'p, 'a, R> {
    /// Of `problem` from `start`, scaled free coordinates.
    pub(super) fn new(problem: &'p PoseProblem<'a, R>, free: &'p [usize], start: &[f64]) -> Self {
        let limits = problem.space.limits(problem.hexapod, &problem.poses_of(start, free)[0]).len();
        let (low, high) = (vec![0.0; start.len()], vec![1.0; start.len()]);
        let within = ConstraintSet::new()
            .with_bounds(BoxBounds::new(Some(low), Some(high)))
            .with_nonlinear_inequalities(limits * problem.poses);
        Self { problem, free, limits, within }
    }

    /// Where the ascent from `start` ends; `start` itself where nothing can be evaluated there.
    pub(super) fn end(self, start: &[f64]) -> Vec<f64> {
        let solver = Slsqp::new().with_absolute_accuracy_tolerance(SETTLED);
        let state = SelectedFirstOrderState::new(start.to_vec());
        let ended = Executor::new(self, solver, state).max_iter(MOST_STEPS).run();
        ended.map_or_else(|_| start.to_vec(), |end| end.state.param().clone())
    }

    /// Limits of every pose with their slopes by its scaled free coordinates; none for a pose that the legs cannot take.
    fn limits_at<'x>(&'x self, x: &'x [f64]) -> impl Iterator<Item = Option<Vec<Slope>>> + 'x {
        x.chunks(self.free.len()).map(|part| self.problem.limits_of(part, self.free))
    }
}

impl<R> Constraints for Ascent<'_, '_, R> {
    type Set = Within;

    fn constraints(&self) -> <Within as ConstraintDescription>::Borrowed<'_> {
        self.within.borrowed()
    }
}

/// A point of no value is infinitely bad: the line search steps back from it.
impl<R: PoseRegressor> CostFunction for Ascent<'_, '_, R> {
    type Param = Vec<f64>;
    type Output = f64;
    type Error = Infallible;

    fn cost(&self, x: &Vec<f64>) -> Result<f64, Infallible> {
        Ok(self.problem.logarithm(x, None, self.free).unwrap_or(f64::INFINITY))
    }
}

impl<R: PoseRegressor> Gradient for Ascent<'_, '_, R> {
    type Gradient = Vec<f64>;

    fn gradient(&self, x: &Vec<f64>) -> Result<Vec<f64>, Infallible> {
        let mut gradient = vec![0.0; x.len()];
        match self.problem.logarithm(x, Some(&mut gradient), self.free) {
            Some(_) => Ok(gradient),
            None => Ok(vec![f64::NAN; x.len()]),
        }
    }
}

impl<R: PoseRegressor> NonlinearInequalityValues for Ascent<'_, '_, R> {
    type Param = Vec<f64>;
    type Values = Vec<f64>;
    type Error = Infallible;

    fn nonlinear_inequalities(&self, x: &Vec<f64>) -> Excesses<Vec<f64>> {
        let mut excesses = Vec::with_capacity(self.limits * self.problem.poses);
        for limits in self.limits_at(x) {
            match limits {
                Some(limits) => excesses.extend(limits.iter().map(|(excess, _)| *excess)),
                None => excesses.extend(std::iter::repeat_n(f64::INFINITY, self.limits)),
            }
        }
        Ok(excesses)
    }
}

impl<R: PoseRegressor> ConstraintJacobian for Ascent<'_, '_, R> {
    type Param = Vec<f64>;
    type Jacobian = DenseMatrix;
    type Error = Infallible;

    fn constraint_jacobian(&self, x: &Vec<f64>) -> Excesses<DenseMatrix> {
        let each = self.free.len();
        let mut slopes = vec![0.0; self.limits * self.problem.poses * x.len()];
        let rows_of_a_pose = slopes.chunks_mut((self.limits * x.len()).max(1));
        for (pose, (rows, limits)) in rows_of_a_pose.zip(self.limits_at(x)).enumerate() {
            for (row, (_, slope)) in rows.chunks_mut(x.len()).zip(limits.into_iter().flatten()) {
                row[pose * each..][..each].copy_from_slice(&slope[..each]);
            }
        }
        Ok(DenseMatrix::from_row_slice(self.limits * self.problem.poses, x.len(), &slopes))
    }
}
