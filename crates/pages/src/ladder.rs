//! The ladder: error on held-out poses, step by step, beside the noise.

use hexbench_model::diagnose::{Diagnosis, StepReport};
use hexbench_model::residuals::ErrorSummary;
use hexbench_report::number::significant;

use super::conclusion::at_the_noise;
use crate::text::{Ink, Paper, bar};

/// Columns of the longest bar.
const BAR: usize = 22;
const NAME: usize = 26;

/// One line per step of the model, then the noise.
pub fn section(paper: &mut Paper, d: &Diagnosis) {
    let heading = if d.steps.len() > 1 { "The error falls" } else { "The error" };
    paper.heading(heading, how_held_out(d));
    paper.line(&format!("  {:<NAME$}{:>8}{:>8}{:>9}", "", "um", "urad", "x noise"));
    let errors: Vec<(&StepReport, ErrorSummary)> =
        d.steps.iter().map(|s| (s, s.holdout.unwrap_or(s.fitted))).collect();
    let largest = errors.iter().map(|(_, e)| e.chi2_reduced.sqrt()).fold(1.0, f64::max);
    for (step, error) in &errors {
        let line = rung(paper.ink(), &name(step), error, largest);
        paper.line(&line);
    }
    let noise = at_least_one(1.0 / largest);
    let (t, r) = (significant(d.noise.translation_um, 3), significant(d.noise.rotation_urad, 3));
    paper.line(&format!("  {:<NAME$}{t:>8}{r:>8}{:>9}  {noise}", "noise of one reading", "1.00"));
}

/// Where the held-out error comes from.
pub fn how_held_out(d: &Diagnosis) -> &'static str {
    match d.steps.first().and_then(|s| s.holdout) {
        None => "on the fitted readings: too few poses to hold any out",
        Some(_) if d.holdout == "holdout file" => "on held-out poses (root mean square, holdout file)",
        Some(_) => "on held-out poses (root mean square, each left out in turn)",
    }
}

/// `springs alone`, then `+ term`.
pub fn name(step: &StepReport) -> String {
    step.terms.last().map_or_else(|| "springs alone".to_owned(), |term| format!("+ {term}"))
}

fn rung(ink: Ink, name: &str, error: &ErrorSummary, largest: f64) -> String {
    let times = error.chi2_reduced.sqrt();
    let (t, r) = (significant(error.rms.translation_um, 3), significant(error.rms.rotation_urad, 3));
    let bar = at_least_one(times / largest);
    let good = at_the_noise(error.chi2_reduced, error.count);
    let bar = if good { ink.good(&bar) } else { ink.bad(&bar) };
    format!("  {name:<NAME$}{t:>8}{r:>8}{:>9}  {bar}", multiple(times))
}

/// A multiple of the noise with the digits that matter.
pub fn multiple(times: f64) -> String {
    if times < 10.0 { format!("{times:.2}") } else { format!("{times:.0}") }
}

/// However small an error, its bar is seen.
fn at_least_one(share: f64) -> String {
    let bar = bar(share, BAR);
    if bar.is_empty() { "#".to_owned() } else { bar }
}
