//! Springs and any terms, by the model's own linearization; derivatives by differences.

use std::sync::Arc;

use hexbench_core::{Hexapod, Observation, Pose, Vector6, Wrench};
use hexbench_model::effects::sizes::sizes;
use hexbench_model::effects::term::Term;
use hexbench_model::estimation::fit::natural;
use hexbench_model::estimation::noise::Noise;
use hexbench_model::estimation::nuisance::ShownInputs;
use hexbench_model::estimation::tolerances::{InputKind, input_columns};
use nalgebra::{DMatrix, DVector};

use super::{PoseRegressor, SettingRegressor, leg_names};
use crate::space::{Loading, Setting};
use crate::to_be_read::ToBeRead;
use crate::{DesignError, Space};

/// A term with its shape value and the natural sizes of its parameters.
#[derive(Clone)]
struct Wanted {
    term: Arc<dyn Term>,
    shape: f64,
    sizes: Vec<f64>,
}

/// Readings of a pose under every setting, by the sensors of the machine where it has some, for springs (first six columns) and the parameters of terms.
///
/// A spring counts in relative changes of its compliance, a parameter of a term in natural sizes. A term with a shape takes the
/// middle one of those it would be tried with.
#[derive(Clone)]
pub struct ModelRegressor<'a> {
    hexapod: &'a Hexapod,
    springs: Vector6,
    noise: Noise,
    terms: Vec<Wanted>,
    settings: Vec<Setting>,
    counts: Vec<usize>,
    /// Combinations of inputs whose errors show, a row for each of [`input_columns`]; no columns where all are exact.
    inputs: DMatrix<f64>,
}

impl<'a> ModelRegressor<'a> {
    /// Springs of the given compliance (m/N) and terms, whitened with a noise; at every pose `repeats` readings under each
    /// setting.
    ///
    /// # Errors
    /// A machine that is singular at the zero pose.
    pub fn new(
        hexapod: &'a Hexapod,
        springs: Vector6,
        noise: Noise,
        terms: &[Arc<dyn Term>],
        settings: &[Setting],
        repeats: usize,
    ) -> Result<Self, DesignError> {
        let counts = vec![repeats; settings.len()];
        let inputs = DMatrix::zeros(InputKind::COLUMNS, 0);
        let mut regressor =
            Self { hexapod, springs, noise, terms: Vec::new(), settings: settings.to_vec(), counts, inputs };
        let ToBeRead { point, lin, .. } = regressor.to_be_read(regressor.readings(&Pose::default()))?;
        let natural = natural(&point, &lin);
        let wanted = |term: &Arc<dyn Term>| {
            let grid = term.shape_grid(&lin.conditions);
            let shape = grid.get(grid.len() / 2).copied().unwrap_or(1.0);
            Wanted { term: Arc::clone(term), shape, sizes: sizes(term.as_ref(), false, shape, &natural) }
        };
        regressor.terms = terms.iter().map(wanted).collect();
        Ok(regressor)
    }

    /// The same with joints, loads and axes as good as the tolerances of the machine: the `most` combinations of their errors that show
    /// most at poses all over a space.
    ///
    /// # Errors
    /// As [`Space::poses`]; a singular pose.
    pub fn within_tolerances(mut self, space: &Space, most: usize) -> Result<Self, DesignError> {
        const POSES: usize = 32;
        const SEED: u32 = 0;
        let poses = space.poses(self.hexapod, POSES, SEED)?;
        let readings = poses.iter().flat_map(|pose| self.readings(pose)).collect();
        let ToBeRead { campaign, point, .. } = self.to_be_read(readings)?;
        let columns = input_columns(&campaign, &point, &self.hexapod.tolerances)?;
        self.inputs = ShownInputs::most(&columns, most).combinations;
        Ok(self)
    }

    /// One reading of a pose under each setting.
    fn readings(&self, pose: &Pose) -> Vec<Observation> {
        self.settings.iter().map(|s| reading(*pose, s)).collect()
    }

    /// Natural sizes of the parameters of the terms, SI, in the order of the columns after the springs.
    pub fn sizes(&self) -> impl Iterator<Item = f64> {
        self.terms.iter().flat_map(|w| w.sizes.iter().copied())
    }

    /// Numbered one by one, so that no two are averaged.
    fn to_be_read(&self, readings: Vec<Observation>) -> Result<ToBeRead, DesignError> {
        let numbered = (1..).zip(readings).map(|(id, o)| Observation { pose_id: id, repeat: 1, ..o });
        ToBeRead::of(self.hexapod, self.springs, self.noise, numbered)
    }

    /// Whitened rows of readings, one column per parameter and per combination of inputs.
    ///
    /// # Errors
    /// A singular pose.
    pub fn rows(&self, readings: Vec<Observation>) -> Result<DMatrix<f64>, DesignError> {
        self.rows_of(&self.to_be_read(readings)?)
    }

    fn rows_of(&self, read: &ToBeRead) -> Result<DMatrix<f64>, DesignError> {
        let ToBeRead { campaign, point, lin, .. } = read;
        let mut rows = DMatrix::zeros(lin.equations(), self.width());
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
        if self.inputs() > 0 {
            let columns = input_columns(campaign, point, &self.hexapod.tolerances)?;
            rows.columns_mut(at, self.inputs()).copy_from(&(columns * &self.inputs));
        }
        Ok(rows)
    }
}

/// A reading to be taken.
pub fn reading(pose: Pose, setting: &Setting) -> Observation {
    Observation {
        approach: setting.approach,
        delta_t: setting.delta_t,
        elapsed: setting.elapsed,
        ..Observation::unread(pose, setting.loading.load, setting.loading.reference)
    }
}

impl PoseRegressor for ModelRegressor<'_> {
    fn parameters(&self) -> usize {
        6 + self.terms.iter().map(|w| w.term.info().parameters.len()).sum::<usize>()
    }

    fn inputs(&self) -> usize {
        self.inputs.ncols()
    }

    fn readings(&self) -> usize {
        self.counts.iter().sum()
    }

    fn names(&self) -> Vec<String> {
        let own = |w: &Wanted| {
            let id = w.term.info().id;
            w.term.info().parameters.iter().map(move |p| format!("{id}.{}", p.name)).collect::<Vec<_>>()
        };
        leg_names().into_iter().chain(self.terms.iter().flat_map(own)).collect()
    }

    fn inform(&self, pose: &Pose, information: &mut DMatrix<f64>) -> Result<(), DesignError> {
        let read: Vec<(&Setting, usize)> =
            self.settings.iter().zip(self.counts.iter().copied()).filter(|(_, count)| *count > 0).collect();
        if read.is_empty() {
            return Ok(());
        }
        let taken = self.to_be_read(read.iter().map(|(s, _)| reading(*pose, s)).collect())?;
        let mut rows = self.rows_of(&taken)?;
        let height = rows.nrows() / read.len();
        for (k, (_, count)) in read.iter().enumerate() {
            rows.rows_mut(height * k, height).scale_mut((*count as f64).sqrt());
        }
        information.gemm_tr(1.0, &rows, &rows, 1.0);
        Ok(())
    }

    /// By central differences: terms state no derivative by the pose.
    fn slopes(&self, pose: &Pose, g: &DMatrix<f64>) -> Result<[f64; 6], DesignError> {
        const STEP: f64 = 1e-6;
        let n = self.width();
        let along = |k: usize, step: f64| -> Result<f64, DesignError> {
            let mut x = pose.to_array();
            x[k] += step;
            let mut information = DMatrix::zeros(n, n);
            self.inform(&Pose::from_array(x), &mut information)?;
            Ok(g.dot(&information))
        };
        let mut slopes = [0.0; 6];
        for (k, slope) in slopes.iter_mut().enumerate() {
            *slope = (along(k, STEP)? - along(k, -STEP)?) / (2.0 * STEP);
        }
        Ok(slopes)
    }

    /// By central differences: terms state no derivative by the load.
    fn load_slope(&self, pose: &Pose, g: &DMatrix<f64>, directions: &[Vector6]) -> Result<f64, DesignError> {
        const STEP: f64 = 1e-4;
        let n = self.width();
        let along = |share: f64| -> Result<f64, DesignError> {
            let moved = |(setting, direction): (&Setting, &Vector6)| {
                let load = setting.loading.load.to_vector() + direction * share;
                Setting {
                    loading: Loading { load: Wrench::from_array(load.into()), ..setting.loading },
                    ..*setting
                }
            };
            let settings: Vec<Setting> = self.settings.iter().zip(directions).map(moved).collect();
            let mut information = DMatrix::zeros(n, n);
            self.under(&settings).inform(pose, &mut information)?;
            Ok(g.dot(&information))
        };
        Ok((along(STEP)? - along(-STEP)?) / (2.0 * STEP))
    }

    fn under(&self, settings: &[Setting]) -> Self {
        Self { settings: settings.to_vec(), ..self.clone() }
    }
}

impl SettingRegressor for ModelRegressor<'_> {
    fn each(&self, pose: &Pose) -> Result<Vec<DMatrix<f64>>, DesignError> {
        let read = self.to_be_read(self.readings(pose))?;
        Ok(read.informations(&self.rows_of(&read)?))
    }

    fn repeated(&self, counts: &[usize]) -> Self {
        Self { counts: counts.to_vec(), ..self.clone() }
    }
}
