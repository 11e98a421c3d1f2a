//! One start of the search: sequential quadratic programming within the bounds and limits.

use std::convert::Infallible;

use basin::{
    BoxBounds, ConstraintDescription, ConstraintJacobian, ConstraintSet, ConstraintSolveError, Constraints,
    CostFunction, DenseMatrix, Executor, Gradient, NoLinearConstraints, NoNonlinearBlock, NonlinearBlock,
    NonlinearBlocks, NonlinearInequalityValues, SelectedFirstOrderState, Slsqp, State,
};

/// Steps of one start before it is taken as it is.
const MOST_STEPS: u64 = 150;
/// Change of `-ln value` at which an ascent ends.
const SETTLED: f64 = 1e-9;

/// Every coordinate within its range, every pose within its limits.
type Within = ConstraintSet<
    BoxBounds<Vec<f64>>,
    NoLinearConstraints,
    NonlinearBlocks<NoNonlinearBlock, NonlinearBlock>,
>;
type Excesses<T> = Result<T, ConstraintSolveError<Infallible>>;

/// What is climbed, in coordinates that are each 0..1 over their range.
pub(super) trait Hill {
    /// Number of coordinates.
    fn size(&self) -> usize;

    /// Number of limits.
    fn limits(&self) -> usize;

    /// `-ln value` and its gradient; none where the value is zero.
    fn logarithm(&self, x: &[f64], gradient: Option<&mut [f64]>) -> Option<f64>;

    /// Excesses over the limits; infinite for a pose that the legs cannot take.
    fn excesses(&self, x: &[f64]) -> Vec<f64>;

    /// Their derivatives by the coordinates, row by row.
    fn excess_slopes(&self, x: &[f64]) -> Vec<f64>;
}

/// A hill with its bounds and limits.
pub(super) struct Ascent<'h, H> {
    hill: &'h H,
    limits: usize,
    within: Within,
}

impl<'h, H: Hill> Ascent<'h, H> {
    pub(super) fn new(hill: &'h H) -> Self {
        let (size, limits) = (hill.size(), hill.limits());
        let within = ConstraintSet::new()
            .with_bounds(BoxBounds::new(Some(vec![0.0; size]), Some(vec![1.0; size])))
            .with_nonlinear_inequalities(limits);
        Self { hill, limits, within }
    }

    /// Where the ascent from `start` ends; `start` itself where nothing can be evaluated there.
    pub(super) fn end(self, start: &[f64]) -> Vec<f64> {
        let solver = Slsqp::new().with_absolute_accuracy_tolerance(SETTLED);
        let state = SelectedFirstOrderState::new(start.to_vec());
        let ended = Executor::new(self, solver, state).max_iter(MOST_STEPS).run();
        ended.map_or_else(|_| start.to_vec(), |end| end.state.param().clone())
    }
}

impl<H> Constraints for Ascent<'_, H> {
    type Set = Within;

    fn constraints(&self) -> <Within as ConstraintDescription>::Borrowed<'_> {
        self.within.borrowed()
    }
}

/// A point of no value is infinitely bad: the line search steps back from it.
impl<H: Hill> CostFunction for Ascent<'_, H> {
    type Param = Vec<f64>;
    type Output = f64;
    type Error = Infallible;

    fn cost(&self, x: &Vec<f64>) -> Result<f64, Infallible> {
        Ok(self.hill.logarithm(x, None).unwrap_or(f64::INFINITY))
    }
}

impl<H: Hill> Gradient for Ascent<'_, H> {
    type Gradient = Vec<f64>;

    fn gradient(&self, x: &Vec<f64>) -> Result<Vec<f64>, Infallible> {
        let mut gradient = vec![0.0; x.len()];
        match self.hill.logarithm(x, Some(&mut gradient)) {
            Some(_) => Ok(gradient),
            None => Ok(vec![f64::NAN; x.len()]),
        }
    }
}

impl<H: Hill> NonlinearInequalityValues for Ascent<'_, H> {
    type Param = Vec<f64>;
    type Values = Vec<f64>;
    type Error = Infallible;

    fn nonlinear_inequalities(&self, x: &Vec<f64>) -> Excesses<Vec<f64>> {
        Ok(self.hill.excesses(x))
    }
}

impl<H: Hill> ConstraintJacobian for Ascent<'_, H> {
    type Param = Vec<f64>;
    type Jacobian = DenseMatrix;
    type Error = Infallible;

    fn constraint_jacobian(&self, x: &Vec<f64>) -> Excesses<DenseMatrix> {
        Ok(DenseMatrix::from_row_slice(self.limits, x.len(), &self.hill.excess_slopes(x)))
    }
}
