//! The plotting area with its grid, ticks and axis titles.

use super::axis::Scale;
use super::canvas::{Across, Along, Canvas, Point, Type};
use super::error::PlotError;
use super::style::{GREY, GRID, INK, LABEL_PX, TICK_PX, text_width};

/// A rectangle in px: left, top, right, bottom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rect {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

/// Gap between axis and tick label, px.
const TICK_GAP_PX: f64 = 6.0;
const HAIR_PX: f64 = 1.0;

/// Two settled axes in a rectangle.
pub(super) struct Frame {
    pub(super) inner: Rect,
    pub(super) x: Scale,
    pub(super) y: Scale,
}

impl Frame {
    /// Axes in `outer`, with room for labels left and below.
    pub(super) fn new(outer: Rect, x: Scale, y: Scale) -> Self {
        let left = outer.left + left_room(&y);
        let bottom = outer.bottom - (TICK_GAP_PX + TICK_PX + 8.0 + LABEL_PX);
        Self { inner: Rect { left, bottom, ..outer }, x, y }
    }

    /// The frame with its left edge elsewhere, so that frames above each other align.
    pub(super) fn with_left(mut self, left: f64) -> Self {
        self.inner.left = left;
        self
    }

    /// Place of `[x, y]` in px.
    pub(super) fn place(&self, [x, y]: [f64; 2]) -> Point {
        let Rect { left, top, right, bottom } = self.inner;
        [self.x.place(x, [left, right]), self.y.place(y, [bottom, top])]
    }

    /// Grid, both axes, tick labels and titles.
    pub(super) fn draw(&self, canvas: &Canvas, x_title: &str, y_title: &str) -> Result<(), PlotError> {
        self.draw_x_ticks(canvas)?;
        self.draw_y_ticks(canvas)?;
        let Rect { left, top, right, bottom } = self.inner;
        canvas.line(&[[left, bottom], [right, bottom]], INK, HAIR_PX, None)?;
        let set = Type::new(LABEL_PX).at(Across::Middle, Along::Top);
        let below = bottom + TICK_GAP_PX + TICK_PX + 7.0;
        canvas.text_within([f64::midpoint(left, right), below], x_title, set, title_room(&self.inner))?;
        self.draw_y_title(canvas, y_title, [top, bottom])
    }

    /// The title of the y axis, read upwards at the far left.
    pub(super) fn draw_y_title(
        &self,
        canvas: &Canvas,
        title: &str,
        [top, bottom]: [f64; 2],
    ) -> Result<(), PlotError> {
        let set = Type::new(LABEL_PX).at(Across::Middle, Along::Foot).upright();
        let x = self.inner.left - TICK_GAP_PX - widest_tick(&self.y) - 6.0;
        canvas.text_within([x, f64::midpoint(top, bottom)], title, set, bottom - top + 30.0)
    }

    fn draw_x_ticks(&self, canvas: &Canvas) -> Result<(), PlotError> {
        let Rect { left, top, right, bottom } = self.inner;
        let set = Type::new(TICK_PX).colour(GREY).at(Across::Middle, Along::Top);
        let x = |tick: f64| self.x.place(tick, [left, right]);
        for &tick in &self.x.ticks {
            canvas.line(&[[x(tick), top], [x(tick), bottom]], GRID, HAIR_PX, None)?;
        }
        let text = |tick: &f64| canvas.text([x(*tick), bottom + TICK_GAP_PX], &self.x.text(*tick), set);
        self.x.ticks.iter().try_for_each(text)
    }

    pub(super) fn draw_y_ticks(&self, canvas: &Canvas) -> Result<(), PlotError> {
        let Rect { left, top, right, bottom } = self.inner;
        let set = Type::new(TICK_PX).colour(GREY).at(Across::Right, Along::Middle);
        let y = |tick: f64| self.y.place(tick, [bottom, top]);
        for &tick in &self.y.ticks {
            canvas.line(&[[left, y(tick)], [right, y(tick)]], GRID, HAIR_PX, None)?;
        }
        let text = |tick: &f64| canvas.text([left - TICK_GAP_PX, y(*tick)], &self.y.text(*tick), set);
        self.y.ticks.iter().try_for_each(text)
    }
}

/// Room that the title and tick labels of a y axis take, px.
pub(super) fn left_room(y: &Scale) -> f64 {
    LABEL_PX + 8.0 + widest_tick(y) + TICK_GAP_PX
}

/// Room for the title of the x axis, which may reach a little beyond it, px.
fn title_room(inner: &Rect) -> f64 {
    inner.right - inner.left + 40.0
}

fn widest_tick(y: &Scale) -> f64 {
    y.ticks.iter().map(|&t| text_width(&y.text(t), TICK_PX)).fold(0.0, f64::max)
}

/// Most ticks that an axis of this length carries without crowding.
pub(super) fn most_ticks(length_px: f64, room_px: f64) -> usize {
    // A whole number of at most a few dozen.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let most = (length_px / room_px) as usize;
    most.clamp(3, 9)
}
