//! How sure: probabilities, and what looks alike.

use hexbench_model::diagnose::{CandidateReport, Diagnosis};
use hexbench_model::verdict::{NONE, OUTSIDE, Verdict};
use hexbench_report::number::percent;

use super::conclusion::{in_words, joined};
use crate::text::{Paper, bar};

/// Least probability that gets a line.
const WORTH_A_LINE: f64 = 0.03;
/// Least probability of a candidate whose look-alikes are listed.
const WORTH_SAYING: f64 = 0.01;
/// Most lines.
const MOST_LINES: usize = 7;
/// Columns of a bar of probability one.
const BAR: usize = 24;
const LABEL: usize = 34;

/// What the probabilities of effects mean beside something unknown.
pub const BESIDE_OUTSIDE: &str = "Beside something without a name the other lines say what helps to fit it, not what is \
                                         there: catalogue terms imitate it.";

/// Probabilities that each effect is at work, alone or beside others.
pub fn section(paper: &mut Paper, d: &Diagnosis) {
    paper.heading("How sure", "probability that each is at work, alone or with others");
    let all = probabilities(d);
    let shown =
        all.iter().take_while(|(_, p)| *p >= WORTH_A_LINE).take(MOST_LINES).count().max(1).min(all.len());
    for (id, p) in &all[..shown] {
        let bar = bar(*p, BAR);
        paper.line(&format!("  {:<width$}{:>6}  {bar}", in_words(id), percent(*p), width = LABEL - 2));
    }
    if let Some((_, next)) = all.get(shown) {
        let most = if *next < 0.01 { "below 1 %".to_owned() } else { format!("at most {}", percent(*next)) };
        paper.line(&format!("  {:<width$}{most}", "anything else, each", width = LABEL));
    }
    if d.verdict == Verdict::Outside && all.iter().any(|(id, p)| *p >= WORTH_A_LINE && id != OUTSIDE) {
        paper.paragraph(2, BESIDE_OUTSIDE);
    }
    look_alikes(paper, d);
}

/// Effects, something outside, and nothing at all, the most probable first.
pub fn probabilities(d: &Diagnosis) -> Vec<(String, f64)> {
    let mut all: Vec<(String, f64)> = d.present.iter().map(|(id, p)| (id.clone(), *p)).collect();
    let special = d.candidates.iter().filter(|c| c.term == NONE || c.term == OUTSIDE);
    all.extend(special.map(|c| (c.term.clone(), c.probability)));
    all.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    all
}

/// Groups that leave the same trace, among the candidates that matter.
fn look_alikes(paper: &mut Paper, d: &Diagnosis) {
    let alike = |c: &&CandidateReport| c.probability > WORTH_SAYING && !c.indistinguishable.is_empty();
    let mut told: Vec<&str> = Vec::new();
    for candidate in d.candidates.iter().filter(alike) {
        // Said of one, it is said of the other.
        if !candidate.indistinguishable.iter().all(|other| told.contains(&other.as_str())) {
            paper.paragraph(2, &likeness(d, candidate));
            told.push(&candidate.term);
        }
    }
}

fn likeness(d: &Diagnosis, candidate: &CandidateReport) -> String {
    let others = joined(&candidate.indistinguishable, "and");
    let (leave, explain) =
        if candidate.indistinguishable.len() == 1 { ("leaves", "explains") } else { ("leave", "explain") };
    if d.added.contains(&candidate.term) {
        return format!(
            "In these data {others} {leave} nearly the same trace as {} (alike to 95 % or more), but {explain} the \
             readings less well.",
            candidate.term
        );
    }
    format!("In these data {others} {leave} the same trace as {} (alike to 95 % or more).", candidate.term)
}
