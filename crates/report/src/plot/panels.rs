//! Several charts in a grid with one legend.

use super::canvas::{Canvas, Type, svg};
use super::chart::{Chart, MARGIN_PX, title};
use super::error::{PlotError, not_empty};
use super::frame::{Rect, left_room};
use super::legend::{self, distinct};
use super::series::Series;
use super::style::{LABEL_PX, Look, NARROW_PX};

/// A drawing for a phone is shown at most so many times larger.
const LARGEST_TIMES: f64 = 1.4;

/// Several charts in a grid; equal series names share one entry of the legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Panels {
    title: String,
    columns: usize,
    charts: Vec<Chart>,
    panel_px: [f64; 2],
}

impl Panels {
    /// An empty grid of so many columns; each panel 232 x 190 px.
    pub fn new(title: impl Into<String>, columns: usize) -> Self {
        Self { title: title.into(), columns: columns.max(1), charts: Vec::new(), panel_px: [232.0, 190.0] }
    }

    /// The grid with one chart more, row by row.
    #[must_use]
    pub fn with(mut self, chart: Chart) -> Self {
        self.charts.push(chart);
        self
    }

    /// The grid with panels of another size, px.
    #[must_use]
    pub fn with_panel_size(self, width_px: f64, height_px: f64) -> Self {
        Self { panel_px: [width_px, height_px], ..self }
    }

    /// Its panels, each a drawing by itself and no wider than a phone: a page puts as many beside each other as there is room for. The legend
    /// comes first; none where no series has a name.
    ///
    /// # Errors
    /// As [`Self::to_svg`].
    pub fn pieces(&self) -> Result<(Option<String>, Vec<String>), PlotError> {
        not_empty(&self.title, self.charts.len())?;
        self.charts.iter().try_for_each(Chart::check)?;
        let entries: Vec<(&Series, Look)> = distinct(self.charts.iter().flat_map(Chart::looks));
        let drawn = |canvas: &Canvas| legend::draw(canvas, &entries, [MARGIN_PX, 2.0], NARROW_PX - MARGIN_PX);
        let height = legend::height(&entries, NARROW_PX - MARGIN_PX) + 4.0;
        let legend = (!entries.is_empty()).then(|| svg([NARROW_PX, height], "", drawn)).transpose()?;
        let panels = self.charts.iter().map(|chart| self.piece(chart)).collect::<Result<_, _>>()?;
        Ok((legend, panels))
    }

    /// One panel, no wider than a phone.
    fn piece(&self, chart: &Chart) -> Result<String, PlotError> {
        let shrunk = (NARROW_PX / self.panel_width()).min(1.0);
        let panel_px = [self.panel_width() * shrunk, self.panel_px[1] * shrunk];
        let alone = Self { panel_px, charts: Vec::new(), ..self.clone() };
        svg(alone.panel_px, "", |canvas| {
            canvas.text_within([4.0, 8.0], &chart.title, Type::new(LABEL_PX).bold(), alone.panel_px[0])?;
            let outer = alone.outer([4.0, 0.0]);
            let frame = chart.frame(outer);
            chart.draw_in(canvas, &frame.with_left(4.0 + left_room(&chart.frame(outer).y)))
        })
    }

    /// Width of a panel by itself where there is room, px.
    pub fn panel_width(&self) -> f64 {
        self.panel_px[0].min(LARGEST_TIMES * NARROW_PX)
    }

    /// The grid as SVG.
    ///
    /// # Errors
    /// [`PlotError::NotFinite`], [`PlotError::Empty`], [`PlotError::Length`].
    pub fn to_svg(&self) -> Result<String, PlotError> {
        not_empty(&self.title, self.charts.len())?;
        self.charts.iter().try_for_each(Chart::check)?;
        let entries: Vec<(&Series, Look)> = distinct(self.charts.iter().flat_map(Chart::looks));
        let width = 2.0 * MARGIN_PX + self.columns as f64 * self.panel_px[0];
        let room = width - 2.0 * MARGIN_PX;
        let head = MARGIN_PX + if self.title.is_empty() { 0.0 } else { super::chart::TITLE_ROW_PX };
        let below_legend = head + legend::height(&entries, room) + 4.0;
        let rows = self.charts.len().div_ceil(self.columns) as f64;
        let size = [width, below_legend + rows * self.panel_px[1] + MARGIN_PX];
        svg(size, &self.title, |canvas| {
            let top = title(canvas, &self.title, [MARGIN_PX, MARGIN_PX], room)?;
            legend::draw(canvas, &entries, [MARGIN_PX, top], room)?;
            self.draw(canvas, below_legend)
        })
    }

    fn draw(&self, canvas: &Canvas, top: f64) -> Result<(), PlotError> {
        for (i, chart) in self.charts.iter().enumerate() {
            let column = i % self.columns;
            let [left, top] = self.corner(i, top);
            let set = Type::new(LABEL_PX).bold();
            canvas.text_within([left, top + 8.0], &chart.title, set, self.panel_px[0])?;
            let room = self.charts.iter().skip(column).step_by(self.columns);
            let room = room.map(|c| left_room(&c.frame(self.outer([left, top])).y)).fold(0.0, f64::max);
            let frame = chart.frame(self.outer([left, top])).with_left(left + room);
            chart.draw_in(canvas, &frame)?;
        }
        Ok(())
    }

    fn corner(&self, index: usize, top: f64) -> [f64; 2] {
        let (row, column) = (index / self.columns, index % self.columns);
        [MARGIN_PX + column as f64 * self.panel_px[0], top + row as f64 * self.panel_px[1]]
    }

    fn outer(&self, [left, top]: [f64; 2]) -> Rect {
        const HEAD_PX: f64 = 24.0;
        let [width, height] = self.panel_px;
        Rect { left, top: top + HEAD_PX, right: left + width - 14.0, bottom: top + height - 6.0 }
    }
}
