//! Evidence of linear effects with Gaussian priors of unknown width, in closed form on Gram matrices.
//!
//! After the columns every model shares (springs, frames) are projected out, a model is a set of column blocks with
//! prior precisions `lambda`:
//!
//! ```text
//! ln Z = (b' M^-1 b) / 2 - ln|M| / 2 + sum ln(lambda) / 2 + ln P(signs),   M = G + diag(lambda)
//! ```
//!
//! relative to the model without any block. Source: MacKay 1992, Neural Computation 4 (evidence framework). The
//! width of the prior of each effect is not known: it is averaged over a grid that is uniform in its logarithm.
//! Where the noise level itself comes from the data, `ln Z` is the Student form of the same integral.

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, Normal};

/// Largest prior width as a multiple of the natural size of a parameter.
pub const WIDEST: f64 = 2.0;
/// Most widths tried per block, in octaves from the widest down.
const MOST_WIDTHS: i32 = 16;
/// An effect is noticeable when its expected signature is this many standard deviations long. Smaller effects leave no
/// trace in these data and count as absent: whether they exist is not a question these data can answer.
pub const NOTICEABLE: f64 = 4.0;

/// Prior widths of a block, widest first, down to where the effect would no longer be noticeable; `signature` is the
/// expected length of its whitened signature at the natural sizes.
pub fn widths(signature: f64) -> Vec<f64> {
    let octaves = (0..MOST_WIDTHS).map(|k| WIDEST * 0.5f64.powi(k));
    let kept: Vec<f64> = octaves.take_while(|g| g * signature >= NOTICEABLE).collect();
    if kept.is_empty() { vec![WIDEST] } else { kept }
}

/// Columns of one form and shape of one effect inside the Gram matrix.
#[derive(Debug, Clone)]
pub struct Block {
    /// First column.
    pub first: usize,
    /// Natural size of each parameter, SI.
    pub sizes: Vec<f64>,
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
}

impl Block {
    /// Number of columns.
    pub fn width(&self) -> usize {
        self.sizes.len()
    }

    fn precision(&self, k: usize, g: f64) -> f64 {
        (g * self.sizes[k]).powi(-2)
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
    /// `y'y`.
    pub yy: f64,
    /// Equations left after the projection.
    pub equations: f64,
    /// Pure error and its degrees of freedom.
    pub pure_error: (f64, f64),
    /// Degrees of freedom behind the noise level: infinite when it is stated.
    pub noise_dof: f64,
    /// The blocks.
    pub blocks: Vec<Block>,
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
    /// Their variances.
    pub variance: DVector<f64>,
}

impl Gram {
    /// Evidence and posterior of a set of variants under noise inflated by the factor `inflation` (variance).
    ///
    /// `None` when the normal equations are not positive definite.
    pub fn posterior(&self, set: &[Variant], inflation: f64) -> Option<Posterior> {
        let columns: Vec<(usize, f64, bool)> = set
            .iter()
            .flat_map(|v| {
                let block = &self.blocks[v.block];
                (0..block.width()).map(move |k| {
                    (block.first + k, block.precision(k, block.widths[v.width]), block.positive[k])
                })
            })
            .collect();
        let n = columns.len();
        // Scaled by the prior widths: M = I + D G D has eigenvalues of at least one.
        let d: Vec<f64> = columns.iter().map(|c| c.1.sqrt().recip()).collect();
        let mut m =
            DMatrix::from_fn(n, n, |i, j| d[i] * d[j] * self.g[(columns[i].0, columns[j].0)] / inflation);
        for i in 0..n {
            m[(i, i)] += 1.0;
        }
        let b = DVector::from_fn(n, |i, _| d[i] * self.b[columns[i].0] / inflation);
        let factor = m.cholesky()?;
        let mean = factor.solve(&b);
        let inverse = factor.inverse();
        let drop = b.dot(&mean);
        let log_det: f64 = 2.0 * factor.l_dirty().diagonal().iter().map(|x| x.ln()).sum::<f64>();
        let signs: f64 = (0..n).filter(|&i| columns[i].2).map(|i| log_sign(mean[i], inverse[(i, i)])).sum();
        let log_evidence = self.gain(drop, inflation) - 0.5 * log_det + signs;
        Some(Posterior {
            log_evidence,
            drop: drop * inflation,
            mean: DVector::from_fn(n, |i, _| mean[i] * d[i]),
            variance: DVector::from_fn(n, |i, _| inverse[(i, i)] * d[i] * d[i]),
        })
    }

    /// Logarithm of the likelihood gained by a drop of (inflated) chi-square, and lost by the inflation itself.
    fn gain(&self, drop: f64, inflation: f64) -> f64 {
        let (pure, pure_dof) = self.pure_error;
        if self.noise_dof.is_finite() {
            // Unknown level with `noise_dof` prior degrees of freedom; repeats already counted in them are left out.
            let (total, n) = if self.noise_dof > 0.0 {
                (self.yy + self.noise_dof, self.equations + self.noise_dof)
            } else {
                (self.yy + pure, self.equations + pure_dof)
            };
            let before = total.max(f64::MIN_POSITIVE);
            return -0.5 * n * ((before - drop).max(1e-12 * before) / before).ln();
        }
        let lost = 0.5 * self.yy * (1.0 - 1.0 / inflation) - 0.5 * self.equations * inflation.ln();
        0.5 * drop + lost
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
        let mut columns = Vec::new();
        let mut scale = Vec::new();
        for v in others {
            let block = &gram.blocks[v.block];
            columns.extend(block.first..block.first + block.width());
            scale.extend(block.sizes.iter().map(|s| s * block.widths[v.width]));
        }
        let n = columns.len();
        let m = DMatrix::from_fn(n, n, |i, j| {
            scale[i] * scale[j] * gram.g[(columns[i], columns[j])] + f64::from(i == j)
        });
        let factor = m.cholesky()?.unpack();
        let b = DVector::from_fn(n, |i, _| scale[i] * gram.b[columns[i]]);
        let forward = factor.solve_lower_triangular(&b)?;
        let drop = forward.norm_squared();
        let log_det = 2.0 * factor.diagonal().iter().map(|x| x.ln()).sum::<f64>();
        Some(Self { columns, scale: DVector::from_vec(scale), factor, forward, drop, log_det })
    }

    fn profile(&self, gram: &Gram, index: usize) -> Vec<(Variant, f64)> {
        let block = &gram.blocks[index];
        let (e, b) = self.complement(gram, block);
        let offset = block.log_share - (block.widths.len() as f64).ln() - 0.5 * self.log_det;
        let variant = |width| Variant { block: index, width };
        if block.width() == 1 {
            let score = |g: f64| single(e[(0, 0)], b[0], g, block.positive[0]);
            let scored = block.widths.iter().map(|&g| score(g)).enumerate();
            return scored
                .map(|(w, (d, rest))| (variant(w), gram.gain(self.drop + d, 1.0) + rest + offset))
                .collect();
        }
        let eigen = e.symmetric_eigen();
        let along = eigen.eigenvectors.tr_mul(&b);
        let score = |g: f64| several(&eigen.eigenvectors, &eigen.eigenvalues, &along, g, &block.positive);
        let scored = block.widths.iter().map(|&g| score(g)).enumerate();
        scored.map(|(w, (d, rest))| (variant(w), gram.gain(self.drop + d, 1.0) + rest + offset)).collect()
    }

    /// Normal equations of a block at its natural sizes, less what the fixed blocks take.
    fn complement(&self, gram: &Gram, block: &Block) -> (DMatrix<f64>, DVector<f64>) {
        let (d, n, s) = (block.width(), self.columns.len(), &block.sizes);
        let mut e = DMatrix::from_fn(d, d, |i, j| s[i] * s[j] * gram.g[(block.first + i, block.first + j)]);
        let mut b = DVector::from_fn(d, |i, _| s[i] * gram.b[block.first + i]);
        if n > 0 {
            let mut x = DMatrix::from_fn(n, d, |i, j| {
                self.scale[i] * s[j] * gram.g[(self.columns[i], block.first + j)]
            });
            self.factor.solve_lower_triangular_mut(&mut x);
            e -= x.tr_mul(&x);
            b -= x.tr_mul(&self.forward);
        }
        (e, b)
    }
}

/// Drop of chi-square of one parameter, and the rest of its log-evidence.
fn single(e: f64, b: f64, g: f64, positive: bool) -> (f64, f64) {
    let m = 1.0 + g * g * e.max(0.0);
    let sign = if positive { log_sign(g * b / m, 1.0 / m) } else { 0.0 };
    (g * g * b * b / m, sign - 0.5 * m.ln())
}

/// The same for several parameters, on the eigenvectors of their normal equations.
fn several(
    vectors: &DMatrix<f64>,
    values: &DVector<f64>,
    along: &DVector<f64>,
    g: f64,
    positive: &[bool],
) -> (f64, f64) {
    let m = values.map(|v| 1.0 + g * g * v.max(0.0));
    let drop = (0..m.len()).map(|k| (g * along[k]).powi(2) / m[k]).sum();
    let log_det: f64 = m.iter().map(|x| x.ln()).sum();
    let sign = |i: usize| {
        let mean: f64 = (0..m.len()).map(|k| vectors[(i, k)] * g * along[k] / m[k]).sum();
        let variance: f64 = (0..m.len()).map(|k| vectors[(i, k)].powi(2) / m[k]).sum();
        log_sign(mean, variance)
    };
    let signs: f64 = (0..m.len()).filter(|&i| positive[i]).map(sign).sum();
    (drop, signs - 0.5 * log_det)
}

/// `ln P(x > 0)` under the posterior minus the same under the prior (one half).
fn log_sign(mean: f64, variance: f64) -> f64 {
    let z = mean / variance.max(1e-300).sqrt();
    if z > 6.0 {
        return std::f64::consts::LN_2;
    }
    if z < -30.0 {
        return -0.5 * z * z;
    }
    (2.0 * Normal::standard().cdf(z)).max(1e-300).ln()
}

/// `ln sum exp`.
pub fn log_sum(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let top = values.clone().fold(f64::NEG_INFINITY, f64::max);
    if top == f64::NEG_INFINITY {
        return top;
    }
    top + values.map(|v| (v - top).exp()).sum::<f64>().ln()
}
