//! One case of one program in numbers.

use hexbench_core::statistics::{COVERAGE_FACTOR, Proportion, root_mean_square};
use hexbench_model::estimation::parameters::stiffness_name;

use crate::trial::{Outcome, outcome_of};
use hexbench_core::Measurand;
use serde::Serialize;

use super::effects::effect_numbers;
use super::forecast::Forecast;
use super::key::AnswerKey;
use super::proper::ProperScore;
use crate::challenge::answer::{CaseAnswer, Number, Predicted, StatedDiagnosis};

/// One case of one program in numbers; what it does not say is absent.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct CaseScore {
    /// Id of the case.
    pub id: String,
    /// Group of the suite.
    pub group: String,
    /// Hidden effects.
    pub effects: Vec<String>,
    /// Length of the signature of the hidden effects in standard deviations of the noise.
    pub distance: f64,
    /// Why there is no answer.
    pub failure: Option<String>,
    /// Stiffness of each leg.
    pub legs: [Option<LegScore>; 6],
    /// Proper scores of the stiffnesses of all six legs, in true stiffnesses.
    pub stiffness: Option<ProperScore>,
    /// Proper scores of the numbers of all hidden effects, in the size of these numbers.
    pub effect_numbers: Option<ProperScore>,
    /// Predictions of held-out readings.
    pub prediction: Option<PredictionScore>,
    /// `right`, `honest` or `wrong`.
    pub outcome: Option<&'static str>,
    /// Largest stated probability.
    pub confidence: Option<f64>,
    /// Scores of the stated probabilities; only where at most one thing is hidden.
    pub forecast: Option<Forecast>,
    /// Wall time, s.
    pub wall_s: Option<f64>,
    /// Peak memory, MB.
    #[serde(rename = "peak_memory_MB")]
    pub peak_memory_mb: Option<f64>,
}

/// Stiffness of one leg against the true one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LegScore {
    /// Stated over true, minus one.
    pub relative_error: f64,
    /// Error in stated standard uncertainties.
    pub z: Option<f64>,
    /// Proper scores, in true stiffnesses.
    pub proper: ProperScore,
}

/// Predictions of held-out readings.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PredictionScore {
    /// Mean square of prediction minus reading, in standard deviations of one reading; 1 is noise.
    pub chi2_reduced: f64,
    /// Root mean square of prediction minus truth, in standard deviations of one reading; 0 is perfect.
    pub error_in_noise: f64,
    /// Root mean square of prediction minus truth, translations.
    pub rms_um: f64,
    /// Root mean square of prediction minus truth, rotations.
    pub rms_urad: f64,
    /// Stated 95 % intervals that hold the truth.
    pub covered: Option<Proportion>,
    /// Root mean square of the errors in stated standard uncertainties; 1 is honest.
    pub z: Option<f64>,
    /// Proper scores, in standard deviations of one reading.
    pub proper: ProperScore,
}

impl CaseScore {
    /// A case without answer.
    pub(super) fn failed(key: &AnswerKey, why: String) -> Self {
        Self {
            id: key.truth.id.clone(),
            group: key.truth.group.clone(),
            effects: key.truth.effects.clone(),
            distance: key.truth.distance,
            failure: Some(why),
            ..Self::default()
        }
    }

    /// Compares an answer with the truth.
    pub fn of(key: &AnswerKey, answer: &CaseAnswer) -> Self {
        let legs = std::array::from_fn(|leg| leg_score(key, &answer.parameters, leg));
        let stated = answer.said.iter().flat_map(|said| &said.candidates).map(|c| c.probability);
        Self {
            failure: None,
            legs,
            stiffness: of_all_legs(&legs),
            effect_numbers: effect_numbers(key, &answer.parameters),
            confidence: stated.reduce(f64::max),
            prediction: Some(prediction_score(key, &answer.predictions)),
            outcome: answer.said.as_ref().map(|said| outcome(key, said).word()),
            forecast: answer
                .said
                .as_ref()
                .and_then(|said| Forecast::of(&key.truth.effects, &said.candidates)),
            ..Self::failed(key, String::new())
        }
    }

    /// Root mean square of the relative errors of the legs stated.
    pub fn stiffness_error(&self) -> Option<f64> {
        root_mean_square(self.legs.iter().flatten().map(|l| l.relative_error))
    }

    /// Root mean square error of the legs in stated standard uncertainties.
    pub fn stiffness_z(&self) -> Option<f64> {
        root_mean_square(self.legs.iter().flatten().filter_map(|l| l.z))
    }
}

/// Of six legs or none: whoever states the easy legs alone has no score.
fn of_all_legs(legs: &[Option<LegScore>; 6]) -> Option<ProperScore> {
    let all: Option<Vec<ProperScore>> = legs.iter().map(|leg| leg.map(|l| l.proper)).collect();
    ProperScore::mean(&all?)
}

fn leg_score(key: &AnswerKey, numbers: &[Number], leg: usize) -> Option<LegScore> {
    let name = stiffness_name(leg);
    let stated = numbers.iter().find(|n| n.name == name)?;
    let true_stiffness = key.truth.leg_stiffness_n_per_um[leg];
    let error = stated.value - true_stiffness;
    Some(LegScore {
        relative_error: error / true_stiffness,
        z: stated.std.map(|std| error / std),
        proper: ProperScore::of(error, stated.std).times(true_stiffness.recip()),
    })
}

fn prediction_score(key: &AnswerKey, predictions: &[Predicted]) -> PredictionScore {
    let sigma = key.truth.noise.sigma();
    let (mut of_reading, mut of_truth, mut squares) = (0.0, 0.0, [0.0; 2]);
    let (mut covered, mut z, mut proper) = (Proportion::default(), Vec::new(), Vec::new());
    for (p, (measured, truth)) in predictions.iter().zip(key.measured.iter().zip(&key.true_readings)) {
        for k in 0..6 {
            let error = difference(key.measurand, k, p.value[k], truth[k]);
            of_reading += (difference(key.measurand, k, p.value[k], measured[k]) / sigma[k]).powi(2);
            of_truth += (error / sigma[k]).powi(2);
            squares[k / 3] += error.powi(2);
            let stated = p.sigma.map(|stated| stated[k]);
            proper.push(ProperScore::of(error, stated).times(sigma[k].recip()));
            if let Some(stated) = stated {
                covered.of += 1;
                covered.hits += usize::from(error.abs() <= COVERAGE_FACTOR * stated);
                z.push(error / stated);
            }
        }
    }
    let numbers = (6 * predictions.len()) as f64;
    let rms = squares.map(|s| (s / (0.5 * numbers)).sqrt() * 1e6);
    PredictionScore {
        chi2_reduced: of_reading / numbers,
        error_in_noise: (of_truth / numbers).sqrt(),
        rms_um: rms[0],
        rms_urad: rms[1],
        covered: (covered.of > 0).then_some(covered),
        z: root_mean_square(z),
        proper: ProperScore::mean(&proper).unwrap_or(ProperScore { crps: 0.0, interval: None }),
    }
}

/// Prediction minus value; angles of poses the short way round.
fn difference(measurand: Measurand, k: usize, predicted: f64, value: f64) -> f64 {
    let plain = predicted - value;
    if measurand == Measurand::AbsolutePose && k >= 3 { plain.sin().atan2(plain.cos()) } else { plain }
}

fn outcome(key: &AnswerKey, said: &StatedDiagnosis) -> Outcome {
    let hidden: Vec<&str> = key.truth.effects.iter().map(String::as_str).collect();
    outcome_of(&hidden, said.verdict, &said.added, &said.credible_set)
}
