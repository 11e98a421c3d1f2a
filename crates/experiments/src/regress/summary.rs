//! A comparison as a page: for the terminal, and as Markdown for the summary of a job.

use hexbench_report::{Page, Section};

use super::cases::UPDATE;
use super::comparison::{LimitOutcome, RunComparison};
use super::limit::LimitGroup;
use crate::alarm::table::section;
use crate::alarm::{LimitVerdict, probability};

/// Limits shown beside those that fail or improved.
const SHOWN: usize = 5;

/// One line: what was compared and what came of it.
pub fn headline(c: &RunComparison) -> String {
    let worse = c.of(LimitVerdict::Worse).count();
    let better = c.of(LimitVerdict::Better).count();
    let verdict = match (worse, better) {
        (0, 0) => "no significant change".to_owned(),
        (0, n) => format!("{n} significantly better than the baseline: consider --update"),
        (n, _) => format!("{n} significantly worse than the baseline"),
    };
    format!("{} limits over {} campaigns, seed {}: {verdict}.", c.findings.len(), c.campaigns, c.seed)
}

/// What the run was compared with.
pub fn against(c: &RunComparison) -> String {
    let Some(update) = &c.baseline else { return String::new() };
    let same = c.same_values().map_or_else(String::new, |n| {
        format!(" {n} of {} limits have the same values as its first run, bit for bit.", c.findings.len())
    });
    format!(
        "Baseline of {}, hexbench {}, {} runs from seed {}: {}.{same}",
        update.date,
        update.hexbench,
        update.runs,
        update.seed,
        update.reason(),
    )
}

/// The rule in one sentence.
pub fn rule(c: &RunComparison) -> String {
    format!(
        "A limit fails when so large a change for the worse has a probability below {} by chance; an unchanged program fails \
         with at most {}.",
        probability(c.level),
        probability(c.false_alarm),
    )
}

/// The page: failures with what to do, what improved, the least probable others or every limit.
pub fn page(c: &RunComparison, all: bool) -> Page {
    let sign = if c.fails() { "failed" } else { "passed" };
    let worse: Vec<&LimitOutcome> = c.of(LimitVerdict::Worse).collect();
    let meant = format!("Meant? `{UPDATE}` makes this the baseline.");
    let page = Page::new(format!("Accuracy regression: {sign}"))
        .with(Section::lead().paragraph(headline(c)).paragraph(against(c)))
        .with(section("Worse than chance explains", &worse))
        .with(Section::new("What to do").list(steps(&worse)).paragraph(meant).when(c.fails()))
        .with(
            section("Better than chance explains", &c.of(LimitVerdict::Better).collect::<Vec<_>>())
                .map(|s| s.remark(format!("`{UPDATE}` makes them the baseline"))),
        );
    let page = if all {
        let of_group =
            |group: &LimitGroup| c.findings.iter().filter(|f| f.group == *group).collect::<Vec<_>>();
        LimitGroup::ALL.iter().fold(page, |page, group| page.with(section(group.word(), &of_group(group))))
    } else {
        let others: Vec<&LimitOutcome> =
            c.by_chance().into_iter().filter(|f| f.verdict == LimitVerdict::Same).take(SHOWN).collect();
        page.with(
            section("The least probable of the others", &others).map(|s| s.remark("--all shows every limit")),
        )
    };
    let unanswered = c.without_answer.iter().take(SHOWN).cloned();
    page.with(Section::new("Campaigns without an answer").list(unanswered).unless_empty())
        .with(Section::new("The rule").paragraph(rule(c)))
}

/// Why each failed limit matters, and the next step of each group.
fn steps(worse: &[&LimitOutcome]) -> Vec<String> {
    let mut steps: Vec<String> = worse.iter().map(|f| format!("next: {}", f.group.next_step())).collect();
    steps.dedup();
    worse.iter().map(|f| format!("{}: {}", f.title, f.why)).chain(steps).collect()
}
