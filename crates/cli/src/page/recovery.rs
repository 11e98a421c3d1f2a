//! The page of `hexbench validate recovery`.

use hexbench_experiments::recovery::study::Study;
use hexbench_experiments::recovery::tables::{summary, tables};
use hexbench_pages::text::{Ink, Paper, Table};

/// Tables, broken bounds, and a line that sums up.
pub(crate) fn recovery(study: &Study, ink: Ink) -> String {
    let mut paper = Paper::new(ink);
    for table in tables(study) {
        paper.heading(table.title, table.remark);
        let mut lines = Table::default();
        lines.row(table.header);
        table.rows.into_iter().for_each(|row| lines.row(row));
        lines.lines().iter().for_each(|line| paper.line(line));
    }
    told(
        &mut paper,
        "Wrong answers",
        study.rows.iter().flat_map(|r| r.wrong_answers.iter().map(move |a| format!("{}: {a}", r.subject))),
    );
    told(&mut paper, "Not made or not fitted", study.failures.iter().cloned());
    told(&mut paper, "Broken bounds", study.broken.iter().cloned());
    paper.heading("Summary", "");
    paper.paragraph(2, &summary(study));
    paper.into_text()
}

fn told(paper: &mut Paper, heading: &str, lines: impl Iterator<Item = String>) {
    let lines: Vec<String> = lines.collect();
    if lines.is_empty() {
        return;
    }
    paper.heading(heading, "");
    for line in &lines {
        paper.hanging("  -", 4, line);
    }
}
