//! What could not be tested, and the smallest sizes this campaign would show.

use std::collections::BTreeMap;

use hexbench_model::diagnose::Diagnosis;
use hexbench_model::power::Detectable;
use hexbench_report::number::significant;

use crate::text::{Paper, Table};

/// A blank at which no line is broken.
const NO_BREAK: &str = "\u{a0}";

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
        let why = why.strip_prefix("it ").filter(|w| w.starts_with("needs")).unwrap_or(why);
        paper.hanging("  -", 4, &format!("{why}: {}", terms.join(", ")));
    }
}

/// One size per effect: that of its most visible parameter.
fn short_sizes(paper: &mut Paper, d: &Diagnosis) {
    let mut terms: Vec<&str> = d.detectable.iter().map(|row| row.term.as_str()).collect();
    terms.dedup();
    let parts: Vec<String> = terms.iter().filter_map(|term| short_size(&d.detectable, term)).collect();
    paper.paragraph(2, &format!("{}. Every parameter: --verbose.", parts.join("; ")));
}

/// `term size unit` kept on one line; the smallest size among the parameters in the unit of the first.
fn short_size(all: &[Detectable], term: &str) -> Option<String> {
    let own = || all.iter().filter(|row| row.term == term);
    let unit = own().find(|row| row.size_at_90_percent_power.is_some())?.unit.as_str();
    let sizes = own().filter(|row| row.unit == unit).filter_map(|row| row.size_at_90_percent_power);
    let size = sizes.min_by(f64::total_cmp)?;
    Some(format!("{term} {} {unit}", significant(size, 2)).replace(' ', NO_BREAK))
}

fn every_size(paper: &mut Paper, d: &Diagnosis) {
    let mut table = Table::default();
    for row in &d.detectable {
        let size = row.size_at_90_percent_power.map_or("none".to_owned(), |s| significant(s, 2));
        table.row([format!("{}.{}", row.term, row.parameter), size, row.unit.clone()]);
    }
    table.left(2).lines().iter().for_each(|line| paper.line(line));
}
