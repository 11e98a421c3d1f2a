//! Groups of bars over names.

use super::axis::Axis;
use super::canvas::{Across, Along, Canvas, Type, svg};
use super::chart::{MARGIN_PX, title};
use super::error::{PlotError, finite, length, not_empty, positive};
use super::frame::{Frame, Rect, most_ticks};
use super::legend::{self, Entry};
use super::series::error_bar;
use super::style::{INK, Look, NARROW_PX, TICK_PX, text_width};

/// Groups of bars: one group for each category, one bar in it for each set.
#[derive(Debug, Clone, PartialEq)]
pub struct Bars {
    title: String,
    categories: Vec<String>,
    y: Axis,
    sets: Vec<Set>,
    size_px: [f64; 2],
}

#[derive(Debug, Clone, PartialEq)]
struct Set {
    name: String,
    values: Vec<f64>,
    errors: Vec<f64>,
}

impl Bars {
    /// An empty chart over names, 720 x 360 px.
    pub fn new(title: impl Into<String>, categories: Vec<String>, y: Axis) -> Self {
        Self { title: title.into(), categories, y, sets: Vec::new(), size_px: [720.0, 360.0] }
    }

    /// The chart with one bar more in each group; one value for each category.
    #[must_use]
    pub fn with(mut self, name: impl Into<String>, values: Vec<f64>) -> Self {
        self.sets.push(Set { name: name.into(), values, errors: Vec::new() });
        self
    }

    /// Error bars of the set added last: half-length above and below each value.
    #[must_use]
    pub fn with_errors(mut self, half_lengths: Vec<f64>) -> Self {
        if let Some(set) = self.sets.last_mut() {
            set.errors = half_lengths;
        }
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
        let entries = self.sets.iter().enumerate().map(|(i, s)| (s.name.as_str(), Look::nth(i)));
        let entries: Vec<(&str, Look)> = entries.filter(|(name, _)| !name.is_empty()).collect();
        svg(self.size_px, &self.title, |canvas| {
            let [width, height] = self.size_px;
            let room = width - 2.0 * MARGIN_PX;
            let top = title(canvas, &self.title, [MARGIN_PX, MARGIN_PX], room)?;
            legend::draw(canvas, &entries, [MARGIN_PX, top], room)?;
            let top = top + legend::height(&entries, room) + 6.0;
            self.draw(
                canvas,
                Rect { left: MARGIN_PX, top, right: width - MARGIN_PX, bottom: height - MARGIN_PX },
            )
        })
    }

    fn check(&self) -> Result<(), PlotError> {
        not_empty(&self.title, self.categories.len().min(self.sets.len()))?;
        finite(&self.title, "an axis", self.y.fixed().chain(&self.size_px))?;
        positive(&self.title, "the foot of the bars", self.y.is_logarithmic().then_some(&0.0))?;
        for set in &self.sets {
            let what = format!("set \"{}\"", set.name);
            length(&self.title, &what, set.values.len(), self.categories.len())?;
            if !set.errors.is_empty() {
                length(
                    &self.title,
                    &format!("the list of errors of {what}"),
                    set.errors.len(),
                    set.values.len(),
                )?;
            }
            finite(&self.title, &what, set.values.iter().chain(&set.errors))?;
        }
        Ok(())
    }

    fn draw(&self, canvas: &Canvas, outer: Rect) -> Result<(), PlotError> {
        const TICK_ROOM_PX: f64 = 28.0;
        let most = most_ticks(outer.bottom - outer.top, TICK_ROOM_PX);
        let [low, high] = self.extent();
        let y = self.y.clone().with_range(low, high).scale([], most);
        let x = Axis::new("", "").with_range(0.0, self.categories.len() as f64).with_ticks(Vec::new());
        let mut frame = Frame::new(outer, x.scale([], most), y);
        frame.inner.bottom = outer.bottom - self.label_room(&frame);
        frame.draw_y_ticks(canvas)?;
        frame.draw_y_title(canvas, &self.y.label(), [frame.inner.top, frame.inner.bottom])?;
        self.draw_bars(canvas, &frame)?;
        self.draw_categories(canvas, &frame)
    }

    /// Range of the bars with their errors and zero, with some air where bars end.
    fn extent(&self) -> [f64; 2] {
        const AIR: f64 = 0.05;
        let error = |s: &Set, i: usize| s.errors.get(i).copied().unwrap_or(0.0);
        let [mut low, mut high] = [0.0_f64; 2];
        for set in &self.sets {
            for (i, value) in set.values.iter().enumerate() {
                low = low.min(value - error(set, i));
                high = high.max(value + error(set, i));
            }
        }
        let span = if high > low { high - low } else { 1.0 };
        [if low < 0.0 { low - AIR * span } else { 0.0 }, if high > 0.0 { high + AIR * span } else { 0.0 }]
    }

    fn group_px(&self, frame: &Frame) -> f64 {
        (frame.inner.right - frame.inner.left) / self.categories.len() as f64
    }

    fn widest_category(&self) -> f64 {
        self.categories.iter().map(|c| text_width(c, TICK_PX)).fold(0.0, f64::max)
    }

    fn upright(&self, frame: &Frame) -> bool {
        self.widest_category() > self.group_px(frame) - 4.0
    }

    fn label_room(&self, frame: &Frame) -> f64 {
        10.0 + if self.upright(frame) { self.widest_category() } else { TICK_PX + 4.0 }
    }

    fn draw_bars(&self, canvas: &Canvas, frame: &Frame) -> Result<(), PlotError> {
        const GROUP_SHARE: f64 = 0.76;
        const BETWEEN_PX: f64 = 1.5;
        let width = GROUP_SHARE / self.sets.len() as f64;
        for (i, set) in self.sets.iter().enumerate() {
            let look = Look::nth(i);
            for (k, &value) in set.values.iter().enumerate() {
                let from = k as f64 + 0.5 * (1.0 - GROUP_SHARE) + i as f64 * width;
                let [left, top] = frame.place([from, value]);
                let [right, foot] = frame.place([from + width, 0.0]);
                canvas.rectangle([left, top], [right - BETWEEN_PX, foot], look.colour)?;
                if let Some(error) = set.errors.get(k) {
                    let ends = [value + error, value - error].map(|y| frame.place([from, y])[1]);
                    let mid = f64::midpoint(left, right - BETWEEN_PX);
                    error_bar(canvas, mid, ends, Look { colour: INK, ..look })?;
                }
            }
        }
        let Rect { left, right, .. } = frame.inner;
        let zero = frame.place([0.0, 0.0])[1];
        canvas.line(&[[left, zero], [right, zero]], INK, 1.0, None)
    }

    fn draw_categories(&self, canvas: &Canvas, frame: &Frame) -> Result<(), PlotError> {
        let upright = self.upright(frame);
        for (k, name) in self.categories.iter().enumerate() {
            let x = frame.place([k as f64 + 0.5, 0.0])[0];
            let at = [x, frame.inner.bottom + 6.0];
            let set = if upright {
                Type::new(TICK_PX).at(Across::Right, Along::Middle).upright()
            } else {
                Type::new(TICK_PX).at(Across::Middle, Along::Top)
            };
            canvas.text(at, name, set)?;
        }
        Ok(())
    }
}

impl Entry for (&str, Look) {
    fn name(&self) -> &str {
        self.0
    }

    fn sample(&self, canvas: &Canvas, [from, to]: [f64; 2], y: f64) -> Result<(), PlotError> {
        const HALF_PX: f64 = 5.0;
        canvas.rectangle([from + 6.0, y - HALF_PX], [to - 6.0, y + HALF_PX], self.1.colour)
    }
}
