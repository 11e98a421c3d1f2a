//! Are the residuals noise? Histogram and normal plot of the whitened residuals.

use crate::page::Section;
use crate::plot::{Axis, Chart, Panels, Series};
use hexbench_model::estimation::scatter::ResidualScatter;
use statrs::distribution::{Continuous, Normal};

use super::ReportError;
use super::data::Data;
use super::figures::sheet;

/// Both charts, a curve for each model.
pub(crate) fn section(data: &Data<'_>) -> Result<Section, ReportError> {
    let mut histogram =
        Chart::new("", Axis::new("residual in units of the noise", ""), Axis::new("density", ""))
            .with(Series::line("noise alone", bell()).as_reference());
    let mut normal =
        Chart::new("", Axis::new("expected from noise", ""), Axis::new("residual in units of the noise", ""))
            .with(Series::line("noise alone", vec![[-3.0, -3.0], [3.0, 3.0]]).as_reference());
    for (name, look, seen) in data.models() {
        let scatter = ResidualScatter::of(&seen.judged.rows);
        histogram = histogram.with(Series::line(name, scatter.histogram()).with_look(look));
        normal = normal.with(Series::markers(name, scatter.quantiles()).with_look(look));
    }
    let panels = Panels::new("", 2).with_panel_size(450.0, 280.0).with(histogram).with(normal);
    let caption =
        "Distribution of the residuals, and their normal plot, in which pure noise lies on the line.";
    let remark = "Residuals of single readings divided by the stated noise.";
    Ok(Section::new("Are the residuals noise?")
        .id("scatter")
        .remark(remark)
        .with(sheet("", &panels, caption)?))
}

fn bell() -> Vec<[f64; 2]> {
    let law = Normal::standard();
    (-24..=24).map(|k| f64::from(k) * 0.25).map(|x| [x, law.pdf(x)]).collect()
}
