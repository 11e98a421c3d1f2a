//! Two results beside each other, for a browser.

use hexbench_model::runs::{ParameterChange, Run, Runs};
use hexbench_report::html::{Block, Cell, Mood, Page, Section};
use hexbench_report::number::percent;
use hexbench_report::plot::{Axis, Bars, Chart, Series};

use super::numbers::provenance;
use super::{Provenance, ReportError};
use crate::conclusion::in_words;
use crate::runs::{
    answer, changed, difference, error_sentence, legend, number, other_answer, probabilities, rungs,
};

/// Parameters of a chart of differences.
const MOST: usize = 40;

/// Differences that a chart shows, combined uncertainties.
const SEEN: f64 = 0.05;

/// The page of two results.
///
/// # Errors
/// [`ReportError`] when a chart cannot be made.
pub fn runs(runs: &Runs, from: &Provenance) -> Result<Page, ReportError> {
    let machine = runs.a.origin.as_ref().or(runs.b.origin.as_ref()).map_or("Two runs", |o| &o.machine);
    let sections = [
        Some(verdict(runs)),
        look_at(runs),
        confidence(runs),
        Some(errors(runs)?),
        stiffness(runs)?,
        parameters(runs)?,
        Some(provenance(from, &runs.a.noise_source)),
    ];
    Ok(Page {
        title: machine.to_owned(),
        subject: format!("two runs: A {} · B {}", runs.a.file, runs.b.file),
        sections: sections.into_iter().flatten().collect(),
    })
}

fn verdict(runs: &Runs) -> Section {
    let (word, mood) = if other_answer(runs) {
        ("ANOTHER ANSWER", Mood::Bad)
    } else if changed(runs) {
        ("CHANGED", Mood::Doubt)
    } else {
        ("THE SAME", Mood::Good)
    };
    let numbers = if runs.parameters.is_empty() { String::new() } else { format!(" {}", legend(runs)) };
    let text = format!("{}{numbers}", error_sentence(runs));
    let row = |name: &str, run: &Run| {
        let from = run.origin.as_ref().map_or("unknown", |o| &o.program);
        vec![Cell::new(name), Cell::words(answer(run)), Cell::words(&run.file), Cell::words(from)]
    };
    Section::new("verdict", "What changed from A to B", "")
        .with(Block::Verdict { word: word.to_owned(), mood, text })
        .with(Block::table(["", "answer", "file", "program"], [row("A", &runs.a), row("B", &runs.b)]))
}

fn look_at(runs: &Runs) -> Option<Section> {
    let items = || Block::list(runs.warnings.iter().cloned());
    (!runs.warnings.is_empty()).then(|| Section::new("look-at", "Look at this", "").with(items()))
}

fn confidence(runs: &Runs) -> Option<Section> {
    let row = |(id, [a, b]): &(String, [f64; 2])| {
        vec![
            Cell::new(in_words(id)),
            Cell::new(percent(*a)),
            Cell::bar(*a),
            Cell::new(percent(*b)),
            Cell::bar(*b),
        ]
    };
    let rows: Vec<Vec<Cell>> = probabilities(runs).map(row).collect();
    let header = ["at work, alone or with others", "A", "", "B", ""];
    (!rows.is_empty()).then(|| Section::new("confidence", "How sure", "").with(Block::table(header, rows)))
}

fn errors(runs: &Runs) -> Result<Section, ReportError> {
    let rows = rungs(runs).into_iter().map(|row| row.into_iter().map(Cell::new).collect());
    let table = Block::table(["model", "x noise", "um", "urad"], rows);
    let times = |run: &Run, last: bool| {
        let step = if last { run.steps.last() } else { run.steps.first() };
        step.map_or(0.0, |s| s.error().chi2_reduced.sqrt())
    };
    let of = |run: &Run| vec![times(run, false), times(run, true), 1.0];
    let names = ["first model", "final model", "noise"].map(str::to_owned).to_vec();
    let bars = Bars::new("", names, Axis::new("error", "x noise"))
        .with("A", of(&runs.a))
        .with("B", of(&runs.b))
        .with_size(720.0, 260.0);
    let remark = "Root mean square; held-out readings where there are some.";
    Ok(Section::new("ladder", "The error", remark)
        .with(table)
        .with(Block::figure(bars.to_svg()?, error_sentence(runs))))
}

/// Leg stiffnesses of both with twice their uncertainty.
fn stiffness(runs: &Runs) -> Result<Option<Section>, ReportError> {
    let of = |side: fn(&ParameterChange) -> Option<[f64; 2]>, shift: f64| -> (Vec<[f64; 2]>, Vec<f64>) {
        let leg = |k: usize| {
            let name = format!("leg-{}.stiffness", k + 1);
            let [value, std] = side(runs.parameters.iter().find(|p| p.name == name)?)?;
            Some(([k as f64 + 1.0 + shift, value], 2.0 * std))
        };
        (0..6).filter_map(leg).unzip()
    };
    let x = Axis::new("leg", "").with_range(0.5, 6.5).with_ticks((1..=6).map(f64::from).collect());
    let mut chart = Chart::new("", x, Axis::new("stiffness", "N/um")).with_size(720.0, 300.0);
    let sides = [("A", of(|p| p.a, -0.1)), ("B", of(|p| p.b, 0.1))];
    if sides.iter().all(|(_, (points, _))| points.is_empty()) {
        return Ok(None);
    }
    for (name, (points, errors)) in sides.into_iter().filter(|(_, (points, _))| !points.is_empty()) {
        chart = chart.with(Series::markers(name, points).with_errors(errors));
    }
    let caption = "Bars: twice the standard uncertainty to both sides.";
    Ok(Some(Section::new("stiffness", "Leg stiffness", "").with(Block::figure(chart.to_svg()?, caption))))
}

fn parameters(runs: &Runs) -> Result<Option<Section>, ReportError> {
    if runs.parameters.is_empty() {
        return Ok(None);
    }
    let row = |p: &ParameterChange| {
        let numbers = [number(p.a), number(p.b)].map(|n| Cell::new(n.replace("+-", "±")));
        let rest = [Cell::new(&p.unit), Cell::new(difference(p))];
        std::iter::once(Cell::new(&p.name)).chain(numbers).chain(rest).collect()
    };
    let remark = "Standard uncertainty (k = 1); B minus A in combined standard uncertainties.";
    let section = Section::new("parameters", "Parameters", remark)
        .with(Block::table(["parameter", "A", "B", "unit", "B − A"], runs.parameters.iter().map(row)))
        .with(Block::paragraph(legend(runs)));
    let (names, sigmas): (Vec<String>, Vec<f64>) =
        runs.parameters.iter().filter_map(|p| Some((p.name.clone(), p.sigmas?))).take(MOST).unzip();
    if sigmas.iter().all(|s| s.abs() < SEEN) {
        return Ok(Some(section));
    }
    let bars = Bars::new("", names, Axis::new("B − A", "combined uncertainties")).with("", sigmas);
    let caption = "Difference of every parameter that both have.";
    Ok(Some(section.with(Block::figure(bars.to_svg()?, caption))))
}
