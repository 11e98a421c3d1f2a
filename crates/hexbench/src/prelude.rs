//! What nearly every program needs: `use hexbench::prelude::*;`.

pub use hexbench_core::files::{read_conditions, read_hexapod, read_measurements};
pub use hexbench_core::{Dataset, Hexapod, Observation, Pose, Wrench};
pub use hexbench_model::application::model_file::{DataOrigin, Estimator, Model};
pub use hexbench_model::application::predict::{Prediction, SensorPrediction, predict, predict_sensors};
pub use hexbench_model::effects::term::Term;
pub use hexbench_model::estimation::campaign::Campaign;
pub use hexbench_model::estimation::estimate::{Estimate, estimates};
pub use hexbench_model::estimation::fit::Fit;
pub use hexbench_model::estimation::fit_named::Added;
pub use hexbench_model::inference::selection::{FitWithErrors, JudgedTask};
pub use hexbench_model::inference::verdict::Verdict;
pub use hexbench_model::results::diagnose::{
    DiagnoseOptions, Diagnosis, DiagnosisStudy, diagnose, diagnose_with, prepare,
};
pub use hexbench_model::terms::catalogue;
