//! How large: parameters of the effects in their own units.

use hexbench_model::diagnose::Diagnosis;
use hexbench_model::estimate::Estimate;
use hexbench_report::number::with_uncertainty;

use super::conclusion::joined;
use crate::text::{Paper, Table};

/// Most parameters of one effect on the page.
const MOST_LINES: usize = 8;
/// Most names listed one by one.
const MOST_NAMES: usize = 6;

/// Values of every effect in the fitted model.
pub(crate) fn section(paper: &mut Paper, d: &Diagnosis, verbose: bool) {
    if d.model.is_empty() {
        return;
    }
    paper.heading("How large", "value +- standard uncertainty (k = 1)");
    if d.model != d.added {
        let model = joined(&d.model, "+");
        paper.paragraph(2, &format!("These numbers belong to the most probable model, springs + {model}."));
    }
    for term in &d.model {
        effect(paper, d, term, verbose);
    }
}

fn effect(paper: &mut Paper, d: &Diagnosis, term: &str, verbose: bool) {
    let own: Vec<&Estimate> = d.parameters.iter().filter(|p| belongs(&p.name, term)).collect();
    let shown = if verbose { own.len() } else { own.len().min(MOST_LINES) };
    let richer =
        if d.richer.iter().any(|r| r == term) { ", of a form richer than the ideal one" } else { "" };
    paper.line(&format!("  {term}{richer}"));
    let mut table = Table::default();
    for p in &most_telling(&own)[..shown] {
        let [value, std] = with_uncertainty(p.value, p.std);
        let unit = if p.unit == "1" { "" } else { &p.unit };
        table.row([format!("  {}", short(&p.name)), value, format!("+- {std}"), unit.to_owned()]);
    }
    table.left(3).lines().iter().for_each(|line| paper.line(line));
    if shown < own.len() {
        paper.line(&format!("    and {} more (--verbose)", own.len() - shown));
    }
    not_determined(paper, d, term);
}

/// In the given order when few, else the ones furthest from zero first.
fn most_telling<'a>(own: &[&'a Estimate]) -> Vec<&'a Estimate> {
    let mut all = own.to_vec();
    if all.len() > MOST_LINES {
        let z = |p: &Estimate| (p.value / p.std).abs();
        all.sort_by(|a, b| z(b).total_cmp(&z(a)));
    }
    all
}

fn not_determined(paper: &mut Paper, d: &Diagnosis, term: &str) {
    let names: Vec<&str> = d.not_determined.iter().filter(|n| belongs(n, term)).map(|n| short(n)).collect();
    let what = match names.len() {
        0 => return,
        n if n <= MOST_NAMES => joined(&names, "and"),
        n => format!("{n} further parameters"),
    };
    paper.paragraph(4, &format!("not determined by these data: {what}"));
}

fn belongs(name: &str, term: &str) -> bool {
    name.strip_prefix(term).is_some_and(|rest| rest.starts_with('.'))
}

fn short(name: &str) -> &str {
    name.split_once('.').map_or(name, |(_, parameter)| parameter)
}
