//! A comparison as a short page of Markdown, as it fits the summary of a job.

use hexbench_report::Document;

use super::comparison::{Comparison, Finding, probability};
use super::rule::Verdict;

/// Limits shown beside those that fail or improved.
const SHOWN: usize = 5;

/// One line: what was compared and what came of it.
pub fn headline(c: &Comparison) -> String {
    let worse = c.of(Verdict::Worse).count();
    let better = c.of(Verdict::Better).count();
    let verdict = match (worse, better) {
        (0, 0) => "no change beyond chance".to_owned(),
        (0, n) => format!("{n} better than the baseline beyond chance: consider --update"),
        (n, _) => format!("{n} worse than the baseline beyond chance"),
    };
    format!("{} limits over {} campaigns, seed {}: {verdict}.", c.findings.len(), c.campaigns, c.seed)
}

/// What the run was compared with.
pub fn against(c: &Comparison) -> String {
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
        update.reason.trim().trim_end_matches('.'),
    )
}

/// The rule in one sentence.
pub fn rule(c: &Comparison) -> String {
    format!(
        "A limit fails when so large a change for the worse has a probability below {} by chance; an unchanged program fails \
         with at most {}.",
        probability(c.level),
        probability(c.false_alarm),
    )
}

/// The page: failures with what to do, what improved, the least probable others.
pub fn markdown(c: &Comparison) -> String {
    let mut page = Document::default();
    let sign = if c.fails() { "failed" } else { "passed" };
    page.heading(2, format!("Accuracy regression: {sign}"));
    page.paragraph(headline(c));
    page.paragraph(against(c));
    section(&mut page, "Worse than chance explains", c.of(Verdict::Worse).collect());
    if c.fails() {
        let mut steps: Vec<&str> = c.of(Verdict::Worse).map(|f| f.group.next_step()).collect();
        steps.dedup();
        page.list(steps);
        page.paragraph("Meant? `hexbench regress --update --reason TEXT` makes this the baseline.");
    }
    section(&mut page, "Better than chance explains", c.of(Verdict::Better).collect());
    let others = c.by_chance().into_iter().filter(|f| f.verdict == Verdict::Same);
    section(&mut page, "The least probable of the others", others.take(SHOWN).collect());
    if !c.without_answer.is_empty() {
        page.heading(3, "Campaigns without an answer");
        page.list(c.without_answer.iter().take(SHOWN).cloned());
    }
    page.paragraph(rule(c));
    page.to_markdown()
}

fn section(page: &mut Document, title: &str, findings: Vec<&Finding>) {
    if findings.is_empty() {
        return;
    }
    page.heading(3, title);
    page.table(["limit", "now", "baseline", "by chance"], findings.into_iter().map(row));
}

/// Title, figures and probability of a finding.
pub fn row(f: &Finding) -> Vec<String> {
    let chance = f.chance.map_or_else(|| "-".to_owned(), probability);
    vec![f.title.clone(), f.now.clone(), f.before.clone(), chance]
}
