//! The test for one effect: what is measured, what noise alone gives, what an effect gives.

use hexbench_core::statistics::quantile;
use hexbench_core::streams::{Purpose, stream};
use hexbench_model::effects::sizes::{WIDEST, sizes};
use hexbench_model::effects::term::Term;
use hexbench_model::estimation::basis::orthonormal;
use hexbench_model::inference::power::ChiSquareDropLaw;
use nalgebra::{DMatrix, DVector};
use rand_distr::{ChiSquared, Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::{Planned, PowerSettings, subject::shapes};

/// A combination of parameters is determined when its standard error is below this share of its widest sensible size.
const DETERMINED_SHARE: f64 = 0.5;
/// Shape grids longer than this are bounded instead of simulated.
const LONG_GRID: usize = 24;
/// Draws of noise behind a simulated threshold: 0.01 is met within 0.0004 (one standard deviation).
const THRESHOLD_DRAWS: usize = 60_000;
/// Draws of noise behind a simulated power: 0.9 is met within 0.005 (one standard deviation).
const POWER_DRAWS: usize = 4_000;

/// A test prepared for a plan.
#[derive(Debug, Clone)]
pub struct PreparedTest {
    /// Orthonormal directions an effect can leave beside the springs, a group for every shape; equations x directions.
    directions: DMatrix<f64>,
    /// First direction and number of directions of every shape.
    groups: Vec<(usize, usize)>,
    threshold: f64,
    way: Way,
}

/// How the power is computed.
#[derive(Debug, Clone)]
enum Way {
    /// From the law; also a bound where there are many shapes.
    Law(ChiSquareDropLaw),
    /// By draws of noise along the directions (directions x draws), and of the noise level.
    Draws(DMatrix<f64>, Vec<f64>),
}

impl PreparedTest {
    /// The test for a term; `None` when springs leave nothing of it, or it does not act in this plan.
    pub fn new(planned: &Planned, term: &dyn Term, settings: &PowerSettings) -> Option<Self> {
        let groups = bases(planned, term);
        let widest = groups.iter().map(DMatrix::ncols).max().filter(|&n| n > 0)?;
        let groups: Vec<DMatrix<f64>> = groups.into_iter().filter(|g| g.ncols() > 0).collect();
        let (directions, places) = beside(&groups);
        let noise_dof = planned.campaign.noise.dof;
        let law = ChiSquareDropLaw { dof: widest as f64, noise_dof };
        if places.len() == 1 || places.len() > LONG_GRID {
            let threshold = law.threshold(settings.alarm / places.len() as f64);
            return Some(Self { directions, groups: places, threshold, way: Way::Law(law) });
        }
        let mut noise = Noise::new(&directions, noise_dof, settings.seed);
        let way = Way::Draws(noise.along(POWER_DRAWS), noise.levels(POWER_DRAWS));
        let drops = noise.largest(&places, THRESHOLD_DRAWS);
        let threshold = quantile(drops, 1.0 - settings.alarm)?;
        Some(Self { directions, groups: places, threshold, way })
    }

    /// Drop of chi-square that counts as seen.
    pub fn threshold(&self) -> f64 {
        self.threshold
    }

    /// Determined parameters, at the shape that determines most.
    pub fn parameters(&self) -> usize {
        self.groups.iter().map(|g| g.1).max().unwrap_or(0)
    }

    /// Shapes tried.
    pub fn shapes(&self) -> usize {
        self.groups.len()
    }

    /// Largest drop of chi-square over the shapes, by whitened residuals.
    pub fn drop(&self, residuals: &DVector<f64>) -> f64 {
        largest(&self.groups, &self.directions.tr_mul(residuals))
    }

    /// True when the residuals show the effect.
    pub fn sees(&self, residuals: &DVector<f64>) -> bool {
        self.drop(residuals) > self.threshold
    }

    /// Chance to see a whitened signature.
    pub fn chance(&self, signature: &DVector<f64>) -> f64 {
        let along = self.directions.tr_mul(signature);
        match &self.way {
            Way::Law(law) => law.power(self.threshold, largest(&self.groups, &along)),
            Way::Draws(noise, levels) => {
                let seen = |(draw, level): &(usize, &f64)| {
                    let moved = noise.column(*draw) + &along;
                    largest(&self.groups, &moved) > self.threshold * **level
                };
                levels.iter().enumerate().filter(seen).count() as f64 / levels.len() as f64
            }
        }
    }
}

/// Directions of every shape: determined combinations of the parameters, less what springs absorb.
fn bases(planned: &Planned, term: &dyn Term) -> Vec<DMatrix<f64>> {
    let basis = |shape: f64| {
        let block = planned.lin.term_block(term, false, shape);
        let natural = sizes(term, false, shape, &planned.natural);
        let column_of = |(k, size)| planned.absorption.rest(&(block.column(k) * size));
        let columns: Vec<DVector<f64>> = natural.into_iter().enumerate().map(column_of).collect();
        determined(&DMatrix::from_columns(&columns))
    };
    shapes(term, planned).into_iter().map(basis).collect()
}

/// Orthonormal basis of the determined combinations of columns at natural size; the best one alone when none is.
fn determined(columns: &DMatrix<f64>) -> DMatrix<f64> {
    let eigen = columns.tr_mul(columns).symmetric_eigen();
    let lengths = eigen.eigenvalues.map(|l| l.max(0.0).sqrt());
    let best = lengths.max();
    let counts = |k: &usize| {
        lengths[*k] > 0.0 && (lengths[*k] * WIDEST * DETERMINED_SHARE >= 1.0 || lengths[*k] >= best)
    };
    let kept: Vec<usize> = (0..lengths.len()).filter(counts).collect();
    orthonormal(columns * eigen.eigenvectors.select_columns(&kept))
}

/// Groups of columns side by side, and where each is.
fn beside(groups: &[DMatrix<f64>]) -> (DMatrix<f64>, Vec<(usize, usize)>) {
    let mut places = Vec::new();
    let mut at = 0;
    for group in groups {
        places.push((at, group.ncols()));
        at += group.ncols();
    }
    let columns: Vec<_> = groups.iter().flat_map(DMatrix::column_iter).collect();
    (DMatrix::from_columns(&columns), places)
}

fn largest(groups: &[(usize, usize)], along: &DVector<f64>) -> f64 {
    groups.iter().map(|&(first, count)| along.rows(first, count).norm_squared()).fold(0.0, f64::max)
}

/// What turns a basis into the one that drawn vectors single out in its span, so that the same noise is drawn whatever basis rounding
/// has picked.
fn upright(basis: &DMatrix<f64>, seed: u64) -> DMatrix<f64> {
    let mut rng = stream(seed, Purpose::PowerTest, [1]);
    let drawn =
        DMatrix::from_fn(basis.nrows(), basis.ncols(), |_, _| -> f64 { StandardNormal.sample(&mut rng) });
    let (mut turn, triangle) = basis.tr_mul(&drawn).qr().unpack();
    for (mut column, along) in turn.column_iter_mut().zip(triangle.diagonal().iter()) {
        column *= along.signum();
    }
    turn
}

/// Noise along directions that need not be orthogonal to each other.
struct Noise {
    mixing: DMatrix<f64>,
    level_dof: f64,
    rng: Pcg64,
}

impl Noise {
    fn new(directions: &DMatrix<f64>, level_dof: f64, seed: u64) -> Self {
        let basis = orthonormal(directions.clone());
        let mixing = directions.tr_mul(&basis) * upright(&basis, seed);
        Self { mixing, level_dof, rng: stream(seed, Purpose::PowerTest, []) }
    }

    /// So many draws, one in each column.
    fn along(&mut self, draws: usize) -> DMatrix<f64> {
        let rng = &mut self.rng;
        let independent =
            DMatrix::from_fn(self.mixing.ncols(), draws, |_, _| -> f64 { StandardNormal.sample(rng) });
        &self.mixing * independent
    }

    /// Estimated over true variance of the noise.
    fn levels(&mut self, draws: usize) -> Vec<f64> {
        let law = ChiSquared::new(self.level_dof).ok().filter(|_| self.level_dof.is_finite());
        let mut level = || law.map_or(1.0, |law| law.sample(&mut self.rng) / self.level_dof);
        (0..draws).map(|_| level()).collect()
    }

    /// Largest drop over the groups in units of the estimated noise.
    fn largest(&mut self, groups: &[(usize, usize)], draws: usize) -> Vec<f64> {
        const AT_ONCE: usize = 1000;
        let mut drops = Vec::with_capacity(draws);
        while drops.len() < draws {
            let (noise, levels) = (self.along(AT_ONCE), self.levels(AT_ONCE));
            let columns = noise.column_iter().zip(&levels);
            drops.extend(columns.map(|(c, level)| largest(groups, &c.into_owned()) / level));
        }
        drops
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SEED: u64 = 5;

    /// Largest drops over two groups of directions, of which the second leans on the first.
    fn drops(change: impl Fn(DMatrix<f64>) -> DMatrix<f64>) -> Vec<f64> {
        let mut rng = stream(SEED, Purpose::Test, []);
        let group = |rng: &mut Pcg64| {
            orthonormal(DMatrix::from_fn(40, 2, |_, _| -> f64 { StandardNormal.sample(rng) }))
        };
        let first = group(&mut rng);
        let leaning = orthonormal(&first + group(&mut rng) * 0.5);
        let (directions, places) = beside(&[change(first), change(leaning)]);
        Noise::new(&directions, 30.0, SEED).largest(&places, 1000)
    }

    #[test]
    fn noise_does_not_hang_on_the_basis_that_rounding_picks() {
        let plain = drops(|group| group);
        let quarter = DMatrix::from_row_slice(2, 2, &[0.6, 0.8, 0.8, -0.6]);
        let turned = drops(|group| group * &quarter);
        for (a, b) in plain.iter().zip(&turned) {
            assert!((a - b).abs() < 1e-9 * a.max(1.0), "{a} {b}");
        }
        let mean = plain.iter().sum::<f64>() / plain.len() as f64;
        assert!((2.0..4.5).contains(&mean), "chi-square of two directions, the larger of two alike: {mean}");
    }
}
