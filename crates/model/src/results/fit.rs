//! A fit of named terms as programs receive it: `fit/1`.

use serde::Serialize;

use super::diagnose::{LegRemainder, NoiseReport};
use super::outliers::{SuspiciousReading, outliers};
use crate::application::model_file::Estimator;
use crate::estimation::estimate::Estimate;
use crate::estimation::fit_named::look_alikes;
use crate::estimation::residuals::ErrorSummary;
use crate::inference::selection::{FitWithErrors, HeldOut, JudgedTask};

/// Correlations larger than this are reported.
pub const REPORTED_CORRELATION: f64 = 0.7;

/// Result of `fit`.
#[derive(Debug, Clone, Serialize)]
pub struct FitReport {
    /// `fit/1`.
    pub format: &'static str,
    /// Terms beside the springs, in the order in which they were added.
    pub terms: Vec<String>,
    /// Lines of the file that were left out of the fit.
    pub excluded: Vec<u64>,
    /// `gls` or `paper`.
    pub estimator: &'static str,
    /// False where the iteration did not come to rest: numbers are provisional.
    pub settled: bool,
    /// How good it is.
    pub quality: FitQuality,
    /// Noise of one reading.
    pub noise: NoiseReport,
    /// Numbers that the data determine, with standard uncertainties (k = 1).
    pub parameters: Vec<Estimate>,
    /// Names of the others.
    pub not_determined: Vec<String>,
    /// Pairs of numbers that the data tell apart badly.
    pub correlations: Vec<Correlation>,
    /// Error on the readings fitted.
    pub fitted: ErrorSummary,
    /// Error on readings held out; absent where none can be.
    pub held_out: Option<ErrorSummary>,
    /// Which readings those are.
    pub holdout: HeldOut,
    /// Legs in which the fit leaves more than noise.
    pub remainder: Vec<LegRemainder>,
    /// Readings that stand out, which count like all others.
    pub suspects: Vec<SuspiciousReading>,
}

/// Chi-square, degrees of freedom and what follows from them.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct FitQuality {
    /// Readings, before averaging.
    pub readings: usize,
    /// Numbers read in all of them: six each, unless something else was read than full poses.
    pub equations: usize,
    /// Parameters, as many as the readings determine beside what was known before.
    pub effective_parameters: f64,
    /// Sum of squared whitened residuals.
    pub chi2: f64,
    /// Degrees of freedom.
    pub dof: f64,
    /// Their ratio.
    pub chi2_reduced: f64,
    /// Akaike's criterion for Gaussian errors of known size, up to a constant of the data.
    pub aic: f64,
    /// Schwarz's criterion likewise.
    pub bic: f64,
}

/// Correlation of two numbers.
#[derive(Debug, Clone, Serialize)]
pub struct Correlation {
    /// Names of the two.
    pub between: [String; 2],
    /// Coefficient.
    pub r: f64,
}

impl FitQuality {
    /// Of a fit to the readings of a task.
    pub fn of(task: &JudgedTask<'_>, judged: &FitWithErrors) -> Self {
        let (fit, campaign) = (&judged.fit, task.campaign);
        let equations = campaign.numbers;
        let parameters = equations as f64 - fit.dof;
        Self {
            readings: campaign.readings,
            equations,
            effective_parameters: parameters,
            chi2: fit.chi2,
            dof: fit.dof,
            chi2_reduced: fit.chi2_reduced(),
            aic: fit.chi2 + 2.0 * parameters,
            bic: fit.chi2 + parameters * (equations.max(1) as f64).ln(),
        }
    }
}

impl FitReport {
    /// Of a fit to the readings of a task.
    pub fn of(task: &JudgedTask<'_>, judged: &FitWithErrors, estimator: Estimator) -> Self {
        let numbers = judged.estimates();
        let correlation = |(a, b, r)| Correlation { between: [a, b], r };
        Self {
            format: "fit/1",
            terms: judged.fit.point.active.iter().map(|a| a.id().to_owned()).collect(),
            excluded: Vec::new(),
            estimator: estimator.word(),
            settled: judged.fit.is_settled(),
            quality: FitQuality::of(task, judged),
            noise: NoiseReport::of(task.campaign),
            parameters: numbers.determined,
            not_determined: numbers.not_determined,
            correlations: look_alikes(&judged.fit, REPORTED_CORRELATION)
                .into_iter()
                .map(correlation)
                .collect(),
            fitted: judged.fitted,
            held_out: judged.held_out.as_ref().map(|held_out| held_out.summary),
            holdout: task.held_out(),
            remainder: LegRemainder::all(&judged.left),
            suspects: outliers(&judged.residuals, task.data),
        }
    }

    /// Of a fit without these lines of the file.
    #[must_use]
    pub fn with_excluded(mut self, lines: &[u64]) -> Self {
        self.excluded = lines.to_vec();
        self
    }
}
