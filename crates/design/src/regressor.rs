//! Rows that a pose contributes to the regressor, and how they change with the pose.

mod model;
mod springs;

pub use model::{ModelRegressor, reading};
pub use springs::{SpringRegressor, Weights};

use hexbench_core::{Pose, Vector6};
use hexbench_model::estimation::parameters::stiffness_name;
use nalgebra::DMatrix;

use crate::DesignError;
use crate::space::Setting;

/// Information that all readings of one pose give about the parameters.
pub trait PoseRegressor: Sync {
    /// Number of parameters p.
    fn parameters(&self) -> usize;

    /// Number of inputs r that are known to a tolerance only; their columns follow those of the parameters.
    fn inputs(&self) -> usize {
        0
    }

    /// Rows of an information matrix: p + r.
    fn width(&self) -> usize {
        self.parameters() + self.inputs()
    }

    /// Readings of one pose: the sum of the repeats of all settings.
    fn readings(&self) -> usize;

    /// Names of the parameters.
    fn names(&self) -> Vec<String>;

    /// Adds `J'J` of the pose ((p + r) x (p + r)) to `information`.
    ///
    /// # Errors
    /// A singular pose.
    fn inform(&self, pose: &Pose, information: &mut DMatrix<f64>) -> Result<(), DesignError>;

    /// Derivatives of `trace(G J'J)` by the six pose coordinates (per m and per rad), for a symmetric `G` of the same size.
    ///
    /// # Errors
    /// A singular pose.
    fn slopes(&self, pose: &Pose, g: &DMatrix<f64>) -> Result<[f64; 6], DesignError>;

    /// Derivative of `trace(G J'J)` when the load of each setting changes along its direction (N and N m, fixed axes), one for each
    /// setting.
    ///
    /// # Errors
    /// A singular pose.
    fn load_slope(&self, pose: &Pose, g: &DMatrix<f64>, directions: &[Vector6]) -> Result<f64, DesignError>;

    /// The same readings under other settings, as many as before.
    #[must_use]
    fn under(&self, settings: &[Setting]) -> Self
    where
        Self: Sized;
}

/// A regressor that can tell its settings apart.
pub trait SettingRegressor: PoseRegressor + Sized {
    /// Information of one reading under each setting ((p + r) x (p + r) each).
    ///
    /// # Errors
    /// A singular pose.
    fn each(&self, pose: &Pose) -> Result<Vec<DMatrix<f64>>, DesignError>;

    /// The same settings, each read so many times; zero leaves one out.
    #[must_use]
    fn repeated(&self, counts: &[usize]) -> Self;
}

/// Names of the six leg springs.
fn leg_names() -> Vec<String> {
    (0..6).map(stiffness_name).collect()
}
