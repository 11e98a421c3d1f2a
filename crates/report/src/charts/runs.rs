//! Charts of two results beside each other.

use hexbench_model::estimation::parameters::stiffness_name;
use hexbench_model::results::runs::{ComparedRuns, ParameterChange, Run};

use super::ReportError;
use crate::page::{Block, Figure, Page, Section};
use crate::plot::{Axis, Bars, Chart, Series};
use crate::words::{self, Provenance};

/// Parameters of a chart of differences.
const MOST: usize = 40;
/// Differences that a chart shows, combined uncertainties.
const SEEN: f64 = 0.05;

/// The page of two results with its charts.
///
/// # Errors
/// [`ReportError`] when a chart cannot be made.
pub fn runs(runs: &ComparedRuns, from: &Provenance) -> Result<Page, ReportError> {
    let mut page =
        words::runs(runs).with_after("ladder", stiffness(runs)?).with(from.section(runs.a.noise_source));
    for (id, chart) in [("ladder", errors(runs)?), ("parameters", differences(runs)?)] {
        if let (Some(section), Some(chart)) = (page.section_mut(id), chart) {
            section.blocks.push(chart);
        }
    }
    Ok(page)
}

/// Beside each other where they can be compared.
fn errors(runs: &ComparedRuns) -> Result<Option<Block>, ReportError> {
    if runs.error.is_none() || runs.noise_changed {
        return Ok(None);
    }
    let times = |run: &Run, last: bool| {
        let step = if last { run.steps.last() } else { run.steps.first() };
        step.map_or(0.0, |s| s.error().times_noise())
    };
    let of = |run: &Run| vec![times(run, false), times(run, true), 1.0];
    let names = ["first model", "final model", "noise"].map(str::to_owned).to_vec();
    let bars = Bars::new("", names, Axis::new("error", "x noise"))
        .with("A", of(&runs.a))
        .with("B", of(&runs.b))
        .with_size(720.0, 260.0);
    let caption = "Error of the first and of the final model of each run.";
    Ok(Some(Block::Figure(Figure::laid_out(bars.laid_out()?, caption))))
}

/// Leg stiffnesses of both with twice their uncertainty.
fn stiffness(runs: &ComparedRuns) -> Result<Option<Section>, ReportError> {
    let of = |side: fn(&ParameterChange) -> Option<[f64; 2]>, shift: f64| -> (Vec<[f64; 2]>, Vec<f64>) {
        let leg = |k: usize| {
            let name = stiffness_name(k);
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
    let caption = "Error bars: plus and minus two standard uncertainties.";
    let figure = Figure::laid_out(chart.laid_out()?, caption);
    Ok(Some(Section::new("Leg stiffness").id("stiffness").with(Block::Figure(figure))))
}

fn differences(runs: &ComparedRuns) -> Result<Option<Block>, ReportError> {
    let (names, sigmas): (Vec<String>, Vec<f64>) =
        runs.parameters.iter().filter_map(|p| Some((p.name.clone(), p.sigmas?))).take(MOST).unzip();
    if sigmas.iter().all(|s| s.abs() < SEEN) {
        return Ok(None);
    }
    let bars = Bars::new("", names, Axis::new("B − A", "combined uncertainties")).with("", sigmas);
    let caption = "Difference of every parameter that both runs have.";
    Ok(Some(Block::Figure(Figure::laid_out(bars.laid_out()?, caption))))
}
