//! Edges in space, seen from several sides in parallel projection; the same scale on every view.

mod marks;
mod view;

use self::marks::{arrow, beside, scale_bar};
use self::view::View;
use super::canvas::{Across, Along, Canvas, Type, svg};
use super::chart::{MARGIN_PX, TITLE_ROW_PX, title};
use super::error::{PlotError, finite, not_empty};
use super::frame::Rect;
use super::legend::{self, Entry};
use super::rungs::Rungs;
use super::style::{LABEL_PX, Look, NARROW_PX};

/// Side of one view, px.
const VIEW_PX: f64 = 420.0;
/// Width of an edge, px; of one that another may hide.
const EDGE_PX: f64 = 1.8;
const WIDE_PX: f64 = 5.0;
/// Width of bars beside the views, px.
const BARS_PX: f64 = 430.0;

/// An edge between two points.
pub type Edge = [[f64; 3]; 2];

/// Bodies made of edges.
#[derive(Debug, Clone, PartialEq)]
pub struct Wireframe {
    title: String,
    views: Vec<View>,
    bodies: Vec<Body>,
    marks: Vec<(String, [f64; 3])>,
    arrows: Vec<(String, Edge)>,
    scale_bar: Option<(String, f64)>,
    bars: Option<Attached>,
}

/// Bars with their place: right of the views, or below them.
#[derive(Debug, Clone, PartialEq)]
struct Attached {
    rungs: Rungs,
    below: bool,
}

#[derive(Debug, Clone, PartialEq)]
struct Body {
    name: String,
    look: Option<usize>,
    edges: Vec<Edge>,
    width: f64,
}

impl Wireframe {
    /// Nothing to see yet.
    pub fn new(title: impl Into<String>) -> Self {
        let (views, bodies, marks, arrows) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { title: title.into(), views, bodies, marks, arrows, scale_bar: None, bars: None }
    }

    /// The drawing with one view more: turned about the z axis and seen from an elevation (90: from above), degrees.
    #[must_use]
    pub fn seen(mut self, name: impl Into<String>, azimuth_deg: f64, elevation_deg: f64) -> Self {
        self.views.push(View::new(name, azimuth_deg, elevation_deg));
        self
    }

    /// The drawing with one body more; without a look it is gray and dashed. Later bodies lie on top.
    #[must_use]
    pub fn with(self, name: impl Into<String>, look: Option<usize>, edges: Vec<Edge>) -> Self {
        self.body(Body { name: name.into(), look, edges, width: EDGE_PX })
    }

    /// The same with wide edges, which show on both sides of a later body in the same place.
    #[must_use]
    pub fn with_wide(self, name: impl Into<String>, look: Option<usize>, edges: Vec<Edge>) -> Self {
        self.body(Body { name: name.into(), look, edges, width: WIDE_PX })
    }

    fn body(mut self, body: Body) -> Self {
        self.bodies.push(body);
        self
    }

    /// The drawing with an arrow and a text at its point.
    #[must_use]
    pub fn arrow(mut self, text: impl Into<String>, from_to: Edge) -> Self {
        self.arrows.push((text.into(), from_to));
        self
    }

    /// The drawing with a bar of a length in space below the first view, and a text beside it.
    #[must_use]
    pub fn scale_bar(mut self, text: impl Into<String>, length: f64) -> Self {
        self.scale_bar = Some((text.into(), length));
        self
    }

    /// The drawing with bars on its right.
    #[must_use]
    pub fn beside(mut self, rungs: Rungs) -> Self {
        self.bars = Some(Attached { rungs, below: false });
        self
    }

    /// The drawing with bars below it, for a narrow page.
    #[must_use]
    pub fn above(mut self, rungs: Rungs) -> Self {
        self.bars = Some(Attached { rungs, below: true });
        self
    }

    /// The drawing with a short text beside a point, away from the middle of the view.
    #[must_use]
    pub fn marked(mut self, text: impl Into<String>, point: [f64; 3]) -> Self {
        self.marks.push((text.into(), point));
        self
    }

    /// The drawing as SVG.
    ///
    /// # Errors
    /// [`PlotError::NotFinite`], [`PlotError::Empty`].
    pub fn to_svg(&self) -> Result<String, PlotError> {
        not_empty(&self.title, self.views.len().min(self.bodies.len()))?;
        for body in &self.bodies {
            finite(
                &self.title,
                &format!("an edge of \"{}\"", body.name),
                body.edges.iter().flatten().flatten(),
            )?;
        }
        finite(&self.title, "a mark", self.marks.iter().flat_map(|(_, point)| point))?;
        finite(&self.title, "an arrow", self.arrows.iter().flat_map(|(_, ends)| ends.iter().flatten()))?;
        finite(&self.title, "the bar of scale", self.scale_bar.iter().map(|(_, length)| length))?;
        self.bars.as_ref().map_or(Ok(()), |bars| bars.rungs.check())?;
        let entries: Vec<&Body> = self.bodies.iter().collect();
        let views = self.views.len() as f64 * self.view_px();
        let [right, under] = self.bars.as_ref().map_or([0.0; 2], Attached::room);
        let width = 2.0 * MARGIN_PX + views + right;
        let room = width - 2.0 * MARGIN_PX;
        let head = MARGIN_PX + if self.title.is_empty() { 0.0 } else { TITLE_ROW_PX };
        let below = head + legend::height(&entries, room) + 4.0;
        svg([width, below + self.view_px() + under + MARGIN_PX], &self.title, |canvas| {
            let top = title(canvas, &self.title, [MARGIN_PX, MARGIN_PX], room)?;
            legend::draw(canvas, &entries, [MARGIN_PX, top], room)?;
            self.draw(canvas, below)?;
            let Some(bars) = &self.bars else { return Ok(()) };
            bars.draw(
                canvas,
                &Rect {
                    left: MARGIN_PX,
                    top: below,
                    right: width - MARGIN_PX,
                    bottom: below + self.view_px(),
                },
                views,
            )
        })
    }

    fn draw(&self, canvas: &Canvas, top: f64) -> Result<(), PlotError> {
        let scale = self.scale();
        for (k, view) in self.views.iter().enumerate() {
            let corner = [MARGIN_PX + k as f64 * self.view_px(), top];
            let [x, y] = self.centre(view);
            let place = |point: &[f64; 3]| {
                let [right, up] = view.project(point);
                [
                    corner[0] + 0.5 * self.view_px() + (right - x) * scale,
                    corner[1] + 0.5 * self.view_px() - (up - y) * scale,
                ]
            };
            canvas.text([corner[0], corner[1] + LABEL_PX], &view.name, Type::new(LABEL_PX))?;
            for body in &self.bodies {
                let look = body.drawn();
                let edges = body.edges.iter().map(|edge| edge.each_ref().map(place));
                edges.into_iter().try_for_each(|e| canvas.line(&e, look.colour, body.width, look.dash))?;
            }
            for (text, ends) in &self.arrows {
                arrow(canvas, text, ends.each_ref().map(place))?;
            }
            let middle = [corner[0] + 0.5 * self.view_px(), corner[1] + 0.5 * self.view_px()];
            let set = Type::new(LABEL_PX).at(Across::Middle, Along::Middle);
            for (text, point) in &self.marks {
                canvas.text(beside(place(point), middle), text, set)?;
            }
        }
        self.scale_bar.as_ref().map_or(Ok(()), |(text, length)| {
            let foot = [MARGIN_PX, top + self.view_px() - 0.5 * LABEL_PX];
            scale_bar(canvas, text, foot, length * scale)
        })
    }

    fn points(&self) -> impl Iterator<Item = &[f64; 3]> {
        let arrows = self.arrows.iter().flat_map(|(_, ends)| ends);
        self.bodies.iter().flat_map(|b| b.edges.iter().flatten()).chain(arrows)
    }

    /// Range of a view across and along.
    fn range(&self, view: &View) -> [[f64; 2]; 2] {
        let empty = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        self.points()
            .map(|p| view.project(p))
            .fold(empty, |range, at| [0, 1].map(|k| [range[k][0].min(at[k]), range[k][1].max(at[k])]))
    }

    fn centre(&self, view: &View) -> [f64; 2] {
        self.range(view).map(|[low, high]| f64::midpoint(low, high))
    }

    /// Width and height of a view, px.
    fn view_px(&self) -> f64 {
        if self.bars.as_ref().is_some_and(|bars| bars.below) { NARROW_PX - 2.0 * MARGIN_PX } else { VIEW_PX }
    }

    /// Pixels per unit at which every view fits.
    fn scale(&self) -> f64 {
        const FILLED: f64 = 0.84;
        let reach = self.views.iter().flat_map(|v| self.range(v)).map(|[low, high]| high - low);
        FILLED * self.view_px() / reach.fold(f64::MIN_POSITIVE, f64::max)
    }
}

impl Attached {
    /// What they need on the right of the views, and below them, px.
    fn room(&self) -> [f64; 2] {
        if self.below { [0.0, MARGIN_PX + self.rungs.height()] } else { [BARS_PX, 0.0] }
    }

    /// Draws them beside or below the rectangle of the views, which are so wide, px.
    fn draw(&self, canvas: &Canvas, outer: &Rect, views: f64) -> Result<(), PlotError> {
        let (left, top) = if self.below {
            (outer.left, outer.bottom + MARGIN_PX)
        } else {
            let middle = 0.5 * (outer.bottom - outer.top - self.rungs.height());
            (outer.left + views + MARGIN_PX, outer.top + middle.max(0.0))
        };
        self.rungs.draw(canvas, &Rect { left, top, ..*outer })
    }
}

impl Body {
    fn drawn(&self) -> Look {
        // Bodies are told apart by color and by where they are: dashes would break their short edges.
        self.look.map_or_else(Look::reference, |n| Look { dash: None, ..Look::nth(n) })
    }
}

impl Entry for &Body {
    fn name(&self) -> &str {
        &self.name
    }

    fn sample(&self, canvas: &Canvas, [from, to]: [f64; 2], y: f64) -> Result<(), PlotError> {
        let look = self.drawn();
        canvas.line(&[[from, y], [to, y]], look.colour, self.width, look.dash)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_below_make_a_narrow_drawing_of_the_same_things() {
        let edge = vec![[[0.0; 3], [1.0, 0.0, 1.0]]];
        let views = Wireframe::new("").seen("", 0.0, 0.0).with("platform", Some(0), edge);
        let bars = Rungs::default().group("error").bar("springs", 1.0, "1 um", 1);
        let [wide, narrow] = [views.clone().beside(bars.clone()), views.above(bars)]
            .map(|drawing| drawing.to_svg().unwrap_or_default());
        let size = |svg: &str, name: &str| {
            svg.split_once(name).and_then(|(_, rest)| rest.split('"').next()?.parse::<f64>().ok())
        };
        assert!(size(&narrow, "width=\"").is_some_and(|width| width <= NARROW_PX), "{narrow}");
        assert!(size(&narrow, "width=\"") < size(&wide, "width=\""), "{narrow}");
        let height_of_error = |svg: &str| {
            svg.split_once(">error<").and_then(|(before, _)| size(before.rsplit("<text").next()?, " y=\""))
        };
        assert!(height_of_error(&narrow) > height_of_error(&wide), "{narrow}");
        assert!(height_of_error(&narrow) > Some(NARROW_PX), "below the machine: {narrow}");
        let texts = |svg: &str| -> Vec<String> {
            svg.split("<text").skip(1).filter_map(|t| Some(t.split(['>', '<']).nth(1)?.to_owned())).collect()
        };
        assert!(texts(&wide) == texts(&narrow) && texts(&wide).len() > 2, "{wide}");
    }

    #[test]
    fn a_body_that_is_nowhere_is_refused() {
        let drawing = Wireframe::new("machine").seen("front", 0.0, 0.0);
        let drawing = drawing.with("platform", None, vec![[[0.0; 3], [f64::NAN, 0.0, 0.0]]]);
        assert!(matches!(drawing.to_svg(), Err(PlotError::NotFinite { .. })));
    }
}
