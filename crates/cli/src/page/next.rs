//! What to measure next when the answer is open.

use hexbench_model::diagnose::{Diagnosis, NextReport};
use hexbench_model::terms::catalogue;
use hexbench_model::verdict::Verdict;

use super::conclusion::in_words;
use crate::output::Paper;
use crate::output::number::significant;

const LABEL: usize = 16;
/// Odds beyond which a number says no more than "overwhelming".
const OVERWHELMING: f64 = 1e4;

/// Readings that separate the rivals; else what makes each of them visible.
pub(crate) fn section(paper: &mut Paper, d: &Diagnosis) {
    if d.verdict != Verdict::Ambiguous {
        return;
    }
    let Some(first) = d.next.first() else { return in_general(paper, d) };
    let rivals = first.separates.each_ref().map(|id| in_words(id));
    paper.heading("What to measure next", &format!("to tell {} from {}", rivals[0], rivals[1]));
    for (k, reading) in d.next.iter().enumerate() {
        proposal(paper, k + 1, reading);
    }
    if !first.text.is_empty() {
        paper.hanging("  in words", LABEL, &first.text);
    }
    let frames =
        "Wrench on the platform at the mobile origin, fixed axes; one reading each, loaded minus reference.";
    paper.hanging("  frames", LABEL, frames);
}

fn proposal(paper: &mut Paper, number: usize, reading: &NextReport) {
    let [a, b, c, alpha, beta, gamma] = reading.pose.map(|x| format!("{:.1}", x + 0.0));
    let pose = format!("({a}, {b}, {c}) mm, ({alpha}, {beta}, {gamma}) deg");
    paper.hanging(&format!("  {number}  pose"), LABEL, &pose);
    paper.hanging("     load", LABEL, &load(&reading.wrench));
    if reading.reference.iter().any(|x| *x != 0.0) {
        paper.hanging("     reference", LABEL, &load(&reading.reference));
    }
    paper.hanging("     way", LABEL, &way(reading));
    paper.hanging("     gain", LABEL, &gain(reading.gain));
}

fn load(w: &[f64; 6]) -> String {
    let [fx, fy, fz, mx, my, mz] = w.map(|x| if x == 0.0 { "0".to_owned() } else { significant(x, 3) });
    format!("F ({fx}, {fy}, {fz}) N, M ({mx}, {my}, {mz}) N m")
}

fn way(reading: &NextReport) -> String {
    let approach = if reading.approach < 0.0 {
        "exceed the load by 40 % of its change and come back (approach -1)"
    } else {
        "load from below (approach +1)"
    };
    if reading.elapsed_s > 0.0 {
        return format!("{approach}; read {} s after the reference", significant(reading.elapsed_s, 2));
    }
    approach.to_owned()
}

/// Expected logarithm of the Bayes factor as odds.
fn gain(nats: f64) -> String {
    let odds = nats.exp();
    let odds = if odds > OVERWHELMING { "more than 10000".to_owned() } else { significant(odds, 2) };
    format!("shifts the odds between the two by a factor of about {odds}")
}

fn in_general(paper: &mut Paper, d: &Diagnosis) {
    paper.heading("What to measure next", "what shows each candidate");
    let terms = catalogue();
    let open = terms.iter().map(|t| t.info()).filter(|i| d.credible_set.iter().any(|id| id == i.id));
    for info in open {
        paper.hanging(&format!("  {}", info.id), 2 * LABEL, info.breaker);
    }
}
