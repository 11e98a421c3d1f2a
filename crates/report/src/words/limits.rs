//! What could not be tested, and the smallest sizes this campaign would show.

use std::collections::BTreeMap;

use hexbench_model::effects::untestable::{Reason, Untestable};
use hexbench_model::inference::power::Detectable;
use hexbench_model::results::diagnose::Diagnosis;

use crate::number::significant;
use crate::page::{PageColumn, Section, Table};

/// A blank at which no line is broken.
const NO_BREAK: &str = "\u{a0}";

/// Effects that the file cannot test, by reason.
pub(super) fn untestable(d: &Diagnosis) -> Option<Section> {
    not_tested(&d.untestable)
}

/// The same of any list of effects.
pub(super) fn not_tested(untestable: &[Untestable]) -> Option<Section> {
    let mut reasons: BTreeMap<String, (&Reason, Vec<&str>)> = BTreeMap::new();
    for u in untestable {
        reasons.entry(u.why.to_string()).or_insert((&u.why, Vec::new())).1.push(u.term);
    }
    let reason = |(sentence, (why, terms)): (String, (&Reason, Vec<&str>))| {
        // The terms are the subject of what follows: no "it".
        let why = match why {
            Reason::OnlyAbsolutePoses => sentence.trim_start_matches("it "),
            _ => &sentence,
        };
        format!("{why}: {}", terms.join(", "))
    };
    Section::new("Could not be tested").id("untestable").list(reasons.into_iter().map(reason)).unless_empty()
}

/// The smallest size of each effect, then of each parameter.
pub(super) fn section(d: &Diagnosis) -> Section {
    smallest(&d.detectable, "the fitted model")
}

/// The same of any list of sizes, and what they are found beside.
pub(super) fn smallest(detectable: &[Detectable], beside: &str) -> Section {
    let mut terms: Vec<&str> = detectable.iter().map(|row| row.term.as_str()).collect();
    terms.dedup();
    let parts: Vec<String> = terms.iter().filter_map(|term| short_size(detectable, term)).collect();
    let section = Section::new("Smallest effect these data can detect")
        .id("limits")
        .remark(format!(
            "in 9 of 10 campaigns with an effect of this size, a diagnosis no longer calls {beside} sufficient; each parameter alone (`hexbench \
             power`: a test of all parameters of an effect together, which sees smaller ones)"
        ))
        .paragraph(if parts.is_empty() {
            "None is detectable.".to_owned()
        } else {
            format!("{}.", parts.join("; "))
        });
    if detectable.is_empty() { section } else { section.table(every_size(detectable)) }
}

/// `term size unit` kept on one line; the smallest size among the parameters in the unit of the first.
fn short_size(all: &[Detectable], term: &str) -> Option<String> {
    let own = || all.iter().filter(|row| row.term == term);
    let unit = own().find(|row| row.size_at_90_percent_power.is_some())?.unit.as_str();
    let sizes = own().filter(|row| row.unit == unit).filter_map(|row| row.size_at_90_percent_power);
    let size = sizes.min_by(f64::total_cmp)?;
    Some(format!("{term} {} {unit}", significant(size, 2)).replace(' ', NO_BREAK))
}

/// Detail: every parameter.
fn every_size(detectable: &[Detectable]) -> Table {
    let row = |row: &Detectable| {
        let size = row.size_at_90_percent_power.map_or("none".to_owned(), |s| significant(s, 2));
        [format!("{}.{}", row.term, row.parameter), size, row.unit.clone()]
    };
    let columns = [PageColumn::words("parameter"), PageColumn::number("size"), PageColumn::words("unit")];
    Table::new(columns).rows(detectable.iter().map(row)).brief(0)
}
