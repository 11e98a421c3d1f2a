//! The files of an answer.

use std::io;
use std::path::Path;

use hexbench_core::Measurand;
use hexbench_core::files::{CsvText, atomic_write};
use serde::Serialize;

use super::methods::Answer;
use super::{AnswerError, CaseFiles};
use crate::application::predict::Prediction;
use crate::estimation::estimate::Estimate;

#[derive(Serialize)]
struct Parameters<'a> {
    format: &'static str,
    parameters: Vec<Number<'a>>,
}

#[derive(Serialize)]
struct Number<'a> {
    name: &'a str,
    value: f64,
    std: Option<f64>,
    unit: &'a str,
}

/// Writes `parameters.json`, `predictions.csv` and, when there is a diagnosis, `diagnosis.json`.
pub(crate) fn answer(out: &Path, case: &CaseFiles, answer: &Answer) -> Result<(), AnswerError> {
    let number = |e: &'_ Estimate| (e.std > 0.0).then_some(e.std);
    let parameters = answer
        .parameters
        .iter()
        .map(|e| Number { name: &e.name, value: e.value, std: number(e), unit: &e.unit })
        .collect();
    json(&out.join("parameters.json"), &Parameters { format: "parameters/1", parameters })?;
    let table = predictions(&answer.predictions, case.predicted());
    text(&out.join("predictions.csv"), &table)?;
    answer.diagnosis.as_ref().map_or(Ok(()), |d| json(&out.join("diagnosis.json"), d))
}

/// Deflections in um and urad, poses in mm and deg, uncertainties in um and urad; every digit that is needed.
fn predictions(rows: &[Prediction], measurand: Measurand) -> String {
    let (values, sigmas) = columns(measurand);
    let header = values.split(',').chain(sigmas.split(','));
    let mut table = CsvText::new(std::iter::once("row").chain(header));
    let unit = |k: usize, value: f64| match (measurand, k < 3) {
        (Measurand::AbsolutePose, true) => value * 1e3,
        (Measurand::AbsolutePose, false) => value.to_degrees(),
        _ => value * 1e6,
    };
    for (number, row) in (1..).zip(rows) {
        let values = row.value.iter().enumerate().map(|(k, value)| unit(k, *value).to_string());
        let sigmas = row.sigma.iter().map(|sigma| (sigma * 1e6).max(LEAST_SIGMA).to_string());
        table.row(std::iter::once(u64::to_string(&number)).chain(values).chain(sigmas));
    }
    table.into_text()
}

/// A row whose reading the model fixes at zero still has an uncertainty above it, um and urad.
const LEAST_SIGMA: f64 = 1e-9;

fn columns(measurand: Measurand) -> (&'static str, &'static str) {
    match measurand {
        Measurand::DeflectionEuler => (
            "da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad",
            "sigma_da_um,sigma_db_um,sigma_dc_um,sigma_dalpha_urad,sigma_dbeta_urad,sigma_dgamma_urad",
        ),
        Measurand::DeflectionRotationVector => (
            "da_um,db_um,dc_um,drx_urad,dry_urad,drz_urad",
            "sigma_da_um,sigma_db_um,sigma_dc_um,sigma_drx_urad,sigma_dry_urad,sigma_drz_urad",
        ),
        Measurand::AbsolutePose => (
            "predicted_a_mm,predicted_b_mm,predicted_c_mm,predicted_alpha_deg,predicted_beta_deg,predicted_gamma_deg",
            "sigma_a_um,sigma_b_um,sigma_c_um,sigma_alpha_urad,sigma_beta_urad,sigma_gamma_urad",
        ),
    }
}

fn json(path: &Path, value: &impl Serialize) -> Result<(), AnswerError> {
    let written = serde_json::to_string_pretty(value).map_err(io::Error::other);
    let whole = written.map_err(|cause| AnswerError::Write { path: path.to_owned(), cause })? + "\n";
    text(path, &whole)
}

fn text(path: &Path, whole: &str) -> Result<(), AnswerError> {
    atomic_write(path, |out| out.write_all(whole.as_bytes()))
        .map_err(|cause| AnswerError::Write { path: path.to_owned(), cause })
}
