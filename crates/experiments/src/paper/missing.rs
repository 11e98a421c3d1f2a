//! The missing effect: what the paper's plan says of it, and what a richer one does.

use hexbench_model::estimation::foreseen::held_out_chance;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::{DiagnosisStudy, diagnose};
use hexbench_model::terms::catalogue;
use hexbench_truth::World;

use super::bench::{Covariates, PaperMachine, richer_plan};
use super::error::PaperError;
use super::experiment::Experiment;

const TRAINING: u64 = 4;
const HOLDOUT: u64 = 5;

/// A diagnosis in the numbers the page needs.
#[derive(Debug, Clone, PartialEq)]
pub struct DiagnosisSummary {
    /// Readings fitted and held out.
    pub readings: [usize; 2],
    /// The verdict.
    pub verdict: Verdict,
    /// Effects named.
    pub added: Vec<String>,
    /// Best candidates with their probabilities.
    pub candidates: Vec<(String, f64)>,
    /// Springs alone, then with each effect more.
    pub steps: Vec<HeldOutError>,
}

/// A model and its held-out error.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldOutError {
    /// Effects beside the springs.
    pub terms: Vec<String>,
    /// Chi-square of the held-out readings per number.
    pub chi2_reduced: f64,
    /// Held-out error, um and urad.
    pub error: [f64; 6],
    /// Chance of held-out errors as large as these if the model is right.
    pub chance: f64,
}

/// Diagnosis of the paper's own readings.
pub(crate) fn on_the_papers_plan(
    bench: &PaperMachine,
    experiment: &Experiment,
) -> Result<DiagnosisSummary, PaperError> {
    finding(bench, &experiment.identification, &experiment.validation)
}

/// Diagnosis of readings by the richer plan.
pub(crate) fn on_the_richer_plan(
    bench: &PaperMachine,
    world: &World,
) -> Result<DiagnosisSummary, PaperError> {
    let [training, holdout] = richer_plan(bench);
    let read = |rows: &[_], source, stream| bench.measure(world, rows, Covariates::All, source, stream);
    let (readings, held_out) = (read(&training, "training", TRAINING)?, read(&holdout, "held out", HOLDOUT)?);
    finding(bench, &readings, &held_out)
}

fn finding(
    bench: &PaperMachine,
    readings: &hexbench_core::Dataset,
    held_out: &hexbench_core::Dataset,
) -> Result<DiagnosisSummary, PaperError> {
    const SHOWN: usize = 3;
    let DiagnosisStudy { diagnosis, fits, campaign, .. } =
        diagnose(&bench.hexapod, readings, Some(held_out), &catalogue())?;
    let mut steps = Vec::new();
    for (report, fit) in diagnosis.steps.iter().zip(&fits) {
        let error = report.holdout.unwrap_or(report.fitted);
        steps.push(HeldOutError {
            terms: report.terms.clone(),
            chi2_reduced: error.chi2_reduced,
            error: error.per_coordinate,
            chance: held_out_chance(&campaign, held_out, fit)?,
        });
    }
    let best = diagnosis.candidates.iter().take(SHOWN);
    Ok(DiagnosisSummary {
        readings: [readings.observations.len(), held_out.observations.len()],
        verdict: diagnosis.verdict,
        added: diagnosis.added,
        candidates: best.map(|c| (c.term.to_string(), c.probability)).collect(),
        steps,
    })
}
