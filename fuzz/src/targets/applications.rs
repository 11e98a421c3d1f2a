//! A campaign that is fitted, a model that predicts.

use hexbench_core::files::read_measurements_from;
use hexbench_core::{Observation, Pose, Wrench};
use hexbench_model::application::model_file::Model;
use hexbench_model::application::predict::predict;
use hexbench_model::estimation::fit::fit_baseline;
use hexbench_model::results::diagnose::prepare;

use super::machines::bundled;

/// Readings fitted at most: an input should take milliseconds.
const MOST_READINGS: usize = 60;

/// Six springs are fitted to what is read, or there is a reason why not.
pub(super) fn campaign(bytes: &[u8]) -> bool {
    let Ok(read) = read_measurements_from(bytes, "measurements.csv") else { return false };
    if read.dataset.observations.len() > MOST_READINGS {
        return false;
    }
    let Ok(campaign) = prepare(&bundled(), &read.dataset) else { return false };
    let Ok(fit) = fit_baseline(&campaign) else { return false };
    assert!(fit.chi2.is_finite() && fit.point.compliances.iter().all(|c| c.is_finite()), "{fit:?}");
    assert!(fit.covariance.iter().all(|x| x.is_finite()), "{fit:?}");
    true
}

/// A model that is accepted is written and read again, and predicts a number or says why not.
pub(super) fn model(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    let Ok(model) = Model::from_changed_toml(text) else { return false };
    let written = model.to_toml().unwrap_or_else(|e| panic!("{e}"));
    Model::from_toml(&written).unwrap_or_else(|e| panic!("{e}\n{written}"));
    let load = Wrench::from_array([10.0, 20.0, -300.0, 1.0, 2.0, 3.0]);
    let row = Observation::unread(Pose::default(), load, Wrench::default());
    let Ok(predicted) = predict(&model, &[row]) else { return false };
    let numbers = predicted.iter().flat_map(|p| p.value.into_iter().chain(p.sigma));
    assert!(numbers.into_iter().all(f64::is_finite), "{predicted:?}");
    true
}
