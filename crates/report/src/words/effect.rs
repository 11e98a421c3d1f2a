//! One effect of the catalogue, explained.

use hexbench_model::effects::term::{Need, Rich, TermInfo};

use crate::number::significant;
use crate::page::{Block, Definition, Page, PageColumn, Section, Table};

/// Physics, equation, parameters with units, needs, source, what makes it visible, and its size where one is usual.
pub fn page(info: &TermInfo, size: Option<String>) -> Page {
    let entries = [
        ("physics", info.physics.to_owned()),
        ("model", info.equation.to_owned()),
        ("visible", format!("when {}", info.shows)),
        ("to isolate it", info.how_to_isolate.to_owned()),
        ("needs", needs(info)),
        ("richer", rich(info.rich).to_owned()),
        ("source", info.source.to_owned()),
    ];
    let entries = entries.into_iter().chain(size.map(|size| ("size", size)));
    let about = Section::new(info.id).remark(info.title);
    let parameters =
        Section::new("Parameters").remark("identified from the data; values below zero only where allowed");
    Page::default()
        .with(about.with(Block::entries(entries.map(|(label, text)| Definition::new(label, text)))))
        .with(parameters.table(table(info)))
}

fn table(info: &TermInfo) -> Table {
    let mut table = Table::new(["", "", ""].map(PageColumn::words));
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
        Need::Approach => "approach or order",
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
