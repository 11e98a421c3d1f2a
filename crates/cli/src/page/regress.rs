//! The page of `hexbench regress`.

use hexbench_experiments::regress::comparison::{Comparison, Finding, probability};
use hexbench_experiments::regress::limit::Group;
use hexbench_experiments::regress::rule::Verdict;
use hexbench_experiments::regress::summary::{against, headline, rule};
use hexbench_pages::text::{Ink, Paper};

/// Limits shown beside those that fail or improved.
const SHOWN: usize = 5;

/// What was compared, what failed or improved, and the least probable others or all.
pub(crate) fn regress(c: &Comparison, all: bool, ink: Ink) -> String {
    let mut paper = Paper::new(ink);
    paper.heading("Baseline", "");
    paper.paragraph(2, &against(c));
    section(&mut paper, "Worse than chance explains", "", c.of(Verdict::Worse).collect());
    let consider = "`hexbench regress --update --reason TEXT` makes them the baseline";
    section(&mut paper, "Better than chance explains", consider, c.of(Verdict::Better).collect());
    if all {
        for group in Group::ALL {
            let of_group = c.findings.iter().filter(|f| f.group == group);
            section(&mut paper, group.word(), "", of_group.collect());
        }
    } else {
        let others = c.by_chance().into_iter().filter(|f| f.verdict == Verdict::Same).take(SHOWN);
        section(&mut paper, "The least probable of the others", "--all shows every limit", others.collect());
    }
    if !c.without_answer.is_empty() {
        paper.heading("Campaigns without an answer", "");
        c.without_answer.iter().take(SHOWN).for_each(|line| paper.hanging("  -", 4, line));
    }
    paper.heading("Summary", "");
    paper.paragraph(2, &headline(c));
    paper.paragraph(2, &rule(c));
    if c.fails() {
        paper.paragraph(2, "Meant? `hexbench regress --update --reason TEXT` makes this the baseline.");
    }
    paper.into_text()
}

fn section(paper: &mut Paper, title: &str, remark: &str, findings: Vec<&Finding>) {
    if findings.is_empty() {
        return;
    }
    paper.heading(title, remark);
    for finding in findings {
        tell(paper, finding);
    }
}

fn tell(paper: &mut Paper, f: &Finding) {
    let ink = paper.ink();
    let title = match f.verdict {
        Verdict::Worse => ink.bad(&f.title),
        Verdict::Better => ink.good(&f.title),
        Verdict::Same => f.title.clone(),
    };
    paper.hanging("  -", 4, &title);
    let chance = f.chance.map(|p| format!("; by chance {}", probability(p))).unwrap_or_default();
    paper.paragraph(6, &format!("now {}, baseline {}{chance}; would notice {}", f.now, f.before, f.notices));
    if f.verdict == Verdict::Worse {
        paper.paragraph(6, &f.why);
        paper.paragraph(6, &format!("next: {}", f.group.next_step()));
    }
}
