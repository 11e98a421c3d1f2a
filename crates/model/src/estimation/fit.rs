//! Generalised least squares of springs, frames, terms and shapes, by Gauss-Newton steps within a trust region.
//!
//! Minimizes `chi2 = |W (y - f(theta))|^2 + sum (p / prior)^2`; the prior widths of term parameters are physical and
//! wide, so they only speak where the data are silent. Springs and frames have no prior.

use std::cell::Cell;
use std::sync::Arc;

use hexbench_core::statistics::median;
use nalgebra::{DMatrix, DVector};

use crate::effects::term::{Natural, Term};
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::equations::Equations;
use crate::estimation::linearization::{Active, Linearization, ModelPoint, beside};
use crate::estimation::lsq::{Solution, Triangle};
use crate::estimation::parameters::Parameters;
use crate::estimation::trust_region::{Minimum, NonlinearProblem, SearchEffort, Termination, TrustRegion};

/// The model is nearly linear in most of its numbers: the first step may be as long as it likes.
const TRUST_REGION: TrustRegion = TrustRegion { first_radius: f64::INFINITY, most_iterations: 40 };
/// A fit has settled when a step changes chi-square by less than this.
const SETTLED_CHI2: f64 = 1e-4;
/// Shapes tried on each side of the best one when a covariance is averaged over them.
const SHAPE_STEPS: i32 = 4;
/// Step of the logarithm of a shape for its derivative.
const SHAPE_STEP: f64 = 1e-4;
/// Least difference of shapes, in the logarithm.
const SETTLED_SHAPE: f64 = 1e-9;
/// Change of the logarithm of a shape over which readings follow its derivative.
const FORETOLD_SHAPE_STEP: f64 = 1e-2;
/// What a fit may still take off chi-square, as a multiple of what its next step promises: along a valley that bends, one step after the
/// other promises a small part of what all of them gain.
const HOPE: f64 = 30.0;
/// A parameter whose standard error exceeds this share of its prior width is not determined by the data.
const DETERMINED_SHARE: f64 = 0.5;

/// A term asked of a fit.
#[derive(Clone)]
pub struct TermSpec {
    /// The effect.
    pub term: Arc<dyn Term>,
    /// Richer form.
    pub rich: bool,
    /// Start value of the shape.
    pub shape: f64,
    /// Prior standard deviation of every parameter, SI.
    pub prior: Vec<f64>,
}

impl PartialEq for TermSpec {
    /// True for the same term, not only one that is alike.
    fn eq(&self, other: &Self) -> bool {
        std::ptr::addr_eq(Arc::as_ptr(&self.term), Arc::as_ptr(&other.term))
            && (self.rich, self.shape) == (other.rich, other.shape)
            && self.prior == other.prior
    }
}

/// A fitted model.
#[derive(Debug, Clone)]
pub struct Fit {
    /// Values of springs, terms, shapes and frames.
    pub point: ModelPoint,
    /// Its numbers, in the order of the columns.
    pub parameters: Parameters,
    /// Their covariance; a shape enters by its logarithm.
    pub covariance: DMatrix<f64>,
    /// Sum of squared whitened residuals over single readings (lack of fit plus pure error).
    pub chi2: f64,
    /// Equations of single readings minus rank.
    pub dof: f64,
    /// Sum of squared whitened residuals of the averaged readings.
    pub lack_of_fit: f64,
    /// Its degrees of freedom.
    pub lack_of_fit_dof: f64,
    /// The last linear solution, for rank and unobservable combinations.
    pub solution: Solution,
    /// Iterations made, and points tried on the way: each cost one linearization of the campaign.
    pub effort: SearchEffort,
    /// Why it ended.
    pub termination: Termination,
}

impl Fit {
    /// Chi-square per degree of freedom of single readings.
    pub fn chi2_reduced(&self) -> f64 {
        self.chi2 / self.dof.max(1.0)
    }

    /// Standard error of a column.
    pub fn std(&self, column: usize) -> f64 {
        self.covariance[(column, column)].max(0.0).sqrt()
    }

    /// True when the data, and not the prior or nothing at all, determine a column.
    pub fn is_determined(&self, column: usize) -> bool {
        let prior = self.parameters[column].prior;
        let by_prior = prior.is_some_and(|p| self.std(column) > DETERMINED_SHARE * p.width);
        !by_prior && self.solution.undetermined_share(column) < 1e-3
    }

    /// True when it ended because there was nothing left to gain.
    pub fn is_settled(&self) -> bool {
        !matches!(self.termination, Termination::MostIterations | Termination::Outdone)
    }

    /// Sizes natural to the machine and campaign, from the fitted springs.
    pub fn natural(&self, linearization: &Linearization) -> Natural {
        natural(&self.point, linearization)
    }
}

/// Sizes natural to a machine and campaign.
pub fn natural(point: &ModelPoint, lin: &Linearization) -> Natural {
    let typical = median(point.compliances.iter().map(|c| c.abs())).unwrap_or(0.0);
    let n = (6 * lin.conditions.len()).max(1) as f64;
    let force = lin.conditions.iter().map(|c| c.force_change().norm_squared()).sum::<f64>() / n;
    let hexapod = &lin.machine.nominal;
    Natural {
        compliance: typical.max(1e-12),
        force: force.sqrt().max(1e-6),
        radius: hexapod.platform_radius().max(1e-6),
        length: lin.machine.home_lengths.mean().max(1e-6),
        elapsed: lin.conditions.iter().map(|c| c.elapsed.abs()).fold(0.0, f64::max),
    }
}

/// Fit springs (and frames in absolute mode) alone.
///
/// # Errors
/// As [`fit`].
pub fn fit_baseline(campaign: &Campaign) -> Result<Fit, ModelError> {
    fit(campaign, &[], None)
}

/// Fit springs, frames and the wanted terms, starting from `start` when given.
///
/// # Errors
/// [`ModelError::SingularPose`], [`ModelError::NoLoad`], [`ModelError::NotFinite`]; [`ModelError::Astray`] for absolute poses that no
/// frames bring near the commanded ones. Iterations that run out are not an error:
/// [`Fit::termination`] tells.
pub fn fit(campaign: &Campaign, wanted: &[TermSpec], start: Option<&ModelPoint>) -> Result<Fit, ModelError> {
    if start.is_none() {
        campaign.refuse_astray(&campaign.frames, "")?;
    }
    let point = start_point(campaign, wanted, start);
    let equations = Equations::at(campaign, &point)?;
    fit_from(campaign, wanted, (point, equations), f64::INFINITY)
}

/// The same beside another fit, with that chi-square: one that will not come below it ends before it has settled.
///
/// # Errors
/// As [`fit`].
pub(crate) fn fit_beside(
    campaign: &Campaign,
    wanted: &[TermSpec],
    start: &ModelPoint,
    rival: f64,
) -> Result<Fit, ModelError> {
    let Start { point, equations } = Start::at(campaign, wanted, start)?;
    fit_from(campaign, wanted, (point, equations), rival)
}

/// The same from a point where the campaign has been linearized already.
fn fit_from(
    campaign: &Campaign,
    wanted: &[TermSpec],
    (point, equations): (ModelPoint, Equations),
    rival: f64,
) -> Result<Fit, ModelError> {
    let parameters = Parameters::at(&point, campaign.is_absolute()).with_priors(wanted);
    if !equations.is_loaded {
        return Err(ModelError::NoLoad);
    }
    let (numbers, place) = (campaign.averaged_numbers(), Cell::default());
    let problem = FitProblem { campaign, parameters, numbers, rival, place };
    let start = problem.seen_from(point, equations)?;
    let found = TRUST_REGION.minimum(&problem, start)?;
    Ok(finish(found, problem))
}

/// A campaign and the numbers that are fitted to it.
struct FitProblem<'a> {
    campaign: &'a Campaign,
    parameters: Parameters,
    /// Averaged numbers that were read.
    numbers: f64,
    /// Chi-square of the best fit so far from another start.
    rival: f64,
    /// Where the last equations stood: to take memory anew for those of every step costs as much as to write them.
    place: Cell<DMatrix<f64>>,
}

/// Numbers of a model, chi-square with what the priors add, and the equations of the campaign there: where the last step was taken as
/// foretold, those before it.
struct FitPoint {
    point: ModelPoint,
    triangle: Triangle,
    objective: f64,
}

impl FitProblem<'_> {
    fn seen_from(&self, point: ModelPoint, equations: Equations) -> Result<FitPoint, ModelError> {
        let triangle = equations.triangle()?;
        self.place.set(equations.into_place());
        let objective = triangle.misfit_at_zero() + self.parameters.penalty(&point);
        Ok(FitPoint { point, triangle, objective })
    }
}

impl NonlinearProblem for FitProblem<'_> {
    type Point = FitPoint;

    fn objective(&self, at: &FitPoint) -> f64 {
        at.objective
    }

    /// Priors included as equations.
    fn equations(&self, at: &FitPoint) -> Result<Triangle, ModelError> {
        let mut triangle = at.triangle.clone();
        push_priors(&mut triangle, &at.point, &self.parameters)?;
        Ok(triangle)
    }

    fn moved(&self, at: &FitPoint, step: &DVector<f64>) -> Result<FitPoint, ModelError> {
        let point = self.parameters.moved(&at.point, step.as_slice());
        let equations = Equations::at_in(self.place.take(), self.campaign, &point)?;
        self.seen_from(point, equations)
    }

    /// Shapes that a step would not move.
    fn held(&self, at: &FitPoint, step: &DVector<f64>) -> Vec<usize> {
        let there = self.parameters.moved(&at.point, step.as_slice());
        let shape = |point: &ModelPoint, term: usize| point.active[term].shape.to_bits();
        let stands = |&term: &usize| shape(&there, term) == shape(&at.point, term);
        let terms = (0..there.active.len()).filter(stands);
        terms.filter_map(|term| self.parameters.shape_of_term(term)).collect()
    }

    /// Unless it changes a shape by more than a derivative is good for.
    fn take_as_foretold(&self, at: &mut FitPoint, step: &DVector<f64>, promised: f64) -> bool {
        let shapes = (0..at.point.active.len()).filter_map(|term| self.parameters.shape_of_term(term));
        if shapes.into_iter().any(|column| step[column].abs() > FORETOLD_SHAPE_STEP) {
            return false;
        }
        at.point = self.parameters.moved(&at.point, step.as_slice());
        at.objective -= promised;
        true
    }

    fn is_outdone(&self, at: &FitPoint, promised: f64) -> bool {
        let chi2 = at.objective - self.parameters.penalty(&at.point) + self.campaign.pure_error;
        chi2 - HOPE * promised > self.rival
    }

    /// Relative to the misfit: a wrong model need not be settled to the last digit.
    fn negligible(&self, at: &FitPoint) -> f64 {
        SETTLED_CHI2 * (at.objective / self.numbers).max(1.0)
    }
}

/// The fit without some groups of the campaign, from where the whole of it was linearized.
///
/// # Errors
/// As [`fit`].
pub fn refit(
    campaign: &Campaign,
    wanted: &[TermSpec],
    start: &Start,
    kept: &[usize],
) -> Result<Fit, ModelError> {
    let part = campaign.part(kept);
    let equations = start.equations.choose_of(&part, kept);
    fit_from(&part, wanted, (start.point.clone(), equations), f64::INFINITY)
}

/// Where fits to parts of a campaign start.
pub struct Start {
    pub(crate) point: ModelPoint,
    pub(crate) equations: Equations,
}

impl Start {
    /// At a point, with the wanted terms.
    ///
    /// # Errors
    /// [`ModelError::SingularPose`].
    pub fn at(campaign: &Campaign, wanted: &[TermSpec], point: &ModelPoint) -> Result<Self, ModelError> {
        Self::where_known(campaign, wanted, point, None)
    }

    /// The same where the equations at the point may be at hand, with the terms that it has.
    ///
    /// # Errors
    /// As [`Self::at`].
    pub(crate) fn where_known(
        campaign: &Campaign,
        wanted: &[TermSpec],
        known: &ModelPoint,
        equations: Option<Equations>,
    ) -> Result<Self, ModelError> {
        let point = start_point(campaign, wanted, Some(known));
        let equations = match equations.filter(|_| have_the_same_terms(&point, known)) {
            Some(there) => there,
            None => Equations::at(campaign, &point)?,
        };
        Ok(Self { point, equations })
    }
}

/// True for the same terms in the same order, with the same shapes.
fn have_the_same_terms(a: &ModelPoint, b: &ModelPoint) -> bool {
    let of = |point: &ModelPoint| -> Vec<_> {
        point.active.iter().map(|a| (Arc::as_ptr(&a.term).cast::<()>(), a.rich, a.shape.to_bits())).collect()
    };
    of(a) == of(b)
}

fn start_point(campaign: &Campaign, wanted: &[TermSpec], start: Option<&ModelPoint>) -> ModelPoint {
    let mut point = start.cloned().unwrap_or_else(|| ModelPoint::start(campaign));
    let known = std::mem::take(&mut point.active);
    point.active = wanted
        .iter()
        .map(|w| {
            let fresh = Active::new(Arc::clone(&w.term), w.rich, w.shape);
            let same = |a: &&Active| a.id() == fresh.id() && a.values.len() == fresh.values.len();
            known.iter().find(same).map_or(fresh.clone(), |a| Active { values: a.values.clone(), ..fresh })
        })
        .collect();
    point
}

pub(crate) fn push_priors(
    triangle: &mut Triangle,
    point: &ModelPoint,
    parameters: &Parameters,
) -> Result<(), ModelError> {
    let (rows, target) = parameters.prior_equations(point);
    if rows.is_empty() { Ok(()) } else { triangle.push(&rows, &target) }
}

/// Covariance with the shapes averaged over instead of linearized in: springs follow an exponent or a time constant
/// far from linearly. The profile of the objective over a few shapes gives their weights; each contributes its own
/// covariance and the distance of its solution. Of several shapes the last is averaged over: a Gaussian that is as wide as all of them
/// together in every direction foresees nothing any more.
///
/// # Errors
/// As [`fit`].
pub fn average_over_shapes(campaign: &Campaign, fit: &mut Fit) -> Result<(), ModelError> {
    let state = Linearization::at(campaign, &fit.point)?;
    for term in 0..fit.point.active.len() {
        if let Some(column) = fit.parameters.shape_of_term(term) {
            fit.covariance = averaged(&state, fit, term, column)?;
        }
    }
    Ok(())
}

/// Covariance averaged over the shape of one term, which has a column of its own.
fn averaged(
    state: &Linearization,
    fit: &Fit,
    term: usize,
    column: usize,
) -> Result<DMatrix<f64>, ModelError> {
    let a = &fit.point.active[term];
    let spread = fit.parameters[column].prior.map_or(fit.std(column), |p| fit.std(column).min(p.width));
    let [low, high] = a.term.shape_bounds(a.shape);
    // What is at other shapes is this term alone.
    let (mut blocks, here) = (own_blocks(state, &fit.point), state.own_share(a, a.shape));
    let mut seen = Vec::new();
    let step = (3.0 * spread / f64::from(SHAPE_STEPS)).max(SETTLED_SHAPE);
    let near = (-SHAPE_STEPS..=SHAPE_STEPS).map(|k| (a.shape * (step * f64::from(k)).exp(), step));
    let near = near.filter(|(shape, _)| (low..=high).contains(shape));
    let all: Vec<(f64, f64)> = near.chain(shapes_beyond(state, a)).collect();
    for (shape, _) in &all {
        let moved = Active { shape: *shape, ..a.clone() };
        blocks[1 + term] = own_block(state, &moved);
        let columns = state.whitened(beside(&blocks));
        let moves = &here - state.own_share(a, *shape);
        seen.push(at_shape(state, fit, (term, column), *shape, (columns, moves))?);
    }
    let best = seen.iter().map(|s| s.0).fold(f64::INFINITY, f64::min);
    let weights: Vec<f64> =
        seen.iter().zip(&all).map(|(s, (_, width))| width * (-0.5 * (s.0 - best)).exp()).collect();
    let total: f64 = weights.iter().sum();
    let mut covariance = DMatrix::zeros(fit.parameters.len(), fit.parameters.len());
    for ((_, x, own), w) in seen.iter().zip(&weights) {
        covariance += (own + x * x.transpose()) * (w / total);
    }
    // Anywhere in an interval alike: the variance of a uniform distribution.
    covariance[(column, column)] += indifferent(state, a).powi(2) / 12.0;
    Ok(covariance)
}

/// Shapes that a fit cannot reach from where it is, such as exponents on the other side of the spring, with the width that each stands for
/// in the logarithm.
fn shapes_beyond(state: &Linearization, a: &Active) -> Vec<(f64, f64)> {
    let [low, high] = a.term.shape_bounds(a.shape);
    let grid = a.term.shape_grid(&state.conditions);
    let beyond: Vec<f64> = grid.into_iter().filter(|shape| !(low..=high).contains(shape)).collect();
    let width = |k: usize| {
        let neighbors = [k.saturating_sub(1), (k + 1).min(beyond.len() - 1)].map(|k| beyond[k].ln());
        (neighbors[1] - neighbors[0]) / 2.0
    };
    (0..beyond.len()).map(|k| (beyond[k], width(k))).collect()
}

/// Width, in the logarithm of a shape, of the interval in which it changes no reading: an instant between two readings; zero where
/// every change shows.
fn indifferent(state: &Linearization, a: &Active) -> f64 {
    const HALVINGS: usize = 24;
    let at = |log: f64| state.own_share(a, a.shape * log.exp());
    let own = at(0.0);
    let is_same = |log: f64| at(log) == own;
    if !is_same(SHAPE_STEP) && !is_same(-SHAPE_STEP) {
        return 0.0;
    }
    let reach = |end: f64| {
        let (mut same, mut other) = (0.0, (end / a.shape).ln());
        if is_same(other) {
            return other.abs();
        }
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(same, other);
            if is_same(middle) { same = middle } else { other = middle }
        }
        same.abs()
    };
    a.term.shape_bounds(a.shape).into_iter().map(reach).sum()
}

/// Objective, increments (the logarithm of the shape among them) and covariance with one shape held at a value: the whitened columns there,
/// and by what the model moves, over the standard deviation of what is a reading's own.
fn at_shape(
    state: &Linearization,
    fit: &Fit,
    (term, held): (usize, usize),
    shape: f64,
    (mut columns, moves): (DMatrix<f64>, DVector<f64>),
) -> Result<(f64, DVector<f64>, DMatrix<f64>), ModelError> {
    let a = &fit.point.active[term];
    let mut moved = fit.point.clone();
    moved.active[term].shape = shape;
    let residual = state.residuals() + state.whitened_column(moves);
    columns.column_mut(held).fill(0.0);
    let mut triangle = Triangle::new(columns.ncols());
    triangle.push(&columns, &residual)?;
    push_priors(&mut triangle, &moved, &fit.parameters)?;
    let solution = triangle.solve()?;
    let mut x = solution.x;
    x[held] = (shape / a.shape).ln();
    // Held, the shape varies only from one of these fits to the next; its prior is not part of any of them.
    let mut covariance = solution.covariance;
    covariance.column_mut(held).fill(0.0);
    covariance.row_mut(held).fill(0.0);
    Ok((solution.rss, x, covariance))
}

/// Whitened columns of springs, frames, term parameters and shapes at a point.
pub fn columns(state: &Linearization, point: &ModelPoint) -> DMatrix<f64> {
    state.whitened(own_columns(state, point))
}

/// The same over the standard deviation of what is a reading's own.
pub(crate) fn own_columns(state: &Linearization, point: &ModelPoint) -> DMatrix<f64> {
    beside(&own_blocks(state, point))
}

/// Those of springs and frames, then of each term.
fn own_blocks(state: &Linearization, point: &ModelPoint) -> Vec<DMatrix<f64>> {
    let terms = point.active.iter().map(|a| own_block(state, a));
    std::iter::once(state.own_common_block()).chain(terms).collect()
}

/// Those of one term, that of its shape among them.
fn own_block(state: &Linearization, a: &Active) -> DMatrix<f64> {
    let mut block = state.own_term_block(a.term.as_ref(), a.rich, a.shape);
    if a.term.info().shape.is_none() {
        return block;
    }
    let by_log_shape = shape_column(state, a);
    if a.term.shape_is_parameter() {
        // shape = value, so d/dvalue gains (d/dlog shape) / value.
        let tied = block.column(0) + by_log_shape / a.values[0].abs().max(a.shape);
        block.set_column(0, &tied);
    } else {
        let width = block.ncols();
        block = block.insert_column(width, 0.0);
        block.set_column(width, &by_log_shape);
    }
    block
}

/// Derivative of the reading, over the standard deviation of what is its own, by the logarithm of a shape, by central differences.
fn shape_column(state: &Linearization, a: &Active) -> DVector<f64> {
    let at = |s: f64| state.own_share(a, s);
    (at(a.shape * SHAPE_STEP.exp()) - at(a.shape * (-SHAPE_STEP).exp())) / (2.0 * SHAPE_STEP)
}

/// The fit whose linear solution is at hand, without its sums over single readings.
pub(crate) fn settled_at(point: ModelPoint, parameters: Parameters, solution: Solution) -> Fit {
    Fit {
        point,
        covariance: solution.covariance.clone(),
        chi2: solution.rss,
        dof: 0.0,
        lack_of_fit: solution.rss,
        lack_of_fit_dof: 0.0,
        parameters,
        solution,
        effort: SearchEffort { iterations: 1, tried: 0 },
        termination: Termination::Settled,
    }
}

fn finish(found: Minimum<FitPoint>, problem: FitProblem<'_>) -> Fit {
    let Minimum { point: FitPoint { point, objective, .. }, solution, effort, termination } = found;
    let FitProblem { campaign, parameters, numbers, .. } = problem;
    let lack_of_fit = (objective - parameters.penalty(&point)).max(0.0);
    // What the data determine: the rank without what the priors hold.
    let unknowns = solution.rank as f64 - parameters.held_by_priors(&solution.covariance);
    Fit {
        point,
        covariance: solution.covariance.clone(),
        chi2: lack_of_fit + campaign.pure_error,
        dof: campaign.numbers as f64 - unknowns,
        lack_of_fit,
        lack_of_fit_dof: numbers - unknowns,
        parameters,
        solution,
        effort,
        termination,
    }
}
