//! What could not be tested, and the smallest sizes this campaign would show.

use std::collections::BTreeMap;

use hexbench_model::diagnose::Diagnosis;
use hexbench_model::power::Detectable;

use super::conclusion::joined;
use crate::output::number::significant;
use crate::output::{Paper, Table};

/// Both lists.
pub(crate) fn section(paper: &mut Paper, d: &Diagnosis, verbose: bool) {
    untestable(paper, d);
    let remark = "seen in 9 of 10 such campaigns, false alarm in 1 of 100";
    paper.heading("Smallest effect these data would show", remark);
    if verbose { every_size(paper, d) } else { short_sizes(paper, d) }
}

fn untestable(paper: &mut Paper, d: &Diagnosis) {
    if d.untestable.is_empty() {
        return;
    }
    let mut reasons: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for u in &d.untestable {
        reasons.entry(&u.why).or_default().push(&u.term);
    }
    paper.heading("Could not be tested", "");
    for (why, terms) in reasons {
        paper.hanging("  -", 4, &format!("{}: {why}", joined(&terms, "and")));
    }
}

/// One parameter of every effect, the most visible of its first kind.
fn short_sizes(paper: &mut Paper, d: &Diagnosis) {
    let mut parts: Vec<String> = Vec::new();
    let mut last = "";
    for first in d.detectable.iter() {
        if first.term == last {
            continue;
        }
        last = &first.term;
        if let Some((size, parameter)) = smallest(&d.detectable, first) {
            // Non-breaking: term, size and unit stay on one line.
            parts.push(format!("{} {size}\u{a0}{} ({parameter})", first.term, unit(&first.unit)));
        }
    }
    let text = parts.join("; ").replace(" (", "\u{a0}(");
    paper.paragraph(2, &text);
}

fn unit(unit: &str) -> String {
    unit.replace(' ', "\u{a0}")
}

/// Smallest size among the parameters of a term that have the unit of `first`.
fn smallest(all: &[Detectable], first: &Detectable) -> Option<(String, String)> {
    let same = all.iter().filter(|d| d.term == first.term && d.unit == first.unit);
    let sized = same.filter_map(|d| Some((d.size_at_90_percent_power?, &d.parameter)));
    let (size, parameter) = sized.min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some((significant(size, 2), parameter.clone()))
}

fn every_size(paper: &mut Paper, d: &Diagnosis) {
    let mut table = Table::default();
    for row in &d.detectable {
        let size = row.size_at_90_percent_power.map_or("none".to_owned(), |s| significant(s, 2));
        table.row([format!("{}.{}", row.term, row.parameter), size, row.unit.clone()]);
    }
    table.left(2).lines().iter().for_each(|line| paper.line(line));
}
