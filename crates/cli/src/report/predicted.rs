//! Predicted against measured, coordinate by coordinate, reading by reading.

use hexbench_core::{Dataset, Vector6};
use hexbench_model::fit::Fit;
use hexbench_model::residuals::{Residual, prediction_errors};
use hexbench_report::html::{Block, Section};
use hexbench_report::plot::{Axis, Chart, Panels, Series};

use super::ReportError;
use super::data::Data;
use super::figures::{FINAL, MEASURED, SPRINGS};
use crate::page::Subject;

/// Readings a panel can show apart.
const MOST: usize = 120;
const NAMES: [&str; 6] = ["a", "b", "c", "alpha", "beta", "gamma"];

/// Held-out readings where there is a file of them, else the fitted ones.
pub(crate) fn section(subject: &Subject<'_>, data: &Data) -> Result<Section, ReportError> {
    let (rows, before, after, what) = match subject.holdout {
        Some(held) => {
            let errors = |fit: &Fit| {
                prediction_errors(subject.hexapod, held, subject.study.campaign.noise, &fit.point)
            };
            let last = subject.study.fits.last().filter(|_| data.after.is_some());
            let after = last.map(errors).transpose()?;
            (
                held,
                errors(&subject.study.outcome.baseline)?,
                after,
                "held-out readings, which no fit has seen",
            )
        }
        None => {
            let after = data.after.as_ref().map(|a| a.readings.clone());
            (subject.data, data.before.readings.clone(), after, "fitted readings")
        }
    };
    let svg = panels(rows, &before, after.as_deref())?.to_svg()?;
    let shown = rows.observations.len().min(MOST);
    let caption = format!("{shown} {what}, in the order of the file.");
    Ok(Section::new("predicted", "Predicted against measured", "").with(Block::figure(&svg, caption)))
}

fn panels(rows: &Dataset, before: &[Residual], after: Option<&[Residual]>) -> Result<Panels, ReportError> {
    let offset = |row: usize| {
        if rows.is_absolute() {
            Vector6::from(rows.observations[row].pose.to_array())
        } else {
            Vector6::zeros()
        }
    };
    let mut panels = Panels::new("", 3).with_panel_size(300.0, 210.0);
    for k in 0..6 {
        let unit = if k < 3 { "um" } else { "urad" };
        let value = |row: usize| 1e6 * (rows.observations[row].measured[k] - offset(row)[k]);
        let measured =
            (0..rows.observations.len().min(MOST)).map(|row| [row as f64 + 1.0, value(row)]).collect();
        let predicted = |all: &[Residual]| -> Vec<[f64; 2]> {
            all.iter().take(MOST).map(|r| [r.row as f64 + 1.0, value(r.row) - 1e6 * r.value[k]]).collect()
        };
        let mut chart = Chart::new("", Axis::new("reading", ""), Axis::new(NAMES[k], unit))
            .with(Series::line("springs alone", predicted(before)).with_look(SPRINGS));
        if let Some(after) = after {
            chart = chart.with(Series::line("with the added effects", predicted(after)).with_look(FINAL));
        }
        panels = panels.with(chart.with(Series::markers("measured", measured).with_look(MEASURED)));
    }
    Ok(panels)
}
