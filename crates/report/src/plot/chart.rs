//! Lines, markers and bands over a number.

use super::axis::Axis;
use super::canvas::{Canvas, Type, svg};
use super::error::{PlotError, finite, not_empty, positive};
use super::frame::{Frame, Rect, most_ticks};
use super::legend::{self, distinct};
use super::series::Series;
use super::style::{Look, NARROW_PX, TITLE_PX};

/// Margin around everything, px.
pub(super) const MARGIN_PX: f64 = 14.0;
/// Height of a title with the gap below it, px.
pub(super) const TITLE_ROW_PX: f64 = 26.0;

/// Lines, markers and bands over a number.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    pub(super) title: String,
    x: Axis,
    y: Axis,
    series: Vec<Series>,
    size_px: [f64; 2],
}

impl Chart {
    /// An empty chart, 720 x 400 px.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self { title: title.into(), x, y, series: Vec::new(), size_px: [720.0, 400.0] }
    }

    /// The chart with one series more; later series lie on top.
    #[must_use]
    pub fn with(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// The chart at another size, px.
    #[must_use]
    pub fn with_size(self, width_px: f64, height_px: f64) -> Self {
        Self { size_px: [width_px, height_px], ..self }
    }

    /// The chart as SVG for a wide window and, no wider than a phone, for a narrow one.
    ///
    /// # Errors
    /// As [`Self::to_svg`].
    pub fn laid_out(self) -> Result<[String; 2], PlotError> {
        let wide = self.to_svg()?;
        let height = self.size_px[1];
        Ok([wide, self.with_size(NARROW_PX, height).to_svg()?])
    }

    /// The chart as SVG.
    ///
    /// # Errors
    /// [`PlotError::NotFinite`], [`PlotError::Empty`], [`PlotError::Length`].
    pub fn to_svg(&self) -> Result<String, PlotError> {
        self.check()?;
        svg(self.size_px, &self.title, |canvas| {
            let [width, height] = self.size_px;
            let entries = distinct(self.looks());
            let room = width - 2.0 * MARGIN_PX;
            let top = title(canvas, &self.title, [MARGIN_PX, MARGIN_PX], room)?;
            legend::draw(canvas, &entries, [MARGIN_PX, top], room)?;
            let outer = Rect {
                left: MARGIN_PX,
                top: top + legend::height(&entries, room) + 6.0,
                right: width - MARGIN_PX - 6.0,
                bottom: height - MARGIN_PX,
            };
            self.draw(canvas, outer)
        })
    }

    /// Series with their looks.
    pub(super) fn looks(&self) -> impl Iterator<Item = (&Series, Look)> {
        self.series.iter().enumerate().map(|(i, s)| (s, s.look(i)))
    }

    pub(super) fn check(&self) -> Result<(), PlotError> {
        not_empty(&self.title, self.series.len())?;
        finite(&self.title, "an axis", self.x.fixed().chain(self.y.fixed()).chain(&self.size_px))?;
        self.series.iter().try_for_each(|s| s.check(&self.title))?;
        self.check_logarithms()
    }

    fn check_logarithms(&self) -> Result<(), PlotError> {
        let check = |axis: &Axis, what: &str, values: Vec<f64>| {
            positive(&self.title, what, axis.fixed().chain(&values).filter(|_| axis.is_logarithmic()))
        };
        check(&self.x, "the x axis", self.series.iter().flat_map(Series::xs).collect())?;
        check(&self.y, "the y axis", self.series.iter().flat_map(Series::ys).collect())
    }

    /// Draws axes and data, without title and legend.
    pub(super) fn draw(&self, canvas: &Canvas, outer: Rect) -> Result<(), PlotError> {
        let frame = self.frame(outer);
        self.draw_in(canvas, &frame)
    }

    /// Its axes settled in a rectangle.
    pub(super) fn frame(&self, outer: Rect) -> Frame {
        const TICK_ROOM_PX: [f64; 2] = [58.0, 26.0];
        let across = most_ticks(outer.right - outer.left, TICK_ROOM_PX[0]);
        let along = most_ticks(outer.bottom - outer.top, TICK_ROOM_PX[1]);
        let x = self.x.scale(self.series.iter().flat_map(Series::xs), across);
        let y = self.y.scale(self.series.iter().flat_map(Series::ys), along);
        Frame::new(outer, x, y)
    }

    /// Draws axes and data in a frame.
    pub(super) fn draw_in(&self, canvas: &Canvas, frame: &Frame) -> Result<(), PlotError> {
        frame.draw(canvas, &self.x.label(), &self.y.label())?;
        self.looks().try_for_each(|(s, look)| s.draw(canvas, frame, look))
    }
}

/// Draws a title, if any; returns where the next thing begins.
pub(super) fn title(canvas: &Canvas, text: &str, [left, top]: [f64; 2], room: f64) -> Result<f64, PlotError> {
    if text.is_empty() {
        return Ok(top);
    }
    let set = Type::new(TITLE_PX).bold();
    canvas.text_within([left, top + TITLE_PX / 2.0], text, set, room)?;
    Ok(top + TITLE_ROW_PX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chart_for_a_narrow_window_is_laid_out_anew_with_the_same_text() {
        let series = Series::line("load", vec![[0.0, 1.0], [1.0, 3.0]]);
        let chart = Chart::new("", Axis::new("leg", ""), Axis::new("stiffness", "N/um")).with(series);
        let [wide, narrow] = chart.laid_out().unwrap();
        let width = |svg: &str| svg.split_once("width=\"").unwrap().1.split_once('"').unwrap().0.to_owned();
        assert_eq!([width(&wide), width(&narrow)], ["720".to_owned(), NARROW_PX.to_string()]);
        let sizes = |svg: &str| svg.split("font-size=\"").skip(1).map(|s| s[..2].to_owned()).max().unwrap();
        assert_eq!(sizes(&wide), sizes(&narrow));
    }
}
