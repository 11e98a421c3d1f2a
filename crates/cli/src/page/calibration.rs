//! The study of calibration on a page.

use std::path::{Path, PathBuf};

use hexbench_experiments::calibration::{Calibration, Fate, Record, headlines};
use hexbench_pages::text::{Ink, Paper, Table};
use hexbench_truth::campaign::Kind;

/// Groups of false answers that get a line.
const GROUPS: usize = 8;

/// Main figures, what became of the truths, the largest groups of false answers, and the files written.
pub(crate) fn calibration(study: &Calibration, written: &[PathBuf], ink: Ink) -> String {
    let mut paper = Paper::new(ink);
    let seed = study.protocol.seed;
    paper.heading(&format!("Calibration: {} trials, seed {seed}", study.protocol.trials()), "");
    for line in headlines(&study.records) {
        paper.hanging("  -", 4, &line);
    }
    fates(&mut paper, &study.records);
    mistakes(&mut paper, &study.records);
    failures(&mut paper, study);
    files(&mut paper, written);
    paper.into_text()
}

/// Folder by folder.
fn files(paper: &mut Paper, written: &[PathBuf]) {
    paper.heading("Written", "");
    for group in written.chunk_by(|a, b| a.parent() == b.parent()) {
        let folder = group[0].parent().unwrap_or(Path::new(""));
        let names: Vec<_> = group.iter().filter_map(|p| p.file_name()).map(|n| n.to_string_lossy()).collect();
        paper.line(&format!("  {}", folder.join("").display()));
        paper.paragraph(4, &names.join(", "));
    }
}

fn fates(paper: &mut Paper, records: &[Record]) {
    paper.heading("What became of the truths", "false: a claim that is not so, or not all of it");
    let mut table = Table::default();
    table.row(["kind", "trials", "right", "honest", "undecided", "missed", "false"]);
    for kind in Kind::ALL {
        let of_kind = || records.iter().filter(move |r| r.kind == kind);
        let count = |wanted: &[Fate]| of_kind().filter(|r| wanted.contains(&r.fate)).count().to_string();
        let single = [Fate::Right, Fate::Honest, Fate::Undecided, Fate::Missed].map(|fate| count(&[fate]));
        let claimed = count(&[Fate::Incomplete, Fate::FalseOutside, Fate::FalseName]);
        let start = [kind.name().to_owned(), of_kind().count().to_string()];
        table.row(start.into_iter().chain(single).chain([claimed]));
    }
    table.lines().iter().for_each(|line| paper.line(line));
}

fn mistakes(paper: &mut Paper, records: &[Record]) {
    let groups = hexbench_experiments::calibration::mistakes(records);
    if groups.is_empty() {
        return;
    }
    paper.heading("Largest groups of false answers", "trials, hidden -> answer, one of them");
    for group in groups.iter().take(GROUPS) {
        let example = group.trials.first().map_or("", |r| r.id.as_str());
        let label = format!("  {:>4}", group.trials.len());
        paper.hanging(&label, 8, &format!("{} -> {} ({example})", group.hidden, group.answer));
    }
}

fn failures(paper: &mut Paper, study: &Calibration) {
    if study.failures.is_empty() {
        return;
    }
    paper.heading("Without an answer", "");
    for (name, why) in &study.failures {
        paper.hanging("  -", 4, &format!("{name}: {why}"));
    }
}
