//! Leg stiffnesses, and what leaving an effect out does to them.

use hexbench_core::Hexapod;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::{AbsorbedReport, Diagnosis};

use super::plus_minus::Wide;
use crate::number::with_uncertainty;
use crate::page::{Block, Section, Table};

/// Rows before those of effects left out: stiffness and uncertainty.
const NUMBERS: usize = 2;
/// Change below which nothing is left of a stiffness, percent.
const ALL_OF_IT: f64 = -100.0;

/// Stiffness per leg with uncertainty, then the bias per effect left out.
pub(super) fn section(hexapod: &Hexapod, d: &Diagnosis, wide: &Wide) -> Section {
    let over =
        if d.verdict == Verdict::Outside { "" } else { ", averaged over all explanations that remain" };
    let of = format!("N/um, {}{over}", wide.remark());
    let nominal = hexapod.nominal_stiffness.map(|k| legs("nominal", k.map(|k| format!("{:.3}", k * 1e-6))));
    let (first, others): (Vec<_>, Vec<_>) = d.absorbed.iter().partition(|a| matters(d, a));
    let brief = NUMBERS + nominal.iter().len() + first.len();
    let table =
        numbers(d, wide).rows(nominal).rows(first.iter().chain(&others).map(|a| bias(a))).brief(brief);
    let mut all = d.absorbed.iter().flat_map(|a| a.bias_of_leg_stiffness_percent).flatten();
    let negative = if all.any(|b| b < ALL_OF_IT) { " Negative: k would be below zero." } else { "" };
    let absorbed = format!(
        "Rows in %: change of k when the effect is omitted from the model and the springs absorb part of it.{negative}"
    );
    let biased = "These values are biased by what is missing: the uncertainties include only what remains unexplained in each leg.";
    let series = "k is the stiffness along the leg of everything in series that carries the leg force: spring, screw, \
                  joints, and mounts insofar as they yield along the leg.";
    Section::new("Leg stiffness")
        .id("stiffness")
        .remark(of)
        .table(table)
        .paragraph(series)
        .with((!d.absorbed.is_empty()).then(|| Block::paragraph(absorbed)))
        .with((d.verdict == Verdict::Outside).then(|| Block::paragraph(biased)))
}

/// A row of a name and a cell for each leg.
fn legs(name: &str, cells: [String; 6]) -> Vec<String> {
    std::iter::once(name.to_owned()).chain(cells).collect()
}

fn numbers(d: &Diagnosis, wide: &Wide) -> Table {
    let known: [Option<[String; 2]>; 6] = std::array::from_fn(|leg| stiffness(d, leg, wide));
    let part = |which: usize, open: &str| {
        std::array::from_fn(|leg| known[leg].as_ref().map_or(open.to_owned(), |k| k[which].clone()))
    };
    let header = legs("leg", std::array::from_fn(|leg| (leg + 1).to_string()));
    Table::named(header).rows([legs("k", part(0, "open")), legs("+-", part(1, "-"))])
}

fn stiffness(d: &Diagnosis, leg: usize, wide: &Wide) -> Option<[String; 2]> {
    d.stiffness(leg).map(|p| with_uncertainty(p.value, wide.factor * p.std))
}

/// Effects of the model, and rivals when the answer is open.
fn matters(d: &Diagnosis, report: &AbsorbedReport) -> bool {
    let rival = d.verdict == Verdict::Ambiguous && d.credible_set.iter().any(|e| e.is_term(&report.term));
    rival || d.model.contains(&report.term)
}

fn bias(report: &AbsorbedReport) -> Vec<String> {
    let cell = |b: Option<f64>| match b {
        None => "-".to_owned(),
        Some(b) if b < ALL_OF_IT => "negative".to_owned(),
        Some(b) => format!("{b:+.1} %"),
    };
    legs(&format!("no {}", report.term), report.bias_of_leg_stiffness_percent.map(cell))
}
