//! Predicted against measured, coordinate by coordinate, reading by reading.

use crate::page::Section;
use crate::plot::{Axis, Chart, Panels, Series};
use hexbench_core::Dataset;
use hexbench_model::estimation::frames::{Frames, ReadingAxes};
use hexbench_model::estimation::residuals::Residual;

use super::ReportError;
use super::data::Data;
use super::figures::{MEASURED, sheet};

/// Readings a panel can show apart.
const MOST: usize = 120;

/// Readings and what the models say of them.
struct PredictedReadings<'a> {
    rows: &'a Dataset,
    models: Vec<Model>,
    /// Standard deviation of one reading, m and rad.
    noise: [f64; 6],
    /// Where the instrument stands, about.
    frames: Frames,
    axes: ReadingAxes,
}

struct Model {
    name: &'static str,
    look: usize,
    errors: Vec<Residual>,
}

/// Held-out readings where there is a file of them, else the fitted ones; nothing where they are no full poses.
pub(crate) fn section(data: &Data<'_>) -> Result<Option<Section>, ReportError> {
    if !data.campaign.reads_poses {
        return Ok(None);
    }
    let (rows, what) = match data.holdout {
        Some(held) => (held, "Held-out readings, which no fit has seen"),
        None => (data.fitted, "The readings"),
    };
    let predicted = predicted(data, rows)?;
    let errors = "Measured minus predicted for the same readings; the band is plus and minus twice the noise of one reading.";
    let section = Section::new("Predicted against measured")
        .id("predicted")
        .with(sheet("values", &predicted.panels(PredictedReadings::values), caption(what, rows))?)
        .with(sheet("errors", &predicted.panels(PredictedReadings::errors), errors)?);
    Ok(Some(section))
}

fn caption(what: &str, rows: &Dataset) -> String {
    let of = if rows.is_absolute() { "; measured pose minus commanded pose" } else { "" };
    let count = rows.observations.len();
    let some = if count > MOST { format!("the first {MOST} of {count}") } else { format!("{count}") };
    format!("{what}, in file order ({some}){of}.")
}

fn predicted<'a>(data: &Data<'_>, rows: &'a Dataset) -> Result<PredictedReadings<'a>, ReportError> {
    let seen_here = std::ptr::eq(rows, data.fitted);
    let mut models = Vec::new();
    for (name, look, seen) in data.models() {
        let errors = if seen_here { seen.judged.rows.clone() } else { data.errors(seen, rows)? };
        models.push(Model { name, look, errors });
    }
    Ok(PredictedReadings {
        rows,
        models,
        noise: data.campaign.noise.sigma(),
        frames: data.campaign.frames,
        axes: data.campaign.axes,
    })
}

impl PredictedReadings<'_> {
    fn panels(&self, chart: fn(&Self, usize) -> Chart) -> Panels {
        let panels = Panels::new("", 3).with_panel_size(300.0, 210.0);
        (0..6).fold(panels, |panels, k| panels.with(chart(self, k)))
    }

    fn count(&self) -> usize {
        self.rows.observations.len().min(MOST)
    }

    fn frame(&self, k: usize) -> Chart {
        let (name, unit) = (self.rows.measurand.names()[k], if k < 3 { "um" } else { "urad" });
        Chart::new("", Axis::new("reading", ""), Axis::new(name, unit))
    }

    /// One coordinate over the number of the reading.
    fn values(&self, k: usize) -> Chart {
        let measured = (0..self.count()).map(|row| [row as f64 + 1.0, self.measured(row, k)]).collect();
        let mut chart = self.frame(k);
        for model in &self.models {
            let value = |r: &Residual| self.measured(r.row, k) - 1e6 * r.value[k];
            let line = model.errors.iter().take(MOST).map(|r| [r.row as f64 + 1.0, value(r)]).collect();
            chart = chart.with(Series::line(model.name, line).with_look(model.look));
        }
        chart.with(Series::markers("measured", measured).with_look(MEASURED).with_marker_size(2.4))
    }

    /// The error of one coordinate over the number of the reading.
    fn errors(&self, k: usize) -> Chart {
        let (last, reach) = (self.count() as f64, 2e6 * self.noise[k]);
        let band = vec![[1.0, -reach, reach], [last, -reach, reach]];
        let mut chart = self.frame(k).with(Series::band("twice the noise", band).with_look(MEASURED));
        for model in &self.models {
            let error = |r: &Residual| [r.row as f64 + 1.0, 1e6 * r.value[k]];
            let points = model.errors.iter().take(MOST).map(error).collect();
            chart =
                chart.with(Series::markers(model.name, points).with_look(model.look).with_marker_size(2.4));
        }
        chart
    }

    /// A measured number, um or urad; of an absolute pose what it is beside the commanded one.
    fn measured(&self, row: usize, k: usize) -> f64 {
        let o = &self.rows.observations[row];
        if !self.rows.is_absolute() {
            return 1e6 * o.measured[k];
        }
        1e6 * self.axes.difference(&self.frames.seen(&o.pose).to_array(), &o.measured)[k]
    }
}
