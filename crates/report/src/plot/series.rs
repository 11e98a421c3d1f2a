//! What a chart shows: lines, markers, bands.

use super::canvas::Canvas;
use super::error::{PlotError, finite, length, not_empty};
use super::frame::Frame;
use super::style::{Look, Marker};

/// Width of the lines of data, px.
const LINE_PX: f64 = 1.8;
/// Half-width of markers, px.
const MARKER_PX: f64 = 3.6;
/// Share of its color that a band lets show.
const BAND_OPACITY: f64 = 0.18;

/// One named set of numbers of a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    pub(super) name: String,
    kind: Kind,
    errors: Vec<f64>,
    look: Option<usize>,
    reference: bool,
    marker_px: f64,
}

#[derive(Debug, Clone, PartialEq)]
enum Kind {
    Line(Vec<[f64; 2]>),
    Markers(Vec<[f64; 2]>),
    Both(Vec<[f64; 2]>),
    Band(Vec<[f64; 3]>),
}

impl Series {
    /// A line through `[x, y]`.
    pub fn line(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self::new(name, Kind::Line(points))
    }

    /// A marker at every `[x, y]`.
    pub fn markers(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self::new(name, Kind::Markers(points))
    }

    /// Markers joined by a line.
    pub fn marked_line(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self::new(name, Kind::Both(points))
    }

    /// The area between `low` and `high` at each `[x, low, high]`.
    pub fn band(name: impl Into<String>, points: Vec<[f64; 3]>) -> Self {
        Self::new(name, Kind::Band(points))
    }

    fn new(name: impl Into<String>, kind: Kind) -> Self {
        Self {
            name: name.into(),
            kind,
            errors: Vec::new(),
            look: None,
            reference: false,
            marker_px: MARKER_PX,
        }
    }

    /// Error bars: half-length above and below each point, in the unit of the y axis.
    #[must_use]
    pub fn with_errors(self, half_lengths: Vec<f64>) -> Self {
        Self { errors: half_lengths, ..self }
    }

    /// The look with this number instead of the place in the chart; equal numbers look alike.
    #[must_use]
    pub fn with_look(self, number: usize) -> Self {
        Self { look: Some(number), ..self }
    }

    /// Markers of another half-width, px: small ones for clouds of many.
    #[must_use]
    pub fn with_marker_size(self, px: f64) -> Self {
        Self { marker_px: px, ..self }
    }

    /// A gray dashed line to compare with, such as a noise level.
    #[must_use]
    pub fn as_reference(self) -> Self {
        Self { reference: true, ..self }
    }

    /// Its look as the `index`-th series of a chart.
    pub(super) fn look(&self, index: usize) -> Look {
        if self.reference { Look::reference() } else { Look::nth(self.look.unwrap_or(index)) }
    }

    pub(super) fn check(&self, chart: &str) -> Result<(), PlotError> {
        let entries = self.xs().len();
        not_empty(chart, entries)?;
        if !self.errors.is_empty() {
            length(chart, &format!("the list of errors of \"{}\"", self.name), self.errors.len(), entries)?;
        }
        let what = format!("series \"{}\"", self.name);
        finite(chart, "the size of a marker", &[self.marker_px])?;
        finite(chart, &what, &self.xs())?;
        finite(chart, &what, &self.ys())?;
        finite(chart, &format!("the errors of {what}"), &self.errors)
    }

    pub(super) fn xs(&self) -> Vec<f64> {
        match &self.kind {
            Kind::Band(points) => points.iter().map(|p| p[0]).collect(),
            Kind::Line(points) | Kind::Markers(points) | Kind::Both(points) => {
                points.iter().map(|p| p[0]).collect()
            }
        }
    }

    /// Every number on the y axis, ends of error bars included.
    pub(super) fn ys(&self) -> Vec<f64> {
        match &self.kind {
            Kind::Band(points) => points.iter().flat_map(|p| [p[1], p[2]]).collect(),
            Kind::Line(points) | Kind::Markers(points) | Kind::Both(points) => {
                let ends = points.iter().zip(&self.errors).flat_map(|(p, e)| [p[1] - e, p[1] + e]);
                points.iter().map(|p| p[1]).chain(ends).collect()
            }
        }
    }

    /// Draws the data in a frame.
    pub(super) fn draw(&self, canvas: &Canvas, frame: &Frame, look: Look) -> Result<(), PlotError> {
        match &self.kind {
            Kind::Band(points) => {
                let low = points.iter().map(|p| frame.place([p[0], p[1]]));
                let high = points.iter().rev().map(|p| frame.place([p[0], p[2]]));
                let outline: Vec<_> = low.chain(high).collect();
                canvas.polygon(&outline, look.colour, BAND_OPACITY)
            }
            Kind::Line(points) => self.draw_line(canvas, frame, points, look),
            Kind::Markers(points) => self.draw_markers(canvas, frame, points, look),
            Kind::Both(points) => {
                self.draw_line(canvas, frame, points, look)?;
                self.draw_markers(canvas, frame, points, look)
            }
        }
    }

    fn draw_line(
        &self,
        canvas: &Canvas,
        frame: &Frame,
        points: &[[f64; 2]],
        look: Look,
    ) -> Result<(), PlotError> {
        let width = if self.reference { LINE_PX * 0.7 } else { LINE_PX };
        let points: Vec<_> = points.iter().map(|p| frame.place(*p)).collect();
        canvas.line(&points, look.colour, width, look.dash)
    }

    fn draw_markers(
        &self,
        canvas: &Canvas,
        frame: &Frame,
        points: &[[f64; 2]],
        look: Look,
    ) -> Result<(), PlotError> {
        for (point, error) in points.iter().zip(&self.errors) {
            let [x, top] = frame.place([point[0], point[1] + error]);
            let [_, bottom] = frame.place([point[0], point[1] - error]);
            error_bar(canvas, x, [top, bottom], look)?;
        }
        points
            .iter()
            .try_for_each(|p| canvas.marker(frame.place(*p), look.marker, look.colour, self.marker_px))
    }

    /// Its sample in the legend, between two ends at a height.
    pub(super) fn sample(
        &self,
        canvas: &Canvas,
        [from, to]: [f64; 2],
        y: f64,
        look: Look,
    ) -> Result<(), PlotError> {
        const BAND_HALF_PX: f64 = 5.0;
        let (line, mid) = ([[from, y], [to, y]], [f64::midpoint(from, to), y]);
        match &self.kind {
            Kind::Band(_) => {
                let (top, bottom) = (y - BAND_HALF_PX, y + BAND_HALF_PX);
                let corners = [[from, top], [to, top], [to, bottom], [from, bottom]];
                canvas.polygon(&corners, look.colour, BAND_OPACITY)
            }
            Kind::Line(_) => canvas.line(&line, look.colour, LINE_PX, look.dash),
            Kind::Markers(_) => canvas.marker(mid, look.marker, look.colour, MARKER_PX),
            Kind::Both(_) => {
                canvas.line(&line, look.colour, LINE_PX, look.dash)?;
                canvas.marker(mid, look.marker, look.colour, MARKER_PX)
            }
        }
    }
}

/// A vertical bar with caps.
pub(super) fn error_bar(
    canvas: &Canvas,
    x: f64,
    [top, bottom]: [f64; 2],
    look: Look,
) -> Result<(), PlotError> {
    const CAP_PX: f64 = 3.0;
    const BAR_PX: f64 = 1.1;
    canvas.line(&[[x, top], [x, bottom]], look.colour, BAR_PX, None)?;
    for y in [top, bottom] {
        canvas.line(&[[x - CAP_PX, y], [x + CAP_PX, y]], look.colour, BAR_PX, None)?;
    }
    Ok(())
}

/// Half-width of the marker samples, for charts that draw their own markers.
pub(super) fn marker(canvas: &Canvas, at: [f64; 2], look: Look, marker: Marker) -> Result<(), PlotError> {
    canvas.marker(at, marker, look.colour, MARKER_PX)
}
