//! What nearly every program needs: `use hexbench::prelude::*;`.

pub use hexbench_core::files::{read_conditions, read_hexapod, read_measurements};
pub use hexbench_core::{Dataset, Hexapod, Observation, Pose, Wrench};
pub use hexbench_model::campaign::Campaign;
pub use hexbench_model::diagnose::{Diagnosis, DiagnosisStudy, diagnose, prepare};
pub use hexbench_model::estimate::{Estimate, estimates};
pub use hexbench_model::fit::Fit;
pub use hexbench_model::fit_named::Added;
pub use hexbench_model::model_file::{DataOrigin, Estimator, Model};
pub use hexbench_model::predict::{Prediction, predict};
pub use hexbench_model::selection::{FitWithErrors, JudgedTask};
pub use hexbench_model::term::Term;
pub use hexbench_model::terms::catalogue;
pub use hexbench_model::verdict::Verdict;
