//! The study as a page.

use hexbench_report::words::written_by;
use hexbench_report::{Page, Section, Table};

use super::correspondence::{CORRESPONDENCES, Correspondence};
use super::study::{RecoveryRow, RecoveryStudy};
use super::tables::{summary, tables};

/// The page.
pub fn page(study: &RecoveryStudy) -> Page {
    let wrong = study
        .rows
        .iter()
        .flat_map(|r: &RecoveryRow| r.wrong_answers.iter().map(move |a| format!("{}: {a}", r.subject)));
    let page = Page::new("Recovery")
        .with(introduction().detail())
        .with(Section::new("In short").paragraph(summary(study)));
    tables(study)
        .into_iter()
        .fold(page, Page::with)
        .with(Section::new("Wrong answers").list(wrong).unless_empty())
        .with(Section::new("Not made or not fitted").list(study.failures.iter().cloned()).unless_empty())
        .with(Section::new("Broken bounds").list(study.broken.iter().cloned()).unless_empty())
        .with(correspondence().detail())
}

fn introduction() -> Section {
    Section::lead()
        .paragraph(written_by("hexbench validate recovery --markdown FILE"))
        .paragraph(
            "What the simulated world hides, the identification finds: leg stiffness, geometry and the size of every effect, with \
             95 % intervals that cover the truth in 95 % of the campaigns. World and model share no physics (see \
             `ARCHITECTURE.md`), so nothing here is an equation checked against itself.",
        )
        .paragraph(
            "Every campaign has a machine, leg stiffnesses, a plan, a noise level, an effect and a size of its own (distances 11, \
             22 and 45; usual sizes for joint geometry). The fit is told which effect is there: the first tables test the \
             estimator, not the search. The diagnosis is told nothing; its effects have distance 22.",
        )
        .paragraph(
            "Bounds: an error without noise must stay below `std |d|`, with `d` the linearization error of the readings (second \
             order in load / (k leg length) for springs, first order for what an effect adds; `recovery/noiseless.rs` derives \
             it). Absolute poses are closed exactly by world and model alike, so that only rounding remains there; deflections \
             must *not* agree to rounding. A coverage must lie within binomial bounds that a right estimator breaks with a chance \
             of 0.001, for each row of a table divided by the number of rows; intervals of one campaign count as one trial.",
        )
}

fn correspondence() -> Section {
    let cells = |c: &Correspondence| {
        [c.effect.to_owned(), format!("`{}`", c.world), c.rule.to_owned(), c.differs.to_owned()]
    };
    let table =
        Table::named(["effect", "world", "model", "what differs"]).words_in(1).words_in(2).words_in(3);
    Section::new("Which number stands for which")
        .paragraph(
            "The world's numbers are those of the case files, SI; the model's are those of `hexbench terms`.",
        )
        .table(table.rows(CORRESPONDENCES.iter().map(cells)))
}
