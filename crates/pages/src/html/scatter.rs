//! Are the residuals noise? Histogram and normal plot of the whitened residuals.

use hexbench_model::scatter::Scatter;
use hexbench_report::html::{Block, Section};
use hexbench_report::plot::{Axis, Chart, Panels, Series};
use statrs::distribution::{Continuous, Normal};

use super::ReportError;
use super::data::Data;
use super::figures::{FINAL, SPRINGS};

/// Both charts, before and after.
pub(crate) fn section(data: &Data) -> Result<Section, ReportError> {
    let before = Scatter::of(&data.before.readings);
    let mut histogram =
        Chart::new("", Axis::new("residual in units of the noise", ""), Axis::new("share per unit", ""))
            .with(Series::line("noise alone", bell()).as_reference())
            .with(Series::line("springs alone", before.histogram()).with_look(SPRINGS));
    let mut normal =
        Chart::new("", Axis::new("expected of noise", ""), Axis::new("residual in units of the noise", ""))
            .with(Series::line("noise alone", vec![[-3.0, -3.0], [3.0, 3.0]]).as_reference())
            .with(Series::markers("springs alone", before.quantiles()).with_look(SPRINGS));
    if let Some(after) = &data.after {
        let after = Scatter::of(&after.readings);
        histogram =
            histogram.with(Series::line("with the added effects", after.histogram()).with_look(FINAL));
        normal = normal.with(Series::markers("with the added effects", after.quantiles()).with_look(FINAL));
    }
    let panels = Panels::new("", 2).with_panel_size(450.0, 280.0).with(histogram).with(normal);
    let caption =
        "Left: how often residuals of a size occur. Right: normal plot; noise alone lies on the line.";
    let remark = "Residuals of single readings over the stated noise.";
    Ok(Section::new("scatter", "Are the residuals noise?", remark)
        .with(Block::figure(&panels.to_svg()?, caption)))
}

fn bell() -> Vec<[f64; 2]> {
    let law = Normal::standard();
    (-24..=24).map(|k| f64::from(k) * 0.25).map(|x| [x, law.pdf(x)]).collect()
}
