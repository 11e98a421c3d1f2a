//! Nonlinear least squares: Gauss-Newton steps within a region in which the linear model has kept its promises.
//!
//! At a point the residuals are taken as linear, `r(x) = y - A x`, and
//! ```text
//! x = argmin |y - A x|^2   with |D x| <= radius,   D: largest norm so far of each column of A
//! ```
//! Within the region this is the Gauss-Newton step; beyond it `(A'A + lambda D^2) x = A'y`, shorter and turned towards the steepest
//! descent. The radius shrinks after a step that gains less than a quarter of what the linear model promised, and grows after one that gains
//! more than three quarters. Lengths `|D x|` are in units of the noise, so that a step does not depend on the units of the unknowns.
//!
//! Source: J. J. More (1978), The Levenberg-Marquardt algorithm: implementation and theory, Lecture Notes in Mathematics 630, 105-116.

use nalgebra::DVector;

use crate::error::ModelError;
use crate::estimation::lsq::{Solution, Triangle};

/// Share of the promised gain below which the region was too large, and above which it may grow.
const POOR_GAIN: f64 = 0.25;
const GOOD_GAIN: f64 = 0.75;
/// Radius after a poor step, and after a good one, as shares of that step.
const SHRUNK: f64 = 0.5;
const GROWN: f64 = 2.0;
/// Steps from a point that may fail before the next are shortened more and more.
const PATIENCE: i32 = 3;

/// What is fitted.
pub trait NonlinearProblem {
    /// The unknowns with all that was computed there.
    type Point;

    /// Sum of squared residuals.
    fn objective(&self, at: &Self::Point) -> f64;

    /// The linear equations of a step from a point, `A x = y` with `|y|^2` the objective.
    ///
    /// # Errors
    /// Numbers that are not finite.
    fn equations(&self, at: &Self::Point) -> Result<Triangle, ModelError>;

    /// The point that a step leads to.
    ///
    /// # Errors
    /// The model cannot be computed there: a shorter step is tried.
    fn moved(&self, at: &Self::Point, step: &DVector<f64>) -> Result<Self::Point, ModelError>;

    /// Unknowns that stand at a bound which a step would cross: the others step without them.
    fn held(&self, _at: &Self::Point, _step: &DVector<f64>) -> Vec<usize> {
        Vec::new()
    }

    /// Takes a step that promises less than is worth one as the linear model foretells it, without computing anything there, where the
    /// problem allows that; `promised`: what it takes off the objective.
    fn take_as_foretold(&self, _at: &mut Self::Point, _step: &DVector<f64>, _promised: f64) -> bool {
        false
    }

    /// True where another search has found less than this one will, by what a step promises to take off the objective.
    fn is_outdone(&self, _at: &Self::Point, _promised: f64) -> bool {
        false
    }

    /// Change of the objective that is not worth a step from a point.
    fn negligible(&self, at: &Self::Point) -> f64;
}

/// Limits of a search.
#[derive(Debug, Clone, Copy)]
pub struct TrustRegion {
    /// Length `|D x|` of the first step at most, in units of the noise; infinite where the model is nearly linear.
    pub first_radius: f64,
    /// Points at which the equations are made at most.
    pub most_iterations: usize,
}

/// Why a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Termination {
    /// A step changed the objective, or promised to, by less than is worth a step.
    Settled,
    /// No step that promises anything keeps its promise: a minimum to the last digits, or as far as differences lead.
    NoDescent,
    /// The iterations ran out first.
    MostIterations,
    /// Another search has found less than this one would.
    Outdone,
}

/// What a search has cost.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct SearchEffort {
    /// Points at which the equations were made and steps began.
    pub iterations: usize,
    /// Points tried on the way, those of steps that were shortened included.
    pub tried: usize,
}

/// Where a search ended.
#[derive(Debug, Clone)]
pub struct Minimum<P> {
    /// The point.
    pub point: P,
    /// The linear solution there, for rank and covariance.
    pub solution: Solution,
    /// What it cost.
    pub effort: SearchEffort,
    /// Why it ended.
    pub termination: Termination,
}

impl TrustRegion {
    /// Goes from a point downhill until nothing is to be gained.
    ///
    /// # Errors
    /// Where the equations cannot be made or solved, and where a problem cannot be computed at any point near the last one.
    pub fn minimum<P: NonlinearProblem>(
        &self,
        problem: &P,
        start: P::Point,
    ) -> Result<Minimum<P::Point>, ModelError> {
        let mut search =
            Search { problem, point: start, radius: self.first_radius, effort: SearchEffort::default() };
        let mut scale = DVector::zeros(0);
        loop {
            search.effort.iterations += 1;
            let triangle = problem.equations(&search.point)?;
            let solution = triangle.solve()?;
            scale = largest(&scale, &solution.column_norms);
            let held = problem.held(&search.point, &solution.x);
            let step = if held.is_empty() {
                search.step(&triangle, &solution.x, &scale)?
            } else {
                let free = triangle.without(&held);
                search.step(&free, &free.solve()?.x, &scale)?
            };
            let termination = match step {
                Step::Gain if search.effort.iterations < self.most_iterations => continue,
                Step::Gain => Termination::MostIterations,
                Step::Negligible | Step::Foretold => Termination::Settled,
                Step::None => Termination::NoDescent,
                Step::Outdone => Termination::Outdone,
            };
            // Where nothing more was computed, the last solution is that of the point.
            let solution = match step {
                Step::Foretold | Step::None | Step::Outdone => solution,
                Step::Gain | Step::Negligible => problem.equations(&search.point)?.solve()?,
            };
            return Ok(Minimum { point: search.point, solution, effort: search.effort, termination });
        }
    }
}

/// The larger of two norms of each column.
fn largest(before: &DVector<f64>, now: &DVector<f64>) -> DVector<f64> {
    if before.is_empty() { now.clone() } else { before.sup(now) }
}

#[derive(Clone, Copy)]
enum Step {
    Gain,
    Negligible,
    Foretold,
    None,
    Outdone,
}

struct Search<'a, P: NonlinearProblem> {
    problem: &'a P,
    point: P::Point,
    radius: f64,
    effort: SearchEffort,
}

impl<P: NonlinearProblem> Search<'_, P> {
    /// The longest step within the region after which the objective is no larger than before.
    fn step(
        &mut self,
        triangle: &Triangle,
        full: &DVector<f64>,
        scale: &DVector<f64>,
    ) -> Result<Step, ModelError> {
        let objective = self.problem.objective(&self.point);
        let negligible = self.problem.negligible(&self.point);
        let mut failures = 0;
        loop {
            let x = if full.component_mul(scale).norm() <= self.radius {
                full.clone()
            } else {
                triangle.within(scale, self.radius)?
            };
            let length = x.component_mul(scale).norm();
            let promised = objective - triangle.misfit(&x);
            if promised < negligible && self.problem.take_as_foretold(&mut self.point, &x, promised) {
                return Ok(Step::Foretold);
            }
            if self.problem.is_outdone(&self.point, promised) {
                return Ok(Step::Outdone);
            }
            self.effort.tried += 1;
            let next = self.problem.moved(&self.point, &x);
            let value = next.as_ref().map_or(f64::INFINITY, |there| self.problem.objective(there));
            // No number is no gain.
            let gain = (objective - value).max(f64::NEG_INFINITY);
            let is_kept = gain >= -0.5 * negligible;
            if is_kept && gain > GOOD_GAIN * promised {
                self.radius = self.radius.max(GROWN * length);
            } else if gain < POOR_GAIN * promised {
                failures += 1;
                // Where one step after the other fails, thousandths of them may still be too long.
                self.radius = SHRUNK.powi((failures - PATIENCE).max(1)) * length;
            }
            match next {
                Ok(next) if is_kept => {
                    self.point = next;
                    return Ok(if gain.abs() < negligible { Step::Negligible } else { Step::Gain });
                }
                // What is promised falls with the square of a step towards a minimum, else with the step.
                Ok(_) if promised < negligible => return Ok(Step::None),
                Err(why) if promised < negligible => return Err(why),
                _ => {}
            }
        }
    }
}
