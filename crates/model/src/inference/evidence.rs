//! Evidence of linear effects with Gaussian priors of unknown width, in closed form on Gram matrices.
//!
//! After the columns every model shares (springs, frames) are projected out, a model is a set of column blocks with
//! prior precisions `lambda`:
//!
//! ```text
//! ln Z = (b' M^-1 b) / 2 - ln|M| / 2 + sum ln(lambda) / 2 + ln P(signs),   M = G + diag(lambda)
//! ```
//!
//! relative to the model without any block. Source: `MacKay` 1992, Neural Computation 4 (evidence framework). The
//! width of the prior of each effect is not known: it is averaged over a grid that is uniform in its logarithm.
//! Where the noise level itself comes from the data, `ln Z` is the Student form of the same integral.

use hexbench_core::Vector6;
use nalgebra::linalg::SymmetricEigen;
use nalgebra::{DMatrix, DVector, Dyn};
use statrs::distribution::{ContinuousCDF, Normal};

use crate::effects::sizes::WIDEST;
use crate::estimation::noise::NoiseLevel;

/// Most widths tried per block, from the widest down.
const MOST_WIDTHS: i32 = 11;
/// Ratio between neighboring widths.
const WIDTH_RATIO: f64 = 0.4;
/// A signature longer than this is evident, if any is, standard deviations.
const LONGEST: f64 = 1e3;
/// Bisections of a length, to more digits than are printed.
const BISECTIONS: usize = 45;
/// An effect is noticeable when its expected signature is this many standard deviations long. Smaller effects leave no
/// trace in these data and count as absent: whether they exist is not a question these data can answer.
pub const NOTICEABLE: f64 = 5.0;

/// Prior widths of a block, widest first, down to where the effect would no longer be noticeable; `signature` is the
/// expected length of its whitened signature at the natural sizes.
pub fn widths(signature: f64) -> Vec<f64> {
    let steps = (0..MOST_WIDTHS).map(|k| WIDEST * WIDTH_RATIO.powi(k));
    let kept: Vec<f64> = steps.take_while(|g| g * signature >= NOTICEABLE).collect();
    if kept.is_empty() { vec![WIDEST] } else { kept }
}

/// Columns of one form and shape of one effect inside the Gram matrix, in units of the prior: `theta = T u` with
/// `u ~ N(0, g^2 I)`.
#[derive(Debug, Clone)]
pub struct PriorBlock {
    /// First column.
    pub first: usize,
    /// `T`: natural sizes times the square root of the prior correlation; with a part of the first, `B` times that.
    pub transform: DMatrix<f64>,
    /// `B^-1 T`, lower triangular: what cannot be negative, in units of the prior.
    base: DMatrix<f64>,
    /// True when `B` adds the second value to the first, of which it is a part.
    has_part: bool,
    /// Which parameters cannot be negative.
    pub positive: Vec<bool>,
    /// Shape value.
    pub shape: f64,
    /// Richer form.
    pub rich: bool,
    /// Logarithm of the prior share of this form and shape within its effect.
    pub log_share: f64,
    /// Prior widths tried, as multiples of the natural sizes.
    pub widths: Vec<f64>,
    /// True when the effect would be noticeable at its largest width.
    pub noticeable: bool,
    /// Logarithm of the prior probability that the signs are right.
    log_signs: f64,
}

/// Correlation between the parameters of one effect that cannot be negative: the six springs of a foundation are soft or
/// stiff together.
const CORRELATION: f64 = 0.5;

impl PriorBlock {
    /// A block with natural sizes (SI) and signs; widths are set once its Gram matrix is known.
    pub fn new(sizes: &[f64], positive: Vec<bool>, shape: f64, rich: bool, share: f64) -> Self {
        let n = sizes.len();
        let related = |i: usize, j: usize| f64::from(positive[i] && positive[j]) * CORRELATION;
        let correlation = DMatrix::from_fn(n, n, |i, j| if i == j { 1.0 } else { related(i, j) });
        let signs: Vec<usize> = (0..n).filter(|&i| positive[i]).collect();
        let of_signs = correlation.select_rows(&signs).select_columns(&signs);
        let log_signs = log_orthant(DVector::zeros(signs.len()), of_signs);
        let root = correlation.cholesky().map_or_else(|| DMatrix::identity(n, n), |c| c.l());
        let transform = DMatrix::from_diagonal(&DVector::from_column_slice(sizes)) * root;
        let log_share = share.ln();
        Self {
            first: 0,
            base: transform.clone(),
            has_part: false,
            transform,
            positive,
            shape,
            rich,
            log_share,
            widths: Vec::new(),
            noticeable: false,
            log_signs,
        }
    }

    /// The same when the second value is a part of the first: it and the rest are alike before the data, and not negative.
    #[must_use]
    pub fn with_part(mut self) -> Self {
        let second = self.base.row(1).into_owned();
        let mut first = self.transform.row_mut(0);
        first += second;
        self.has_part = true;
        self
    }

    /// Number of columns.
    pub fn width(&self) -> usize {
        self.positive.len()
    }

    /// Choose the prior widths from the expected length of the whitened signature at natural size.
    pub fn set_widths(&mut self, signature: f64) {
        self.widths = widths(signature);
        self.noticeable = WIDEST * signature >= NOTICEABLE;
    }

    /// `u` from parameter values, SI.
    fn in_prior_units(&self, values: &DVector<f64>) -> DVector<f64> {
        let mut free = values.clone();
        if self.has_part {
            free[0] -= values[1];
        }
        self.base.solve_lower_triangular(&free).unwrap_or(free)
    }

    /// Logarithm of the probability that none of the values is negative which cannot be, and none a larger part than there is, over the
    /// same before the data; given those values and their covariance.
    fn log_odds_of_signs(&self, mut values: DVector<f64>, mut spread: DMatrix<f64>) -> f64 {
        if self.has_part {
            values[0] -= values[1];
            for _ in 0..2 {
                let second = spread.row(1).into_owned();
                let mut first = spread.row_mut(0);
                first -= second;
                spread = spread.transpose();
            }
        }
        log_orthant(values, spread) - self.log_signs
    }
}

/// What a drop of chi-square is worth.
#[derive(Debug, Clone, Copy)]
pub struct Likelihood {
    /// `y'y`.
    pub yy: f64,
    /// Equations left after the projection.
    pub equations: f64,
    /// What is known of the noise level beside them.
    pub level: NoiseLevel,
}

impl Likelihood {
    /// Logarithm of the likelihood gained by a drop of (inflated) chi-square, and lost by the inflation itself. The noise level is
    /// integrated out: with `S` and `nu` known of it, `n` equations and an inflation `v` of what the model leaves,
    ///
    /// ```text
    /// -n/2 ln v - (n + nu)/2 ln((S + yy/v - drop) / (S + yy))
    /// ```
    pub fn gain(&self, drop: f64, inflation: f64) -> f64 {
        let lost = 0.5 * self.equations * inflation.ln();
        if self.level.dof.is_infinite() {
            return 0.5 * (drop + self.yy * (1.0 - 1.0 / inflation)) - lost;
        }
        let before = (self.level.sum + self.yy).max(f64::MIN_POSITIVE);
        let after = (self.level.sum + self.yy / inflation - drop).max(1e-12 * before);
        -lost - 0.5 * (self.equations + self.level.dof) * (after / before).ln()
    }
}

/// A block with a prior width.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Variant {
    /// Index of the block.
    pub block: usize,
    /// Index into the widths of the block.
    pub width: usize,
}

/// Projected normal equations of all blocks.
#[derive(Debug, Clone)]
pub struct Gram {
    /// `Z'Z`.
    pub g: DMatrix<f64>,
    /// `Z'y`.
    pub b: DVector<f64>,
    /// What a drop of chi-square is worth.
    pub likelihood: Likelihood,
    /// The blocks.
    pub blocks: Vec<PriorBlock>,
    /// Compliance (m/N) the six springs take over from one unit of every column; 6 rows.
    pub absorbed: DMatrix<f64>,
    /// Covariance of the springs alone, (m/N)^2; 6x6.
    pub springs: DMatrix<f64>,
}

/// Posterior of one set of variants.
#[derive(Debug, Clone)]
pub struct Posterior {
    /// `ln Z` relative to no block.
    pub log_evidence: f64,
    /// Drop of chi-square, `b' M^-1 b`.
    pub drop: f64,
    /// Mean of the parameters, blocks in turn.
    pub mean: DVector<f64>,
}

impl Gram {
    /// Evidence and posterior of a set of variants under noise inflated by the factor `inflation` (variance).
    ///
    /// `None` when the normal equations are not positive definite.
    pub fn posterior(&self, set: &[Variant], inflation: f64) -> Option<Posterior> {
        let (columns, scale) = self.columns(set);
        let n = columns.len();
        // M = I + D G D has eigenvalues of at least one.
        let m = DMatrix::from_fn(n, n, |i, j| {
            scale[i] * scale[j] * self.g[(columns[i], columns[j])] / inflation + f64::from(i == j)
        });
        let b = DVector::from_fn(n, |i, _| scale[i] * self.b[columns[i]] / inflation);
        let factor = m.cholesky()?;
        let mean = factor.solve(&b);
        let drop = b.dot(&mean);
        let log_det: f64 = factor.ln_determinant();
        let (mut signs, mut at) = (0.0, 0);
        let mut values = DVector::zeros(n);
        for v in set {
            let block = &self.blocks[v.block];
            let (d, t) = (block.width(), &block.transform * block.widths[v.width]);
            let theta = &t * mean.rows(at, d);
            let signed: Vec<usize> = (0..d).filter(|&k| block.positive[k]).collect();
            if !signed.is_empty() {
                // Their covariance t M^-1 t' = |L^-1 t'|^2; nothing stands above the rows of the block.
                let mut root = DMatrix::zeros(n - at, signed.len());
                root.rows_mut(0, d).copy_from(&t.select_rows(&signed).transpose());
                let corner = factor.l_dirty().view((at, at), (n - at, n - at));
                corner.solve_lower_triangular_mut(&mut root);
                signs += block.log_odds_of_signs(theta.select_rows(&signed), root.tr_mul(&root));
            }
            values.rows_mut(at, d).copy_from(&theta);
            at += d;
        }
        let log_evidence = self.gain(drop, inflation) - 0.5 * log_det + signs;
        Some(Posterior { log_evidence, drop: drop * inflation, mean: values })
    }

    /// Springs beside a set of variants: change of the compliances (m/N) against springs alone, and their variances.
    ///
    /// `None` as for [`Self::posterior`].
    pub fn springs(&self, set: &[Variant]) -> Option<(Vector6, Vector6)> {
        let rest = Rest::new(self, set)?;
        let taken = DMatrix::from_fn(6, rest.columns.len(), |leg, k| {
            self.absorbed[(leg, rest.columns[k])] * rest.scale[k]
        });
        // Covariance of the columns is (L L')^-1, their mean L'^-1 of the forward solution.
        let spread = rest.factor.solve_lower_triangular(&taken.transpose())?;
        let change = -spread.tr_mul(&rest.forward);
        let variance = |leg: usize| self.springs[(leg, leg)] + spread.column(leg).norm_squared();
        Some((Vector6::from_fn(|leg, _| change[leg]), Vector6::from_fn(|leg, _| variance(leg))))
    }

    /// Columns of a set of variants and their prior widths.
    fn columns(&self, set: &[Variant]) -> (Vec<usize>, DVector<f64>) {
        let (mut columns, mut scale) = (Vec::new(), Vec::new());
        for v in set {
            let block = &self.blocks[v.block];
            columns.extend(block.first..block.first + block.width());
            scale.extend(std::iter::repeat_n(block.widths[v.width], block.width()));
        }
        (columns, DVector::from_vec(scale))
    }

    /// Logarithm of the likelihood of springs alone, up to what all points of linearization of a campaign share.
    pub(crate) fn log_likelihood_without(&self) -> f64 {
        let Likelihood { yy, equations, level } = self.likelihood;
        if level.dof.is_infinite() {
            return -0.5 * yy;
        }
        -0.5 * (equations + level.dof) * (level.sum + yy).max(f64::MIN_POSITIVE).ln()
    }

    fn gain(&self, drop: f64, inflation: f64) -> f64 {
        self.likelihood.gain(drop, inflation)
    }

    /// Length of the whitened signature of one unit (SI) of every parameter of a block, less what springs, frames and
    /// the fixed others can imitate.
    pub fn signature_lengths(&self, others: &[Variant], block: usize) -> Vec<f64> {
        let Some(rest) = Rest::new(self, others) else { return Vec::new() };
        let block = &self.blocks[block];
        let (e, _) = rest.complement(self, block);
        let unit =
            |k: usize| block.in_prior_units(&DVector::from_fn(block.width(), |i, _| f64::from(i == k)));
        let length = |u: DVector<f64>| u.dot(&(&e * &u)).max(0.0).sqrt();
        (0..block.width()).map(|k| length(unit(k))).collect()
    }

    /// Length of the signature of each parameter of a block at which the block explains readings better than nothing does by so much, nats;
    /// `lost`: of the length, to noise. Infinite where no length does. The signs of the parameters count as at the shortest length.
    pub(crate) fn lengths_believed(
        &self,
        others: &[Variant],
        block: usize,
        least: f64,
        lost: f64,
    ) -> Vec<f64> {
        let Some(rest) = Rest::new(self, others) else { return Vec::new() };
        let block = &self.blocks[block];
        let (e, _) = rest.complement(self, block);
        let scoring = Scoring::of(block, e.clone());
        let believed = |k: usize| {
            let unit = block.in_prior_units(&DVector::from_fn(block.width(), |i, _| f64::from(i == k)));
            let b = &e * &unit;
            let length = unit.dot(&b).max(0.0).sqrt();
            let at_once = scoring.of_readings(&(b / length));
            at_once.length_of(least, &self.likelihood) + lost
        };
        (0..block.width()).map(believed).collect()
    }

    /// Share of the signature of one set of values (SI) that another block can imitate: the cosine between the
    /// signature and its best imitation, both less what springs, frames and the fixed others take.
    pub fn imitation(&self, others: &[Variant], block: usize, values: &[f64], imitator: usize) -> f64 {
        let Some(rest) = Rest::new(self, others) else { return 0.0 };
        let (a, b) = (&self.blocks[block], &self.blocks[imitator]);
        let v = a.in_prior_units(&DVector::from_column_slice(values));
        let (e, _) = rest.complement(self, a);
        let (g, _) = rest.complement(self, b);
        let cross = rest.cross(self, a, b).tr_mul(&v);
        let length = v.dot(&(&e * &v));
        let explained = drop_of(g, &cross);
        if length > 0.0 { (explained / length).clamp(0.0, 1.0).sqrt() } else { 0.0 }
    }

    /// Log-evidence of each variant of an effect beside fixed others, largest first. The signs of the others are left
    /// out: they are the same for all variants to first order.
    pub fn profile(&self, others: &[Variant], blocks: &[usize]) -> Vec<(Variant, f64)> {
        let Some(rest) = Rest::new(self, others) else { return Vec::new() };
        let mut scored: Vec<(Variant, f64)> = blocks.iter().flat_map(|&b| rest.profile(self, b)).collect();
        scored.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        scored
    }
}

/// Fixed blocks, factored once: everything else is judged by its Schur complement.
struct Rest {
    columns: Vec<usize>,
    scale: DVector<f64>,
    factor: DMatrix<f64>,
    forward: DVector<f64>,
    drop: f64,
    log_det: f64,
}

impl Rest {
    fn new(gram: &Gram, others: &[Variant]) -> Option<Self> {
        let (columns, scale) = gram.columns(others);
        let n = columns.len();
        let m = DMatrix::from_fn(n, n, |i, j| {
            scale[i] * scale[j] * gram.g[(columns[i], columns[j])] + f64::from(i == j)
        });
        let factor = m.cholesky()?.unpack();
        let b = DVector::from_fn(n, |i, _| scale[i] * gram.b[columns[i]]);
        let forward = factor.solve_lower_triangular(&b)?;
        let drop = forward.norm_squared();
        let log_det = 2.0 * factor.diagonal().iter().map(|x| x.ln()).sum::<f64>();
        Some(Self { columns, scale, factor, forward, drop, log_det })
    }

    fn profile(&self, gram: &Gram, index: usize) -> Vec<(Variant, f64)> {
        let block = &gram.blocks[index];
        let (e, b) = self.complement(gram, block);
        let offset = block.log_share - (block.widths.len() as f64).ln() - 0.5 * self.log_det;
        let variant = |width| Variant { block: index, width };
        let scored = Scoring::of(block, e).of_readings(&b).0.into_iter().enumerate();
        scored.map(|(w, (d, rest))| (variant(w), gram.gain(self.drop + d, 1.0) + rest + offset)).collect()
    }

    /// `Z_a' Z_b` at natural sizes, less what the fixed blocks take.
    fn cross(&self, gram: &Gram, a: &PriorBlock, b: &PriorBlock) -> DMatrix<f64> {
        let mut cross = DMatrix::from_fn(a.width(), b.width(), |i, j| gram.g[(a.first + i, b.first + j)]);
        if !self.columns.is_empty() {
            cross -= self.reduced(gram, a).tr_mul(&self.reduced(gram, b));
        }
        cross
    }

    /// Forward-substituted cross block with the fixed columns.
    fn reduced(&self, gram: &Gram, block: &PriorBlock) -> DMatrix<f64> {
        let mut x = DMatrix::from_fn(self.columns.len(), block.width(), |i, j| {
            self.scale[i] * gram.g[(self.columns[i], block.first + j)]
        });
        self.factor.solve_lower_triangular_mut(&mut x);
        x
    }

    /// Normal equations of a block at its natural sizes, less what the fixed blocks take.
    fn complement(&self, gram: &Gram, block: &PriorBlock) -> (DMatrix<f64>, DVector<f64>) {
        let d = block.width();
        let mut e = gram.g.view((block.first, block.first), (d, d)).into_owned();
        let mut b = gram.b.rows(block.first, d).into_owned();
        if !self.columns.is_empty() {
            let x = self.reduced(gram, block);
            e -= x.tr_mul(&x);
            b -= x.tr_mul(&self.forward);
        }
        (e, b)
    }
}

/// The normal equations of a block at its natural sizes, ready for any readings.
enum Scoring<'a> {
    One(&'a PriorBlock, f64),
    /// On the eigenvectors, with the rows of the parameters that cannot be negative.
    Several(&'a PriorBlock, SymmetricEigen<f64, Dyn>, DMatrix<f64>),
}

impl<'a> Scoring<'a> {
    fn of(block: &'a PriorBlock, e: DMatrix<f64>) -> Self {
        if block.width() == 1 {
            return Self::One(block, e[(0, 0)]);
        }
        let eigen = e.symmetric_eigen();
        let rows: Vec<usize> = (0..block.width()).filter(|&k| block.positive[k]).collect();
        let signed = block.base.select_rows(&rows) * &eigen.eigenvectors;
        Self::Several(block, eigen, signed)
    }

    fn of_readings(&self, b: &DVector<f64>) -> Scored {
        match self {
            Self::One(block, e) => {
                Scored(block.widths.iter().map(|g| single(*e, b[0], *g, block.positive[0])).collect())
            }
            Self::Several(block, eigen, signed) => {
                let along = eigen.eigenvectors.tr_mul(b);
                let score = |g: &f64| several(signed, &eigen.eigenvalues, &along, *g, block);
                Scored(block.widths.iter().map(score).collect())
            }
        }
    }
}

/// Of every prior width of a block: the drop of chi-square, and the rest of its log-evidence.
struct Scored(Vec<(f64, f64)>);

impl Scored {
    /// By how much the readings have to be multiplied for a log-evidence of so much, on the average over the widths.
    fn length_of(&self, least: f64, likelihood: &Likelihood) -> f64 {
        let numbers = likelihood.equations + likelihood.level.dof;
        let gain = |drop: f64| {
            if numbers.is_finite() { 0.5 * numbers * (drop / numbers).ln_1p() } else { 0.5 * drop }
        };
        let evidence = |length: f64| {
            let all = self.0.iter().map(|(drop, rest)| gain(drop * length * length) + rest);
            log_sum(all) - (self.0.len() as f64).ln()
        };
        let (mut low, mut high) = (0.0, LONGEST);
        if evidence(high) < least {
            return f64::INFINITY;
        }
        for _ in 0..BISECTIONS {
            let middle = f64::midpoint(low, high);
            if evidence(middle) < least { low = middle } else { high = middle }
        }
        high
    }
}

/// `b' G^-1 b`; zero when the columns of `G` are no columns of their own.
pub(crate) fn drop_of(mut g: DMatrix<f64>, b: &DVector<f64>) -> f64 {
    let ridge = 1e-9 * g.diagonal().max().max(f64::MIN_POSITIVE);
    for k in 0..g.nrows() {
        g[(k, k)] += ridge;
    }
    g.cholesky().map_or(0.0, |c| b.dot(&c.solve(b)))
}

/// Drop of chi-square of one parameter, and the rest of its log-evidence.
pub(crate) fn single(e: f64, b: f64, g: f64, positive: bool) -> (f64, f64) {
    let m = 1.0 + g * g * e.max(0.0);
    let sign = if positive { log_sign(g * b / m, 1.0 / m) } else { 0.0 };
    (g * g * b * b / m, sign - 0.5 * m.ln())
}

/// The same for several parameters, on the eigenvectors of their normal equations; `signed` holds the rows of the
/// parameters that cannot be negative, in values per eigenvector.
fn several(
    signed: &DMatrix<f64>,
    values: &DVector<f64>,
    along: &DVector<f64>,
    g: f64,
    block: &PriorBlock,
) -> (f64, f64) {
    let m = values.map(|v| 1.0 + g * g * v.max(0.0));
    let drop = (0..m.len()).map(|k| (g * along[k]).powi(2) / m[k]).sum();
    let log_det: f64 = m.iter().map(|x| x.ln()).sum();
    if !block.positive.contains(&true) {
        return (drop, -0.5 * log_det);
    }
    let mean = signed * DVector::from_fn(m.len(), |k, _| g * along[k] / m[k]);
    let mut scaled = signed.clone();
    for (k, mut column) in scaled.column_iter_mut().enumerate() {
        column /= m[k];
    }
    let spread = scaled * signed.transpose();
    (drop, log_orthant(mean, spread) - block.log_signs - 0.5 * log_det)
}

/// Logarithm of the probability that all components of a Gaussian are positive, by conditioning on one sign after the other and
/// matching moments. Source: Mendell and Elston 1974, Biometrics 30.
pub fn log_orthant(mut mean: DVector<f64>, mut c: DMatrix<f64>) -> f64 {
    let n = mean.len();
    let mut log_p = 0.0;
    for k in 0..n {
        let s = c[(k, k)].max(1e-300).sqrt();
        let z = mean[k] / s;
        let log_tail = log_normal_cdf(z);
        log_p += log_tail;
        // Mean and variance of a unit Gaussian beyond -z.
        let hazard = (-0.5 * z * z - 0.5 * std::f64::consts::TAU.ln() - log_tail).exp();
        let shrink = (hazard * (hazard + z)).clamp(0.0, 1.0);
        for i in k + 1..n {
            let a = c[(i, k)] / s;
            mean[i] += a * hazard;
            for j in k + 1..n {
                let b = c[(j, k)] / s;
                c[(i, j)] -= a * b * shrink;
            }
        }
    }
    log_p
}

/// `ln P(x > 0)` under the posterior minus the same under the prior (one half).
fn log_sign(mean: f64, variance: f64) -> f64 {
    log_normal_cdf(mean / variance.max(1e-300).sqrt()) + std::f64::consts::LN_2
}

/// Logarithm of the standard normal distribution function, also far in the tail.
fn log_normal_cdf(z: f64) -> f64 {
    if z > 6.0 {
        return 0.0;
    }
    if z < -30.0 {
        return -0.5 * z * z - (-z).ln() - 0.5 * std::f64::consts::TAU.ln();
    }
    Normal::standard().cdf(z).max(1e-300).ln()
}

/// `ln sum exp`.
pub fn log_sum(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let top = values.clone().fold(f64::NEG_INFINITY, f64::max);
    if top == f64::NEG_INFINITY {
        return top;
    }
    top + values.map(|v| (v - top).exp()).sum::<f64>().ln()
}

#[cfg(test)]
impl Gram {
    /// Effects of one size each that no reading shows, and no readings.
    pub(crate) fn unseen(effects: usize) -> Self {
        let block = |first| {
            let mut block = PriorBlock { first, ..PriorBlock::new(&[1.0], vec![false], 1.0, false, 1.0) };
            block.set_widths(0.0);
            block
        };
        Self {
            g: DMatrix::zeros(effects, effects),
            b: DVector::zeros(effects),
            likelihood: Likelihood { yy: 0.0, equations: 0.0, level: NoiseLevel::EXACT },
            blocks: (0..effects).map(block).collect(),
            absorbed: DMatrix::zeros(6, effects),
            springs: DMatrix::zeros(6, 6),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readings_of_the_believed_length_have_just_the_evidence_asked_for() {
        for (positive, level) in [(false, NoiseLevel::EXACT), (true, NoiseLevel { sum: 40.0, dof: 40.0 })] {
            let mut gram = Gram::unseen(1);
            gram.blocks[0] = PriorBlock::new(&[1.0], vec![positive], 1.0, false, 1.0);
            gram.blocks[0].set_widths(60.0);
            gram.g[(0, 0)] = 60.0 * 60.0;
            gram.likelihood = Likelihood { yy: 0.0, equations: 80.0, level };
            let [least, lost] = [4.0, 1.5];
            let length = gram.lengths_believed(&[], 0, least, lost)[0] - lost;
            // Readings that are as long and nothing else, beside a noise of its expected size.
            gram.b[0] = 60.0 * length;
            gram.likelihood.yy = length * length + if level.dof.is_finite() { 80.0 } else { 0.0 };
            let evidence = log_sum(gram.profile(&[], &[0]).iter().map(|p| p.1));
            let tolerance = if positive { 0.5 } else { 1e-6 };
            assert!((evidence - least).abs() < tolerance, "{evidence} at {length}");
        }
    }

    #[test]
    fn prior_widths_go_from_twice_the_natural_size_down_to_what_is_noticeable() {
        let all = widths(f64::INFINITY);
        assert_eq!((all.len(), all[0].to_bits()), (11, 2.0_f64.to_bits()));
        assert!(all.windows(2).all(|w| (w[1] / w[0] - 0.4).abs() < 1e-12), "{all:?}");
        // The third width is 0.32: it is noticed from a signature of 5 / 0.32 standard deviations on.
        assert_eq!([15.7, 15.5].map(|signature| widths(signature).len()), [3, 2]);
        assert_eq!(widths(0.1), [2.0], "what nobody notices has its widest prior");
    }

    /// `ln` of the integral of `exp(b u - e u^2 / 2)` over the prior, by the trapezoid rule.
    fn integral(e: f64, b: f64, g: f64, positive: bool) -> f64 {
        const STEP: f64 = 1e-3;
        let at = |k: i32| {
            let t = f64::from(k) * STEP;
            (b * g * t - 0.5 * (1.0 + e * g * g) * t * t).exp() / std::f64::consts::TAU.sqrt()
        };
        let all = -20_000..=20_000;
        if positive {
            let half: f64 = all.filter(|k| *k >= 0).map(|k| if k == 0 { 0.5 * at(k) } else { at(k) }).sum();
            return (2.0 * STEP * half).ln();
        }
        (STEP * all.map(at).sum::<f64>()).ln()
    }

    #[test]
    fn the_evidence_of_one_size_is_the_integral_over_its_prior() {
        for (e, b, g, positive) in
            [(4.0, 3.0, 0.5, false), (4.0, -3.0, 2.0, false), (4.0, 3.0, 2.0, true), (0.3, -2.0, 1.0, true)]
        {
            let (drop, rest) = single(e, b, g, positive);
            let (found, expected) = (0.5 * drop + rest, integral(e, b, g, positive));
            assert!((found - expected).abs() < 1e-5, "{e} {b} {g} {positive}: {found} {expected}");
        }
    }
}
