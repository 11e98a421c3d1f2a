//! What elongations of legs do to the whitened readings, less what springs, inputs and the effects already in the model take.

use hexbench_core::{Matrix6, Vector6};
use nalgebra::{DMatrix, DVector};

use super::tables::{LawColumns, Values};
use crate::effects::term::Natural;
use crate::effects::user_term::PartKind;
use crate::estimation::basis::{orthonormal, project};
use crate::estimation::linearization::{Linearization, ModelPoint, beside};
use crate::estimation::noise::NoiseLevel;
use crate::inference::candidates::target;
use crate::inference::evidence::Likelihood;

/// A column per leg and condition as values `phi`, six per condition, gives the whitened and projected reading
/// `A phi`, and
///
/// ```text
/// A' r = share,   A' A = R' R - U' U
/// ```
///
/// with the readers `R` of the conditions. `U` has a row for every input within its tolerance and every column already in the model.
/// Errors that readings share are left out: what survives is weighed with them.
pub(crate) struct ElongationSpace {
    /// `A' r`, six per condition.
    share: Vec<Vector6>,
    /// `R' R` of every condition.
    length: Vec<Matrix6>,
    /// `U` of each leg: a row for each of its rows, a column per condition.
    taken: [DMatrix<f64>; 6],
    /// Worth of a drop of chi-square.
    pub(crate) likelihood: Likelihood,
    /// Elongation natural to the machine under these loads, m.
    pub(crate) elongation: f64,
}

/// Spaces of everything laws act on.
pub(crate) struct Spaces {
    elongation: ElongationSpace,
    bodies: [ElongationSpace; 3],
}

impl Spaces {
    /// Of a linearized model; `point` holds what is in it beside the springs.
    pub(crate) fn new(lin: &Linearization, point: &ModelPoint, level: NoiseLevel, natural: &Natural) -> Self {
        let mut columns = vec![lin.common_block()];
        columns.extend(point.active.iter().map(|a| lin.term_block(a.term.as_ref(), a.rich, a.shape)));
        let basis = orthonormal(beside(&columns));
        let mut residual = target(lin, point);
        project(&basis, &mut residual);
        let yy = residual.norm_squared();
        let equations = lin.numbers() - basis.ncols() as f64;
        // Symmetric whitening: what is whitened once more stands beside a column that is not whitened at all.
        let rows = [Some(lin.whitened(basis)), lin.input_block()];
        let rows = beside(&rows.into_iter().flatten().collect::<Vec<_>>());
        let residual = lin.whitened(DMatrix::from_column_slice(residual.len(), 1, residual.as_slice()));
        let residual = residual.column(0).into_owned();
        let likelihood = Likelihood { yy, equations, level };
        let space = |kind: PartKind| {
            let readers = lin.readers_of(|c, k| {
                let mut one = Vector6::zeros();
                one[k] = natural_unit(kind, k, natural);
                kind.action(c, &one)
            });
            ElongationSpace::of(&readers, &residual, &rows, likelihood, natural.compliance * natural.force)
        };
        Self { elongation: space(PartKind::Elongation), bodies: PartKind::BODIES.map(space) }
    }

    /// That of one kind.
    pub(crate) fn of(&self, kind: PartKind) -> &ElongationSpace {
        PartKind::BODIES.iter().position(|k| *k == kind).map_or(&self.elongation, |k| &self.bodies[k])
    }
}

/// SI units of component `k` that are natural to one meter of elongation: rad on the platform radius, N on the compliance of a leg.
pub(crate) fn natural_unit(kind: PartKind, k: usize, natural: &Natural) -> f64 {
    match (kind, k < 3) {
        (PartKind::Elongation, _) | (PartKind::BaseMotion | PartKind::PlatformMotion, true) => 1.0,
        (PartKind::BaseMotion | PartKind::PlatformMotion, false) => 1.0 / natural.radius,
        (PartKind::Wrench, true) => 1.0 / natural.compliance,
        (PartKind::Wrench, false) => natural.radius / natural.compliance,
    }
}

impl ElongationSpace {
    fn of(
        readers: &[Matrix6],
        residual: &DVector<f64>,
        rows: &DMatrix<f64>,
        likelihood: Likelihood,
        elongation: f64,
    ) -> Self {
        let share = readers.iter().enumerate().map(|(i, r)| r.tr_mul(&residual.fixed_rows::<6>(6 * i)));
        let mut taken = [(); 6].map(|()| DMatrix::zeros(rows.ncols(), readers.len()));
        for (i, reader) in readers.iter().enumerate() {
            let along = rows.fixed_rows::<6>(6 * i).tr_mul(reader);
            for (of_leg, column) in taken.iter_mut().zip(along.column_iter()) {
                of_leg.set_column(i, &column);
            }
        }
        Self {
            share: share.collect(),
            length: readers.iter().map(|r| r.tr_mul(r)).collect(),
            taken,
            likelihood,
            elongation,
        }
    }

    /// Normal equations of some laws, one or two columns per leg each, in units of the natural elongation. Many at once share one product
    /// of matrices.
    pub(crate) fn sums(&self, laws: &[LawColumns]) -> Vec<LegSums> {
        let all: Vec<&Values> = laws.iter().flatten().collect();
        let overlaps = std::array::from_fn(|leg| {
            let of_leg = all.iter().flat_map(|column| column.iter().map(move |phi| phi[leg]));
            &self.taken[leg] * DMatrix::from_iterator(self.share.len(), all.len(), of_leg)
        });
        let mut first = 0;
        let one = |law: &LawColumns| {
            first += law.len();
            self.of_law(law, &overlaps, first - law.len())
        };
        laws.iter().map(one).collect()
    }

    /// Those of one; `first`: place of its columns among those of the overlaps.
    fn of_law(&self, law: &LawColumns, overlaps: &[DMatrix<f64>; 6], first: usize) -> LegSums {
        let mut sums = LegSums { columns: law.len(), ..LegSums::default() };
        for (w, column) in law.iter().enumerate() {
            for (phi, share) in column.iter().zip(&self.share) {
                (0..6).for_each(|leg| sums.b[6 * w + leg] += phi[leg] * share[leg]);
            }
            for (v, other) in law.iter().enumerate().take(w + 1) {
                self.add_lengths(column, other, 6 * w, 6 * v, &mut sums);
            }
        }
        let overlap = |k: usize| overlaps[k % 6].column(first + k / 6);
        for i in 0..6 * law.len() {
            for j in 0..=i {
                sums.g[i][j] -= overlap(i).dot(&overlap(j));
                sums.g[j][i] = sums.g[i][j];
            }
        }
        let square: f64 = law.iter().flatten().flatten().map(|x| x * x).sum();
        let count = (6 * self.share.len() * law.len()).max(1) as f64;
        sums.scale = if square > 0.0 { self.elongation / (square / count).sqrt() } else { 0.0 };
        sums
    }

    /// Products of two columns, of which only the lower triangle counts.
    fn add_lengths(&self, a: &[[f64; 6]], b: &[[f64; 6]], at: usize, beside: usize, sums: &mut LegSums) {
        for ((x, y), length) in a.iter().zip(b).zip(&self.length) {
            for i in 0..6 {
                let last = if at == beside { i } else { 5 };
                for j in 0..=last {
                    sums.g[at + i][beside + j] += x[i] * length[(i, j)] * y[j];
                }
            }
        }
    }
}

/// Normal equations of the columns of six legs, leg by leg; those of any choice of legs are sums of them.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct LegSums {
    pub(crate) columns: usize,
    pub(crate) b: [f64; 12],
    pub(crate) g: [[f64; 12]; 12],
    /// Size that gives the natural elongation, SI.
    pub(crate) scale: f64,
}

impl LegSums {
    /// Normal equations of one choice of legs: `b`, then `g` of first, mixed, second column.
    pub(crate) fn of(&self, signs: [i8; 6]) -> ([f64; 2], [f64; 3]) {
        let (mut b, mut g) = ([0.0; 2], [0.0; 3]);
        let concerned = |leg: &usize| signs[*leg] != 0;
        for i in (0..6).filter(concerned) {
            let si = f64::from(signs[i]);
            b[0] += si * self.b[i];
            b[1] += si * self.b[6 + i];
            for j in (0..6).filter(concerned) {
                let s = si * f64::from(signs[j]);
                g[0] += s * self.g[i][j];
                g[1] += s * self.g[6 + i][j];
                g[2] += s * self.g[6 + i][6 + j];
            }
        }
        (b.map(|x| x * self.scale), g.map(|x| x * self.scale * self.scale))
    }
}
