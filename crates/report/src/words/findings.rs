//! Faults of the data, before anything is said of the machine.

use hexbench_model::inference::examination::{Finding, FindingKind};
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::{Alternative, Diagnosis};
use hexbench_model::results::words::joined;

use crate::number::{multiple, percent, rounded};
use crate::page::{Block, Mood, Section};

/// Most lines of the file named in a sentence.
const MOST_LINES: usize = 6;

/// What is wrong with the readings, how sure, what to do, which take part, and what would change if others did.
pub(super) fn section(d: &Diagnosis) -> Option<Section> {
    Section::new("The data")
        .id("findings")
        .with((!d.read_as.is_empty()).then(|| Block::colored(Mood::Doubt, read_as(&d.read_as))))
        .list(d.findings.iter().map(sentence))
        .with((!d.findings.is_empty() && !d.is_misread()).then(|| Block::colored(Mood::Doubt, aside(d))))
        .with(d.alternative.as_ref().map(|other| Block::paragraph(changes(d, other))))
        .with((!d.excluded.is_empty()).then(|| Block::colored(Mood::Doubt, excluded(&d.excluded))))
        .unless_empty()
}

/// What became of the readings that seem wrong.
fn aside(d: &Diagnosis) -> String {
    let concerned: usize = d.findings.iter().filter(|f| f.excludes()).map(|f| f.rows.len()).sum();
    match (concerned, d.keep_all) {
        (0, _) if d.findings.iter().all(|f| f.kind == FindingKind::Holdout) => {
            "The measurements themselves are weighed as they are.".to_owned()
        }
        (0, _) => {
            "The readings are weighed accordingly; what follows is said of the machine alone.".to_owned()
        }
        (1, false) => "One reading is left out of everything that follows.".to_owned(),
        (n, false) => format!("{n} readings are left out of everything that follows."),
        (1, true) => "This reading is kept, as asked: it takes part in everything that follows.".to_owned(),
        (n, true) => {
            format!("These {n} readings are kept, as asked: they take part in everything that follows.")
        }
    }
}

/// `Read as asked: deflection-sign=reversed.`
pub(super) fn read_as(changes: &[String]) -> String {
    format!("The files are read otherwise than they say, as asked: {}.", changes.join(", then "))
}

/// `Left out before anything else, as asked: line 12.`
fn excluded(rows: &[u64]) -> String {
    format!("Left out before anything else, as asked: {}.", lines(rows))
}

/// `With line 19 kept the verdict would be outside instead of measurement, leg 3 would read 4.21 instead of 4.02 N/um, ...`
fn changes(d: &Diagnosis, other: &Alternative) -> String {
    let lead = match (lines(&other.rows), d.keep_all) {
        (rows, false) => format!("With {rows} kept"),
        (rows, true) => format!("Without {rows}"),
    };
    let noise = |chi2: f64| multiple(chi2.sqrt());
    let error = d.steps.last().map_or(String::new(), |step| {
        let (there, here) = (noise(other.chi2_reduced), noise(step.fitted.chi2_reduced));
        if there == here {
            format!(", and the fit would miss the readings by the same {here} times the noise")
        } else {
            format!(", and the fit would miss the readings by {there} instead of {here} times the noise")
        }
    });
    format!("{lead} {}, {}{error}.", verdict_change(d, other), leg_change(d, other))
}

fn verdict_change(d: &Diagnosis, other: &Alternative) -> String {
    let (here, there) = (answer(d.verdict, &d.added), answer(other.verdict, &other.added));
    if here == there {
        format!("the verdict would still be {here}")
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
                "no leg stiffness would change in its digits".to_owned()
            } else {
                format!("leg {leg} would read {new} instead of {old} {}", here.unit)
            }
        }
        (Some(_), None) => format!("the stiffness of leg {leg} would be open"),
        (None, Some(there)) => {
            let value = rounded(there.value, there.std);
            format!("the stiffness of leg {leg}, open here, would be {value} {}", there.unit)
        }
        (None, None) => "the stiffness of every leg would still be open".to_owned(),
    }
}

/// `Load, lines 12 and 13 (> 99 %): ... Do this.`
pub(super) fn sentence(finding: &Finding) -> String {
    let lines = if finding.rows.is_empty() { String::new() } else { format!(", {}", lines(&finding.rows)) };
    let Finding { kind, probability, text, size, next, .. } = finding;
    let is_said = kind.is_of_file() || text.contains(size.as_str());
    let size = if is_said { String::new() } else { format!(" ({size})") };
    format!("{}{lines} ({}): {text}{size}. To do: {next}.", kind.title(), percent(*probability))
}

/// `line 12`, `lines 12, 13`.
fn lines(rows: &[u64]) -> String {
    let listed: Vec<String> = rows.iter().take(MOST_LINES).map(u64::to_string).collect();
    let more = if rows.len() > MOST_LINES { ", ..." } else { "" };
    let noun = if rows.len() == 1 { "line" } else { "lines" };
    format!("{noun} {}{more}", listed.join(", "))
}
