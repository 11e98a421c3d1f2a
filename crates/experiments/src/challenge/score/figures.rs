//! Figures over some cases of one program.

use hexbench_core::statistics::{self, COVERAGE_FACTOR, Proportion, median, root_mean_square};
use serde::Serialize;
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::case::CaseScore;

/// A share with its exact binomial 95 % bounds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Interval {
    /// How often it held.
    pub hits: usize,
    /// Of how many.
    pub of: usize,
    /// Clopper and Pearson; the numbers of one case are not independent, so the truth is somewhat wider.
    pub bounds: [f64; 2],
}

/// A mean and its standard error over cases.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Mean {
    /// Mean.
    pub mean: f64,
    /// Standard error; absent for a single case.
    pub standard_error: Option<f64>,
    /// Cases.
    pub of: usize,
}

impl Mean {
    /// Its 95 % interval by Student's t; none for a single case.
    pub(super) fn interval(&self) -> Option<[f64; 2]> {
        let law = StudentsT::new(0.0, 1.0, self.of as f64 - 1.0).ok()?;
        let half = law.inverse_cdf(0.975) * self.standard_error?;
        Some([self.mean - half, self.mean + half])
    }
}

/// Figures over some cases; absent where nothing is stated.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Figures {
    /// Cases.
    pub cases: usize,
    /// Cases with an answer that could be read.
    pub answered: usize,
    /// Median over cases of the root mean square relative error of the leg stiffnesses.
    pub stiffness_error: Option<f64>,
    /// Root mean square error of leg stiffnesses in stated standard uncertainties; 1 is honest.
    pub stiffness_z: Option<f64>,
    /// Stated 95 % intervals that hold the true stiffness.
    pub stiffness_covered: Option<Interval>,
    /// CRPS of the stiffnesses, in true stiffnesses.
    pub stiffness_crps: Option<Mean>,
    /// Interval score of the stiffnesses, in true stiffnesses.
    pub stiffness_interval: Option<Mean>,
    /// CRPS of the numbers of hidden effects, in their size.
    pub effects_crps: Option<Mean>,
    /// Interval score of the numbers of hidden effects, in their size.
    pub effects_interval: Option<Mean>,
    /// Median over cases of chi-square against the readings, per number.
    pub chi2_reduced: Option<f64>,
    /// Median over cases of the error against the truth, in noise.
    pub error_in_noise: Option<f64>,
    /// Median over cases of the error of translations.
    pub rms_um: Option<f64>,
    /// Median over cases of the error of rotations.
    pub rms_urad: Option<f64>,
    /// Stated 95 % intervals that hold the true reading.
    pub predictions_covered: Option<Interval>,
    /// CRPS of the predictions, in standard deviations of one reading.
    pub predictions_crps: Option<Mean>,
    /// Interval score of the predictions, in standard deviations of one reading.
    pub predictions_interval: Option<Mean>,
    /// Cases with a diagnosis that is right, honest, wrong.
    pub outcomes: Option<[usize; 3]>,
    /// The same as shares of the cases with a diagnosis, with their bounds.
    pub outcome_shares: Option<[Interval; 3]>,
    /// Logarithmic score of stated probabilities, nats.
    pub log: Option<Mean>,
    /// Brier score of stated probabilities.
    pub brier: Option<Mean>,
    /// Median wall time of a case, s.
    pub wall_s: Option<f64>,
    /// Longest wall time of a case, s.
    pub longest_s: Option<f64>,
    /// Most memory of a case, MB.
    #[serde(rename = "peak_memory_MB")]
    pub peak_memory_mb: Option<f64>,
}

impl Figures {
    /// Figures over cases.
    pub fn of<'a>(cases: impl IntoIterator<Item = &'a CaseScore>) -> Self {
        let cases: Vec<&CaseScore> = cases.into_iter().collect();
        let of =
            |f: &dyn Fn(&CaseScore) -> Option<f64>| cases.iter().filter_map(|c| f(c)).collect::<Vec<f64>>();
        let prediction =
            |f: fn(&super::PredictionScore) -> f64| median(of(&|c| c.prediction.as_ref().map(f)));
        let z: Vec<f64> = cases.iter().flat_map(|c| c.legs.iter().flatten().filter_map(|l| l.z)).collect();
        let within = Proportion::count(&z, |z| z.abs() <= COVERAGE_FACTOR);
        let predicted = cases.iter().filter_map(|c| c.prediction.as_ref()?.covered);
        let most = |values: Vec<f64>| values.into_iter().reduce(f64::max);
        Self {
            cases: cases.len(),
            answered: cases.iter().filter(|c| c.failure.is_none()).count(),
            stiffness_error: median(of(&CaseScore::stiffness_error)),
            stiffness_z: root_mean_square(z.iter().copied()),
            stiffness_covered: interval(within),
            stiffness_crps: mean(&of(&|c| c.stiffness.map(|s| s.crps))),
            stiffness_interval: mean(&of(&|c| c.stiffness?.interval)),
            effects_crps: mean(&of(&|c| c.effect_numbers.map(|s| s.crps))),
            effects_interval: mean(&of(&|c| c.effect_numbers?.interval)),
            chi2_reduced: prediction(|p| p.chi2_reduced),
            error_in_noise: prediction(|p| p.error_in_noise),
            rms_um: prediction(|p| p.rms_um),
            rms_urad: prediction(|p| p.rms_urad),
            predictions_covered: interval(predicted.sum()),
            predictions_crps: mean(&of(&|c| c.prediction.map(|p| p.proper.crps))),
            predictions_interval: mean(&of(&|c| c.prediction?.proper.interval)),
            outcomes: outcomes(&cases),
            outcome_shares: outcomes(&cases).and_then(shares),
            log: mean(&of(&|c| c.forecast.map(|f| f.log))),
            brier: mean(&of(&|c| c.forecast.map(|f| f.brier))),
            wall_s: median(of(&|c| c.wall_s)),
            longest_s: most(of(&|c| c.wall_s)),
            peak_memory_mb: most(of(&|c| c.peak_memory_mb)),
        }
    }
}

fn interval(p: Proportion) -> Option<Interval> {
    (p.of > 0).then(|| Interval { hits: p.hits, of: p.of, bounds: p.interval() })
}

fn outcomes(cases: &[&CaseScore]) -> Option<[usize; 3]> {
    let count = |word| cases.iter().filter(|c| c.outcome == Some(word)).count();
    let counts = ["right", "honest", "wrong"].map(count);
    (counts.iter().sum::<usize>() > 0).then_some(counts)
}

fn shares(counts: [usize; 3]) -> Option<[Interval; 3]> {
    let of = counts.iter().sum();
    let [right, honest, wrong] = counts.map(|hits| interval(Proportion { hits, of }));
    Some([right?, honest?, wrong?])
}

/// Mean and standard error.
pub(super) fn mean(values: &[f64]) -> Option<Mean> {
    let all = || values.iter().copied();
    let n = values.len() as f64;
    let standard_error = statistics::standard_deviation(all()).map(|deviation| deviation / n.sqrt());
    statistics::mean(all()).map(|mean| Mean { mean, standard_error, of: values.len() })
}
