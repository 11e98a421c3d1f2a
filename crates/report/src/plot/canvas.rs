//! The sheet: lines, areas, markers and text in pixels.
//!
//! Plotters places everything on whole units, which makes lines wobble at one unit per pixel; the sheet is therefore
//! drawn in tenths of a pixel and shown at its true size by its view box.

use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, IntoDrawingArea};
use plotters::element::{Circle, DashedPathElement, PathElement, Polygon, Rectangle, Text};
use plotters::prelude::SVGBackend;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontStyle, FontTransform, IntoFont, RGBColor, ShapeStyle, TextStyle};

use super::error::PlotError;
use super::style::{Dash, INK, Marker, PAPER, text_width};

/// Units of the drawing per pixel.
const UNITS: f64 = 10.0;

/// A point in pixels from the upper left corner.
pub(super) type Point = [f64; 2];

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// A sheet to draw on.
pub(super) struct Canvas<'a> {
    area: Area<'a>,
}

/// How a text is set.
#[derive(Clone, Copy)]
pub(super) struct Type {
    pub(super) px: f64,
    pub(super) colour: RGBColor,
    pub(super) bold: bool,
    pub(super) across: HPos,
    pub(super) along: VPos,
    /// Read from bottom to top.
    pub(super) upright: bool,
}

impl Type {
    /// Plain text of a size, its left middle at the given point.
    pub(super) fn new(px: f64) -> Self {
        Self { px, colour: INK, bold: false, across: HPos::Left, along: VPos::Center, upright: false }
    }

    pub(super) fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    pub(super) fn colour(self, colour: RGBColor) -> Self {
        Self { colour, ..self }
    }

    pub(super) fn at(self, across: HPos, along: VPos) -> Self {
        Self { across, along, ..self }
    }

    pub(super) fn upright(self) -> Self {
        Self { upright: true, ..self }
    }
}

/// Draws a sheet of the given size (px) and returns its SVG.
pub(super) fn svg(
    size: [f64; 2],
    title: &str,
    draw: impl FnOnce(&Canvas<'_>) -> Result<(), PlotError>,
) -> Result<String, PlotError> {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, (extent(size[0]), extent(size[1]))).into_drawing_area();
        area.fill(&PAPER).map_err(failed)?;
        let canvas = Canvas { area };
        draw(&canvas)?;
        canvas.area.present().map_err(failed)?;
    }
    Ok(at_true_size(&text, size, title))
}

/// The drawing with its width and height in pixels and its title for readers who do not see.
fn at_true_size(drawn: &str, [width, height]: [f64; 2], title: &str) -> String {
    let body = drawn.split_once('>').map_or("", |(_, body)| body);
    let (w, h) = (extent(width), extent(height));
    let title = escaped(title);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
         viewBox=\"0 0 {w} {h}\" role=\"img\">\n<title>{title}</title>{body}"
    )
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

// Coordinates were checked to be finite and lie on the sheet, a few thousand units wide.
#[allow(clippy::cast_possible_truncation)]
fn units(px: f64) -> i32 {
    (px * UNITS).round() as i32
}

fn extent(px: f64) -> u32 {
    units(px).unsigned_abs()
}

fn place([x, y]: Point) -> (i32, i32) {
    (units(x), units(y))
}

#[allow(clippy::needless_pass_by_value, reason = "shape of map_err")]
fn failed(error: impl std::fmt::Display) -> PlotError {
    PlotError::Drawing(error.to_string())
}

fn stroke(colour: RGBColor, width: f64) -> ShapeStyle {
    ShapeStyle { color: colour.to_rgba(), filled: false, stroke_width: extent(width) }
}

impl Canvas<'_> {
    /// A line through points.
    pub(super) fn line(
        &self,
        points: &[Point],
        colour: RGBColor,
        width: f64,
        dash: Dash,
    ) -> Result<(), PlotError> {
        let points: Vec<_> = points.iter().copied().map(place).collect();
        let style = stroke(colour, width);
        match dash {
            None => self.area.draw(&PathElement::new(points, style)).map_err(failed),
            Some((on, off)) => {
                let dashed = DashedPathElement::new(points, units(on), units(off), style);
                self.area.draw(&dashed).map_err(failed)
            }
        }
    }

    /// A filled rectangle between two corners.
    pub(super) fn rectangle(&self, a: Point, b: Point, colour: RGBColor) -> Result<(), PlotError> {
        let upper_left = [a[0].min(b[0]), a[1].min(b[1])];
        let lower_right = [a[0].max(b[0]), a[1].max(b[1])];
        let corners = [place(upper_left), place(lower_right)];
        self.area.draw(&Rectangle::new(corners, colour.filled())).map_err(failed)
    }

    /// A filled area, see-through by `opacity`.
    pub(super) fn polygon(&self, points: &[Point], colour: RGBColor, opacity: f64) -> Result<(), PlotError> {
        let points: Vec<_> = points.iter().copied().map(place).collect();
        self.area.draw(&Polygon::new(points, colour.mix(opacity))).map_err(failed)
    }

    /// A marker about a point; `size` is about its half-width.
    pub(super) fn marker(
        &self,
        at: Point,
        marker: Marker,
        colour: RGBColor,
        size: f64,
    ) -> Result<(), PlotError> {
        const RIM_PX: f64 = 1.5;
        let corner = |x: f64, y: f64| [at[0] + x * size, at[1] + y * size];
        match marker {
            Marker::Circle => {
                self.area.draw(&Circle::new(place(at), units(size), colour.filled())).map_err(failed)
            }
            Marker::Ring => {
                self.area.draw(&Circle::new(place(at), units(size), PAPER.filled())).map_err(failed)?;
                self.area.draw(&Circle::new(place(at), units(size), stroke(colour, RIM_PX))).map_err(failed)
            }
            Marker::Square => self.rectangle(corner(-0.9, -0.9), corner(0.9, 0.9), colour),
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

    /// A line of text. Upright text is turned a quarter to the left; its anchor turns with it.
    pub(super) fn text(&self, at: Point, text: &str, set: Type) -> Result<(), PlotError> {
        // The backend divides by this to turn heights of boxes into sizes of fonts.
        const BOX_PER_EM: f64 = 1.24;
        let style = if set.bold { FontStyle::Bold } else { FontStyle::Normal };
        let turn = if set.upright { FontTransform::Rotate270 } else { FontTransform::None };
        let font = ("Helvetica, Arial, sans-serif", set.px * UNITS * BOX_PER_EM)
            .into_font()
            .style(style)
            .transform(turn);
        let style = TextStyle::from(font).color(&set.colour).pos(Pos::new(set.across, set.along));
        self.area.draw(&Text::new(text.to_owned(), place(at), style)).map_err(failed)
    }

    /// Text that is shortened with an ellipsis when it is wider than `room` px.
    pub(super) fn text_within(&self, at: Point, text: &str, set: Type, room: f64) -> Result<(), PlotError> {
        if text_width(text, set.px) <= room {
            return self.text(at, text, set);
        }
        let mut short = text.to_owned();
        while !short.is_empty() && text_width(&short, set.px) + set.px > room {
            short.pop();
        }
        self.text(at, &format!("{}…", short.trim_end()), set)
    }
}
