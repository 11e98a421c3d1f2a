//! The study as a page of Markdown.

use hexbench_report::Document;

use super::correspondence::CORRESPONDENCES;
use super::study::Study;
use super::tables::{summary, tables};

const BEGINNING: &str = "\
# Recovery

What the simulated world hides, the identification finds: leg stiffness, geometry and the size of every effect, with 95 %
intervals that cover the truth in 95 % of the campaigns. World and model share no physics (see `ARCHITECTURE.md`), so nothing
here is an equation checked against itself. This page is written by

```text
hexbench validate recovery --markdown docs/recovery.md
```

Every campaign has a machine, leg stiffnesses, a plan, a noise level, an effect and a size of its own (distances 11, 22 and
45; usual sizes for joint geometry). The fit is told which effect is there: the first tables test the estimator, not the
search. The diagnosis is told nothing; its effects have distance 22.

Bounds: an error without noise must stay below `std |d|`, with `d` the linearisation error of the readings (second order in
load / (k leg length) for springs, first order for what an effect adds; `crates/experiments/src/recovery/noiseless.rs` derives
it). Absolute poses are closed exactly by world and model alike, so that only rounding remains there; deflections must *not*
agree to rounding. A coverage must lie within binomial bounds that a right estimator breaks with a chance of 0.001, for
each row of a table divided by the number of rows; intervals of one campaign count as one trial.
";

/// The page.
pub fn document(study: &Study) -> String {
    let mut page = Document::default();
    page.paragraph(summary(study));
    if !study.broken.is_empty() {
        page.list(study.broken.iter().map(|broken| format!("broken: {broken}")));
    }
    for table in tables(study) {
        page.heading(2, table.title);
        page.paragraph(capital(table.remark) + ".");
        page.table(table.header.iter().map(ToString::to_string), table.rows.clone());
    }
    wrong_answers(&mut page, study);
    correspondence(&mut page);
    format!("{BEGINNING}\n{}", page.to_markdown())
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

fn wrong_answers(page: &mut Document, study: &Study) {
    let of_row = |row: &super::study::Row| {
        row.wrong_answers.iter().map(|a| format!("{}: {a}", row.subject)).collect::<Vec<_>>()
    };
    let told: Vec<String> = study.rows.iter().flat_map(of_row).collect();
    if !told.is_empty() {
        page.heading(2, "Wrong answers");
        page.list(told);
    }
}

fn correspondence(page: &mut Document) {
    page.heading(2, "Which number stands for which");
    page.paragraph(
        "The world's numbers are those of the case files, SI; the model's are those of `hexbench terms`.",
    );
    let cells = |c: &super::correspondence::Correspondence| {
        vec![c.effect.to_owned(), format!("`{}`", c.world), c.rule.to_owned(), c.differs.to_owned()]
    };
    page.table(["effect", "world", "model", "what differs"], CORRESPONDENCES.iter().map(cells));
}
