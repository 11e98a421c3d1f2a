//! Bars that lie below each other, with a line to compare with: how an error falls to the noise.

use super::canvas::{Across, Along, Canvas, Type, svg};
use super::chart::MARGIN_PX;
use super::error::{PlotError, finite, not_empty};
use super::frame::Rect;
use super::style::{GREY, GRID, LABEL_PX, Look, TICK_PX, TITLE_PX, text_width};

/// Height of one bar with the gap below it, px.
const ROW_PX: f64 = 30.0;
const BAR_PX: f64 = 18.0;
/// Above the first bar of a group: its title, and the name of its line.
const HEAD_PX: f64 = 44.0;
/// Between two groups.
const BETWEEN_PX: f64 = 22.0;

/// Groups of bars that lie below each other.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Rungs {
    groups: Vec<Group>,
}

#[derive(Debug, Clone, PartialEq)]
struct Group {
    title: String,
    line: Option<Line>,
    bars: Vec<Bar>,
}

#[derive(Debug, Clone, PartialEq)]
struct Line {
    name: String,
    at: f64,
    half_band: f64,
}

#[derive(Debug, Clone, PartialEq)]
struct Bar {
    name: String,
    value: f64,
    text: String,
    look: usize,
}

impl Rungs {
    /// The chart with one group more.
    #[must_use]
    pub fn group(mut self, title: impl Into<String>) -> Self {
        self.groups.push(Group { title: title.into(), line: None, bars: Vec::new() });
        self
    }

    /// The last group with a line across its bars, and a band of this half-width about it.
    #[must_use]
    pub fn line(mut self, name: impl Into<String>, at: f64, half_band: f64) -> Self {
        if let Some(group) = self.groups.last_mut() {
            group.line = Some(Line { name: name.into(), at, half_band });
        }
        self
    }

    /// The last group with one bar more: its name, its length, the text behind it, its look.
    #[must_use]
    pub fn bar(mut self, name: impl Into<String>, value: f64, text: impl Into<String>, look: usize) -> Self {
        if let Some(group) = self.groups.last_mut() {
            group.bars.push(Bar { name: name.into(), value, text: text.into(), look });
        }
        self
    }

    /// The chart as SVG of a width, px.
    ///
    /// # Errors
    /// [`PlotError::NotFinite`], [`PlotError::Empty`].
    pub fn to_svg(&self, width_px: f64) -> Result<String, PlotError> {
        self.check()?;
        svg([width_px, self.height() + 2.0 * MARGIN_PX], "", |canvas| {
            let outer = Rect { left: MARGIN_PX, top: MARGIN_PX, right: width_px - MARGIN_PX, bottom: 0.0 };
            self.draw(canvas, &outer)
        })
    }

    /// The same in words, a sentence for each group: its bars, and the line they are compared with.
    pub fn words(&self) -> Vec<String> {
        self.groups.iter().map(Group::words).collect()
    }

    pub(super) fn check(&self) -> Result<(), PlotError> {
        not_empty("", self.groups.iter().map(|g| g.bars.len()).sum())?;
        let values = self.groups.iter().flat_map(|g| {
            let line = g.line.iter().flat_map(|l| [&l.at, &l.half_band]);
            g.bars.iter().map(|b| &b.value).chain(line)
        });
        finite("", "a bar", values)
    }

    /// Height of all groups, px.
    pub(super) fn height(&self) -> f64 {
        let of = |g: &Group| HEAD_PX + ROW_PX * g.bars.len() as f64;
        let between = BETWEEN_PX * self.groups.len().saturating_sub(1) as f64;
        self.groups.iter().map(of).sum::<f64>() + between
    }

    /// Draws the groups from the upper left corner of a rectangle.
    pub(super) fn draw(&self, canvas: &Canvas, outer: &Rect) -> Result<(), PlotError> {
        let mut top = outer.top;
        for group in &self.groups {
            group.draw(canvas, outer, top)?;
            top += HEAD_PX + ROW_PX * group.bars.len() as f64 + BETWEEN_PX;
        }
        Ok(())
    }
}

impl Group {
    fn words(&self) -> String {
        let bars: Vec<String> = self.bars.iter().map(|b| format!("{} {}", b.name, b.text)).collect();
        let line = self.line.as_ref().map(|line| format!(" (line: {})", line.name)).unwrap_or_default();
        format!("{}: {}{line}.", self.title, bars.join(", "))
    }

    fn draw(&self, canvas: &Canvas, outer: &Rect, top: f64) -> Result<(), PlotError> {
        const GAP_PX: f64 = 8.0;
        let widest =
            |of: fn(&Bar) -> &str| self.bars.iter().map(|b| text_width(of(b), LABEL_PX)).fold(0.0, f64::max);
        let half = 0.5 * (outer.right - outer.left);
        let names = widest(|b| &b.name).min(half);
        let left = outer.left + names + GAP_PX;
        let right = outer.right - widest(|b| &b.text) - GAP_PX;
        let line_end = self.line.as_ref().map_or(0.0, |l| l.at + l.half_band);
        let longest = self.bars.iter().map(|b| b.value).fold(line_end, f64::max).max(f64::MIN_POSITIVE);
        let place = |value: f64| left + (right - left) * value.max(0.0) / longest;
        let ends = [top + HEAD_PX - 6.0, top + HEAD_PX + ROW_PX * self.bars.len() as f64 - 4.0];
        canvas.text_within(
            [outer.left, top + 8.0],
            &self.title,
            Type::new(TITLE_PX).bold(),
            outer.right - outer.left,
        )?;
        if let Some(line) = self.line.as_ref().filter(|line| line.half_band > 0.0) {
            let band = [place(line.at - line.half_band), place(line.at + line.half_band)];
            canvas.cell([band[0], ends[0]], [band[1], ends[1]], GRID, 1.0)?;
        }
        for (k, bar) in self.bars.iter().enumerate() {
            let middle = top + HEAD_PX + ROW_PX * k as f64 + 0.5 * BAR_PX;
            let (above, below) = (middle - 0.5 * BAR_PX, middle + 0.5 * BAR_PX);
            canvas.text_within([outer.left, middle], &bar.name, Type::new(LABEL_PX), names + 1.0)?;
            canvas.rectangle(
                [left, above],
                [place(bar.value).max(left + 2.0), below],
                Look::nth(bar.look).colour,
            )?;
            let end = place(bar.value).max(left) + GAP_PX;
            let text = self.beside_line(end, text_width(&bar.text, LABEL_PX), &place, GAP_PX);
            canvas.text([text, middle], &bar.text, Type::new(LABEL_PX).bold())?;
        }
        self.draw_line(canvas, &place, ends, outer)
    }

    /// Where a text of a width begins that would begin at a place: beyond the line and its band where they would cross it.
    fn beside_line(&self, at: f64, width: f64, place: &impl Fn(f64) -> f64, gap: f64) -> f64 {
        let Some(line) = &self.line else { return at };
        let [first, last] = [line.at - line.half_band, line.at + line.half_band].map(place);
        if at < last + gap && at + width > first { last + gap } else { at }
    }

    /// The line and its name, on top of the bars.
    fn draw_line(
        &self,
        canvas: &Canvas,
        place: &impl Fn(f64) -> f64,
        [above, below]: [f64; 2],
        outer: &Rect,
    ) -> Result<(), PlotError> {
        const LINE_PX: f64 = 1.6;
        let Some(line) = &self.line else { return Ok(()) };
        let x = place(line.at);
        let look = Look::reference();
        canvas.line(&[[x, above], [x, below]], look.colour, LINE_PX, look.dash)?;
        let half = 0.5 * text_width(&line.name, TICK_PX);
        let x = x.clamp(outer.left + half, (outer.right - half).max(outer.left + half));
        let set = Type::new(TICK_PX).colour(GREY).at(Across::Middle, Along::Middle);
        canvas.text([x, above - 8.0], &line.name, set)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_are_as_long_as_they_say_beside_their_line() {
        let rungs = Rungs::default()
            .group("error")
            .line("noise", 1.0, 0.1)
            .bar("a", 2.0, "2", 1)
            .bar("b", 1.0, "1", 0);
        let svg = rungs.to_svg(400.0).unwrap_or_default();
        let widths: Vec<f64> = svg
            .split("<path fill=\"#")
            .filter(|p| p.starts_with("D55E00") || p.starts_with("0072B2"))
            .filter_map(|p| p.split('h').nth(1)?.split('v').next()?.parse().ok())
            .collect();
        assert_eq!(widths.len(), 2, "{svg}");
        assert!((widths[0] / widths[1] - 2.0).abs() < 0.01, "{widths:?}");
        assert!(svg.contains(">noise<") && svg.contains("stroke-dasharray"));
    }

    #[test]
    fn the_text_of_a_short_bar_does_not_cross_the_line() {
        let rungs = Rungs::default().group("error").line("noise", 1.0, 0.05).bar("a", 0.9, "0.90 x", 0);
        let begins =
            |at: f64| format!("{:.0}", rungs.groups[0].beside_line(at, 30.0, &|value| 100.0 * value, 8.0));
        assert_eq!([20.0, 90.0, 100.0, 120.0].map(begins), ["20", "113", "113", "120"]);
    }

    #[test]
    fn what_is_drawn_is_told_in_words() {
        let rungs = Rungs::default().group("error").line("noise", 1.0, 0.1).bar("a", 2.0, "2 x", 1);
        assert_eq!(
            rungs.group("more").bar("b", 1.0, "1 um", 0).words(),
            ["error: a 2 x (line: noise).", "more: b 1 um."]
        );
    }

    #[test]
    fn nothing_and_what_is_no_number_are_refused() {
        assert!(matches!(Rungs::default().group("a").to_svg(400.0), Err(PlotError::Empty { .. })));
        let rungs = Rungs::default().group("a").bar("a", f64::NAN, "", 0);
        assert!(matches!(rungs.to_svg(400.0), Err(PlotError::NotFinite { .. })));
    }
}
