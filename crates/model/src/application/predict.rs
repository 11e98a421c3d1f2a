//! What a fitted model says of poses and loads nobody has measured, with its uncertainty.
//!
//! The model refers to the measured pose (forces are taken where they act, legs where they stand), which a prediction
//! does not have; so the reading is found by iteration: `y <- y - (y - prediction(y))`, which contracts by about
//! load / (stiffness * leg length) per round. In absolute mode the same iteration is a Newton search for the platform
//! pose at which the legs of the calibrated machine have their commanded lengths plus elongations. It starts at the
//! commanded pose and finds the solution near it; a hexapod has others, and none is claimed to be the only one.
//!
//! Sensors look at the same two states as in the fit of a campaign that they have read: where the structure lets the platform stand,
//! whatever is read; nothing is iterated.

use std::ops::Add;

use hexbench_core::{Columns, Dataset, Matrix6, Measurand, Observation};
use nalgebra::DMatrix;
use thiserror::Error;

use crate::application::model_file::Model;
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::fit::columns;
use crate::estimation::frames::Frames;
use crate::estimation::linearization::Linearization;
use crate::estimation::noise::Noise;
use crate::estimation::parameters::ParameterPlace;
use crate::estimation::tolerances::{InputKind, input_columns};

/// Rounds after which a prediction counts as not settled.
const MOST_ROUNDS: usize = 60;
/// A prediction has settled when no value moves by more than this, m and rad.
const SETTLED: f64 = 1e-13;

/// What a model predicts for one row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prediction {
    /// Loaded minus reference, or the absolute pose; m and rad, in the measured coordinates of the model.
    pub value: [f64; 6],
    /// Standard uncertainty (k = 1) from the covariance of the model and the tolerances of joints and loads, of absolute poses in turned
    /// frames along the axes of [`ReadingAxes`](crate::estimation::frames::ReadingAxes); the noise of a future reading is not in it.
    pub sigma: [f64; 6],
}

/// What a model predicts for one number of a sensor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SensorPrediction {
    /// Loaded minus reference, m or rad.
    pub value: f64,
    /// Standard uncertainty (k = 1) from the covariance of the model and the tolerances of joints and loads, m or rad; the noise of a
    /// future reading is not in it.
    pub sigma: f64,
}

/// What the sensors read in a row, and the covariance of these numbers (m, rad).
pub type WithCovariance = (Vec<SensorPrediction>, DMatrix<f64>);

/// A row that cannot be predicted.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("line {line}: {cause}")]
pub struct PredictError {
    /// Line of the file.
    pub line: u64,
    /// Why.
    pub cause: ModelError,
}

/// Predict every row; measured values are ignored.
///
/// # Errors
/// [`PredictError`] with the first row that is singular or does not settle.
pub fn predict(model: &Model, rows: &[Observation]) -> Result<Vec<Prediction>, PredictError> {
    Ok(predict_with_covariance(model, rows)?.into_iter().map(|(reading, _)| reading).collect())
}

/// The same with the covariance of each row (m, rad), whose diagonal is the square of `sigma`.
///
/// # Errors
/// As [`predict`].
pub fn predict_with_covariance(
    model: &Model,
    rows: &[Observation],
) -> Result<Vec<(Prediction, Matrix6)>, PredictError> {
    predict_as(model, rows, model.measurand, Uncertain::Reading)
}

/// Predict what every sensor of the machine reads in every row: the numbers of [`Model::sensor_channels`], in their order.
///
/// # Errors
/// As [`predict`].
pub fn predict_sensors(
    model: &Model,
    rows: &[Observation],
) -> Result<Vec<Vec<SensorPrediction>>, PredictError> {
    Ok(predict_sensors_with_covariance(model, rows)?.into_iter().map(|(readings, _)| readings).collect())
}

/// The same with the covariance of all numbers of each row (m, rad), whose diagonal is the square of `sigma`.
///
/// # Errors
/// As [`predict`].
pub fn predict_sensors_with_covariance(
    model: &Model,
    rows: &[Observation],
) -> Result<Vec<WithCovariance>, PredictError> {
    let channels = model.sensor_channels().len();
    if channels == 0 {
        return Ok(vec![(Vec::new(), DMatrix::zeros(0, 0)); rows.len()]);
    }
    let asked = |rows: &[Observation]| {
        Dataset::of_poses("", model.measurand, Columns::default(), rows.to_vec())
            .to_be_read_by(&model.hexapod.sensors)
    };
    let answers = answered(model, rows, Uncertain::Reading, asked)?;
    let covariance = kept_covariance(model, Uncertain::Reading);
    let of_row = |blocks: &[Answer]| {
        let all = |of: fn(&Answer) -> &DMatrix<f64>| {
            DMatrix::from_fn(channels, of(&blocks[0]).ncols(), |n, p| of(&blocks[n / 6])[(n % 6, p)])
        };
        let (reader, inputs) = (all(|block| &block.reader), all(|block| &block.inputs));
        let spread = spread(&reader, &covariance, &inputs);
        let values = blocks.iter().flat_map(|block| block.value).take(channels);
        let number = |(k, value)| SensorPrediction { value, sigma: deviation(&spread, k) };
        (values.enumerate().map(number).collect(), spread)
    };
    Ok(answers.chunks(channels.div_ceil(6)).map(of_row).collect())
}

/// Which uncertainty is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Uncertain {
    /// Of the reading: everything.
    Reading,
    /// Of the platform: without effects of the metrology. Frames stay, because only together with them is a geometry
    /// determined: what is meant is the pose as an instrument would find it, in the axes of the machine.
    Platform,
    /// The same by the parameters alone: of what the platform does under loads that are exact.
    Parameters,
}

/// Predict in other coordinates than those of the model's data (deflections only).
pub(crate) fn predict_as(
    model: &Model,
    rows: &[Observation],
    measurand: Measurand,
    uncertain: Uncertain,
) -> Result<Vec<(Prediction, Matrix6)>, PredictError> {
    let answers = predict_with_slopes(model, rows, measurand, uncertain)?;
    let covariance = kept_covariance(model, uncertain);
    Ok(answers.iter().map(|answer| answer.with_covariance(&covariance)).collect())
}

/// The same with the slope of each number in every parameter whose uncertainty counts.
pub(crate) fn predict_with_slopes(
    model: &Model,
    rows: &[Observation],
    measurand: Measurand,
    uncertain: Uncertain,
) -> Result<Vec<Answer>, PredictError> {
    answered(model, rows, uncertain, |rows| poses(model, rows, measurand))
}

/// Six predicted numbers, and what a unit of each parameter whose uncertainty counts does to them.
#[derive(Debug, Clone)]
pub(crate) struct Answer {
    pub(crate) value: [f64; 6],
    /// Six rows, a column for each of [`kept_covariance`].
    pub(crate) reader: DMatrix<f64>,
    /// Six rows, a column for each input that is known to a tolerance only, times its standard deviation.
    pub(crate) inputs: DMatrix<f64>,
}

impl Answer {
    /// The numbers with their covariance by the parameters and, apart from them, by the inputs: other loads are applied than those that the
    /// model was fitted to.
    pub(crate) fn with_covariance(&self, covariance: &DMatrix<f64>) -> (Prediction, Matrix6) {
        let spread = spread(&self.reader, covariance, &self.inputs);
        let sigma = std::array::from_fn(|k| deviation(&spread, k));
        (Prediction { value: self.value, sigma }, Matrix6::from_fn(|i, j| spread[(i, j)]))
    }
}

/// Covariance of numbers by the parameters that they hang on, and by the inputs apart from them.
fn spread(reader: &DMatrix<f64>, covariance: &DMatrix<f64>, inputs: &DMatrix<f64>) -> DMatrix<f64> {
    reader * covariance * reader.transpose() + inputs * inputs.transpose()
}

/// Two motions one after the other.
impl Add for Answer {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            value: std::array::from_fn(|k| self.value[k] + other.value[k]),
            reader: self.reader + other.reader,
            inputs: self.inputs + other.inputs,
        }
    }
}

fn deviation(spread: &DMatrix<f64>, k: usize) -> f64 {
    spread[(k, k)].max(0.0).sqrt()
}

/// Predict what is asked of rows; a row makes as many predictions, six numbers each, as it makes observations.
fn answered(
    model: &Model,
    rows: &[Observation],
    uncertain: Uncertain,
    asked: impl Fn(&[Observation]) -> Dataset,
) -> Result<Vec<Answer>, PredictError> {
    if rows.is_empty() {
        return Ok(Vec::new());
    }
    settle(model, asked(rows), uncertain).or_else(|_| {
        // Something is wrong with some row: one by one, to name it.
        let one = |row: &Observation| {
            let found = settle(model, asked(std::slice::from_ref(row)), uncertain);
            found.map_err(|cause| PredictError { line: row.line, cause })
        };
        Ok(rows.iter().map(one).collect::<Result<Vec<_>, _>>()?.concat())
    })
}

/// Moves the readings of a dataset until they are what the model predicts.
fn settle(model: &Model, mut data: Dataset, uncertain: Uncertain) -> Result<Vec<Answer>, ModelError> {
    let mut last_step = f64::INFINITY;
    for _ in 0..MOST_ROUNDS {
        let campaign =
            Campaign::in_frames(&model.hexapod, &data, unit_noise(), frames(model, data.measurand))?;
        let lin = Linearization::at(&campaign, &model.point)?;
        last_step = 0.0;
        for (i, group) in campaign.groups.iter().enumerate() {
            let step = lin.conditions[i].weights.numbers(lin.residual(i));
            if !step.iter().all(|x| x.is_finite()) {
                return Err(ModelError::NotFinite { what: "the prediction" });
            }
            last_step = last_step.max(step.amax());
            for &row in &group.rows {
                let measured = &mut data.observations[row as usize].measured;
                *measured = campaign.axes.moved(measured, &std::array::from_fn(|k| -step[k]));
            }
        }
        if last_step < SETTLED {
            return answers(model, &campaign, &lin, &data, uncertain);
        }
    }
    Err(ModelError::NotConverged { iterations: MOST_ROUNDS, last_step })
}

/// Rows of full poses with a first guess in the place of the measurement.
fn poses(model: &Model, rows: &[Observation], measurand: Measurand) -> Dataset {
    let machine = model.point.calibrated_machine();
    let guess = |o: &Observation| match measurand {
        Measurand::AbsolutePose => machine.target_pose(&o.pose).to_array(),
        _ => [0.0; 6],
    };
    let observations =
        rows.iter().map(|o| Observation { measured: guess(o), sigma: None, block: 0, ..*o }).collect();
    Dataset::of_poses("", measurand, Columns::default(), observations)
}

/// Frames in which a prediction is read.
fn frames(model: &Model, measurand: Measurand) -> Frames {
    if measurand == Measurand::AbsolutePose { Frames::of(&model.point.machine) } else { Frames::default() }
}

/// Weights of one; the level does not matter for a prediction.
fn unit_noise() -> Noise {
    Noise::stated(1.0, 1.0)
}

/// What the inputs do that are known to a tolerance only, a standard deviation of each: of the platform without the axes of the readings,
/// and without joints where those of the model were found by calibration.
fn inputs(model: &Model, campaign: &Campaign, uncertain: Uncertain) -> Result<DMatrix<f64>, ModelError> {
    if uncertain == Uncertain::Parameters {
        return Ok(DMatrix::zeros(6 * campaign.groups.len(), 0));
    }
    let mut columns = input_columns(campaign, &model.point, &model.hexapod.tolerances)?;
    if uncertain == Uncertain::Platform {
        columns.columns_range_mut(InputKind::Frame.columns()).fill(0.0);
    }
    if campaign.is_absolute() {
        columns.columns_range_mut(InputKind::Joints.columns()).fill(0.0);
    }
    Ok(columns)
}

fn answers(
    model: &Model,
    campaign: &Campaign,
    lin: &Linearization,
    data: &Dataset,
    uncertain: Uncertain,
) -> Result<Vec<Answer>, ModelError> {
    let jacobian = columns(lin, &model.point).select_columns(&kept_columns(model, uncertain));
    let of_inputs = inputs(model, campaign, uncertain)?;
    let nothing = Answer { value: [0.0; 6], reader: DMatrix::zeros(0, 0), inputs: DMatrix::zeros(0, 0) };
    let mut all = vec![nothing; data.observations.len()];
    for (i, group) in campaign.groups.iter().enumerate() {
        let numbers = |columns: &DMatrix<f64>| {
            let mut rows = columns.rows(6 * i, 6).into_owned();
            for mut column in rows.column_iter_mut() {
                let weighted = column.fixed_rows::<6>(0).into_owned();
                column.copy_from(&lin.conditions[i].weights.numbers(weighted));
            }
            rows
        };
        let (reader, inputs) = (numbers(&jacobian), numbers(&of_inputs));
        for &row in &group.rows {
            let value = data.observations[row as usize].measured;
            all[row as usize] = Answer { value, reader: reader.clone(), inputs: inputs.clone() };
        }
    }
    Ok(all)
}

/// Covariance of the parameters whose uncertainty counts.
pub(crate) fn kept_covariance(model: &Model, uncertain: Uncertain) -> DMatrix<f64> {
    let kept = kept_columns(model, uncertain);
    model.covariance.select_columns(&kept).select_rows(&kept)
}

fn kept_columns(model: &Model, uncertain: Uncertain) -> Vec<usize> {
    let all = 0..model.covariance.ncols();
    if uncertain == Uncertain::Reading {
        return all.collect();
    }
    let of_metrology = |k: &usize| match model.parameters[*k].place {
        ParameterPlace::Value { term, .. } | ParameterPlace::Shape { term } => {
            model.point.active[term].term.is_of_metrology()
        }
        ParameterPlace::Spring(_) | ParameterPlace::Frames(_) => false,
    };
    all.filter(|k| !of_metrology(k)).collect()
}
