//! Faults of the data, before anything is said of the machine.

use hexbench_model::inference::examination::Finding;
use hexbench_model::results::diagnose::Diagnosis;

use crate::number::percent;
use crate::page::{Block, Mood, Section};

/// Most lines of the file named in a sentence.
const MOST_LINES: usize = 6;

/// What is wrong with the readings, how sure, and what to do.
pub(super) fn section(d: &Diagnosis) -> Option<Section> {
    let left_out: usize = d.findings.iter().filter(|f| f.excludes()).map(|f| f.rows.len()).sum();
    let aside = match left_out {
        0 => "The readings are weighed accordingly; what follows is said of the machine alone.".to_owned(),
        1 => "One reading is left out of everything that follows.".to_owned(),
        n => format!("{n} readings are left out of everything that follows."),
    };
    Section::new("The data")
        .id("findings")
        .list(d.findings.iter().map(sentence))
        .unless_empty()
        .map(|section| section.with(Block::colored(Mood::Doubt, aside)))
}

/// `Load, lines 12 and 13 (> 99 %): ... Do this.`
fn sentence(finding: &Finding) -> String {
    let lines = match finding.rows.as_slice() {
        [] => String::new(),
        [one] => format!(", line {one}"),
        many => {
            let listed: Vec<String> = many.iter().take(MOST_LINES).map(u64::to_string).collect();
            let more = if many.len() > MOST_LINES { ", ..." } else { "" };
            format!(", lines {}{more}", listed.join(", "))
        }
    };
    let Finding { kind, probability, text, size, next, .. } = finding;
    let size = if text.contains(size.as_str()) { String::new() } else { format!(" ({size})") };
    format!("{}{lines} ({}): {text}{size}. To do: {next}.", kind.title(), percent(*probability))
}
