//! The report of a fit: quality, values with uncertainty, correlations, errors.

use hexbench_model::campaign::Campaign;
use hexbench_model::estimate::estimates;
use hexbench_model::fit::Fit;
use hexbench_model::fit_named::look_alikes;
use hexbench_model::model_file::Estimator;
use hexbench_model::residuals::ErrorSummary;
use hexbench_model::selection::{HeldOut, Judged, Task};
use hexbench_model::words::joined;
use hexbench_report::number::{significant, with_uncertainty};

use crate::text::{Ink, Paper, Table};

/// Correlations larger than this are told.
const TOLD: f64 = 0.7;
/// Most correlations told.
const MOST_TOLD: usize = 10;

/// The whole report.
pub fn report(task: &Task<'_>, judged: &Judged, estimator: Estimator, ink: Ink) -> String {
    let (campaign, fit) = (task.campaign, &judged.fit);
    let mut paper = Paper::new(ink);
    quality(&mut paper, campaign, fit, estimator);
    values(&mut paper, fit);
    correlations(&mut paper, fit);
    error_table(&mut paper, task, judged);
    paper.into_text()
}

fn quality(paper: &mut Paper, campaign: &Campaign, fit: &Fit, estimator: Estimator) {
    let terms: Vec<String> = fit.point.active.iter().map(|a| a.id().to_owned()).collect();
    let with = if terms.is_empty() { String::new() } else { format!(" + {}", joined(&terms)) };
    let method = match estimator {
        Estimator::Gls => "generalised least squares",
        Estimator::Paper => "the paper's unweighted minimum-norm least squares",
    };
    paper.heading(&format!("Fit: leg springs{with}"), method);
    // Gaussian likelihood with known noise, up to a constant of the data.
    let parameters = (6 * campaign.readings) as f64 - fit.dof;
    let equations = (6 * campaign.readings) as f64;
    let mut table = Table::default();
    table.row(["readings".to_owned(), campaign.readings.to_string()]);
    table.row(["equations".to_owned(), format!("{equations}")]);
    table.row(["parameters (effective)".to_owned(), format!("{parameters:.1}")]);
    table.row(["chi-square".to_owned(), significant(fit.chi2, 6)]);
    table.row(["degrees of freedom".to_owned(), format!("{:.1}", fit.dof)]);
    table.row(["reduced chi-square".to_owned(), significant(fit.chi2_reduced(), 4)]);
    table.row(["AIC".to_owned(), significant(fit.chi2 + 2.0 * parameters, 6)]);
    table.row(["BIC".to_owned(), significant(fit.chi2 + parameters * equations.ln(), 6)]);
    table.lines().iter().for_each(|line| paper.line(line));
    if !fit.settled {
        paper.paragraph(2, "The fit did not settle; treat its numbers as provisional.");
    }
}

fn values(paper: &mut Paper, fit: &Fit) {
    let all = estimates(fit);
    paper.heading("Values", "+/- standard uncertainty (k = 1)");
    let mut table = Table::default();
    for e in &all.determined {
        let [value, std] = with_uncertainty(e.value, e.std);
        let share = 100.0 * (e.std / e.value).abs();
        let percent =
            if share.is_finite() { format!("({} %)", significant(share, 2)) } else { String::new() };
        table.row([e.name.clone(), value, format!("+/- {std}"), percent, e.unit.clone()]);
    }
    table.lines().iter().for_each(|line| paper.line(line));
    if !all.not_determined.is_empty() {
        let text = format!("Not determined by these data, so no number: {}.", joined(&all.not_determined));
        paper.paragraph(2, &text);
    }
}

fn correlations(paper: &mut Paper, fit: &Fit) {
    let pairs = look_alikes(fit, TOLD);
    if pairs.is_empty() {
        return;
    }
    paper.heading("Correlations", "beyond 0.7: what the data tell apart badly");
    for (a, b, r) in pairs.iter().take(MOST_TOLD) {
        paper.line(&format!("  {r:+.3}  {a}, {b}"));
    }
    if pairs.len() > MOST_TOLD {
        paper.line(&format!("  and {} more", pairs.len() - MOST_TOLD));
    }
}

fn error_table(paper: &mut Paper, task: &Task<'_>, judged: &Judged) {
    paper.heading("Errors", "root mean square");
    let mut table = Table::default();
    table.row(["", "translation um", "rotation urad", "chi2 per number"]);
    let mut row = |name: &str, e: &ErrorSummary| {
        let (t, r) = (significant(e.rms.translation_um, 3), significant(e.rms.rotation_urad, 3));
        table.row([name.to_owned(), t, r, significant(e.chi2_reduced, 3)]);
    };
    row("fitted readings", &judged.fitted);
    if let Some(held) = &judged.held_out {
        let name = match task.held_out() {
            HeldOut::File => "held-out readings",
            HeldOut::PosesInTurn => "poses left out in turn",
        };
        row(name, held);
    }
    let noise = task.campaign.noise;
    let level = |sigma: f64| significant(sigma * 1e6, 3);
    let source = format!("noise ({})", noise.source.word());
    table.row([source, level(noise.translation), level(noise.rotation), "1".to_owned()]);
    table.lines().iter().for_each(|line| paper.line(line));
}
