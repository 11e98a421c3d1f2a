//! One effect of the catalogue, explained.

use hexbench_model::term::{Need, Rich, TermInfo};
use hexbench_report::number::significant;

use crate::text::{Ink, Paper, Table};

const LABEL: usize = 12;

/// Physics, equation, parameters with units, needs, source, and what makes it visible.
pub fn text(info: &TermInfo, ink: Ink) -> String {
    let mut paper = Paper::new(ink);
    paper.heading(info.id, info.title);
    paper.hanging("  physics", LABEL, info.physics);
    paper.hanging("  model", LABEL, info.equation);
    paper.hanging("  visible", LABEL, &format!("when {}", info.shows));
    paper.hanging("  to see it", LABEL, info.breaker);
    paper.hanging("  needs", LABEL, &needs(info));
    paper.hanging("  richer", LABEL, rich(info.rich));
    paper.hanging("  source", LABEL, info.source);
    paper.heading("Parameters", "identified from the data; values below zero only where allowed");
    parameters(info).left(1).lines().iter().for_each(|line| paper.line(line));
    paper.into_text()
}

fn parameters(info: &TermInfo) -> Table {
    let mut table = Table::default();
    for p in info.parameters {
        let sign = if p.positive { "> 0" } else { "any sign" };
        table.row([p.name, p.unit, sign]);
    }
    if let Some(shape) = info.shape {
        let [low, high] = shape.bounds.map(|b| significant(b * shape.per_si, 3));
        table.row([shape.name, shape.unit, &format!("{low} to {high}")]);
    }
    table
}

/// What the file must hold, in words.
pub fn needs(info: &TermInfo) -> String {
    let words: Vec<&str> = info.needs.iter().map(|n| need(*n)).collect();
    if words.is_empty() { "deflections or absolute poses, no extra column".into() } else { words.join(", ") }
}

fn need(need: Need) -> &'static str {
    match need {
        Need::Absolute => "absolute poses (measured_a_mm ...)",
        Need::Approach => "approach",
        Need::DeltaT => "delta_T_K",
        Need::Elapsed => "elapsed_s",
        Need::Brackets => "legs that share a bracket ([legs] brackets)",
        Need::Loads => "two load states at the same pose",
    }
}

/// What the richer form allows, in words.
pub fn rich(rich: Rich) -> &'static str {
    match rich {
        Rich::None => "none",
        Rich::PerLeg => "the size may differ from leg to leg",
        Rich::Full => "a full symmetric 6x6 compliance instead of six springs",
    }
}
