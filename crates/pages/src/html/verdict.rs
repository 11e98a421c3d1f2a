//! The answer: verdict, error on held-out poses, probabilities.

use hexbench_model::diagnose::{Diagnosis, StepReport};
use hexbench_model::verdict::{OUTSIDE, Verdict};
use hexbench_report::html::{Block, Cell, Mood, Section};
use hexbench_report::number::{percent, significant};

use crate::{conclusion, confidence, ladder as rungs};

/// Names of the measured numbers, translations first.
const COORDINATES: [&str; 6] = ["a um", "b um", "c um", "alpha urad", "beta urad", "gamma urad"];

/// The verdict in a sentence.
pub(crate) fn verdict(d: &Diagnosis) -> Section {
    let mood = match d.verdict {
        Verdict::Adequate | Verdict::Named => Mood::Good,
        Verdict::Ambiguous => Mood::Doubt,
        Verdict::Outside => Mood::Bad,
    };
    let word = conclusion::word(d.verdict).to_uppercase();
    let text = conclusion::sentences(d).join(" ");
    Section::new("verdict", "Verdict", "").with(Block::Verdict { word, mood, text })
}

/// The error on held-out poses, step by step, beside the noise.
pub(crate) fn ladder(d: &Diagnosis) -> Section {
    let title = if d.steps.len() > 1 { "The error falls" } else { "The error" };
    let header = ["model", "x noise", "", "um", "urad"].into_iter().chain(COORDINATES);
    let largest = d.steps.iter().map(times).fold(1.0, f64::max);
    let mut rows: Vec<Vec<Cell>> = d.steps.iter().map(|s| rung(s, largest)).collect();
    let (t, r) = (d.noise.translation_um, d.noise.rotation_urad);
    let noise = [t, r, t, t, t, r, r, r].map(|x| Cell::new(significant(x, 3)));
    let name = [Cell::new("noise of one reading"), Cell::new("1.00"), Cell::bar(1.0 / largest)];
    rows.push(name.into_iter().chain(noise).collect());
    Section::new("ladder", title, rungs::how_held_out(d)).with(Block::table(header, rows))
}

fn times(step: &StepReport) -> f64 {
    step.holdout.unwrap_or(step.fitted).chi2_reduced.sqrt()
}

fn rung(step: &StepReport, largest: f64) -> Vec<Cell> {
    let error = step.holdout.unwrap_or(step.fitted);
    let name = [Cell::new(rungs::name(step)), Cell::new(rungs::multiple(times(step)))];
    let sizes = [error.rms.translation_um, error.rms.rotation_urad].into_iter().chain(error.per_coordinate);
    let bar = Cell::bar(times(step) / largest);
    name.into_iter().chain([bar]).chain(sizes.map(|x| Cell::new(significant(x, 3)))).collect()
}

/// Probabilities, and what looks alike.
pub(crate) fn confidence(d: &Diagnosis) -> Section {
    const WORTH_A_ROW: f64 = 0.005;
    let all = confidence::probabilities(d);
    let shown = all.iter().enumerate().filter(|(k, (_, p))| *k == 0 || *p >= WORTH_A_ROW);
    let row = |(id, p): &(String, f64)| {
        vec![
            Cell::new(conclusion::in_words(id)),
            Cell::new(percent(*p)),
            Cell::bar(*p),
            Cell::words(alike(d, id)),
        ]
    };
    let rows = shown.map(|(_, one)| row(one));
    let table =
        Block::table(["at work, alone or with others", "chance", "", "looks the same in these data"], rows);
    let section = Section::new("confidence", "How sure", "").with(table);
    if d.verdict == Verdict::Outside && all.iter().any(|(id, p)| *p >= WORTH_A_ROW && id != OUTSIDE) {
        return section.with(Block::paragraph(confidence::BESIDE_OUTSIDE));
    }
    section
}

fn alike(d: &Diagnosis, id: &str) -> String {
    let known = d.candidates.iter().find(|c| c.term == id);
    known.map(|c| c.indistinguishable.join(", ")).unwrap_or_default()
}
