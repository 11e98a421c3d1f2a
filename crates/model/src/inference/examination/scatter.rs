//! How errors scatter: competing statements about the noise, and physics of which no catalogue knows beside them.
//!
//! The likelihood of what is left of the readings under each statement, its parameters on a grid and penalized as by Schwarz
//! (1978, Annals of Statistics 6). Averaging over the readings of a group is orthogonal, so that statements about rows and
//! about averaged readings are compared on the same footing. A law without a name acts in the legs: where that explains
//! the rest better than any statement about the noise, nothing is said of the noise.

mod levels;

use std::collections::BTreeMap;

use hexbench_core::{Observation, Vector6};
use nalgebra::Matrix6;
use statrs::function::gamma::ln_gamma;

pub(super) use self::levels::Levels;
use super::BELIEVED;
use super::of_conditions::{OfConditions, of_conditions};
use super::remainder::Remainder;
use crate::estimation::campaign::row_sigma;
use crate::estimation::noise::{SharedReference, Structure, Symmetric6};
use crate::estimation::whitening::Filters;
use crate::inference::search::PRIOR_OF_DISCREPANCY;

/// Chance that a statement of the noise is simply wrong.
const MISSTATED: f64 = 0.02;
/// Shares and correlations tried.
const GRID: [f64; 14] = [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.97];
/// Correlations of a drift from row to row that are tried.
const CORRELATIONS: [f64; 8] = [0.3, 0.6, 0.8, 0.9, 0.95, 0.97, 0.985, 0.995];
/// Step of the logarithm of the levels that are tried beside heavy tails.
const STEP_OF_LEVELS: f64 = 0.1;
/// Degrees of freedom of heavy tails.
const TAILS: [f64; 5] = [3.0, 4.0, 5.0, 7.0, 10.0];

/// Readings, less what the fit took, that a covariance of six coordinates takes: with fewer it is singular, and explains anything.
const LEAST_READINGS: f64 = 9.0;

/// A statement about the noise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    /// As stated, or another level.
    Level,
    /// Another level of some numbers than of the others: of rotations, or of one number alone.
    Levels(Levels),
    /// Beside the level, a share of each reading itself.
    Proportional(f64),
    /// Errors have something in common.
    Common(Structure),
    /// Student's t with these degrees of freedom.
    Tails(f64),
    /// A law in the legs that no effect of the catalogue follows.
    Law,
}

/// A statement with its size and how well it explains the rest.
#[derive(Debug, Clone, Copy)]
pub(super) struct Statement {
    /// What it says.
    pub(super) kind: Kind,
    /// Standard deviation over the stated one.
    pub(super) level: f64,
    /// Logarithm of its evidence, up to a constant.
    pub(super) evidence: f64,
}

impl Statement {
    /// Standard deviation, over the stated one, that each reading has for itself at least; none where that is not known.
    pub(super) fn own_level(&self) -> Option<f64> {
        match self.kind {
            Kind::Tails(_) => Some(self.level * (-STEP_OF_LEVELS).exp()),
            Kind::Common(Structure::Setup { share } | Structure::Reference { share, .. }) => {
                Some(self.level * (1.0 - share).sqrt())
            }
            _ => None,
        }
    }
}

/// What is said of the noise of the rest.
pub(super) struct Statements {
    /// Best first.
    pub(super) all: Vec<Statement>,
    /// A law far larger than the noise.
    pub(super) wide_law: Statement,
    /// Evidence of physics without a name, which is rare.
    pub(super) physics: f64,
    /// Evidence of the noise as stated.
    pub(super) stated: f64,
}

/// The statements about the noise of the rest. `patterns`: evidence over the noise as stated of those that a search found in it.
pub(super) fn statements(rest: &Remainder<'_>, patterns: f64) -> Statements {
    let judge = Judge::new(rest);
    let stated = judge.white(1.0);
    let mut all = vec![judge.level()];
    all.extend(judge.levels());
    let repeats = judge.has_repeats;
    let setup = |share| Structure::Setup { share };
    if repeats {
        all.push(judge.blocks(&judge.groups, setup));
    }
    let reference = |record| move |share| Structure::Reference { share, record };
    if let Some(named) = &judge.named {
        let mut statement = judge.blocks(named, reference(SharedReference::Named));
        // The file says so itself: the readings need only agree.
        statement.evidence += BELIEVED;
        all.push(statement);
    } else {
        all.push(judge.blocks(&judge.poses, reference(SharedReference::Pose)));
        if repeats {
            all.push(judge.blocks(&judge.records, reference(SharedReference::Repeat)));
        }
    }
    all.push(judge.drift());
    if judge.has_six_numbers() {
        let repeated = judge.rows.len() - judge.means.len();
        let readings = rest.freedom() / 6.0 + repeated as f64;
        all.extend(judge.axes().filter(|_| readings >= LEAST_READINGS));
    }
    all.push(judge.tails());
    all.extend(judge.proportional());
    let others = all.iter().map(|statement| statement.evidence).fold(stated, f64::max);
    let OfConditions { mut law, wide_law, loads, warmth } = of_conditions(rest, &judge, [stated, others]);
    // A law that is known by its pattern explains more than one of which nothing is known.
    let known = stated + patterns;
    let physics = known.max(PRIOR_OF_DISCREPANCY.ln() + law.evidence.max(wide_law.evidence));
    law.evidence = law.evidence.max(known);
    all.push(law);
    all.extend(loads);
    all.extend(warmth);
    all.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    Statements { all, wide_law, physics, stated }
}

/// The rest, with rows grouped in the ways that statements speak of.
pub(super) struct Judge {
    /// Single readings over the stated noise, freed of what the fit took.
    rows: Vec<Vector6>,
    /// The readings themselves over it; none of absolute poses, whose size says nothing.
    shares: Vec<Vector6>,
    /// Which of their numbers were read, and how many in all.
    read: Vec<[bool; 6]>,
    numbers: f64,
    /// Line of each in the file, and which of the blocks of numbers it has.
    lines: Vec<[usize; 2]>,
    /// Rows of each group, pose, and repeat at a pose.
    groups: Vec<Vec<usize>>,
    poses: Vec<Vec<usize>>,
    records: Vec<Vec<usize>>,
    /// Rows of each reference reading, where the file numbers them.
    named: Option<Vec<Vec<usize>>>,
    /// Averaged readings of each group over their noise, freed likewise.
    means: Vec<Vector6>,
    /// Squares of the repeats about their means.
    within: f64,
    /// How well the level is known that somebody has stated, relative; none where nobody has.
    tolerance: Option<f64>,
    /// True when there are repeats to tell it too.
    has_repeats: bool,
}

impl Judge {
    fn new(rest: &Remainder<'_>) -> Self {
        let freed = (rest.lin.numbers() / rest.freedom().max(1.0)).sqrt();
        let means: Vec<Vector6> =
            (0..rest.campaign.groups.len()).map(|g| rest.means.fixed_rows::<6>(6 * g) * freed).collect();
        let row = |i: usize| {
            let g = rest.group_of[i];
            let share = rest.means.fixed_rows::<6>(6 * g) / rest.readings(g).sqrt();
            rest.rows[i] + share * (freed - 1.0)
        };
        let rows: Vec<Vector6> = (0..rest.rows.len()).map(row).collect();
        let all: f64 = rows.iter().map(Vector6::norm_squared).sum();
        let between: f64 = means.iter().map(Vector6::norm_squared).sum();
        // Of readings of one block: those of another look at other things.
        let record = |i: usize| rest.campaign.groups[rest.group_of[i]].record;
        let repeat = |i: usize| rest.data.observations[i].repeat;
        let reference =
            |i: usize| (rest.data.observations[i].reference_record, rest.data.observations[i].block);
        let is_named = rest.data.columns.reference_record;
        let noise = &rest.campaign.noise;
        let share = |row: &Observation| {
            let sigma = row_sigma(row, noise);
            Vector6::from_fn(|k, _| row.measured[k] / sigma[k])
        };
        let deflections: &[Observation] =
            if rest.campaign.is_absolute() { &[] } else { &rest.data.observations };
        Self {
            shares: deflections.iter().map(share).collect(),
            groups: gathered(rows.len(), |i| rest.group_of[i]),
            poses: gathered(rows.len(), record),
            records: gathered(rows.len(), |i| (record(i), repeat(i))),
            named: is_named.then(|| gathered(rows.len(), reference)),
            within: (all - between).max(0.0),
            tolerance: noise.is_stated().then_some(rest.campaign.hexapod.tolerances.noise),
            has_repeats: rows.len() > means.len(),
            lines: rest
                .data
                .observations
                .iter()
                .map(|o| [usize::try_from(o.line).unwrap_or(0), o.block])
                .collect(),
            read: rest.data.observations.iter().map(|o| std::array::from_fn(|k| o.is_read(k))).collect(),
            numbers: rest.campaign.numbers as f64,
            rows,
            means,
        }
    }

    fn numbers(&self) -> f64 {
        self.numbers
    }

    /// True when every row has the same six numbers: a covariance of them has no place for one that was not read, or for more.
    fn has_six_numbers(&self) -> bool {
        self.reads_poses() && self.reads_all()
    }

    /// True when the numbers are those of poses, some of which may be missing.
    fn reads_poses(&self) -> bool {
        self.lines.iter().all(|[_, block]| *block == 0)
    }

    /// True when no number is missing of those that a row of a block has.
    fn reads_all(&self) -> bool {
        self.read.iter().flatten().all(|read| *read)
    }

    /// What a level costs that is not the stated one.
    fn surprise(&self, level: f64) -> f64 {
        let Some(tolerance) = self.tolerance else { return 0.0 };
        let by_tolerance = -0.5 * (level.ln() / tolerance).powi(2);
        // Now and then a statement is off by any factor; without repeats, physics without a name looks the same.
        if self.has_repeats { by_tolerance.max(MISSTATED.ln()) } else { by_tolerance }
    }

    /// A penalty for each parameter that is chosen.
    pub(super) fn penalty(&self, parameters: f64) -> f64 {
        0.5 * parameters * self.numbers().ln()
    }

    fn white(&self, level: f64) -> f64 {
        let squares: f64 = self.rows.iter().map(Vector6::norm_squared).sum();
        -self.numbers() * level.ln() - 0.5 * squares / (level * level)
    }

    fn level(&self) -> Statement {
        let squares: f64 = self.rows.iter().map(Vector6::norm_squared).sum();
        let level = (squares / self.numbers()).sqrt();
        let evidence = self.white(level) + self.surprise(level) - self.penalty(1.0);
        Statement { kind: Kind::Level, level, evidence }
    }

    /// The best of a family with one parameter: `half log det` and `quadratic form` for unit level.
    fn best(&self, kind: impl Fn(f64) -> Kind, law: impl Fn(f64) -> (f64, f64)) -> Statement {
        let at = |&parameter: &f64| {
            let (half_log_det, square) = law(parameter);
            let level = (square / self.numbers()).sqrt().max(1e-12);
            let fit = -half_log_det - self.numbers() * level.ln() - 0.5 * self.numbers();
            let evidence = fit + self.surprise(level) - self.penalty(2.0);
            Statement { kind: kind(parameter), level, evidence }
        };
        let all = GRID.iter().map(at);
        let nothing = Statement { kind: Kind::Level, level: 1.0, evidence: f64::NEG_INFINITY };
        all.fold(nothing, |best, s| if s.evidence > best.evidence { s } else { best })
    }

    /// Rows of a block share an error.
    fn blocks(&self, blocks: &[Vec<usize>], structure: impl Fn(f64) -> Structure) -> Statement {
        let sums: Vec<(f64, f64, f64)> =
            blocks.iter().flat_map(|rows| (0..6).filter_map(|k| self.sums(rows, k))).collect();
        let law = |share: f64| {
            let of = |&(m, all, common): &(f64, f64, f64)| {
                let (own, joint) = (1.0 - share, 1.0 + (m - 1.0) * share);
                (0.5 * ((m - 1.0) * own.ln() + joint.ln()), (all - common) / own + common / joint)
            };
            sums.iter().map(of).fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1))
        };
        self.best(|share| Kind::Common(structure(share)), law)
    }

    /// How many of these rows have a number, their squares, and the square of their mean; none where no row has it.
    fn sums(&self, rows: &[usize], number: usize) -> Option<(f64, f64, f64)> {
        let (mut m, mut all, mut sum) = (0.0, 0.0, 0.0);
        for &i in rows.iter().filter(|&&i| self.read[i][number]) {
            let x = self.rows[i][number];
            (m, all, sum) = (m + 1.0, all + x * x, sum + x);
        }
        (m > 0.0).then(|| (m, all, sum * sum / m))
    }

    /// Part of each row resembles the row before.
    fn drift(&self) -> Statement {
        let mut best = Statement { kind: Kind::Level, level: 1.0, evidence: f64::NEG_INFINITY };
        for correlation in CORRELATIONS {
            let structure = |share| Kind::Common(Structure::Drift { share, correlation });
            let found = self.best(structure, |share| self.innovations(share, correlation));
            if found.evidence > best.evidence {
                best = found;
            }
        }
        best.evidence -= self.penalty(1.0);
        best
    }

    /// Half the logarithm of the determinant and the quadratic form of a drift with unit level.
    fn innovations(&self, share: f64, correlation: f64) -> (f64, f64) {
        if self.reads_all() {
            return self.innovations_of([0, 1, 2, 3, 4, 5], share, correlation);
        }
        let each = (0..6).map(|k| self.innovations_of([k], share, correlation));
        each.fold((0.0, 0.0), |sum, own| (sum.0 + own.0, sum.1 + own.1))
    }

    /// The same of coordinates that are read in the same rows.
    fn innovations_of<const N: usize>(&self, of: [usize; N], share: f64, correlation: f64) -> (f64, f64) {
        let own = 1.0 - share;
        let loading = (share / own).sqrt();
        let (mut count, mut square) = (0_usize, 0.0);
        let mut variances = LogOfProduct::default();
        let mut filters = Filters::<N>::default();
        let read = self.rows.iter().zip(&self.lines).zip(&self.read).filter(|(_, read)| read[of[0]]);
        for ((row, &line), _) in read {
            let (innovations, variance) =
                filters.step(line, of.map(|k| row[k] / own.sqrt()), loading, correlation);
            square += innovations.iter().map(|x| x * x).sum::<f64>() / variance;
            variances.push(variance);
            count += 1;
        }
        (0.5 * N as f64 * (count as f64 * own.ln() + variances.value()), square)
    }

    /// The coordinates of a reading have a covariance of their own; where nothing repeats, a law of the machine could look like it.
    fn axes(&self) -> Option<Statement> {
        let covariance =
            self.rows.iter().map(|r| r * r.transpose()).sum::<Matrix6<f64>>() / self.rows.len() as f64;
        let factor = covariance.cholesky().filter(|_| self.has_repeats)?;
        let log_det: f64 = factor.ln_determinant();
        let level = (log_det / 12.0).exp();
        let fit = -0.5 * self.rows.len() as f64 * log_det - 0.5 * self.numbers();
        let evidence = fit + self.surprise(level) - self.penalty(21.0);
        Some(Statement {
            kind: Kind::Common(Structure::Axes { covariance: Symmetric6::new(&covariance) }),
            level: 1.0,
            evidence,
        })
    }

    /// Student's t; its level is that of the Gaussian in the middle of it.
    fn tails(&self) -> Statement {
        let of_row = |i: usize| (0..6).filter(move |&k| self.read[i][k]).map(move |k| self.rows[i][k]);
        let squares: Vec<f64> = (0..self.rows.len()).flat_map(of_row).map(|x| x * x).collect();
        let at = |freedom: f64, level: f64| {
            // Over the constant of a Gaussian, which the other statements leave out.
            let constant =
                ln_gamma(f64::midpoint(freedom, 1.0)) - ln_gamma(0.5 * freedom) - 0.5 * (0.5 * freedom).ln();
            let (mut all, share) = (LogOfProduct::default(), 1.0 / (level * level * freedom));
            for square in &squares {
                all.push(1.0 + square * share);
            }
            self.numbers() * (constant - level.ln()) - f64::midpoint(freedom, 1.0) * all.value()
        };
        let levels = (-12..=12).map(|k| (STEP_OF_LEVELS * f64::from(k)).exp());
        let all = TAILS.iter().flat_map(|&freedom| levels.clone().map(move |level| (freedom, level)));
        let stated = |(freedom, level): (f64, f64)| Statement {
            kind: Kind::Tails(freedom),
            level,
            evidence: at(freedom, level) + self.surprise(level) - self.penalty(2.0),
        };
        let nothing = Statement { kind: Kind::Level, level: 1.0, evidence: f64::NEG_INFINITY };
        all.map(stated).fold(nothing, |best, s| if s.evidence > best.evidence { s } else { best })
    }

    /// True when repeats or a statement tell of the noise.
    pub(super) fn knows_noise(&self) -> bool {
        self.has_repeats || self.tolerance.is_some()
    }

    /// Squares of the averaged numbers.
    pub(super) fn between(&self) -> f64 {
        self.means.iter().map(Vector6::norm_squared).sum()
    }

    /// Logarithm of the likelihood when every condition scatters by so many of six shapes, or by one of them.
    pub(super) fn scattered_by(&self, shapes: &[Matrix6<f64>], only: Option<usize>, size: f64) -> f64 {
        let of = |(mean, shape): (&Vector6, &Matrix6<f64>)| {
            if let Some(one) = only {
                // |I + s^2 a a'| = 1 + s^2 a'a, and the inverse takes off what lies along a.
                let (acting, variance) = (shape.column(one), size * size);
                let more = variance * acting.norm_squared();
                let along = variance * acting.dot(mean).powi(2);
                return -0.5 * (more.ln_1p() + mean.norm_squared() - along / (1.0 + more));
            }
            let covariance = Matrix6::identity() + size * size * shape * shape.transpose();
            let Some(factor) = covariance.cholesky() else { return f64::NEG_INFINITY };
            let half_log_det = 0.5 * factor.ln_determinant();
            -half_log_det - 0.5 * mean.dot(&factor.solve(mean))
        };
        self.means.iter().zip(shapes).map(of).sum::<f64>() - 0.5 * self.within
    }
}

/// Logarithm of a product of positive numbers, of which few are taken.
struct LogOfProduct {
    product: f64,
    log: f64,
}

impl Default for LogOfProduct {
    fn default() -> Self {
        Self { product: 1.0, log: 0.0 }
    }
}

impl LogOfProduct {
    /// Far from where numbers end, whatever the next factor is.
    const RANGE: std::ops::Range<f64> = 1e-100..1e100;

    fn push(&mut self, factor: f64) {
        self.product *= factor;
        if !Self::RANGE.contains(&self.product) {
            self.log += self.product.ln();
            self.product = 1.0;
        }
    }

    fn value(&self) -> f64 {
        self.log + self.product.ln()
    }
}

/// Rows by what they have in common, in order.
fn gathered<K: Ord>(rows: usize, key: impl Fn(usize) -> K) -> Vec<Vec<usize>> {
    let mut all: BTreeMap<K, Vec<usize>> = BTreeMap::new();
    for i in 0..rows {
        all.entry(key(i)).or_default().push(i);
    }
    all.into_values().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_logarithm_of_a_product_is_the_sum_of_the_logarithms_however_many_and_large() {
        let mut all = LogOfProduct::default();
        let factors =
            (0..4_000).map(|i| 10.0_f64.powf(f64::from(i % 37) * if i < 2_000 { 3.0 } else { -3.0 }));
        let mut sum = 0.0;
        for factor in factors {
            all.push(factor);
            sum += factor.ln();
        }
        assert!((all.value() - sum).abs() < 1e-9 * 2_000.0 * 100.0, "{} for {sum}", all.value());
    }

    fn judge(tolerance: Option<f64>, has_repeats: bool) -> Judge {
        Judge {
            rows: vec![Vector6::repeat(1.0)],
            shares: Vec::new(),
            read: vec![[true; 6]],
            numbers: 100.0,
            lines: vec![[2, 0]],
            groups: Vec::new(),
            poses: Vec::new(),
            records: Vec::new(),
            named: None,
            means: Vec::new(),
            within: 0.0,
            tolerance,
            has_repeats,
        }
    }

    #[test]
    fn a_stated_noise_is_off_by_its_tolerance_and_now_and_then_by_anything() {
        for (tolerance, has_repeats, level, surprise) in [
            (Some(0.1), false, 1.1_f64, -0.5 * (1.1_f64.ln() / 0.1).powi(2)),
            (Some(0.1), false, 3.0, -0.5 * (3.0_f64.ln() / 0.1).powi(2)),
            (Some(0.4), false, 1.1, -0.5 * (1.1_f64.ln() / 0.4).powi(2)),
            (Some(0.1), true, 3.0, 0.02_f64.ln()),
            (None, false, 3.0, 0.0),
        ] {
            let found = judge(tolerance, has_repeats).surprise(level);
            assert!((found - surprise).abs() < 1e-9, "{tolerance:?} {has_repeats} {level}: {found}");
        }
        assert!((judge(Some(0.1), true).penalty(2.0) - 100.0_f64.ln()).abs() < 1e-12);
    }

    #[test]
    fn a_covariance_takes_rows_of_the_same_six_numbers() {
        assert!(judge(Some(0.1), true).has_six_numbers());
        assert!(!Judge { lines: vec![[2, 1]], ..judge(Some(0.1), true) }.has_six_numbers());
        let missing = [true, true, false, true, true, true];
        assert!(!Judge { read: vec![missing], ..judge(Some(0.1), true) }.has_six_numbers());
    }
}
