//! Leg stiffnesses, and what leaving an effect out does to them.

use hexbench_core::Hexapod;
use hexbench_model::diagnose::{AbsorbedReport, Diagnosis};
use hexbench_model::verdict::Verdict;
use hexbench_report::number::with_uncertainty;

use crate::text::{Paper, Table};

/// Stiffness per leg with uncertainty, then the bias per effect left out.
pub(crate) fn section(paper: &mut Paper, hexapod: &Hexapod, d: &Diagnosis, verbose: bool) {
    let of = match d.verdict {
        Verdict::Ambiguous => "N/um, +- standard uncertainty (k = 1), over all explanations that remain",
        _ => "N/um, +- standard uncertainty (k = 1)",
    };
    paper.heading("Leg stiffness", of);
    let mut table = table(d);
    if let Some(nominal) = hexapod.nominal_stiffness {
        table.row(std::iter::once("nominal".to_owned()).chain(nominal.map(|k| format!("{:.3}", k * 1e-6))));
    }
    let reports: Vec<&AbsorbedReport> = d.absorbed.iter().filter(|a| worth_telling(d, a, verbose)).collect();
    for report in &reports {
        table.row(bias(report));
    }
    table.lines().iter().for_each(|line| paper.line(line));
    if !reports.is_empty() {
        let text = "% rows: change of k when that effect is left out of the model: the springs absorb what they can.";
        paper.paragraph(2, text);
    }
    if d.verdict == Verdict::Outside {
        let text = "Biased by what is missing: the uncertainties do not cover an effect without a name.";
        paper.paragraph(2, text);
    }
}

fn table(d: &Diagnosis) -> Table {
    let mut table = Table::default();
    let legs: Vec<Option<[String; 2]>> = (1..=6).map(|leg| stiffness(d, leg)).collect();
    let row = |name: &str, cell: &dyn Fn(usize) -> String| -> Vec<String> {
        std::iter::once(name.to_owned()).chain((0..6).map(cell)).collect()
    };
    let part = |leg: usize, which: usize| legs[leg].as_ref().map_or("-".to_owned(), |k| k[which].clone());
    table.row(row("leg", &|leg| (leg + 1).to_string()));
    table.row(row("k", &|leg| part(leg, 0)));
    table.row(row("+-", &|leg| part(leg, 1)));
    table
}

fn stiffness(d: &Diagnosis, leg: usize) -> Option<[String; 2]> {
    let name = format!("leg-{leg}.stiffness");
    d.parameters.iter().find(|p| p.name == name).map(|p| with_uncertainty(p.value, p.std))
}

/// Effects of the model, and rivals when the answer is open.
fn worth_telling(d: &Diagnosis, report: &AbsorbedReport, verbose: bool) -> bool {
    let rival = d.verdict == Verdict::Ambiguous && d.credible_set.contains(&report.term);
    verbose || rival || d.model.contains(&report.term)
}

fn bias(report: &AbsorbedReport) -> Vec<String> {
    let cell = |b: &Option<f64>| b.map_or("-".to_owned(), |b| format!("{b:+.1} %"));
    let cells = report.bias_of_leg_stiffness_percent.iter().map(cell);
    std::iter::once(format!("no {}", report.term)).chain(cells).collect()
}
