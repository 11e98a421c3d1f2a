//! How sure: probabilities, and what looks alike.

use hexbench_core::words::joined;
use hexbench_model::inference::explanation::Explanation;
use hexbench_model::inference::importance::GaussianCheck;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::{CandidateReport, Diagnosis};

use super::conclusion::in_words;
use crate::number::{self, percent};
use crate::page::{Block, Cell, PageColumn, Section, Table};

/// Least probability that gets a row.
const WORTH_A_ROW: f64 = 0.01;
/// Most rows where there is little room.
const BRIEF: usize = 7;
/// Least probability of a candidate whose look-alikes are listed.
const WORTH_SAYING: f64 = 0.01;

/// What the probabilities of effects mean beside something unknown.
const BESIDE_OUTSIDE: &str = "If something outside the catalogue is present, the other rows show which terms help to \
                              imitate it, not which effects are present.";

/// Probabilities that each effect is at work, alone or beside others.
pub fn section(d: &Diagnosis) -> Section {
    let all = probabilities(d);
    let shown = all.iter().take_while(|(_, p)| *p >= WORTH_A_ROW).count().max(1).min(all.len());
    let row = |(e, p): &(Explanation, f64)| [Cell::from(in_words(e)), percent(*p).into(), Cell::bar(*p)];
    let columns = [PageColumn::words("effect"), PageColumn::number("probability"), PageColumn::bars()];
    let table = Table::new(columns).rows(all[..shown].iter().map(row)).brief(BRIEF);
    let beside =
        d.verdict == Verdict::Outside && all[..shown].iter().any(|(e, _)| *e != Explanation::Outside);
    Section::new("How sure")
        .id("confidence")
        .remark("probability that each is present, alone or with others")
        .table(table)
        .with((shown < all.len()).then(|| Block::paragraph("Every other explanation: below 1 %.")))
        .with(beside.then(|| Block::paragraph(BESIDE_OUTSIDE)))
        .with_all(d.gaussian_checks.iter().filter(|c| c.is_off()).map(|c| Block::paragraph(roughness(c))))
        .with_all(look_alikes(d).into_iter().map(Block::paragraph))
}

/// What is said where the evidence of a set rests on a Gaussian that is none.
fn roughness(check: &GaussianCheck) -> String {
    let factor = factor_of(check.log_evidence_change.abs());
    let direction = if check.log_evidence_change < 0.0 { "smaller" } else { "larger" };
    let heavy =
        if check.is_heavy() { "; a few draws dominate this estimate, so it is rough too" } else { "" };
    format!(
        "The probability of {} is rough: its parameters are far from Gaussian, and with {} draws its evidence is {factor} times \
         {direction}{heavy}.",
        joined(&check.terms),
        check.draws,
    )
}

/// `e` to this power, as people read it.
fn factor_of(nats: f64) -> String {
    const MOST_NATS: f64 = 9.0;
    if nats > MOST_NATS { "more than 8000".to_owned() } else { number::significant(nats.exp(), 2) }
}

/// Effects, something outside, and nothing at all, the most probable first.
pub fn probabilities(d: &Diagnosis) -> Vec<(Explanation, f64)> {
    let terms = d.present.iter().map(|(id, p)| (Explanation::Term(id.clone()), *p));
    let special = d.candidates.iter().filter(|c| c.term.term().is_none());
    let mut all: Vec<_> = terms.chain(special.map(|c| (c.term.clone(), c.probability))).collect();
    all.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    all
}

/// Groups of nearly the same signature, among the candidates that matter.
fn look_alikes(d: &Diagnosis) -> Vec<String> {
    let alike = |c: &&CandidateReport| c.probability > WORTH_SAYING && !c.indistinguishable.is_empty();
    let mut said: Vec<&str> = Vec::new();
    let mut sentences = Vec::new();
    for candidate in d.candidates.iter().filter(alike) {
        // Said of one, it is said of the other.
        let is_new = |other: &&str| !said.contains(other);
        let others: Vec<&str> =
            candidate.indistinguishable.iter().map(String::as_str).filter(is_new).collect();
        if !others.is_empty() {
            sentences.push(likeness(d, candidate, &others));
            said.extend(candidate.term.term());
        }
    }
    sentences
}

fn likeness(d: &Diagnosis, candidate: &CandidateReport, others: &[&str]) -> String {
    let (have, are) = if others.len() == 1 { ("has", "is") } else { ("have", "are") };
    let is_added = d.added.iter().any(|id| candidate.term.is_term(id));
    let rarer = if is_added { format!(", but {are} less probable") } else { String::new() };
    format!(
        "In these data {} {have} nearly the same signature as {} (similarity 95 % or more){rarer}.",
        joined(others),
        candidate.term
    )
}
