//! Generalised least squares of springs, frames, terms and shapes by Gauss-Newton.
//!
//! Minimises `chi2 = |W (y - f(theta))|^2 + sum (p / prior)^2`; the prior widths of term parameters are physical and
//! wide, so they only speak where the data are silent. Springs and frames have no prior.

use std::sync::Arc;

use hexbench_core::statistics::median;
use nalgebra::{DMatrix, DVector};

use crate::campaign::Campaign;
use crate::error::ModelError;
use crate::linearization::{Active, Linearization, Point, beside};
use crate::lsq::{Solution, Triangle};
use crate::term::{Natural, Term};

/// Iterations after which a fit counts as not settled.
const MOST_ITERATIONS: usize = 40;
/// A fit has settled when a step changes chi-square by less than this.
const SETTLED_CHI2: f64 = 1e-4;
/// Prior standard deviation of the logarithm of a shape about its start.
const SHAPE_PRIOR: f64 = 0.7;
/// Shapes tried on each side of the best one when a covariance is averaged over them.
const SHAPE_STEPS: i32 = 4;
/// A parameter whose standard error exceeds this share of its prior width is not determined by the data.
const DETERMINED_SHARE: f64 = 0.5;

/// A term asked of a fit.
#[derive(Clone)]
pub struct Wanted {
    /// The effect.
    pub term: Arc<dyn Term>,
    /// Richer form.
    pub rich: bool,
    /// Start value of the shape.
    pub shape: f64,
    /// Prior standard deviation of every parameter, SI.
    pub prior: Vec<f64>,
}

/// A fitted model.
#[derive(Debug, Clone)]
pub struct Fit {
    /// Values of springs, terms, shapes and frames.
    pub point: Point,
    /// Covariance of `[springs, frames, parameters and shape of each term in turn]`; a shape enters by its logarithm.
    pub covariance: DMatrix<f64>,
    /// Column of the first parameter of each term.
    pub offsets: Vec<usize>,
    /// Prior width of each column, infinite without prior.
    pub prior: DVector<f64>,
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
    /// Gauss-Newton iterations made.
    pub iterations: usize,
    /// Points tried on the way, those of shortened steps included: each cost one linearisation of the campaign.
    pub tried: usize,
    /// False when the iterations ran out first.
    pub settled: bool,
    /// Change of chi-square in the last iteration.
    pub last_step: f64,
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
        let by_prior =
            self.prior[column].is_finite() && self.std(column) > DETERMINED_SHARE * self.prior[column];
        !by_prior && self.solution.undetermined_share(column) < 1e-3
    }

    /// Sizes natural to the machine and campaign, from the fitted springs.
    pub fn natural(&self, linearization: &Linearization) -> Natural {
        natural(&self.point, linearization)
    }
}

/// Sizes natural to a machine and campaign.
pub fn natural(point: &Point, lin: &Linearization) -> Natural {
    let typical = median(point.springs.iter().map(|c| c.abs())).unwrap_or(0.0);
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
/// [`ModelError::SingularPose`], [`ModelError::NoLoad`], [`ModelError::NotFinite`]. Iterations that run out are not an error:
/// [`Fit::settled`] tells.
pub fn fit(campaign: &Campaign, wanted: &[Wanted], start: Option<&Point>) -> Result<Fit, ModelError> {
    let point = start_point(campaign, wanted, start);
    let state = Linearization::at(campaign, &point)?;
    fit_from(campaign, wanted, point, state)
}

/// What a fit has cost so far.
#[derive(Debug, Clone, Copy, Default)]
struct Effort {
    iterations: usize,
    tried: usize,
}

/// The same from a point where the campaign has been linearised already.
fn fit_from(
    campaign: &Campaign,
    wanted: &[Wanted],
    mut point: Point,
    mut state: Linearization,
) -> Result<Fit, ModelError> {
    let prior = prior_widths(campaign, wanted);
    if state.conditions.iter().all(|c| c.force_change().amax() < 1e-9) {
        return Err(ModelError::NoLoad);
    }
    let mut objective = state.residuals().norm_squared() + penalty(&point, wanted);
    let mut effort = Effort::default();
    loop {
        effort.iterations += 1;
        let solution = step(&state, &point, wanted, &prior)?;
        // Relative to the misfit: a wrong model need not be settled to the last digit.
        let small = SETTLED_CHI2 * (objective / state.equations() as f64).max(1.0);
        let most = objective + 0.5 * small;
        let (next, next_state, next_objective) =
            search(campaign, &point, &solution.x, wanted, most, &mut effort)?;
        let last_step = (objective - next_objective).abs();
        point = next;
        state = next_state;
        objective = next_objective;
        let settled = last_step < small;
        if settled || effort.iterations == MOST_ITERATIONS {
            let solution = step(&state, &point, wanted, &prior)?;
            let fit = finish(campaign, point, &state, solution, prior, wanted, effort);
            return Ok(Fit { settled, last_step, ..fit });
        }
    }
}

/// The fit without some groups of the campaign, from where the whole of it was linearised.
///
/// # Errors
/// As [`fit`].
pub fn refit(
    campaign: &Campaign,
    wanted: &[Wanted],
    start: &Start,
    kept: &[usize],
) -> Result<Fit, ModelError> {
    let state = start.state.choose(kept.iter().copied());
    fit_from(&campaign.part(kept), wanted, start.point.clone(), state)
}

/// Where fits to parts of a campaign start.
pub struct Start {
    point: Point,
    state: Linearization,
}

impl Start {
    /// At a point, with the wanted terms.
    ///
    /// # Errors
    /// [`ModelError::SingularPose`].
    pub fn at(campaign: &Campaign, wanted: &[Wanted], point: &Point) -> Result<Self, ModelError> {
        let point = start_point(campaign, wanted, Some(point));
        let state = Linearization::at(campaign, &point)?;
        Ok(Self { point, state })
    }
}

fn start_point(campaign: &Campaign, wanted: &[Wanted], start: Option<&Point>) -> Point {
    let mut point = start.cloned().unwrap_or_else(|| Point::start(campaign));
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

/// True when the shape of a term is a column of its own.
fn has_shape_column(term: &dyn Term) -> bool {
    term.info().shape.is_some() && !term.shape_is_parameter()
}

fn common(campaign: &Campaign) -> usize {
    if campaign.is_absolute() { 18 } else { 6 }
}

fn prior_widths(campaign: &Campaign, wanted: &[Wanted]) -> DVector<f64> {
    let mut widths = vec![f64::INFINITY; common(campaign)];
    for w in wanted {
        widths.extend(&w.prior);
        if has_shape_column(w.term.as_ref()) {
            widths.push(SHAPE_PRIOR);
        }
    }
    DVector::from_vec(widths)
}

fn penalty(point: &Point, wanted: &[Wanted]) -> f64 {
    let of = |a: &Active, w: &Wanted| {
        let values: f64 = a.values.iter().zip(&w.prior).map(|(p, s)| (p / s).powi(2)).sum();
        values
            + if has_shape_column(a.term.as_ref()) {
                ((a.shape / w.shape).ln() / SHAPE_PRIOR).powi(2)
            } else {
                0.0
            }
    };
    point.active.iter().zip(wanted).map(|(a, w)| of(a, w)).sum()
}

/// One linear solve for the increments of all columns, priors included as equations.
fn step(
    state: &Linearization,
    point: &Point,
    wanted: &[Wanted],
    prior: &DVector<f64>,
) -> Result<Solution, ModelError> {
    let mut triangle = Triangle::new(prior.len());
    for part in state.parts() {
        let piece = state.part(&part);
        triangle.push(&columns(&piece, point), &piece.residuals())?;
    }
    push_priors(&mut triangle, point, wanted, prior)?;
    triangle.solve()
}

/// Priors as equations: `(value + x) / width = 0`.
fn push_priors(
    triangle: &mut Triangle,
    point: &Point,
    wanted: &[Wanted],
    prior: &DVector<f64>,
) -> Result<(), ModelError> {
    let offset = prior_offsets(point, wanted, prior.len());
    let with_prior: Vec<usize> = (0..prior.len()).filter(|&k| prior[k].is_finite()).collect();
    if with_prior.is_empty() {
        return Ok(());
    }
    let rows = DMatrix::from_fn(with_prior.len(), prior.len(), |i, j| {
        if with_prior[i] == j { 1.0 / prior[j] } else { 0.0 }
    });
    let target = DVector::from_fn(with_prior.len(), |i, _| -offset[with_prior[i]] / prior[with_prior[i]]);
    triangle.push(&rows, &target)
}

/// Current distance of every column from the centre of its prior.
fn prior_offsets(point: &Point, wanted: &[Wanted], columns: usize) -> Vec<f64> {
    let used: usize =
        point.active.iter().map(|a| a.values.len() + usize::from(has_shape_column(a.term.as_ref()))).sum();
    let mut offsets = vec![0.0; columns - used];
    for (a, w) in point.active.iter().zip(wanted) {
        offsets.extend(&a.values);
        if has_shape_column(a.term.as_ref()) {
            offsets.push((a.shape / w.shape).ln());
        }
    }
    offsets
}

/// Covariance with the shapes averaged over instead of linearised in: springs follow an exponent or a time constant
/// far from linearly. The profile of the objective over a few shapes gives their weights; each contributes its own
/// covariance and the distance of its solution.
///
/// # Errors
/// As [`fit`].
pub fn average_over_shapes(campaign: &Campaign, wanted: &[Wanted], fit: &mut Fit) -> Result<(), ModelError> {
    let state = Linearization::at(campaign, &fit.point)?;
    for k in 0..wanted.len() {
        if has_shape_column(wanted[k].term.as_ref()) {
            fit.covariance = averaged(&state, wanted, fit, k)?;
        }
    }
    Ok(())
}

/// Covariance averaged over the shape of one term.
fn averaged(
    state: &Linearization,
    wanted: &[Wanted],
    fit: &Fit,
    k: usize,
) -> Result<DMatrix<f64>, ModelError> {
    let a = &fit.point.active[k];
    let shape_column = fit.offsets[k] + a.values.len();
    let spread = fit.std(shape_column).min(SHAPE_PRIOR);
    let [low, high] = a.term.shape_bounds(a.shape);
    let mut seen = Vec::new();
    for step in -SHAPE_STEPS..=SHAPE_STEPS {
        let shift = 3.0 * spread * f64::from(step) / f64::from(SHAPE_STEPS);
        let shape = a.shape * shift.exp();
        if (low..=high).contains(&shape) {
            seen.push(at_shape(state, wanted, fit, k, shape)?);
        }
    }
    let best = seen.iter().map(|s| s.0).fold(f64::INFINITY, f64::min);
    let weights: Vec<f64> = seen.iter().map(|s| (-0.5 * (s.0 - best)).exp()).collect();
    let total: f64 = weights.iter().sum();
    let mut covariance = DMatrix::zeros(fit.prior.len(), fit.prior.len());
    for ((_, x, own), w) in seen.iter().zip(&weights) {
        covariance += (own + x * x.transpose()) * (w / total);
    }
    Ok(covariance)
}

/// Objective, increments (the logarithm of the shape among them) and covariance with one shape held at a value.
fn at_shape(
    state: &Linearization,
    wanted: &[Wanted],
    fit: &Fit,
    k: usize,
    shape: f64,
) -> Result<(f64, DVector<f64>, DMatrix<f64>), ModelError> {
    let a = &fit.point.active[k];
    let held = fit.offsets[k] + a.values.len();
    let mut moved = fit.point.clone();
    moved.active[k].shape = shape;
    let values = DVector::from_column_slice(&a.values);
    let block = |s: f64| state.term_block(a.term.as_ref(), a.rich, s) * &values;
    let residual = state.residuals() + block(a.shape) - block(shape);
    let mut columns = columns(state, &moved);
    columns.column_mut(held).fill(0.0);
    let mut triangle = Triangle::new(columns.ncols());
    triangle.push(&columns, &residual)?;
    push_priors(&mut triangle, &moved, wanted, &fit.prior)?;
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
pub fn columns(state: &Linearization, point: &Point) -> DMatrix<f64> {
    let mut blocks = vec![state.common_block()];
    for a in &point.active {
        let mut block = state.term_block(a.term.as_ref(), a.rich, a.shape);
        if a.term.info().shape.is_some() {
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
        }
        blocks.push(block);
    }
    beside(&blocks)
}

/// Derivative of the whitened reading by the logarithm of a shape, by central differences.
fn shape_column(state: &Linearization, a: &Active) -> DVector<f64> {
    const STEP: f64 = 1e-4;
    let values = DVector::from_column_slice(&a.values);
    let at = |s: f64| state.term_block(a.term.as_ref(), a.rich, s) * &values;
    (at(a.shape * STEP.exp()) - at(a.shape * (-STEP).exp())) / (2.0 * STEP)
}

/// The full step, or the first of its shorter ones that leaves the objective at `most`; none at all when even the shortest does not.
fn search(
    campaign: &Campaign,
    point: &Point,
    x: &DVector<f64>,
    wanted: &[Wanted],
    most: f64,
    effort: &mut Effort,
) -> Result<(Point, Linearization, f64), ModelError> {
    let mut factor = 1.0;
    loop {
        let next = moved(campaign, point, x, factor);
        effort.tried += 1;
        let outcome = Linearization::at(campaign, &next);
        let small = factor < 1e-3;
        match outcome {
            Ok(state) => {
                let value = state.residuals().norm_squared() + penalty(&next, wanted);
                if value <= most {
                    return Ok((next, state, value));
                }
                if small {
                    let state = Linearization::at(campaign, point)?;
                    let value = state.residuals().norm_squared() + penalty(point, wanted);
                    return Ok((point.clone(), state, value));
                }
            }
            Err(e) if small => return Err(e),
            Err(_) => {}
        }
        factor *= 0.4;
    }
}

fn moved(campaign: &Campaign, point: &Point, x: &DVector<f64>, factor: f64) -> Point {
    let mut next = point.clone();
    for leg in 0..6 {
        next.springs[leg] += factor * x[leg];
    }
    if campaign.is_absolute() {
        let motion: Vec<f64> = (6..18).map(|k| factor * x[k]).collect();
        next.move_frames(&motion);
    }
    let mut at = common(campaign);
    for a in &mut next.active {
        for value in &mut a.values {
            *value += factor * x[at];
            at += 1;
        }
        let Some(shape) = a.term.info().shape else { continue };
        if a.term.shape_is_parameter() {
            a.shape = a.values[0].clamp(shape.bounds[0], shape.bounds[1]);
        } else {
            // A shape moves by at most a third per step: its columns are far from linear in it.
            a.shape =
                (a.shape * (factor * x[at]).clamp(-0.3, 0.3).exp()).clamp(shape.bounds[0], shape.bounds[1]);
            at += 1;
        }
    }
    next
}

fn finish(
    campaign: &Campaign,
    point: Point,
    state: &Linearization,
    solution: Solution,
    prior: DVector<f64>,
    wanted: &[Wanted],
    Effort { iterations, tried }: Effort,
) -> Fit {
    let mut offsets = Vec::new();
    let mut at = common(campaign);
    for w in wanted {
        offsets.push(at);
        at += w.prior.len() + usize::from(has_shape_column(w.term.as_ref()));
    }
    let lack_of_fit = state.residuals().norm_squared();
    let unknowns = effective_parameters(&solution, &prior);
    Fit {
        point,
        covariance: solution.covariance.clone(),
        offsets,
        chi2: lack_of_fit + campaign.pure_error,
        dof: (6 * campaign.readings) as f64 - unknowns,
        lack_of_fit,
        lack_of_fit_dof: state.equations() as f64 - unknowns,
        prior,
        solution,
        iterations,
        tried,
        settled: true,
        last_step: 0.0,
    }
}

/// Number of parameters the data determine: rank minus what the priors hold, `sum (1 - var / prior^2)`.
fn effective_parameters(solution: &Solution, prior: &DVector<f64>) -> f64 {
    let held: f64 = (0..prior.len())
        .filter(|&k| prior[k].is_finite())
        .map(|k| (solution.covariance[(k, k)] / prior[k].powi(2)).clamp(0.0, 1.0))
        .sum();
    solution.rank as f64 - held
}
