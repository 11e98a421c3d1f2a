//! The study as a page of Markdown.

use super::correspondence::CORRESPONDENCES;
use super::study::Study;
use super::tables::{Table, summary, tables};

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
load / (k leg length) for springs, first order for what an effect adds; `crates/validation/src/recovery/noiseless.rs` derives
it). Absolute poses are closed exactly by world and model alike, so that only rounding remains there; deflections must *not*
agree to rounding. A coverage must lie within binomial bounds that a right estimator breaks with a chance of 7e-4, for
each row of a table divided by the number of rows; intervals of one campaign count as one trial.
";

/// The page.
pub fn document(study: &Study) -> String {
    let mut text = String::from(BEGINNING);
    text += &format!("\n{}\n", summary(study));
    for broken in &study.broken {
        text += &format!("\n- broken: {broken}\n");
    }
    for table in tables(study) {
        text += &section(&table);
    }
    text + &wrong_answers(study) + &correspondence()
}

fn section(table: &Table) -> String {
    let header: Vec<String> = table.header.iter().map(ToString::to_string).collect();
    let rule: Vec<String> =
        (0..header.len()).map(|k| if k == 0 { "---" } else { "---:" }.to_owned()).collect();
    let lines = [header, rule].into_iter().chain(table.rows.iter().cloned());
    let body: String = lines.map(|cells| format!("| {} |\n", cells.join(" | "))).collect();
    format!("\n## {}\n\n{}.\n\n{body}", table.title, capital(table.remark))
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

fn wrong_answers(study: &Study) -> String {
    let told: String = study
        .rows
        .iter()
        .flat_map(|row| row.wrong_answers.iter().map(move |a| format!("- {}: {a}\n", row.subject)))
        .collect();
    if told.is_empty() { String::new() } else { format!("\n## Wrong answers\n\n{told}") }
}

fn correspondence() -> String {
    let row = |c: &super::correspondence::Correspondence| {
        format!("| {} | `{}` | {} | {} |\n", c.effect, c.world, c.rule, c.differs)
    };
    let rows: String = CORRESPONDENCES.iter().map(row).collect();
    format!(
        "\n## Which number stands for which\n\nThe world's numbers are those of the case files, SI; the model's are those \
         of `hexbench terms`.\n\n| effect | world | model | what differs |\n| --- | --- | --- | --- |\n{rows}"
    )
}
