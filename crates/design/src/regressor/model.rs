//! Springs and any terms, by the model's own linearisation; derivatives by differences.

use std::sync::Arc;

use hexbench_core::{Columns, Dataset, Hexapod, Measurand, Observation, Pose, Vector6};
use hexbench_model::campaign::Campaign;
use hexbench_model::candidates::sizes;
use hexbench_model::fit::natural;
use hexbench_model::linearization::{Linearization, Point};
use hexbench_model::noise::Noise;
use hexbench_model::term::Term;
use nalgebra::{DMatrix, DVector};

use super::{PoseRegressor, leg_names};
use crate::DesignError;
use crate::space::Loading;

/// A term with its shape value and the natural sizes of its parameters.
struct Wanted {
    term: Arc<dyn Term>,
    shape: f64,
    sizes: Vec<f64>,
}

/// Readings of a pose under every loading, for springs (first six columns) and the parameters of terms.
///
/// A spring counts in relative changes of its compliance, a parameter of a term in natural sizes. A term with a shape takes the
/// middle one of those it would be tried with.
pub struct ModelRegressor<'a> {
    hexapod: &'a Hexapod,
    springs: Vector6,
    noise: Noise,
    terms: Vec<Wanted>,
    readings: Vec<Observation>,
}

impl<'a> ModelRegressor<'a> {
    /// Springs of the given compliance (m/N) and terms, whitened with a noise; at every pose `repeats` readings under each
    /// loading.
    ///
    /// # Errors
    /// A machine that is singular at the zero pose.
    pub fn new(
        hexapod: &'a Hexapod,
        springs: Vector6,
        noise: Noise,
        terms: &[Arc<dyn Term>],
        loads: &[Loading],
        repeats: usize,
    ) -> Result<Self, DesignError> {
        let of = |l: &Loading| reading(Pose::default(), l);
        let readings: Vec<Observation> =
            loads.iter().flat_map(|l| std::iter::repeat_n(of(l), repeats)).collect();
        let mut regressor = Self { hexapod, springs, noise, terms: Vec::new(), readings };
        let (point, lin) = regressor.linearized(regressor.readings.clone())?;
        let natural = natural(&point, &lin);
        let wanted = |term: &Arc<dyn Term>| {
            let grid = term.shape_grid(&lin.conditions);
            let shape = grid.get(grid.len() / 2).copied().unwrap_or(1.0);
            Wanted { term: Arc::clone(term), shape, sizes: sizes(term.as_ref(), false, &natural) }
        };
        regressor.terms = terms.iter().map(wanted).collect();
        Ok(regressor)
    }

    fn linearized(&self, readings: Vec<Observation>) -> Result<(Point, Linearization), DesignError> {
        // Numbered one by one, so that no two are averaged.
        let numbered = (1..).zip(readings).map(|(id, o)| Observation { pose_id: id, repeat: 1, ..o });
        let dataset = Dataset {
            source: String::new(),
            measurand: Measurand::DeflectionEuler,
            columns: Columns { reference: true, approach: true, delta_t: true, elapsed: true, sigma: false },
            observations: numbered.collect(),
        };
        let campaign = Campaign::with_noise(self.hexapod, &dataset, self.noise)?;
        let point = Point { springs: self.springs, ..Point::start(&campaign) };
        let lin = Linearization::at(&campaign, &point)?;
        Ok((point, lin))
    }

    /// Whitened rows of readings, six each, one column per parameter.
    ///
    /// # Errors
    /// A singular pose.
    pub fn rows(&self, readings: Vec<Observation>) -> Result<DMatrix<f64>, DesignError> {
        let (_, lin) = self.linearized(readings)?;
        let mut rows = DMatrix::zeros(lin.equations(), self.parameters());
        let springs =
            lin.common_block() * DMatrix::from_diagonal(&DVector::from_column_slice(self.springs.as_slice()));
        rows.columns_mut(0, 6).copy_from(&springs);
        let mut at = 6;
        for wanted in &self.terms {
            let mut block = lin.term_block(wanted.term.as_ref(), false, wanted.shape);
            for (mut column, size) in block.column_iter_mut().zip(&wanted.sizes) {
                column *= *size;
            }
            rows.columns_mut(at, block.ncols()).copy_from(&block);
            at += block.ncols();
        }
        Ok(rows)
    }
}

/// A reading to be taken.
pub fn reading(pose: Pose, loading: &Loading) -> Observation {
    Observation {
        pose_id: 1,
        repeat: 1,
        line: 0,
        pose,
        wrench: loading.load,
        reference: loading.reference,
        approach: 1.0,
        delta_t: 0.0,
        elapsed: 0.0,
        measured: [0.0; 6],
        sigma: None,
    }
}

impl PoseRegressor for ModelRegressor<'_> {
    fn parameters(&self) -> usize {
        6 + self.terms.iter().map(|w| w.term.info().parameters.len()).sum::<usize>()
    }

    fn readings(&self) -> usize {
        self.readings.len()
    }

    fn names(&self) -> Vec<String> {
        let own = |w: &Wanted| {
            let id = w.term.info().id;
            w.term.info().parameters.iter().map(move |p| format!("{id}.{}", p.name)).collect::<Vec<_>>()
        };
        leg_names().into_iter().chain(self.terms.iter().flat_map(own)).collect()
    }

    fn inform(&self, pose: &Pose, information: &mut DMatrix<f64>) -> Result<(), DesignError> {
        let readings = self.readings.iter().map(|o| Observation { pose: *pose, ..*o }).collect();
        let rows = self.rows(readings)?;
        information.gemm_tr(1.0, &rows, &rows, 1.0);
        Ok(())
    }

    /// By central differences: terms state no derivative by the pose.
    fn slopes(&self, pose: &Pose, g: &DMatrix<f64>) -> Result<[f64; 6], DesignError> {
        const STEP: f64 = 1e-6;
        let p = self.parameters();
        let along = |k: usize, step: f64| -> Result<f64, DesignError> {
            let mut x = pose.to_array();
            x[k] += step;
            let mut information = DMatrix::zeros(p, p);
            self.inform(&Pose::from_array(x), &mut information)?;
            Ok(g.dot(&information))
        };
        let mut slopes = [0.0; 6];
        for (k, slope) in slopes.iter_mut().enumerate() {
            *slope = (along(k, STEP)? - along(k, -STEP)?) / (2.0 * STEP);
        }
        Ok(slopes)
    }
}
