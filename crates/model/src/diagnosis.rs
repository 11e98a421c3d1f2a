//! Diagnosis: linearise, search, fit, linearise again at the best set, until the best set stays.

use std::sync::Arc;

use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::campaign::Campaign;
use crate::candidates::{
    Candidate, Collector, Kind, Untestable, orthonormal, project, sizes, target, why_untestable,
};
use crate::error::ModelError;
use crate::evidence::Gram;
use crate::fit::{Fit, Wanted, fit, fit_baseline};
use crate::linearization::{Linearization, Point};
use crate::pattern::{Course, Pattern, Variable, spread};
use crate::period::period_grid;
use crate::search::{Search, Set, Sets};
use crate::term::{Natural, Term};

/// Rounds of linearisation and search.
const MOST_ROUNDS: usize = 6;
/// Shape grids longer than this are scanned beside the best set instead of searched.
const LONG_GRID: usize = 24;
/// Prior width of a fit relative to the width the evidence prefers.
const FIT_WIDTH: f64 = 3.0;
/// Prior weight of all patterns together, relative to one term of the catalogue.
const WEIGHT_OF_PATTERNS: f64 = 2.0;
/// Most effects in a set.
const MOST_EFFECTS: usize = 4;

/// Outcome of the search: sets with probabilities, and the fit of the best one.
pub struct Outcome {
    /// Campaign's testable terms and patterns.
    pub candidates: Vec<Candidate>,
    /// Terms that this file cannot test.
    pub untestable: Vec<Untestable>,
    /// All sets looked at.
    pub sets: Sets,
    /// Normal equations of the last round.
    pub gram: Gram,
    /// Fit of the springs alone.
    pub baseline: Fit,
    /// Fit of the terms of the best set.
    pub best: Fit,
    /// Natural sizes.
    pub natural: Natural,
    /// Linearisation at the best fit.
    pub lin: Linearization,
}

/// Search the best explanation of a campaign among `terms` and patterns.
///
/// # Errors
/// As [`fit`].
pub fn explain(campaign: &Campaign, terms: &[Arc<dyn Term>]) -> Result<Outcome, ModelError> {
    let baseline = fit_baseline(campaign)?;
    let mut best = baseline.clone();
    let mut lin = Linearization::at(campaign, &best.point)?;
    let natural = baseline.natural(&lin);
    let mut rich = false;
    let mut history: Vec<Vec<String>> = Vec::new();
    loop {
        let (testable, mut untestable) = split(terms, campaign, &lin);
        let (gram, candidates) = collect(campaign, &best.point, &lin, &testable, natural, rich);
        let (candidates, faint) = noticeable(candidates, &gram);
        untestable.extend(faint);
        let sets = Search::new(&gram, &candidates, campaign.noise.allows_verdict()).run(MOST_EFFECTS, &[]);
        let top = sets.sets.first().cloned();
        let wanted = top.as_ref().map(|s| wanted(s, &gram, &candidates, &natural)).unwrap_or_default();
        let next = fit(campaign, &wanted, Some(&best.point)).or_else(|_| fit(campaign, &wanted, None))?;
        lin = Linearization::at(campaign, &next.point)?;
        best = next;
        let names = top.map(|s| names(&s, &candidates)).unwrap_or_default();
        let settled = history.last() == Some(&names);
        history.push(names);
        if settled || history.len() >= MOST_ROUNDS {
            return Ok(Outcome { candidates, untestable, sets, gram, baseline, best, natural, lin });
        }
        // Richer forms and scans come in once the ideal forms leave something unexplained.
        rich = true;
    }
}

/// Leave out terms of which no physically sensible size would show.
fn noticeable(candidates: Vec<Candidate>, gram: &Gram) -> (Vec<Candidate>, Vec<Untestable>) {
    let why = "no size that makes physical sense would show in these poses and loads";
    let (kept, faint): (Vec<_>, Vec<_>) =
        candidates.into_iter().partition(|c| c.blocks.iter().any(|&b| gram.blocks[b].noticeable));
    let faint = faint.iter().filter_map(Candidate::id).map(|term| Untestable { term, why: why.to_owned() });
    (kept, faint.collect())
}

fn names(set: &Set, candidates: &[Candidate]) -> Vec<String> {
    set.members.iter().map(|&m| label(&candidates[m])).collect()
}

/// Id of a term or description of a pattern.
pub fn label(candidate: &Candidate) -> String {
    match &candidate.kind {
        Kind::Term(t) => t.info().id.to_owned(),
        Kind::Pattern(p) => p.text(),
    }
}

fn split(
    terms: &[Arc<dyn Term>],
    campaign: &Campaign,
    lin: &Linearization,
) -> (Vec<Arc<dyn Term>>, Vec<Untestable>) {
    let (mut testable, mut untestable) = (Vec::new(), Vec::new());
    for term in terms {
        match why_untestable(term.as_ref(), campaign, lin) {
            None => testable.push(Arc::clone(term)),
            Some(why) => untestable.push(Untestable { term: term.info().id, why }),
        }
    }
    (testable, untestable)
}

fn collect(
    campaign: &Campaign,
    point: &Point,
    lin: &Linearization,
    terms: &[Arc<dyn Term>],
    natural: Natural,
    rich: bool,
) -> (Gram, Vec<Candidate>) {
    let mut collector = Collector::new(lin, natural);
    let scanner = Scanner::new(lin, point, None);
    for term in terms {
        let grid = term.shape_grid(&lin.conditions);
        let shapes = if term.info().shape.is_none() {
            vec![1.0]
        } else if grid.len() > LONG_GRID {
            vec![Scanner::new(lin, point, Some(term.info().id)).best_shape(term.as_ref(), &grid)]
        } else if grid.is_empty() {
            continue;
        } else {
            grid.clone()
        };
        let active = point.active.iter().find(|a| a.id() == term.info().id);
        collector.add_term(term, &shapes, grid.len(), active.filter(|_| rich).map(|a| a.shape));
    }
    for (pattern, log_weight) in patterns(campaign, lin, &scanner, rich) {
        collector.add_pattern(pattern, log_weight);
    }
    collector.finish(campaign, point)
}

/// Patterns worth weighing; those found by scanning carry the number of trials in their prior.
fn patterns(
    campaign: &Campaign,
    lin: &Linearization,
    scanner: &Scanner<'_>,
    scan: bool,
) -> Vec<(Pattern, f64)> {
    let mut simple = Vec::new();
    let legs = || std::iter::once(None).chain((0..6).map(Some));
    let has = |v: Variable| spread(v, &lin.conditions) > 0.0;
    for leg in legs() {
        if campaign.columns.elapsed && has(Variable::Elapsed) {
            let pattern =
                Pattern { leg, variable: Variable::Elapsed, course: Course::Linear, compliance: false };
            simple.push(pattern);
        }
    }
    let mut all: Vec<(Pattern, f64)> =
        simple.iter().map(|p| (*p, (0.3 * WEIGHT_OF_PATTERNS / 7.0).ln())).collect();
    if scan {
        all.extend(scanner.patterns(campaign));
    }
    all
}

/// Fits one candidate at a time beside springs, frames and the terms found so far.
struct Scanner<'a> {
    lin: &'a Linearization,
    basis: DMatrix<f64>,
    residual: nalgebra::DVector<f64>,
}

impl<'a> Scanner<'a> {
    /// `point`: the terms at which `lin` was made; `except`: one that is to be explained anew.
    fn new(lin: &'a Linearization, point: &Point, except: Option<&str>) -> Self {
        let mut columns = vec![lin.common_block()];
        columns.extend(
            point
                .active
                .iter()
                .filter(|a| Some(a.id()) != except)
                .map(|a| lin.term_block(a.term.as_ref(), a.rich, a.shape)),
        );
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
        Self { lin, basis, residual }
    }

    /// Drop of chi-square when these columns are added.
    fn drop(&self, mut columns: DMatrix<f64>) -> f64 {
        let overlap = self.basis.tr_mul(&columns);
        columns.gemm(-1.0, &self.basis, &overlap, 1.0);
        let b = columns.tr_mul(&self.residual);
        let mut g = columns.tr_mul(&columns);
        let ridge = 1e-9 * g.diagonal().max().max(1e-300);
        for k in 0..g.nrows() {
            g[(k, k)] += ridge;
        }
        g.cholesky().map_or(0.0, |c| b.dot(&c.solve(&b)))
    }

    fn best_shape(&self, term: &dyn Term, grid: &[f64]) -> f64 {
        self.peak(grid, |s| self.drop(self.lin.term_block(term, false, s)))
    }

    /// Grid point with the largest drop, refined between its neighbours.
    fn peak(&self, grid: &[f64], drop: impl Fn(f64) -> f64 + Sync) -> f64 {
        let scores: Vec<f64> = grid.par_iter().map(|&s| drop(s)).collect();
        let Some(best) = (0..grid.len()).max_by(|&a, &b| scores[a].total_cmp(&scores[b])) else { return 1.0 };
        let (low, high) = (grid[best.saturating_sub(1)], grid[(best + 1).min(grid.len() - 1)]);
        golden(low, high, drop)
    }

    /// The best pattern of every family.
    fn patterns(&self, campaign: &Campaign) -> Vec<(Pattern, f64)> {
        let mut found = Vec::new();
        for family in families(campaign, self.lin) {
            let drops: Vec<f64> = family.par_iter().map(|p| self.pattern_drop(p)).collect();
            if let Some(best) = (0..family.len()).max_by(|&a, &b| drops[a].total_cmp(&drops[b])) {
                found.push((
                    self.refined(family[best]),
                    (0.1 * WEIGHT_OF_PATTERNS / family.len() as f64).ln(),
                ));
            }
        }
        found
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

    fn pattern_drop(&self, pattern: &Pattern) -> f64 {
        let range = spread(pattern.variable, &self.lin.conditions);
        if range <= 0.0 {
            return 0.0;
        }
        self.drop(self.lin.block_of(pattern.width(), |c, out| pattern.actions(c, range, out)))
    }
}

/// Maximum of a function with one peak between two points, by golden sections.
fn golden(a: f64, b: f64, f: impl Fn(f64) -> f64) -> f64 {
    const RATIO: f64 = 0.618_033_988_749_894_9;
    let (mut low, mut high) = (a.min(b), a.max(b));
    for _ in 0..20 {
        let (x, y) = (high - RATIO * (high - low), low + RATIO * (high - low));
        if f(x) > f(y) {
            high = y;
        } else {
            low = x;
        }
    }
    f64::midpoint(low, high)
}

/// Families of patterns that no term of the catalogue describes.
fn families(campaign: &Campaign, lin: &Linearization) -> Vec<Vec<Pattern>> {
    let legs: Vec<Option<usize>> = std::iter::once(None).chain((0..6).map(Some)).collect();
    let periods = period_grid(&lin.conditions);
    let wave = |leg: Option<usize>| {
        periods
            .iter()
            .map(|&p| Pattern {
                leg,
                variable: Variable::LegLength,
                course: Course::Periodic(p),
                compliance: true,
            })
            .collect::<Vec<_>>()
    };
    let mut families = vec![wave(None), legs[1..].iter().flat_map(|&l| wave(l)).collect()];
    let mut linear = Vec::new();
    let mut steps = Vec::new();
    for (variable, present) in [
        (Variable::Elapsed, campaign.columns.elapsed),
        (Variable::DeltaT, campaign.columns.delta_t),
        (Variable::LegLength, true),
        (Variable::LegForce, true),
    ] {
        if !present || spread(variable, &lin.conditions) <= 0.0 {
            continue;
        }
        for &leg in &legs {
            for compliance in [false, true] {
                for course in [Course::Linear, Course::Quadratic] {
                    let known = leg.is_none()
                        && compliance
                        && variable == Variable::LegLength
                        && course == Course::Linear
                        || leg.is_none()
                            && !compliance
                            && variable == Variable::DeltaT
                            && course == Course::Linear;
                    if !known {
                        linear.push(Pattern { leg, variable, course, compliance });
                    }
                }
                if variable != Variable::LegForce {
                    let pattern = |at| Pattern { leg, variable, course: Course::Step(at), compliance };
                    steps.extend(thresholds(variable, lin).into_iter().map(pattern));
                }
            }
        }
    }
    families.push(linear);
    families.push(steps);
    families.retain(|f| !f.is_empty());
    families
}

/// Values between which a step may lie: the deciles of the variable.
fn thresholds(variable: Variable, lin: &Linearization) -> Vec<f64> {
    let mut values: Vec<f64> =
        lin.conditions.iter().flat_map(|c| (0..6).map(move |leg| variable.value(c, leg))).collect();
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

/// The terms of a set as a fit wants them.
pub fn wanted(set: &Set, gram: &Gram, candidates: &[Candidate], natural: &Natural) -> Vec<Wanted> {
    let mut all = Vec::new();
    for (&m, v) in set.members.iter().zip(&set.variants) {
        let Kind::Term(term) = &candidates[m].kind else { continue };
        let block = &gram.blocks[v.block];
        let width = FIT_WIDTH * block.widths[v.width];
        let prior = sizes(term.as_ref(), block.rich, natural).iter().map(|s| s * width).collect();
        all.push(Wanted { term: Arc::clone(term), rich: block.rich, shape: block.shape, prior });
    }
    all
}
