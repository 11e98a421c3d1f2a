//! A table whose cells are shaded.

use super::axis::number;
use super::canvas::{Across, Along, Canvas, Type, svg};
use super::chart::{MARGIN_PX, title};
use super::error::{PlotError, finite, length, not_empty};
use super::style::{DEEP, INK, LABEL_PX, NARROW_PX, PAPER, TICK_PX, text_width};

/// Side of the smallest cell, px: a name turned upright is as wide.
const LEAST_CELL_PX: f64 = TICK_PX + 1.0;

/// A table of numbers, each cell shaded from white (zero) to dark (the largest).
#[derive(Debug, Clone, PartialEq)]
pub struct HeatMap {
    title: String,
    rows: Vec<String>,
    columns: Vec<String>,
    values: Vec<Vec<f64>>,
    row_title: String,
    column_title: String,
    decimals: usize,
    full_shade: Option<f64>,
    no_shade: f64,
    cell_px: [f64; 2],
    is_triangle: bool,
}

impl HeatMap {
    /// A table; `values` has one list for each row. Zeros stay blank.
    pub fn new(
        title: impl Into<String>,
        rows: Vec<String>,
        columns: Vec<String>,
        values: Vec<Vec<f64>>,
    ) -> Self {
        Self {
            title: title.into(),
            rows,
            columns,
            values,
            row_title: String::new(),
            column_title: String::new(),
            decimals: 0,
            full_shade: None,
            no_shade: 0.0,
            cell_px: [30.0, 24.0],
            is_triangle: false,
        }
    }

    /// What rows and columns are.
    #[must_use]
    pub fn with_axis_titles(self, rows: impl Into<String>, columns: impl Into<String>) -> Self {
        Self { row_title: rows.into(), column_title: columns.into(), ..self }
    }

    /// Decimals of the numbers in the cells.
    #[must_use]
    pub fn with_decimals(self, decimals: usize) -> Self {
        Self { decimals, ..self }
    }

    /// The size at which a cell is darkest, instead of the largest one.
    #[must_use]
    pub fn with_full_shade_at(self, value: f64) -> Self {
        Self { full_shade: Some(value), ..self }
    }

    /// The size at which a cell is blank paper, instead of zero: for numbers that differ by little.
    #[must_use]
    pub fn with_no_shade_at(self, value: f64) -> Self {
        Self { no_shade: value, ..self }
    }

    /// Cells of another size, px.
    #[must_use]
    pub fn with_cell_size(self, width_px: f64, height_px: f64) -> Self {
        Self { cell_px: [width_px, height_px], ..self }
    }

    /// Only what is on and below the diagonal, for a table that is its own mirror image; columns are named below it.
    #[must_use]
    pub fn as_triangle(self) -> Self {
        Self { is_triangle: true, ..self }
    }

    /// The table for a phone: cells as narrow as they have to be, without numbers where these do not fit.
    fn narrow(self) -> Self {
        let [left, _] = self.corner();
        let room = (NARROW_PX - left - MARGIN_PX) / self.columns.len().max(1) as f64;
        let side = room.clamp(LEAST_CELL_PX, self.cell_px[0].max(LEAST_CELL_PX));
        Self { cell_px: [side, side.min(self.cell_px[1]).max(LEAST_CELL_PX)], ..self }
    }

    /// The table as SVG for a wide window and, no wider than a phone, for a narrow one.
    ///
    /// # Errors
    /// As [`Self::to_svg`].
    pub fn laid_out(self) -> Result<[String; 2], PlotError> {
        let wide = self.to_svg()?;
        Ok([wide, self.narrow().to_svg()?])
    }

    /// The table as SVG; its size follows the cells and names.
    ///
    /// # Errors
    /// [`PlotError::NotFinite`], [`PlotError::Empty`], [`PlotError::Length`].
    pub fn to_svg(&self) -> Result<String, PlotError> {
        self.check()?;
        let [left, top] = self.corner();
        let width = (left + self.columns.len() as f64 * self.cell_px[0] + MARGIN_PX).max(320.0);
        let below = if self.is_triangle { self.column_names_px() } else { 0.0 };
        let height = top + self.rows.len() as f64 * self.cell_px[1] + below + MARGIN_PX;
        svg([width, height], &self.title, |canvas| {
            title(canvas, &self.title, [MARGIN_PX, MARGIN_PX], width - 2.0 * MARGIN_PX)?;
            self.draw_cells(canvas, [left, top])?;
            self.draw_names(canvas, [left, top])?;
            self.draw_axis_titles(canvas, [left, top])
        })
    }

    fn check(&self) -> Result<(), PlotError> {
        not_empty(&self.title, self.rows.len().min(self.columns.len()))?;
        length(&self.title, "the table", self.values.len(), self.rows.len())?;
        for (name, row) in self.rows.iter().zip(&self.values) {
            length(&self.title, &format!("row \"{name}\""), row.len(), self.columns.len())?;
            finite(&self.title, &format!("row \"{name}\""), row)?;
        }
        finite(
            &self.title,
            "the settings",
            self.full_shade.iter().chain([&self.no_shade]).chain(&self.cell_px),
        )
    }

    /// Upper left corner of the first cell, px.
    fn corner(&self) -> [f64; 2] {
        let row_title = if self.row_title.is_empty() { 0.0 } else { LABEL_PX + 10.0 };
        let column_title = if self.column_title.is_empty() { 0.0 } else { LABEL_PX + 8.0 };
        let head = MARGIN_PX + if self.title.is_empty() { 0.0 } else { super::chart::TITLE_ROW_PX };
        let names = if self.is_triangle { 0.0 } else { self.column_names_px() };
        [MARGIN_PX + row_title + widest(&self.rows) + 8.0, head + column_title + names]
    }

    /// Height of the names of the columns, px.
    fn column_names_px(&self) -> f64 {
        8.0 + if self.upright() { widest(&self.columns) } else { TICK_PX }
    }

    /// Names of columns are turned when they do not fit over their cells.
    fn upright(&self) -> bool {
        widest(&self.columns) > self.cell_px[0] - 4.0
    }

    fn darkest(&self) -> f64 {
        let largest = || self.values.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
        self.full_shade.unwrap_or_else(largest).abs().max(f64::MIN_POSITIVE)
    }

    fn draw_cells(&self, canvas: &Canvas, [left, top]: [f64; 2]) -> Result<(), PlotError> {
        const LIGHT_TEXT_FROM: f64 = 0.62;
        const GAP_PX: f64 = 1.0;
        const FAINTEST: f64 = 0.035;
        let ([w, h], darkest) = (self.cell_px, self.darkest());
        for (i, row) in self.values.iter().enumerate() {
            let shown = if self.is_triangle { i + 1 } else { row.len() };
            for (j, &value) in row.iter().enumerate().take(shown) {
                let (x, y) = (left + j as f64 * w, top + i as f64 * h);
                let above = (value.abs() - self.no_shade).max(0.0);
                let share = above / (darkest - self.no_shade).max(f64::MIN_POSITIVE);
                // Faint cells stay apart from the paper so that the table shows where nothing is.
                let shade = FAINTEST + (1.0 - FAINTEST) * share.min(1.0);
                canvas.cell([x, y], [x + w - GAP_PX, y + h - GAP_PX], DEEP, shade)?;
                let written = number(value, self.decimals);
                if value != 0.0 && text_width(&written, TICK_PX) < w {
                    let ink = if share > LIGHT_TEXT_FROM { PAPER } else { INK };
                    let set = Type::new(TICK_PX).colour(ink).at(Across::Middle, Along::Middle);
                    let centre = [x + 0.5 * (w - GAP_PX), y + 0.5 * (h - GAP_PX)];
                    canvas.text(centre, &written, set)?;
                }
            }
        }
        Ok(())
    }

    fn draw_names(&self, canvas: &Canvas, [left, top]: [f64; 2]) -> Result<(), PlotError> {
        let [w, h] = self.cell_px;
        let at_row = Type::new(TICK_PX).at(Across::Right, Along::Middle);
        for (i, name) in self.rows.iter().enumerate() {
            canvas.text([left - 7.0, top + (i as f64 + 0.5) * h], name, at_row)?;
        }
        let bottom = top + self.rows.len() as f64 * h;
        let (y, across, along) = if self.is_triangle {
            (bottom + 6.0, Across::Right, Along::Top)
        } else {
            (top - 6.0, Across::Left, Along::Foot)
        };
        let flat = Type::new(TICK_PX).at(Across::Middle, along);
        let turned = Type::new(TICK_PX).at(across, Along::Middle).upright();
        for (j, name) in self.columns.iter().enumerate() {
            let set = if self.upright() { turned } else { flat };
            canvas.text([left + (j as f64 + 0.5) * w, y], name, set)?;
        }
        Ok(())
    }

    fn draw_axis_titles(&self, canvas: &Canvas, [left, top]: [f64; 2]) -> Result<(), PlotError> {
        let (w, h) = (self.columns.len() as f64 * self.cell_px[0], self.rows.len() as f64 * self.cell_px[1]);
        let set = Type::new(LABEL_PX).bold();
        if !self.row_title.is_empty() {
            let at = [MARGIN_PX + LABEL_PX / 2.0, top + h / 2.0];
            canvas.text(at, &self.row_title, set.at(Across::Middle, Along::Middle).upright())?;
        }
        if self.column_title.is_empty() {
            return Ok(());
        }
        let head = MARGIN_PX + if self.title.is_empty() { 0.0 } else { super::chart::TITLE_ROW_PX };
        let at = [left + w / 2.0, head + LABEL_PX / 2.0];
        canvas.text(at, &self.column_title, set.at(Across::Middle, Along::Middle))
    }
}

fn widest(names: &[String]) -> f64 {
    names.iter().map(|n| text_width(n, TICK_PX)).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

    use super::*;

    fn mirrored(count: usize) -> HeatMap {
        let names: Vec<String> = (1..=count).map(|k| format!("stiffness {k}")).collect();
        let cell = |i: usize, j: usize| if i == j { 1.0 } else { 0.25 };
        let values = (0..count).map(|i| (0..count).map(|j| cell(i, j)).collect()).collect();
        HeatMap::new("", names.clone(), names, values).with_decimals(2).as_triangle()
    }

    #[test]
    fn a_triangle_shows_every_pair_once_and_names_every_column() {
        let svg = mirrored(4).to_svg().unwrap();
        assert_eq!((svg.matches(">0.25<").count(), svg.matches(">1.00<").count()), (6, 4), "{svg}");
        assert_eq!(svg.matches(">stiffness 4<").count(), 2, "{svg}");
    }

    #[test]
    fn on_a_phone_cells_are_as_narrow_as_they_have_to_be_and_numbers_that_do_not_fit_are_left_out() {
        let width = |map: HeatMap| {
            let svg = map.to_svg().unwrap();
            let text = svg.split("viewBox=\"0 0 ").nth(1).unwrap().split(' ').next().unwrap().to_owned();
            (text.parse::<f64>().unwrap(), svg.contains(">0.25<"))
        };
        assert!(width(mirrored(16)).0 > NARROW_PX);
        assert_eq!(width(mirrored(16).narrow()), (NARROW_PX, false));
        assert!(width(mirrored(4).narrow()).1, "where there is room they stay");
    }
}
