//! The sheet: lines, areas, markers and text in pixels, written as SVG.
//!
//! What follows each other and looks alike becomes one element: a path of many lines or markers, a group of many texts. A page holds
//! thousands of them and is mailed around.

use std::cell::RefCell;
use std::fmt::Write;

use super::error::PlotError;
use super::style::{Colour, Dash, INK, Marker, PAPER, text_width};
use crate::number::with_micro;

/// A point in pixels from the upper left corner.
pub(super) type Point = [f64; 2];

/// Which end of a text stands at its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Across {
    Left,
    Middle,
    Right,
}

/// Which height of a text stands at its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Along {
    Top,
    Middle,
    Foot,
}

/// How a text is set.
#[derive(Clone, Copy)]
pub(super) struct Type {
    pub(super) px: f64,
    pub(super) colour: Colour,
    pub(super) bold: bool,
    pub(super) across: Across,
    pub(super) along: Along,
    /// Read from bottom to top.
    pub(super) upright: bool,
}

impl Type {
    /// Plain text of a size, its left middle at the given point.
    pub(super) fn new(px: f64) -> Self {
        Self { px, colour: INK, bold: false, across: Across::Left, along: Along::Middle, upright: false }
    }

    pub(super) fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    pub(super) fn colour(self, colour: Colour) -> Self {
        Self { colour, ..self }
    }

    pub(super) fn at(self, across: Across, along: Along) -> Self {
        Self { across, along, ..self }
    }

    pub(super) fn upright(self) -> Self {
        Self { upright: true, ..self }
    }

    /// From the point down to the line the letters stand on, px.
    fn drop(self) -> f64 {
        const OF_TOP: f64 = 0.76;
        const OF_MIDDLE: f64 = 0.35;
        match self.along {
            Along::Top => OF_TOP * self.px,
            Along::Middle => OF_MIDDLE * self.px,
            Along::Foot => 0.0,
        }
    }

    /// Attributes of a group of such texts.
    fn attributes(self) -> String {
        let anchor = match self.across {
            Across::Left => "",
            Across::Middle => " text-anchor=\"middle\"",
            Across::Right => " text-anchor=\"end\"",
        };
        let weight = if self.bold { " font-weight=\"bold\"" } else { "" };
        format!(" fill=\"{}\" font-size=\"{}\"{anchor}{weight}", self.colour, short(self.px))
    }
}

/// A sheet to draw on.
pub(super) struct Canvas {
    ink: RefCell<Ink>,
}

/// What is drawn, and what is still open: elements that look alike are joined.
#[derive(Default)]
struct Ink {
    svg: String,
    open: Option<(Kind, String)>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Path,
    Text,
}

impl Ink {
    fn put(&mut self, kind: Kind, attributes: String, content: &str) -> std::fmt::Result {
        if self.open.as_ref().is_none_or(|(k, a)| *k != kind || *a != attributes) {
            self.close();
            match kind {
                Kind::Path => write!(self.svg, "<path{attributes} d=\"")?,
                Kind::Text => write!(self.svg, "<g{attributes}>")?,
            }
            self.open = Some((kind, attributes));
        }
        self.svg.push_str(content);
        Ok(())
    }

    fn close(&mut self) {
        self.svg.push_str(match self.open.take() {
            Some((Kind::Path, _)) => "\"/>\n",
            Some((Kind::Text, _)) => "</g>\n",
            None => "",
        });
    }
}

/// Draws a sheet of the given size (px) and returns its SVG.
pub(super) fn svg(
    [width, height]: [f64; 2],
    title: &str,
    draw: impl FnOnce(&Canvas) -> Result<(), PlotError>,
) -> Result<String, PlotError> {
    let canvas = Canvas { ink: RefCell::default() };
    canvas.rectangle([0.0, 0.0], [width, height], PAPER)?;
    draw(&canvas)?;
    let mut ink = canvas.ink.into_inner();
    ink.close();
    Ok(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
         viewBox=\"0 0 {} {}\" role=\"img\" font-family=\"Helvetica, Arial, sans-serif\">\n<title>{}</title>\n{}</svg>\n",
        short(width),
        short(height),
        escaped(&with_micro(title)),
        ink.svg
    ))
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// A number of px to a tenth, without a trailing zero.
fn short(px: f64) -> String {
    let text = format!("{px:.1}");
    let text = text.strip_suffix(".0").unwrap_or(&text);
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

fn place([x, y]: Point) -> String {
    format!("{} {}", short(x), short(y))
}

/// `M x y L ...`; the letter of the lines is implied.
fn through(points: impl IntoIterator<Item = Point>) -> String {
    let places: Vec<String> = points.into_iter().map(place).collect();
    format!("M{}", places.join(" "))
}

fn stroke(colour: Colour, width: f64, dash: Dash) -> String {
    let dash = dash
        .map(|(on, off)| format!(" stroke-dasharray=\"{} {}\"", short(on), short(off)))
        .unwrap_or_default();
    format!(" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{}\"{dash}", short(width))
}

fn fill(colour: Colour, opacity: f64) -> String {
    let opacity = if opacity < 1.0 { format!(" fill-opacity=\"{opacity:.2}\"") } else { String::new() };
    format!(" fill=\"{colour}\"{opacity}")
}

impl Canvas {
    fn put(&self, kind: Kind, attributes: String, content: &str) -> Result<(), PlotError> {
        self.ink.borrow_mut().put(kind, attributes, content)?;
        Ok(())
    }

    /// A line through points.
    pub(super) fn line(
        &self,
        points: &[Point],
        colour: Colour,
        width: f64,
        dash: Dash,
    ) -> Result<(), PlotError> {
        self.put(Kind::Path, stroke(colour, width, dash), &through(points.iter().copied()))
    }

    /// A filled rectangle between two corners.
    pub(super) fn rectangle(&self, a: Point, b: Point, colour: Colour) -> Result<(), PlotError> {
        self.cell(a, b, colour, 1.0)
    }

    /// A filled rectangle between two corners, see-through by `opacity`.
    pub(super) fn cell(&self, a: Point, b: Point, colour: Colour, opacity: f64) -> Result<(), PlotError> {
        let [x, y] = [a[0].min(b[0]), a[1].min(b[1])];
        let [width, height] = [(a[0] - b[0]).abs(), (a[1] - b[1]).abs()].map(short);
        self.put(Kind::Path, fill(colour, opacity), &format!("M{}h{width}v{height}h-{width}z", place([x, y])))
    }

    /// A filled area, see-through by `opacity`.
    pub(super) fn polygon(&self, points: &[Point], colour: Colour, opacity: f64) -> Result<(), PlotError> {
        self.put(Kind::Path, fill(colour, opacity), &format!("{}z", through(points.iter().copied())))
    }

    /// A marker about a point; `size` is about its half-width.
    pub(super) fn marker(
        &self,
        at: Point,
        marker: Marker,
        colour: Colour,
        size: f64,
    ) -> Result<(), PlotError> {
        const RIM_PX: f64 = 1.5;
        let corner = |x: f64, y: f64| [at[0] + x * size, at[1] + y * size];
        match marker {
            Marker::Circle => self.dot(at, colour, size),
            Marker::Ring => {
                let rim = format!(" fill=\"{PAPER}\" stroke=\"{colour}\" stroke-width=\"{RIM_PX}\"");
                let (r, d) = (short(size), short(2.0 * size));
                let ring = format!("M{}a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0 -{d} 0z", place(corner(-1.0, 0.0)));
                self.put(Kind::Path, rim, &ring)
            }
            // A line as long as it is wide: the shortest way to say a square.
            Marker::Square => {
                let side = 1.8 * size;
                let line = format!("M{}h{}", place(corner(-0.9, 0.0)), short(side));
                self.put(Kind::Path, stroke(colour, side, None), &line)
            }
            Marker::Triangle => {
                self.polygon(&[corner(-1.1, 0.85), corner(1.1, 0.85), corner(0.0, -1.15)], colour, 1.0)
            }
            Marker::Diamond => {
                let corners = [corner(-1.2, 0.0), corner(0.0, 1.2), corner(1.2, 0.0), corner(0.0, -1.2)];
                self.polygon(&corners, colour, 1.0)
            }
            Marker::Cross => {
                self.line(&[corner(-0.9, -0.9), corner(0.9, 0.9)], colour, RIM_PX, None)?;
                self.line(&[corner(-0.9, 0.9), corner(0.9, -0.9)], colour, RIM_PX, None)
            }
        }
    }

    /// A line without length and with round ends, the shortest way to say a dot. PDF paints such a line with round ends only
    /// (ISO 32000-1, 8.5.3.2): no other marker may be said like this.
    fn dot(&self, at: Point, colour: Colour, size: f64) -> Result<(), PlotError> {
        let line = format!("{} stroke-linecap=\"round\"", stroke(colour, 2.0 * size, None));
        self.put(Kind::Path, line, &format!("M{}h0", place(at)))
    }

    /// A line of text. Upright text is turned a quarter to the left; its anchor turns with it.
    pub(super) fn text(&self, [x, y]: Point, text: &str, set: Type) -> Result<(), PlotError> {
        let turn =
            if set.upright { format!(" transform=\"rotate(-90 {})\"", place([x, y])) } else { String::new() };
        let [x, foot] = [x, y + set.drop()].map(short);
        let element = format!("<text x=\"{x}\" y=\"{foot}\"{turn}>{}</text>", escaped(&with_micro(text)));
        self.put(Kind::Text, set.attributes(), &element)
    }

    /// Text that is shortened with an ellipsis when it is wider than `room` px.
    pub(super) fn text_within(&self, at: Point, text: &str, set: Type, room: f64) -> Result<(), PlotError> {
        if text_width(text, set.px) <= room {
            return self.text(at, text, set);
        }
        self.text(at, &shortened(text, set.px, room), set)
    }
}

/// A text within `room` px: a unit in brackets at its end stays whole.
fn shortened(text: &str, px: f64, room: f64) -> String {
    let (words, unit) = match text.rfind(" (") {
        Some(at) if text.ends_with(')') => text.split_at(at),
        _ => (text, ""),
    };
    let left = room - text_width(unit, px);
    let (words, unit, room) = if left > 0.5 * room { (words, unit, left) } else { (text, "", room) };
    let mut short = words.to_owned();
    while !short.is_empty() && text_width(&short, px) + px > room {
        short.pop();
    }
    format!("{}…{unit}", short.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_title_that_is_too_long_keeps_its_unit() {
        let short = shortened("compliance of all legs (nm/N)", 12.0, 130.0);
        assert!(short.ends_with("… (nm/N)") && short.starts_with("compliance"), "{short}");
        assert!(text_width(&short, 12.0) <= 130.0);
        assert!(shortened("a long title without any unit", 12.0, 60.0).ends_with('…'));
    }
}
