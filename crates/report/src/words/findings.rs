//! Faults of the data, before anything is said of the machine.

use std::collections::BTreeSet;

use hexbench_core::words::joined;
use hexbench_model::inference::examination::{Finding, FindingKind};
use hexbench_model::inference::misread::Change;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::{Alternative, Diagnosis};

use crate::number::{multiple, percent, rounded};
use crate::page::{Block, Mood, Section};

/// Most lines of the file, or ranges of lines, named in a sentence.
const MOST_LINES: usize = 6;

/// Most findings of a kind, each with readings of its own, that have a sentence each.
const MOST_APART: usize = 3;

/// Products of a factor and its inverse differ by less from one.
const ONE_FACTOR: f64 = 1e-3;

/// What is wrong with the readings, how sure, what to do, which take part, and what would change if others did.
pub(super) fn section(d: &Diagnosis) -> Option<Section> {
    Section::new("The data")
        .id("findings")
        .with((!d.read_as.is_empty()).then(|| Block::colored(Mood::Doubt, read_as(&d.read_as))))
        .list(if undoes_what_was_asked(d) { vec![asked_is_wrong(d)] } else { sentences(&d.findings) })
        .with((!d.findings.is_empty() && !d.is_misread()).then(|| Block::colored(Mood::Doubt, aside(d))))
        .with(d.alternative.as_ref().map(|other| Block::paragraph(changes(d, other))))
        .with((!d.excluded.is_empty()).then(|| Block::colored(Mood::Doubt, excluded(&d.excluded))))
        .unless_empty()
}

/// What became of the readings that seem wrong.
fn aside(d: &Diagnosis) -> String {
    let rows = d.findings.iter().filter(|f| f.excludes()).flat_map(|f| &f.rows);
    let concerned = rows.collect::<BTreeSet<_>>().len();
    match (concerned, d.keep_all) {
        (0, _) if d.findings.iter().all(|f| f.kind == FindingKind::Holdout) => {
            "The measurements themselves are used unchanged.".to_owned()
        }
        (0, _) => {
            "The readings are weighted accordingly; everything below is about the machine alone.".to_owned()
        }
        (1, false) => "Everything below omits one reading.".to_owned(),
        (n, false) => format!("Everything below omits {n} readings."),
        (1, true) => "As requested, this reading is kept: everything below uses it.".to_owned(),
        (n, true) => {
            format!("As requested, these {n} readings are kept: everything below uses them.")
        }
    }
}

/// True where the best explanation of the files is that what was asked to be read otherwise stands there rightly.
pub(super) fn undoes_what_was_asked(d: &Diagnosis) -> bool {
    let asked: Result<Vec<Change>, _> = d.read_as.iter().map(|name| name.parse()).collect();
    let Ok([asked]) = asked.as_deref() else { return false };
    let undoes = |found: &Change| match (found, asked) {
        (Change::Scaled(group, found), Change::Scaled(of, asked)) => {
            group == of && (found * asked - 1.0).abs() < ONE_FACTOR
        }
        (Change::Reversed(_) | Change::StatesExchanged | Change::JointsExchanged, _) => found == asked,
        _ => false,
    };
    d.findings.iter().any(|finding| matches!(finding.read_as.as_slice(), [found] if undoes(found)))
}

fn asked_is_wrong(d: &Diagnosis) -> String {
    let asked = d.read_as.join(", ");
    format!(
        "The requested correction makes these files wrong: undone, the readings are explained far better. To do: remove --read-as {asked}."
    )
}

/// `Read as asked: deflection-sign=reversed.`
pub(super) fn read_as(changes: &[String]) -> String {
    format!("As requested, the files are read with this correction: {}.", changes.join(", then "))
}

/// `Left out beforehand, as requested: line 12.`
fn excluded(rows: &[u64]) -> String {
    format!("Left out beforehand, as requested: {}.", lines(rows))
}

/// `With line 19 kept, the verdict would be outside instead of measurement, the stiffness of leg 3 would be 4.21 instead of 4.02 N/um, ...`
fn changes(d: &Diagnosis, other: &Alternative) -> String {
    let lead = match (lines(&other.rows), d.keep_all) {
        (rows, false) => format!("With {rows} kept,"),
        (rows, true) => format!("Without {rows},"),
    };
    let noise = |chi2: f64| multiple(chi2.sqrt());
    let error = d.steps.last().map_or(String::new(), |step| {
        let (there, here) = (noise(other.chi2_reduced), noise(step.fitted.chi2_reduced));
        if there == here {
            format!(", and the residuals of the fit would be the same {here} times the noise")
        } else {
            format!(", and the residuals of the fit would be {there} instead of {here} times the noise")
        }
    });
    format!("{lead} {}, {}{error}.", verdict_change(d, other), leg_change(d, other))
}

fn verdict_change(d: &Diagnosis, other: &Alternative) -> String {
    let (here, there) = (answer(d.verdict, &d.added), answer(other.verdict, &other.added));
    if here == there {
        "the answer would be the same".to_owned()
    } else {
        format!("the verdict would be {there} instead of {here}")
    }
}

/// `named (base-compliance)`.
fn answer(verdict: Verdict, added: &[String]) -> String {
    let names = if added.is_empty() { String::new() } else { format!(" ({})", joined(added)) };
    format!("{}{names}", verdict.word())
}

/// The leg whose stiffness changes most, in units of its uncertainty; one that becomes open or known before all others.
fn leg_change(d: &Diagnosis, other: &Alternative) -> String {
    let change = |leg: &usize| match (d.stiffness(*leg), &other.stiffness[*leg]) {
        (Some(here), Some(there)) => (there.value - here.value).abs() / here.std,
        (None, None) => 0.0,
        _ => f64::INFINITY,
    };
    let most = (0..6).max_by(|a, b| change(a).total_cmp(&change(b))).unwrap_or(0);
    let leg = most + 1;
    match (d.stiffness(most), &other.stiffness[most]) {
        (Some(here), Some(there)) => {
            let [new, old] = [there.value, here.value].map(|value| rounded(value, here.std));
            if new == old {
                "no leg stiffness would change in the digits shown".to_owned()
            } else {
                format!("the stiffness of leg {leg} would be {new} instead of {old} {}", here.unit)
            }
        }
        (Some(_), None) => format!("the stiffness of leg {leg} would be undetermined"),
        (None, Some(there)) => {
            let value = rounded(there.value, there.std);
            format!("the stiffness of leg {leg}, undetermined here, would be {value} {}", there.unit)
        }
        (None, None) => "the stiffness of every leg would still be undetermined".to_owned(),
    }
}

/// A sentence for each finding; where there are many of a kind, one for all of them, with every line.
fn sentences(findings: &[Finding]) -> Vec<String> {
    let of_kind = |kind: FindingKind| findings.iter().filter(move |f| f.kind == kind && f.excludes());
    let is_many = |f: &Finding| of_kind(f.kind).count() > MOST_APART;
    let is_first = |n: usize, f: &Finding| findings[..n].iter().all(|before| before.kind != f.kind);
    let shown = findings.iter().enumerate().filter(|(n, f)| !is_many(f) || is_first(*n, f));
    shown
        .map(|(_, f)| if is_many(f) { together(&of_kind(f.kind).collect::<Vec<_>>()) } else { sentence(f) })
        .collect()
}

/// `Blunder, lines 12, 40 to 43 (> 99 % each): five single faults; the clearest: ... To do: ...`
fn together(all: &[&Finding]) -> String {
    let mut rows: Vec<u64> = all.iter().flat_map(|f| f.rows.iter().copied()).collect();
    rows.sort_unstable();
    let least = all.iter().map(|f| f.probability).fold(1.0, f64::min);
    let (count, Finding { kind, text, next, .. }) = (all.len(), all[0]);
    let (title, lines, sure) = (kind.title(), runs(&rows).join(", "), percent(least));
    format!(
        "{title}, lines {lines} ({sure} each): {count} single faults; the clearest: {text}. To do: {next}, and likewise for the others."
    )
}

/// `12, 13, 40 to 43`: numbers in ascending order, three or more that follow one another as a range.
fn runs(rows: &[u64]) -> Vec<String> {
    let chunks = rows.chunk_by(|a, b| *b <= a + 1);
    let run = |run: &[u64]| match run {
        [first, _, .., last] if last > &(first + 1) => vec![format!("{first} to {last}")],
        few => few.iter().map(u64::to_string).collect(),
    };
    chunks.flat_map(run).collect()
}

/// `Load, lines 12 and 13 (> 99 %): ... Do this.`
pub(super) fn sentence(finding: &Finding) -> String {
    let lines = if finding.rows.is_empty() { String::new() } else { format!(", {}", lines(&finding.rows)) };
    let Finding { kind, probability, text, size, next, .. } = finding;
    let is_said = kind.is_of_file() || says(text, size);
    let size = if is_said { String::new() } else { format!(" ({size})") };
    format!("{}{lines} ({}): {text}{size}. To do: {next}.", kind.title(), percent(*probability))
}

/// `line 12`, `lines 12, 13`, `lines 12 to 29`.
fn lines(rows: &[u64]) -> String {
    let mut rows = rows.to_vec();
    rows.sort_unstable();
    let mut listed = runs(&rows);
    let more = if listed.len() > MOST_LINES { ", ..." } else { "" };
    listed.truncate(MOST_LINES);
    let noun = if rows.len() == 1 { "line" } else { "lines" };
    format!("{noun} {}{more}", listed.join(", "))
}

/// The numbers in a text, without their signs.
fn numbers(text: &str) -> Vec<&str> {
    let is_part = |c: char| c.is_ascii_digit() || c == '.';
    text.split(|c| !is_part(c)).map(|n| n.trim_matches('.')).filter(|n| !n.is_empty()).collect()
}

/// True where a text has every number of the size already.
fn says(text: &str, size: &str) -> bool {
    let (said, all) = (numbers(text), numbers(size));
    if all.is_empty() { text.contains(size) } else { all.iter().all(|n| said.contains(n)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn blunder(line: u64) -> Finding {
        Finding {
            kind: FindingKind::Blunder,
            probability: 0.9995,
            rows: vec![line],
            size: format!("{line} sigma"),
            text: format!("da in line {line} is {line} sigma away"),
            next: "read the record again".to_owned(),
            read_as: Vec::new(),
            is_within_tolerance: false,
        }
    }

    #[test]
    fn many_faults_of_a_kind_are_told_together_with_every_line() {
        let told = sentences(&[43, 12, 41, 42].map(blunder));
        assert_eq!(
            told,
            [
                "Blunder, lines 12, 41 to 43 (> 99 % each): 4 single faults; the clearest: da in line 43 is 43 sigma \
                 away. To do: read the record again, and likewise for the others."
            ]
        );
        assert_eq!(sentences(&[43, 12, 41].map(blunder)).len(), 3);
    }

    #[test]
    fn lines_that_follow_one_another_are_a_range() {
        assert_eq!(lines(&[7]), "line 7");
        assert_eq!(lines(&[9, 8, 4]), "lines 4, 8, 9");
        assert_eq!(lines(&(38..=55).collect::<Vec<_>>()), "lines 38 to 55");
        assert_eq!(lines(&[1, 3, 5, 7, 9, 11, 13]), "lines 1, 3, 5, 7, 9, 11, ...");
    }

    #[test]
    fn a_size_whose_numbers_the_text_has_is_not_repeated() {
        let finding = |text: &str, size: &str| {
            let (text, size) = (text.to_owned(), size.to_owned());
            sentence(&Finding { kind: FindingKind::Tolerance, rows: Vec::new(), text, size, ..blunder(1) })
        };
        let said = finding("fy most, by +1.0 %", "fy +1.0 %");
        assert_eq!(said, "Tolerance (> 99 %): fy most, by +1.0 %. To do: read the record again.");
        // A number that is part of another one is not said.
        assert!(finding("18 readings", "8 readings").contains("18 readings (8 readings)"));
        assert!(finding("the instrument drifts", "80 % of the variance").contains("(80 % of the variance)"));
    }
}
