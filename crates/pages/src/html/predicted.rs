//! Predicted against measured, coordinate by coordinate, reading by reading.

use hexbench_core::Dataset;
use hexbench_model::fit::Fit;
use hexbench_model::residuals::{Residual, prediction_errors};
use hexbench_report::html::{Block, Section};
use hexbench_report::plot::{Axis, Chart, Panels, Series};

use super::ReportError;
use super::data::Data;
use super::figures::{FINAL, MEASURED, SPRINGS};
use crate::Subject;

/// Readings a panel can show apart.
const MOST: usize = 120;
const NAMES: [&str; 6] = ["a", "b", "c", "alpha", "beta", "gamma"];

/// Readings and what both models say of them.
struct Shown<'a> {
    rows: &'a Dataset,
    before: Vec<Residual>,
    after: Option<Vec<Residual>>,
    what: &'static str,
}

/// Held-out readings where there is a file of them, else the fitted ones.
pub(crate) fn section(subject: &Subject<'_>, data: &Data) -> Result<Section, ReportError> {
    let shown = match subject.holdout {
        Some(held) => held_out(subject, held, data)?,
        None => Shown {
            rows: subject.data,
            before: data.before.readings.clone(),
            after: data.after.as_ref().map(|a| a.readings.clone()),
            what: "fitted readings",
        },
    };
    let mut panels = Panels::new("", 3).with_panel_size(300.0, 210.0);
    for k in 0..6 {
        panels = panels.with(shown.chart(k));
    }
    let caption =
        format!("{} {}, in the order of the file.", shown.rows.observations.len().min(MOST), shown.what);
    let figure = Block::figure(&panels.to_svg()?, caption);
    Ok(Section::new("predicted", "Predicted against measured", "").with(figure))
}

fn held_out<'a>(subject: &Subject<'_>, rows: &'a Dataset, data: &Data) -> Result<Shown<'a>, ReportError> {
    let study = subject.study;
    let errors = |fit: &Fit| prediction_errors(subject.hexapod, rows, study.campaign.noise, &fit.point);
    let last = study.fits.last().filter(|_| data.after.is_some());
    let after = last.map(errors).transpose()?;
    let what = "held-out readings, which no fit has seen";
    Ok(Shown { rows, before: errors(&study.outcome.baseline)?, after, what })
}

impl Shown<'_> {
    /// One coordinate over the number of the reading.
    fn chart(&self, k: usize) -> Chart {
        let unit = if k < 3 { "um" } else { "urad" };
        let count = self.rows.observations.len().min(MOST);
        let measured = (0..count).map(|row| [row as f64 + 1.0, self.measured(row, k)]).collect();
        let predicted = |all: &[Residual]| -> Vec<[f64; 2]> {
            let value = |r: &Residual| self.measured(r.row, k) - 1e6 * r.value[k];
            all.iter().take(MOST).map(|r| [r.row as f64 + 1.0, value(r)]).collect()
        };
        let mut chart = Chart::new("", Axis::new("reading", ""), Axis::new(NAMES[k], unit))
            .with(Series::line("springs alone", predicted(&self.before)).with_look(SPRINGS));
        if let Some(after) = &self.after {
            chart = chart.with(Series::line("with the added effects", predicted(after)).with_look(FINAL));
        }
        chart.with(Series::markers("measured", measured).with_look(MEASURED))
    }

    /// A measured number, um or urad; of an absolute pose what it is beside the commanded one.
    fn measured(&self, row: usize, k: usize) -> f64 {
        let o = &self.rows.observations[row];
        let commanded = if self.rows.is_absolute() { o.pose.to_array()[k] } else { 0.0 };
        1e6 * (o.measured[k] - commanded)
    }
}
