//! All laws of the grammar, weighed one by one beside what is in the model.

use hexbench_core::interrupt::go_on;
use hexbench_core::parallel;

use super::law::{Law, Product};
use super::legs::{LegChoice, axes, choices};
use super::space::Spaces;
use super::tables::Tables;
use crate::effects::sizes::WIDEST;
use crate::effects::user_term::PartKind;
use crate::error::ModelError;
use crate::inference::evidence::{log_sum, single, widths};
use crate::inference::golden::golden;
use crate::inference::leg_sums::{LawColumns, LegSums};

/// Steps of the search for the best constant between two of its grid.
const GOLDEN_STEPS: usize = 18;
/// Choices of legs kept of one product.
const LEGS_KEPT: usize = 3;
/// Choices of legs of one product whose evidence is computed: those that fit best.
const LEGS_LOOKED_AT: usize = 6;
/// Laws whose normal equations are computed together.
const TOGETHER: usize = 64;
/// What the evidence usually takes off the likelihood for a size that is fitted, nats.
const COST_OF_A_SIZE: f64 = 2.5;

/// A law and what speaks for it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ScoredLaw {
    /// The law.
    pub(crate) law: Law,
    /// Log-evidence plus the logarithm of the prior, the values tried of its constant charged; relative to no law.
    pub(crate) score: f64,
    /// Logarithm of the prior: minus the length of the law's description, nats.
    pub(crate) log_prior: f64,
}

/// What a scan found.
pub(crate) struct Scanned {
    /// Laws, best first; of one product in the same legs the best constant only.
    pub(crate) laws: Vec<ScoredLaw>,
    /// Laws weighed, every choice of legs and value of a constant counted.
    pub(crate) tried: usize,
}

/// The scan.
pub(crate) struct LawScan<'a> {
    pub(crate) spaces: &'a Spaces,
    pub(crate) tables: &'a Tables,
    pub(crate) products: &'a [(Product, f64)],
}

/// A product of the grammar, by its place, with a value of its constant.
type Task = (usize, f64);

impl LawScan<'_> {
    /// The best laws, at most so many, their constants refined.
    pub(crate) fn run(&self, most: usize) -> Result<Scanned, ModelError> {
        let (legs, axes) = (choices(), axes());
        let choices = |k: usize| if self.is_body(k) { &axes } else { &legs };
        let of_product = |k: usize| self.tables.grid(&self.products[k].0).iter().map(move |&c| (k, c));
        let tasks: Vec<Task> = (0..self.products.len()).flat_map(of_product).collect();
        // What acts on one thing stands together in the grammar.
        let mut batches: Vec<&[Task]> = Vec::new();
        for alike in tasks.chunk_by(|a, b| self.kind(a.0) == self.kind(b.0)) {
            batches.extend(alike.chunks(TOGETHER));
        }
        let best = |batch: &&[Task]| {
            go_on();
            self.best_of_each(batch, choices)
        };
        let scored: Vec<Vec<ScoredLaw>> = parallel::try_map(&batches, best)?;
        let mut laws = best_constants(scored.into_iter().flatten());
        laws.truncate(most);
        let mut laws = parallel::try_map(&laws, |law| self.refined(law))?;
        sort(&mut laws);
        Ok(Scanned { laws, tried: tasks.iter().map(|t| choices(t.0).len()).sum() })
    }

    fn kind(&self, k: usize) -> PartKind {
        self.products[k].0.kind()
    }

    fn is_body(&self, k: usize) -> bool {
        self.kind(k) != PartKind::Elongation
    }

    /// The best laws of each of some products that act on one thing.
    fn best_of_each<'b>(
        &self,
        batch: &[Task],
        choices: impl Fn(usize) -> &'b Vec<(LegChoice, f64)>,
    ) -> Result<Vec<ScoredLaw>, ModelError> {
        let Some(kind) = batch.first().map(|task| self.kind(task.0)) else { return Ok(Vec::new()) };
        let columns = |&(k, constant): &Task| self.tables.columns(&self.products[k].0, constant);
        let columns: Vec<LawColumns> = batch.iter().map(columns).collect::<Result<_, _>>()?;
        let sums = self.spaces.of(kind).sums(&columns);
        Ok(batch
            .iter()
            .zip(&sums)
            .flat_map(|(&task, sums)| self.best_of(sums, task, choices(task.0)))
            .collect())
    }

    /// The best choices of legs of a product.
    fn best_of(&self, sums: &LegSums, (k, constant): Task, legs: &[(LegChoice, f64)]) -> Vec<ScoredLaw> {
        let (product, of_product) = self.products[k];
        let charge = independent(self.tables.grid(&product).len()).ln();
        let mut best = [(f64::NEG_INFINITY, LegChoice::Each, 0.0); LEGS_LOOKED_AT];
        for &(legs, of_legs) in legs {
            let promise = promise(sums, legs) + of_legs;
            if let Some(place) = best.iter().position(|known| known.0 < promise) {
                best[place..].rotate_right(1);
                best[place] = (promise, legs, of_legs);
            }
        }
        let of = |(_, legs, of_legs): (f64, LegChoice, f64)| {
            let log_prior = of_product + of_legs;
            let score = self.evidence(sums, legs) + log_prior - charge;
            ScoredLaw { law: Law { product, legs, constant }, score, log_prior }
        };
        let mut scored = best.map(of);
        sort(&mut scored);
        scored[..LEGS_KEPT].to_vec()
    }

    /// Log-evidence of a choice of legs, averaged over the widths of the prior.
    fn evidence(&self, sums: &LegSums, legs: LegChoice) -> f64 {
        let LegChoice::Signed(signs) = legs else { return self.evidence_of_each(sums) };
        let (b, g) = sums.of(signs);
        let signature = (g[0] + if sums.columns == 2 { g[2] } else { 0.0 }).max(0.0).sqrt();
        self.averaged(signature, |width| {
            if sums.columns == 2 { pair(b, g, width) } else { single(g[0], b[0], width, false) }
        })
    }

    /// The same of a size in every leg.
    fn evidence_of_each(&self, sums: &LegSums) -> f64 {
        let size = 6 * sums.columns;
        let trace: f64 = (0..size).map(|k| sums.g[k][k]).sum();
        self.averaged(sums.scale * trace.max(0.0).sqrt(), |width| each(sums, size, sums.scale * width))
    }

    /// Average over the widths of a prior; `of`: drop of chi-square and the rest of the log-evidence at a width.
    fn averaged(&self, signature: f64, of: impl Fn(f64) -> (f64, f64)) -> f64 {
        let tried = widths(signature);
        let scores = tried.iter().map(|&width| {
            let (drop, rest) = of(width);
            self.spaces.likelihood.gain(drop, 1.0) + rest
        });
        let scores: Vec<f64> = scores.collect();
        log_sum(scores.iter().copied()) - (tried.len() as f64).ln()
    }

    /// The best constant between the neighbors of that of the grid.
    fn refined(&self, found: &ScoredLaw) -> Result<ScoredLaw, ModelError> {
        let Law { product, legs, constant } = found.law;
        let grid = self.tables.grid(&product);
        let Some(at) =
            grid.binary_search_by(|c| c.total_cmp(&constant)).ok().filter(|_| product.constant().is_some())
        else {
            return Ok(*found);
        };
        let ends = [grid[at.saturating_sub(1)], grid[(at + 1).min(grid.len() - 1)]];
        let mut at = |log: f64| -> Result<f64, ModelError> {
            let columns = self.tables.columns(&product, log.exp())?;
            let sums = self.spaces.of(product.kind()).sums(&[columns]);
            Ok(self.evidence(&sums[0], legs))
        };
        let best = match self.tables.separate(&product, ends) {
            Some(values) => best_of_all(&values, &mut at)?,
            None => golden(ends.map(f64::ln), GOLDEN_STEPS, &mut at)?.exp(),
        };
        let score = at(best.ln())? + found.log_prior - independent(grid.len()).ln();
        Ok(if score > found.score {
            ScoredLaw { law: Law { product, legs, constant: best }, score, ..*found }
        } else {
            *found
        })
    }
}

/// What the evidence of a choice of legs can be at most, less what all of them share: the likelihood at the best sizes.
fn promise(sums: &LegSums, legs: LegChoice) -> f64 {
    let drop = match legs {
        LegChoice::Each => each(sums, 6 * sums.columns, sums.scale * WIDEST).0,
        LegChoice::Signed(signs) => {
            let (b, g) = sums.of(signs);
            if sums.columns == 2 { pair(b, g, WIDEST).0 } else { single(g[0], b[0], WIDEST, false).0 }
        }
    };
    let sizes = if legs == LegChoice::Each { 6 * sums.columns } else { sums.columns };
    0.5 * drop - COST_OF_A_SIZE * sizes as f64
}

/// Values of a constant that count as different: neighbors of a grid resemble each other.
fn independent(grid: usize) -> f64 {
    (grid as f64 / 3.0).max(1.0)
}

/// Drop of chi-square of two sizes with a common prior width, and the rest of their log-evidence.
fn pair(b: [f64; 2], g: [f64; 3], width: f64) -> (f64, f64) {
    let w = width * width;
    let (a, c, d) = (1.0 + w * g[0], w * g[1], 1.0 + w * g[2]);
    let det = (a * d - c * c).max(1.0);
    let top = d * b[0] * b[0] - 2.0 * c * b[0] * b[1] + a * b[1] * b[1];
    (w * top / det, -0.5 * det.ln())
}

/// The same of a size in every leg, by a Cholesky factor of `I + s^2 G`.
fn each(sums: &LegSums, size: usize, s: f64) -> (f64, f64) {
    let mut factor = [[0.0; 12]; 12];
    let (mut forward, mut log_det, mut drop) = ([0.0; 12], 0.0, 0.0);
    for i in 0..size {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
            let entry = s * s * sums.g[i][j] + f64::from(u8::from(i == j)) - known;
            factor[i][j] = if i == j { entry.max(1e-12).sqrt() } else { entry / factor[j][j] };
        }
        let known: f64 = (0..i).map(|k| factor[i][k] * forward[k]).sum();
        forward[i] = (s * sums.b[i] - known) / factor[i][i];
        drop += forward[i] * forward[i];
        log_det += factor[i][i].ln();
    }
    (drop, -log_det)
}

/// Of every product in the same legs the best constant, best first.
fn best_constants(scored: impl Iterator<Item = ScoredLaw>) -> Vec<ScoredLaw> {
    let mut all: Vec<ScoredLaw> = scored.filter(|s| s.score.is_finite()).collect();
    sort(&mut all);
    let mut seen = std::collections::HashSet::new();
    all.retain(|s| seen.insert((s.law.product, s.law.legs)));
    all
}

/// Best first; in the order of the grammar where scores are equal.
pub(crate) fn sort(laws: &mut [ScoredLaw]) {
    let place = |s: &ScoredLaw| (s.law.product, s.law.legs);
    laws.sort_by(|a, b| b.score.total_cmp(&a.score).then_with(|| place(a).cmp(&place(b))));
}

/// The value at which `f` of its logarithm is largest.
fn best_of_all(
    values: &[f64],
    f: &mut impl FnMut(f64) -> Result<f64, ModelError>,
) -> Result<f64, ModelError> {
    let mut best = (f64::NEG_INFINITY, 1.0);
    for &value in values {
        let score = f(value.ln())?;
        if score > best.0 {
            best = (score, value);
        }
    }
    Ok(best.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_neighbors_of_a_grid_count_as_one_value() {
        let found = [1, 3, 12].map(|values| independent(values).to_bits());
        assert_eq!(found, [1.0_f64, 1.0, 4.0].map(f64::to_bits));
    }

    #[test]
    fn two_sizes_that_do_not_touch_are_two_single_ones() {
        let (drop, rest) = pair([3.0, -2.0], [4.0, 0.0, 0.5], 1.5);
        let one = [single(4.0, 3.0, 1.5, false), single(0.5, -2.0, 1.5, false)];
        assert!((drop - one[0].0 - one[1].0).abs() < 1e-12 && (rest - one[0].1 - one[1].1).abs() < 1e-12);
    }

    #[test]
    fn the_best_constant_is_found_among_values_and_between_two() {
        let mut f = |log: f64| Ok(-(log.exp() - 0.6).powi(2));
        assert!((best_of_all(&[0.1, 0.5, 2.0], &mut f).unwrap() - 0.5).abs() < 1e-12);
        for ends in [[0.1_f64, 2.0], [2.0, 0.1]] {
            let found = golden(ends.map(f64::ln), GOLDEN_STEPS, &mut f).unwrap().exp();
            assert!((found - 0.6).abs() < 1e-2, "{found}");
        }
    }
}
