//! Scans over periods, thresholds and legs: one candidate at a time beside everything found so far.

use hexbench_core::Matrix6;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::campaign::Campaign;
use crate::candidates::{orthonormal, project, target};
use crate::linearization::{Linearization, Point};
use crate::pattern::{Course, Pattern, Variable, spread};
use crate::period::period_grid;
use crate::term::Term;

/// Steps of the search for the top of a peak.
const GOLDEN_STEPS: usize = 20;

/// The residual and the columns that any further effect has to share it with.
pub(crate) struct Scanner<'a> {
    lin: &'a Linearization,
    basis: DMatrix<f64>,
    residual: DVector<f64>,
    /// Whitened reading per leg elongation at every condition.
    readers: Vec<Matrix6>,
}

impl<'a> Scanner<'a> {
    /// `point`: the terms at which `lin` was made; `except`: one that is to be explained anew.
    pub(crate) fn new(lin: &'a Linearization, point: &Point, except: Option<&str>) -> Self {
        let mut columns = vec![lin.common_block()];
        let kept = point.active.iter().filter(|a| Some(a.id()) != except);
        columns.extend(kept.map(|a| lin.term_block(a.term.as_ref(), a.rich, a.shape)));
        let width = columns.iter().map(DMatrix::ncols).sum();
        let mut all = DMatrix::zeros(lin.equations(), width);
        let mut at = 0;
        for c in &columns {
            all.columns_mut(at, c.ncols()).copy_from(c);
            at += c.ncols();
        }
        let basis = orthonormal(&all);
        let mut residual = target(lin, point);
        project(&basis, &mut residual);
        Self { lin, basis, residual, readers: lin.elongation_readers() }
    }

    /// Drop of chi-square when these columns are added.
    fn drop(&self, columns: &DMatrix<f64>) -> f64 {
        let overlap = self.basis.tr_mul(columns);
        let b = columns.tr_mul(&self.residual);
        let mut g = columns.tr_mul(columns) - overlap.tr_mul(&overlap);
        let ridge = 1e-9 * g.diagonal().max().max(f64::MIN_POSITIVE);
        for k in 0..g.nrows() {
            g[(k, k)] += ridge;
        }
        g.cholesky().map_or(0.0, |c| b.dot(&c.solve(&b)))
    }

    /// Shape of a term with the largest drop: the best of the grid, refined between its neighbours.
    pub(crate) fn best_shape(&self, term: &dyn Term, grid: &[f64]) -> f64 {
        let drop = |s: f64| self.drop(&self.lin.term_block(term, false, s));
        let scores: Vec<f64> = grid.par_iter().map(|&s| drop(s)).collect();
        let Some(best) = highest(&scores) else { return 1.0 };
        golden(grid[best.saturating_sub(1)], grid[(best + 1).min(grid.len() - 1)], drop)
    }

    /// The best pattern of every family, with the number of patterns it was chosen from.
    pub(crate) fn patterns(&self, campaign: &Campaign) -> Vec<(Pattern, usize)> {
        let best = |family: &Vec<Pattern>| {
            let scores: Vec<f64> = family.par_iter().map(|p| self.pattern_drop(p)).collect();
            highest(&scores).map(|i| (self.refined(family[i]), family.len()))
        };
        families(campaign, self.lin).iter().filter_map(best).collect()
    }

    fn pattern_drop(&self, pattern: &Pattern) -> f64 {
        let range = spread(pattern.variable, &self.lin.conditions);
        if range <= 0.0 {
            return 0.0;
        }
        let mut columns = DMatrix::zeros(self.lin.equations(), pattern.width());
        for (i, (c, reader)) in self.lin.conditions.iter().zip(&self.readers).enumerate() {
            for (wave, e) in pattern.elongations(c, range).iter().take(pattern.width()).enumerate() {
                let reading = pattern.leg.map_or_else(|| reader * e, |leg| reader.column(leg) * e[leg]);
                columns.fixed_view_mut::<6, 1>(6 * i, wave).copy_from(&reading);
            }
        }
        self.drop(&columns)
    }

    /// A periodic pattern with its period between the grid points on both sides.
    fn refined(&self, pattern: Pattern) -> Pattern {
        let Course::Periodic(period) = pattern.course else { return pattern };
        let grid = period_grid(&self.lin.conditions);
        let place = grid.iter().position(|&p| p <= period).unwrap_or(0);
        let (longer, shorter) = (grid[place.saturating_sub(1)], grid[(place + 1).min(grid.len() - 1)]);
        let with = |p: f64| Pattern { course: Course::Periodic(p), ..pattern };
        with(golden(shorter, longer, |p| self.pattern_drop(&with(p))))
    }
}

fn highest(scores: &[f64]) -> Option<usize> {
    (0..scores.len()).max_by(|&a, &b| scores[a].total_cmp(&scores[b]))
}

/// Maximum of a function with one peak between two points, by golden sections.
fn golden(a: f64, b: f64, f: impl Fn(f64) -> f64) -> f64 {
    const RATIO: f64 = 0.618_033_988_749_894_9;
    let (mut low, mut high) = (a.min(b), a.max(b));
    let (mut x, mut y) = (high - RATIO * (high - low), low + RATIO * (high - low));
    let (mut fx, mut fy) = (f(x), f(y));
    for _ in 0..GOLDEN_STEPS {
        if fx > fy {
            (high, y, fy) = (y, x, fx);
            x = high - RATIO * (high - low);
            fx = f(x);
        } else {
            (low, x, fx) = (x, y, fy);
            y = low + RATIO * (high - low);
            fy = f(y);
        }
    }
    f64::midpoint(low, high)
}

/// Families of patterns that no term of the catalogue describes: waves over leg length common to all legs, waves in
/// single legs, courses of leg and variable, steps.
fn families(campaign: &Campaign, lin: &Linearization) -> Vec<Vec<Pattern>> {
    let periods = period_grid(&lin.conditions);
    let wave = |leg: Option<usize>| {
        let pattern = move |p: &f64| Pattern {
            leg,
            variable: Variable::LegLength,
            course: Course::Periodic(*p),
            compliance: true,
        };
        periods.iter().map(pattern).collect::<Vec<_>>()
    };
    let courses = variables(campaign, lin).into_iter().flat_map(courses).collect();
    let steps = variables(campaign, lin).into_iter().flat_map(|v| steps(v, lin)).collect();
    let mut families = vec![wave(None), (0..6).flat_map(|l| wave(Some(l))).collect(), courses, steps];
    families.retain(|f: &Vec<Pattern>| !f.is_empty());
    families
}

/// Variables that vary in these data.
fn variables(campaign: &Campaign, lin: &Linearization) -> Vec<Variable> {
    let present = [
        (Variable::Elapsed, campaign.columns.elapsed),
        (Variable::DeltaT, campaign.columns.delta_t),
        (Variable::LegLength, true),
        (Variable::LegForce, true),
    ];
    let varies = |v: Variable| spread(v, &lin.conditions) > 0.0;
    present.into_iter().filter(|(v, has)| *has && varies(*v)).map(|(v, _)| v).collect()
}

fn legs() -> impl Iterator<Item = Option<usize>> + Clone {
    std::iter::once(None).chain((0..6).map(Some))
}

fn courses(variable: Variable) -> Vec<Pattern> {
    let mut all = Vec::new();
    for leg in legs() {
        for compliance in [false, true] {
            for course in [Course::Linear, Course::Quadratic] {
                let pattern = Pattern { leg, variable, course, compliance };
                if !in_catalogue(&pattern) {
                    all.push(pattern);
                }
            }
        }
    }
    all
}

/// Patterns that are terms: compliance in proportion to length, length in proportion to temperature.
fn in_catalogue(p: &Pattern) -> bool {
    let known = [(Variable::LegLength, true), (Variable::DeltaT, false)];
    p.leg.is_none() && p.course == Course::Linear && known.contains(&(p.variable, p.compliance))
}

fn steps(variable: Variable, lin: &Linearization) -> Vec<Pattern> {
    if variable == Variable::LegForce {
        return Vec::new();
    }
    let cuts = thresholds(variable, lin);
    let kinds = legs().flat_map(|leg| [(leg, false), (leg, true)]);
    let step = |(leg, compliance), at: f64| Pattern { leg, variable, course: Course::Step(at), compliance };
    kinds.flat_map(|kind| cuts.iter().map(move |&at| step(kind, at))).collect()
}

/// Values between which a step may lie: the twentieths of the variable.
fn thresholds(variable: Variable, lin: &Linearization) -> Vec<f64> {
    let per_leg = |c| (0..6).map(move |leg| variable.value(c, leg));
    let mut values: Vec<f64> = lin.conditions.iter().flat_map(per_leg).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    let n = values.len();
    if n < 4 {
        return Vec::new();
    }
    let mut cuts: Vec<f64> = (1..20).map(|k| values[(k * n / 20).min(n - 2)]).collect();
    cuts.dedup();
    cuts
}
