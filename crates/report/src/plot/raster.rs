//! Signed sizes over a row of many columns: where something is large, and to which side.

use super::canvas::{Across, Along, Canvas, Type, svg};
use super::chart::{MARGIN_PX, title};
use super::error::{PlotError, finite, length, not_empty};
use super::frame::most_ticks;
use super::legend::{self, Entry};
use super::style::{Colour, DEEP, GREY, GRID, LABEL_PX, NARROW_PX, RUST, TICK_PX, text_width};
use crate::number::significant;

/// Height of a row, px.
const ROW_PX: f64 = 18.0;
/// Width of the cells of all columns unless for a phone, px.
const WIDTH_PX: f64 = 840.0;
/// Widest column, px.
const WIDEST_COLUMN_PX: f64 = 24.0;
/// Gap above a group of rows but the first, px.
const GROUP_GAP_PX: f64 = 24.0;

/// Rows of signed numbers. A cell above zero fills the upper half of its row, one below the lower half, the darker the larger: the
/// sign rests on place and color.
#[derive(Debug, Clone, PartialEq)]
pub struct Raster {
    title: String,
    levels: Vec<f64>,
    above: String,
    below: String,
    column_title: String,
    groups: Vec<Group>,
    /// Width of the cells of all columns, px.
    width_px: f64,
}

#[derive(Debug, Clone, PartialEq)]
struct Group {
    name: String,
    rows: Vec<(String, Vec<f64>)>,
}

impl Raster {
    /// Nothing to see yet; `levels` are the sizes from which cells are darker, rising.
    pub fn new(title: impl Into<String>, levels: Vec<f64>) -> Self {
        let empty = String::new;
        Self {
            title: title.into(),
            levels,
            above: empty(),
            below: empty(),
            column_title: empty(),
            groups: Vec::new(),
            width_px: WIDTH_PX,
        }
    }

    /// What a number above zero means, what one below, and what a column is.
    #[must_use]
    pub fn with_words(
        self,
        above: impl Into<String>,
        below: impl Into<String>,
        column: impl Into<String>,
    ) -> Self {
        Self { above: above.into(), below: below.into(), column_title: column.into(), ..self }
    }

    /// One group of rows more: the name of each row and its numbers, one for each column.
    #[must_use]
    pub fn with(mut self, name: impl Into<String>, rows: Vec<(String, Vec<f64>)>) -> Self {
        self.groups.push(Group { name: name.into(), rows });
        self
    }

    /// The same for a phone.
    fn narrow(self) -> Self {
        let width_px = NARROW_PX - self.left() - MARGIN_PX;
        Self { width_px, ..self }
    }

    /// The drawing as SVG for a wide window and, no wider than a phone, for a narrow one.
    ///
    /// # Errors
    /// As [`Self::to_svg`].
    pub fn laid_out(self) -> Result<[String; 2], PlotError> {
        let wide = self.to_svg()?;
        Ok([wide, self.narrow().to_svg()?])
    }

    /// The drawing as SVG.
    ///
    /// # Errors
    /// [`PlotError::NotFinite`], [`PlotError::Empty`], [`PlotError::Length`].
    pub fn to_svg(&self) -> Result<String, PlotError> {
        self.check()?;
        let entries = self.entries();
        let left = self.left();
        let width = left + self.width_px + MARGIN_PX;
        let room = width - 2.0 * MARGIN_PX;
        let head = MARGIN_PX + if self.title.is_empty() { 0.0 } else { super::chart::TITLE_ROW_PX };
        let top = head + legend::height(&entries, room) + GROUP_GAP_PX;
        let foot = top + self.height();
        svg([width, foot + TICK_PX + LABEL_PX + 22.0], &self.title, |canvas| {
            let below = title(canvas, &self.title, [MARGIN_PX, MARGIN_PX], room)?;
            legend::draw(canvas, &entries, [MARGIN_PX, below], room)?;
            self.draw_groups(canvas, [left, top])?;
            self.draw_columns(canvas, [left, foot])
        })
    }

    fn columns(&self) -> usize {
        self.groups.first().and_then(|g| g.rows.first()).map_or(0, |(_, row)| row.len())
    }

    fn check(&self) -> Result<(), PlotError> {
        not_empty(&self.title, self.columns().min(self.levels.len()))?;
        finite(&self.title, "the levels", &self.levels)?;
        for (name, row) in self.groups.iter().flat_map(|g| &g.rows) {
            let what = format!("row \"{name}\"");
            length(&self.title, &what, row.len(), self.columns())?;
            finite(&self.title, &what, row)?;
        }
        Ok(())
    }

    /// Where the cells begin, px.
    fn left(&self) -> f64 {
        MARGIN_PX + self.widest_name() + 8.0
    }

    fn widest_name(&self) -> f64 {
        let names = self.groups.iter().flat_map(|g| &g.rows).map(|(name, _)| text_width(name, TICK_PX));
        names.fold(0.0, f64::max)
    }

    fn height(&self) -> f64 {
        let rows: usize = self.groups.iter().map(|g| g.rows.len()).sum();
        rows as f64 * ROW_PX + self.groups.len().saturating_sub(1) as f64 * GROUP_GAP_PX
    }

    fn column_px(&self) -> f64 {
        (self.width_px / self.columns() as f64).min(WIDEST_COLUMN_PX)
    }

    /// How dark a number is: none below the first level.
    fn opacity(&self, value: f64) -> Option<f64> {
        let reached = self.levels.iter().take_while(|l| value.abs() >= **l).count();
        (reached > 0).then(|| shade(reached, self.levels.len()))
    }

    fn entries(&self) -> Vec<Sample> {
        let signs = [(&self.above, RUST), (&self.below, DEEP)];
        let of = |(word, colour): (&String, Colour)| {
            let word = word.clone();
            (1..=self.levels.len()).map(move |k| {
                let from = significant(self.levels[k - 1], 2);
                let name = if k == 1 { format!("{word}, from {from}") } else { format!("from {from}") };
                Sample { name, colour, opacity: shade(k, self.levels.len()) }
            })
        };
        signs.into_iter().flat_map(of).collect()
    }

    fn draw_groups(&self, canvas: &Canvas, [left, top]: [f64; 2]) -> Result<(), PlotError> {
        let mut y = top;
        for group in &self.groups {
            let set = Type::new(LABEL_PX).at(Across::Left, Along::Foot);
            canvas.text([left, y - 6.0], &group.name, set)?;
            for (name, row) in &group.rows {
                self.draw_row(canvas, [left, y], name, row)?;
                y += ROW_PX;
            }
            y += GROUP_GAP_PX;
        }
        Ok(())
    }

    fn draw_row(
        &self,
        canvas: &Canvas,
        [left, top]: [f64; 2],
        name: &str,
        row: &[f64],
    ) -> Result<(), PlotError> {
        let (width, mid) = (self.column_px(), top + 0.5 * ROW_PX);
        let set = Type::new(TICK_PX).colour(GREY).at(Across::Right, Along::Middle);
        canvas.text([left - 7.0, mid], name, set)?;
        canvas.line(&[[left, mid], [left + width * row.len() as f64, mid]], GRID, 1.0, None)?;
        // By shade: cells that look alike become one path.
        for level in 1..=self.levels.len() {
            let wanted = shade(level, self.levels.len());
            for (k, value) in row.iter().enumerate().filter(|(_, v)| self.opacity(**v) == Some(wanted)) {
                let (x, half) = (left + k as f64 * width, 0.5 * ROW_PX - 1.0);
                let (colour, end) = if *value > 0.0 { (RUST, mid - half) } else { (DEEP, mid + half) };
                canvas.cell([x, mid], [x + width, end], colour, wanted)?;
            }
        }
        Ok(())
    }

    fn draw_columns(&self, canvas: &Canvas, [left, foot]: [f64; 2]) -> Result<(), PlotError> {
        const TICK_ROOM_PX: f64 = 60.0;
        let columns = self.columns();
        let width = self.column_px();
        let most = most_ticks(width * columns as f64, TICK_ROOM_PX);
        let step = columns.div_ceil(most).max(1);
        let set = Type::new(TICK_PX).colour(GREY).at(Across::Middle, Along::Top);
        for k in (0..columns).step_by(step) {
            canvas.text([left + (k as f64 + 0.5) * width, foot + 4.0], &(k + 1).to_string(), set)?;
        }
        let middle = [left + 0.5 * width * columns as f64, foot + TICK_PX + 12.0];
        canvas.text(middle, &self.column_title, Type::new(LABEL_PX).at(Across::Middle, Along::Top))
    }
}

/// Shade of the `level`-th of `levels`, from one.
fn shade(level: usize, levels: usize) -> f64 {
    const LIGHTEST: f64 = 0.25;
    LIGHTEST + (1.0 - LIGHTEST) * (level - 1) as f64 / (levels - 1).max(1) as f64
}

struct Sample {
    name: String,
    colour: Colour,
    opacity: f64,
}

impl Entry for Sample {
    fn name(&self) -> &str {
        &self.name
    }

    fn sample(&self, canvas: &Canvas, [from, to]: [f64; 2], y: f64) -> Result<(), PlotError> {
        canvas.cell([from + 10.0, y - 6.0], [to, y + 6.0], self.colour, self.opacity)
    }
}
