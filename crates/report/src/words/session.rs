//! What somebody did with some measurements: models tried, readings left out, notes.

use hexbench_core::words::joined;

use crate::number::multiple;
use crate::page::{Block, Cell, Mood, PageColumn, Section, Table};

/// A step of a session.
#[derive(Debug, Clone, Copy)]
pub struct StepTaken<'a> {
    /// Terms beside the leg springs.
    pub terms: &'a [String],
    /// Lines left out of the fit.
    pub excluded: &'a [u64],
    /// Held-out error (else fitted) as a multiple of the noise.
    pub times_noise: f64,
}

/// Steps in their order, with the error of each; `at`: the one shown, from zero.
pub fn steps(taken: &[StepTaken<'_>], at: usize) -> Section {
    let largest = taken.iter().map(|s| s.times_noise).fold(1.0, f64::max);
    let columns = [
        PageColumn::number("step"),
        PageColumn::words("model"),
        PageColumn::words("left out"),
        PageColumn::number("x noise"),
        PageColumn::bars(),
        PageColumn::words(""),
    ];
    let mut table = Table::new(columns);
    for (k, step) in taken.iter().enumerate() {
        let mood = if k == at { Mood::Good } else { Mood::Doubt };
        let left_out = if step.excluded.is_empty() { "nothing".to_owned() } else { lines(step.excluded) };
        table.row([
            Cell::from((k + 1).to_string()),
            model(step.terms).into(),
            left_out.into(),
            multiple(step.times_noise).into(),
            Cell::colored_bar(step.times_noise / largest, mood),
            if k == at { "the model below" } else { "" }.into(),
        ]);
    }
    Section::new("Steps of the session").id("session").remark("held-out error after every step").table(table)
}

/// What somebody wrote beside it, a paragraph a line.
pub fn notes(text: &str) -> Option<Section> {
    let written = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let section = written.fold(Section::new("Notes of the session").id("session-notes"), Section::paragraph);
    (!section.blocks.is_empty()).then_some(section)
}

/// Which readings a fit was made without, and how many; nothing where it had all of them.
pub fn left_out(all: &[u64]) -> Option<Section> {
    let count = match all.len() {
        0 => return None,
        1 => "One reading is".to_owned(),
        n => format!("{n} readings are"),
    };
    let text = format!("{count} left out of the fit, as requested: {}.", lines(all));
    Some(Section::new("Readings left out").id("left-out").with(Block::colored(Mood::Doubt, text)))
}

/// `line 3`, `lines 3, 5 and 7-9`: every one of them, in the order of the file.
pub fn lines(all: &[u64]) -> String {
    let mut sorted = all.to_vec();
    sorted.sort_unstable();
    sorted.dedup();
    let runs = sorted.chunk_by(|a, b| a + 1 == *b).map(|run| match run {
        [first, .., last] => format!("{first}-{last}"),
        [line] => line.to_string(),
        [] => String::new(),
    });
    format!("line{} {}", if sorted.len() == 1 { "" } else { "s" }, joined(&runs.collect::<Vec<_>>()))
}

fn model(terms: &[String]) -> String {
    if terms.is_empty() { "springs alone".to_owned() } else { format!("springs + {}", terms.join(" + ")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_named_one_or_many() {
        assert_eq!(lines(&[3]), "line 3");
        assert_eq!(lines(&[9, 3, 7, 8, 5]), "lines 3, 5 and 7-9");
        assert!(left_out(&[]).is_none() && left_out(&[3]).is_some());
    }

    #[test]
    fn blank_notes_are_no_section() {
        assert!(notes(" \n ").is_none());
        assert_eq!(notes("one\n\ntwo").map(|s| s.blocks.len()), Some(2));
    }
}
