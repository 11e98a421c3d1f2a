//! The charts of the page.

use hexbench_report::plot::{Axis, Bars, Chart, Panels, PlotError, Series};

use super::super::bench::sigma;
use super::super::curves::ValidationPose;
use super::super::published::{FIGURE_8_POINT, PREDICTION_ERROR, VALIDATION_MM};
use super::super::study::Reproduction;

const SYMBOLS: [(&str, &str); 6] =
    [("Δa", "µm"), ("Δb", "µm"), ("Δc", "µm"), ("Δα", "µrad"), ("Δβ", "µrad"), ("Δγ", "µrad")];

/// File names and charts.
pub(super) fn all(study: &Reproduction) -> Result<Vec<(&'static str, String)>, PlotError> {
    let [along_x, along_y] = &study.compared;
    let [hidden_x, hidden_y] = &study.hidden_compared;
    let (alone, hidden) = ("springs alone", "with a support that gives");
    Ok(vec![
        ("figure-7.svg", figure_7(study).to_svg()?),
        ("figure-8.svg", figure_8(study).to_svg()?),
        ("figure-9.svg", panels('X', along_x, alone).to_svg()?),
        ("figure-10.svg", panels('Y', along_y, alone).to_svg()?),
        ("table-4.svg", table_4(study).to_svg()?),
        ("figure-9-hidden.svg", panels('X', hidden_x, hidden).to_svg()?),
        ("figure-10-hidden.svg", panels('Y', hidden_y, hidden).to_svg()?),
    ])
}

fn figure_7(study: &Reproduction) -> Chart {
    let axes = (Axis::new("Vertical load", "N"), Axis::new("Observability index O1, SI", ""));
    let chart = Chart::new("Observability over load (Fig. 7)", axes.0, axes.1).with_size(720.0, 360.0);
    let curve = |chart: Chart, set: &super::super::curves::IndexOverLoad| {
        chart.with(Series::marked_line(format!("{}, our machine", set.name), set.points.clone()))
    };
    study.index_over_load.iter().fold(chart, curve)
}

fn figure_8(study: &Reproduction) -> Chart {
    let line = &study.linearity;
    let errors = vec![sigma()[2] * 1e6; line.ideal.len()];
    let chart = Chart::new(
        "Deflection over load at the zero pose (Fig. 8)",
        Axis::new("Load along Z, downwards", "N"),
        Axis::new("Deflection along Z, downwards", "µm"),
    )
    .with_size(720.0, 360.0)
    .with(Series::line("world, without noise", line.ideal.clone()));
    let [deflection, load] = FIGURE_8_POINT;
    let trial = |chart: Chart, (k, points): (usize, &Vec<[f64; 2]>)| {
        let series = Series::markers(format!("trial {}", k + 1), points.clone()).with_look(k + 1);
        chart.with(if k == 0 { series.with_errors(errors.clone()) } else { series })
    };
    let chart = line.trials.iter().enumerate().fold(chart, trial);
    chart.with(Series::line("paper, as read", vec![[0.0, 0.0], [load, deflection]]).as_reference())
}

fn panels(axis: char, compared: &[ValidationPose], world: &str) -> Panels {
    let figure = if axis == 'X' { 9 } else { 10 };
    let title = format!("Deflection along {axis}, {world} (Fig. {figure})");
    let panel = |k: usize| {
        let (symbol, unit) = SYMBOLS[k];
        let of = |value: fn(&ValidationPose) -> &[f64; 6]| -> Vec<[f64; 2]> {
            compared.iter().map(|c| [c.position_mm, value(c)[k]]).collect()
        };
        let band = compared.iter().map(|c| {
            let (mid, half) = (c.predicted[k], 2.0 * c.predicted_std[k]);
            [c.position_mm, mid - half, mid + half]
        });
        let reach = if k < 3 { 25.0 } else { 40.0 };
        let x = Axis::new(format!("{axis} position"), "mm").with_ticks(VALIDATION_MM.to_vec());
        Chart::new(symbol, x, Axis::new("", unit).with_range(-reach, reach))
            .with(Series::band("twice its uncertainty", band.collect()).with_look(0))
            .with(Series::line("predicted", of(|c| &c.predicted)).with_look(0))
            .with(
                Series::markers("measured, twice the noise", of(|c| &c.measured))
                    .with_errors(vec![2.0 * sigma()[k] * 1e6; compared.len()])
                    .with_look(1),
            )
    };
    (0..6).fold(Panels::new(title, 3), |panels, k| panels.with(panel(k)))
}

fn table_4(study: &Reproduction) -> Bars {
    let names = SYMBOLS.map(|(symbol, _)| symbol.to_owned()).to_vec();
    let in_noise = |rms: &[f64; 6]| (0..6).map(|k| rms[k] * 1e-6 / sigma()[k]).collect::<Vec<_>>();
    Bars::new("Error of prediction (Table 4)", names, Axis::new("Root mean square", "noise of one reading"))
        .with_size(720.0, 340.0)
        .with("paper", in_noise(&PREDICTION_ERROR))
        .with("springs alone, expected", in_noise(&study.springs.paper.expected))
        .with("with the support, expected", in_noise(&study.hidden_expected))
        .with("springs alone, weighted fit", in_noise(&study.springs.weighted.expected))
}
