//! What competes: the terms this file can test, and patterns outside the catalogue; as one projected Gram matrix.

use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use crate::effects::sizes::sizes;
use crate::effects::term::{Natural, Rich, Term};
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::Fit;
use crate::estimation::linearization::{Linearization, ModelPoint, parameter_count};
use crate::estimation::parallel::sum_in_order;
use crate::estimation::whitening::Inexact;
use crate::inference::evidence::{Gram, Likelihood, PriorBlock};
use crate::inference::pattern::Pattern;

/// Prior share of the ideal form where there is a richer one.
const IDEAL_SHARE: f64 = 0.8;

/// Eigenvalues of the scaled Gram matrix of the common columns below this share of the largest are not determined.
const DETERMINED: f64 = 1e-13;

/// One competitor.
#[derive(Clone)]
pub struct Candidate {
    /// What it is.
    pub kind: CandidateKind,
    /// Its blocks in the Gram matrix.
    pub blocks: Vec<usize>,
    /// The version of a term that each of them holds; none of a pattern.
    versions: Vec<Arc<dyn Term>>,
    /// Logarithm of its prior weight relative to a term of the catalogue.
    pub log_weight: f64,
}

/// Term or pattern.
#[derive(Clone)]
pub enum CandidateKind {
    /// An effect with a name.
    Term(Arc<dyn Term>),
    /// A pattern without one.
    Pattern(Pattern),
}

impl Candidate {
    /// Id of the term, when it is one.
    pub fn id(&self) -> Option<&'static str> {
        match &self.kind {
            CandidateKind::Term(t) => Some(t.info().id),
            CandidateKind::Pattern(_) => None,
        }
    }

    /// The version of the term in one of its blocks, when it is one.
    pub fn version(&self, block: usize) -> Option<&Arc<dyn Term>> {
        self.blocks.iter().zip(&self.versions).find(|(b, _)| **b == block).map(|(_, version)| version)
    }

    /// How far the next shape of the version in one of its blocks is from that of the block, in logarithm; zero where there is none.
    pub fn step_of_shape(&self, block: usize, blocks: &[PriorBlock]) -> f64 {
        let Some(version) = self.version(block) else { return 0.0 };
        let alike =
            self.blocks.iter().zip(&self.versions).filter(|(_, v)| std::ptr::eq(v.info(), version.info()));
        let steps = alike.map(|(&b, _)| (blocks[b].shape / blocks[block].shape).ln().abs());
        let next = steps.filter(|&step| step > 0.0).fold(f64::INFINITY, f64::min);
        if next.is_finite() { next } else { 0.0 }
    }

    /// True for a version with fewer numbers than the usual one, of which it is a special case.
    pub fn is_special(&self, version: &dyn Term) -> bool {
        let CandidateKind::Term(usual) = &self.kind else { return false };
        version.info().parameters.len() < usual.info().parameters.len()
    }

    /// Those of its forms that span the others.
    pub fn spanning_forms<'a>(
        &'a self,
        blocks: &'a [PriorBlock],
    ) -> impl Iterator<Item = CompetingForm> + 'a {
        self.forms(blocks).filter(|form| !self.is_special(form.version.as_ref()))
    }

    /// The forms in which it competes, when it is a term; `blocks`: those of the Gram matrix.
    pub fn forms<'a>(&'a self, blocks: &'a [PriorBlock]) -> impl Iterator<Item = CompetingForm> + 'a {
        self.blocks.iter().zip(&self.versions).map(|(&b, version)| CompetingForm {
            version: Arc::clone(version),
            rich: blocks[b].rich,
            shape: blocks[b].shape,
            share: blocks[b].log_share.exp(),
        })
    }
}

/// A form of a term that competes: which version of it, ideal or richer, of which shape.
#[derive(Clone)]
pub struct CompetingForm {
    /// The term itself or another version of it.
    pub version: Arc<dyn Term>,
    /// Richer form.
    pub rich: bool,
    /// Value of the shape.
    pub shape: f64,
    /// Prior share within the effect.
    pub share: f64,
}

/// Forms with the shapes of a fit in the places of their neighbors: between the values of a grid the evidence may be far below its peak.
/// A peak narrower than its part of the grid counts with the share that it fills (Laplace). Beyond the ends of a grid there is nothing
/// to take the place of: a fit that goes there has no peak.
pub fn with_fitted_shapes(mut forms: Vec<CompetingForm>, fit: &Fit) -> Vec<CompetingForm> {
    for (k, active) in fit.point.active.iter().enumerate() {
        let Some(column) = fit.parameters.shape_of_term(k) else { continue };
        let is_own = |f: &CompetingForm| !f.rich && std::ptr::eq(f.version.info(), active.term.info());
        let mut own: Vec<&mut CompetingForm> = forms.iter_mut().filter(|f| is_own(f)).collect();
        own.sort_by(|a, b| a.shape.total_cmp(&b.shape));
        let above = own.partition_point(|form| form.shape < active.shape);
        if above == 0 || above == own.len() {
            continue;
        }
        let step = (own[above].shape / own[above - 1].shape).ln();
        let is_nearer_below = (active.shape / own[above - 1].shape).ln() < 0.5 * step;
        let nearest = if is_nearer_below { above - 1 } else { above };
        own[nearest].share *= (TAU.sqrt() * fit.std(column) / step).min(1.0);
        own[nearest].shape = active.shape;
    }
    forms
}

/// The forms of a version in the given shapes out of `trials`, which share `share` of the prior; also its richer form at a shape.
pub fn forms_of(
    version: &Arc<dyn Term>,
    shapes: &[f64],
    trials: usize,
    rich: Option<f64>,
    share: f64,
) -> Vec<CompetingForm> {
    let rich = rich.filter(|_| version.info().rich != Rich::None);
    let ideal_share = if rich.is_some() { IDEAL_SHARE } else { 1.0 };
    let form = |rich, shape, share| CompetingForm { version: Arc::clone(version), rich, shape, share };
    let each = share * ideal_share / trials.max(1) as f64;
    let ideal = shapes.iter().map(|&s| form(false, s, each));
    ideal.chain(rich.map(|s| form(true, s, share * (1.0 - IDEAL_SHARE)))).collect()
}

/// Where the columns of a block come from.
enum Source {
    Term { term: Arc<dyn Term>, rich: bool, shape: f64 },
    Pattern { pattern: Pattern, range: f64 },
}

impl Source {
    fn columns(&self, lin: &Linearization) -> DMatrix<f64> {
        match self {
            Self::Term { term, rich, shape } => lin.term_block(term.as_ref(), *rich, *shape),
            Self::Pattern { pattern, range } => {
                lin.block_of(pattern.width(), |c, out| pattern.actions(c, *range, out))
            }
        }
    }
}

/// Collects blocks of whitened columns that are multiplied together and projected at the end, a part of the conditions
/// at a time.
pub struct Collector<'a> {
    lin: &'a Linearization,
    natural: Natural,
    sources: Vec<Source>,
    width: usize,
    blocks: Vec<PriorBlock>,
    candidates: Vec<Candidate>,
}

impl<'a> Collector<'a> {
    /// Nothing collected yet.
    pub fn new(lin: &'a Linearization, natural: Natural) -> Self {
        Self { lin, natural, sources: Vec::new(), width: 0, blocks: Vec::new(), candidates: Vec::new() }
    }

    /// Add a term with the given shapes out of `trials`; also its richer form at the shape `rich`. No other versions of it.
    pub fn add_term(&mut self, term: &Arc<dyn Term>, shapes: &[f64], trials: usize, rich: Option<f64>) {
        self.add_forms(term, forms_of(term, shapes, trials, rich, 1.0));
    }

    /// Add a term in these forms.
    pub fn add_forms(&mut self, term: &Arc<dyn Term>, forms: Vec<CompetingForm>) {
        let blocks = forms.iter().map(|form| self.push_form(form)).collect();
        let versions = forms.into_iter().map(|form| form.version).collect();
        let kind = CandidateKind::Term(Arc::clone(term));
        self.candidates.push(Candidate { kind, blocks, versions, log_weight: term.log_prior() });
    }

    fn push_form(&mut self, form: &CompetingForm) -> usize {
        let CompetingForm { version, rich, shape, share } = form;
        let mut positive: Vec<bool> = version.info().parameters.iter().map(|p| p.positive).collect();
        positive.resize(parameter_count(version.as_ref(), *rich), false);
        let sizes = sizes(version.as_ref(), *rich, *shape, &self.natural);
        let mut block = PriorBlock::new(&sizes, positive, *shape, *rich, *share);
        if version.second_is_part_of_first() {
            block = block.with_part();
        }
        self.push(Source::Term { term: Arc::clone(version), rich: *rich, shape: *shape }, block)
    }

    /// Add a pattern with its prior weight relative to a term.
    pub fn add_pattern(&mut self, pattern: Pattern, log_weight: f64) {
        let range = pattern.spread(&self.lin.conditions);
        if range <= 0.0 {
            return;
        }
        let block = PriorBlock::new(&pattern.sizes(&self.natural), pattern.positive(), 1.0, false, 1.0);
        let blocks = vec![self.push(Source::Pattern { pattern, range }, block)];
        let kind = CandidateKind::Pattern(pattern);
        self.candidates.push(Candidate { kind, blocks, versions: Vec::new(), log_weight });
    }

    fn push(&mut self, source: Source, mut block: PriorBlock) -> usize {
        block.first = self.width;
        self.width += block.width();
        self.sources.push(source);
        self.blocks.push(block);
        self.blocks.len() - 1
    }

    /// Multiply everything, and project it off the common columns.
    pub fn finish(self, campaign: &Campaign, point: &ModelPoint) -> (Gram, Vec<Candidate>) {
        let parts = self.lin.parts_of_noise();
        let sums = sum_in_order(&parts, |part| self.products(part, point));
        let Some(sums) = sums else { unreachable!("a campaign has at least one condition") };
        let sums = without_inputs(&sums, self.lin);
        let (common, width) = (self.lin.common_columns(), self.width);
        let root = inverse_root(&sums.view((0, 0), (common, common)).into_owned());
        // Overlap of everything with an orthonormal basis of the common columns.
        let overlap = root.tr_mul(&sums.view((0, common), (common, width + 1)));
        let rest = sums.view((common, common), (width + 1, width + 1)) - overlap.tr_mul(&overlap);
        let g = rest.view((0, 0), (width, width)).into_owned();
        let mut blocks = self.blocks;
        for block in &mut blocks {
            let trace = (0..block.width()).map(|k| g[(block.first + k, block.first + k)]).sum::<f64>();
            block.set_widths(trace.max(0.0).sqrt());
        }
        let gram = Gram {
            g,
            b: rest.view((0, width), (width, 1)).column(0).into_owned(),
            likelihood: Likelihood {
                yy: rest[(width, width)].max(0.0),
                equations: self.lin.numbers() - root.ncols() as f64,
                level: campaign.noise_level(),
            },
            blocks,
            absorbed: root.rows(0, 6) * overlap.columns(0, width),
            springs: root.rows(0, 6) * root.rows(0, 6).transpose(),
        };
        (gram, self.candidates)
    }

    /// `[C Z y U]' [C Z y U]` of a part of the conditions; `U`: columns of the inputs known to a tolerance only, where there are any.
    fn products(&self, part: &Range<usize>, point: &ModelPoint) -> DMatrix<f64> {
        let (lin, inputs) = (self.lin.part_of_noise(part), self.lin.inexact().map(Inexact::z));
        let (common, used) = (lin.common_columns(), self.lin.common_columns() + self.width + 1);
        let mut all = DMatrix::zeros(lin.equations(), used + inputs.map_or(0, DMatrix::ncols));
        all.columns_mut(0, common).copy_from(&lin.common_block());
        for (block, source) in self.blocks.iter().zip(&self.sources) {
            let mut place = all.columns_mut(common + block.first, block.width());
            place.gemm(1.0, &source.columns(&lin), &block.transform, 0.0);
        }
        all.set_column(common + self.width, &target(&lin, point));
        if let Some(u) = inputs {
            all.columns_mut(used, u.ncols()).copy_from(&u.rows(6 * part.start, 6 * part.len()));
        }
        squared(&all)
    }
}

/// `A' W W A` from `[A U]' [A U]`, `W` whitening by the inputs known to a tolerance only.
fn without_inputs(products: &DMatrix<f64>, lin: &Linearization) -> DMatrix<f64> {
    let Some(inexact) = lin.inexact() else { return products.clone() };
    let inputs = inexact.known().nrows();
    let used = products.nrows() - inputs;
    let taken = products.view((0, used), (used, inputs)) * inexact.known();
    let mut rest = products.view((0, 0), (used, used)).into_owned();
    rest.gemm(-1.0, &taken, &taken.transpose(), 1.0);
    rest
}

/// `A' A`: strips of its upper triangle, mirrored.
fn squared(a: &DMatrix<f64>) -> DMatrix<f64> {
    const STRIP: usize = 32;
    let (transposed, n) = (a.transpose(), a.ncols());
    let mut product = DMatrix::zeros(n, n);
    for first in (0..n).step_by(STRIP) {
        let (width, rest) = (STRIP.min(n - first), n - first);
        let mut place = product.view_mut((first, first), (width, rest));
        place.gemm(1.0, &transposed.rows(first, width), &a.columns(first, rest), 0.0);
    }
    product.fill_lower_triangle_with_upper_triangle();
    product
}

/// `T` with `T' G T = I` on the determined subspace of a Gram matrix whose columns have any units.
fn inverse_root(g: &DMatrix<f64>) -> DMatrix<f64> {
    let n = g.nrows();
    let scale = DVector::from_fn(n, |k, _| if g[(k, k)] > 0.0 { g[(k, k)].sqrt().recip() } else { 0.0 });
    let scaled = DMatrix::from_fn(n, n, |i, j| g[(i, j)] * scale[i] * scale[j]);
    let eigen = scaled.symmetric_eigen();
    let largest = eigen.eigenvalues.max();
    let kept: Vec<usize> = (0..n).filter(|&k| eigen.eigenvalues[k] > DETERMINED * largest).collect();
    DMatrix::from_fn(n, kept.len(), |i, j| {
        scale[i] * eigen.eigenvectors[(i, kept[j])] / eigen.eigenvalues[kept[j]].sqrt()
    })
}

/// What springs, frames and the terms together must explain: the residual plus what active terms explain now.
pub fn target(lin: &Linearization, point: &ModelPoint) -> DVector<f64> {
    let mut explained = DVector::zeros(lin.equations());
    for a in &point.active {
        explained += lin.own_share(a, a.shape);
    }
    lin.residuals() + lin.whitened_column(explained)
}

#[cfg(test)]
impl Candidate {
    /// A term with one block.
    pub(crate) fn of_block(term: &Arc<dyn Term>, block: usize) -> Self {
        let versions = vec![Arc::clone(term)];
        Self { kind: CandidateKind::Term(Arc::clone(term)), blocks: vec![block], versions, log_weight: 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::terms::catalogue;

    #[test]
    fn a_richer_form_has_a_fifth_of_the_prior_and_half_the_size_of_the_ideal_one() {
        let natural = Natural { compliance: 2e-8, force: 100.0, radius: 0.1, length: 0.5, elapsed: 10.0 };
        let with = |rich| catalogue().into_iter().find(|t| t.info().rich == rich).unwrap();
        for rich in [Rich::PerLeg, Rich::Full] {
            let term = with(rich);
            let ideal = term.info().parameters.len();
            let shares: Vec<f64> =
                forms_of(&term, &[1.0], 1, Some(1.0), 1.0).iter().map(|f| f.share).collect();
            assert!((shares[0] - 0.8).abs() < 1e-12 && (shares[1] - 0.2).abs() < 1e-12, "{shares:?}");
            assert_eq!(forms_of(&term, &[1.0], 1, None, 1.0).len(), 1);
            let sizes = sizes(term.as_ref(), true, 1.0, &natural);
            let second = if rich == Rich::Full { sizes[1] } else { sizes[0] };
            assert!((sizes[ideal] / (0.5 * (sizes[0] * second).sqrt()) - 1.0).abs() < 1e-12, "{sizes:?}");
        }
    }
}
