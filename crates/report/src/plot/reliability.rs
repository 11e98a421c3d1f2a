//! Stated probability against observed frequency, with counts.

use super::axis::Axis;
use super::canvas::{Canvas, svg};
use super::chart::{MARGIN_PX, title};
use super::error::{PlotError, finite, not_empty};
use super::frame::{Frame, Rect};
use super::series::{error_bar, marker};
use super::style::{Look, Marker};

/// Statements of about the same probability.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReliabilityBin {
    /// Lower and upper edge, 0 to 1.
    pub edges: [f64; 2],
    /// Mean of the stated probabilities.
    pub stated: f64,
    /// Share of the statements that were true.
    pub observed: f64,
    /// Ends of the interval of the observed share.
    pub interval: [f64; 2],
    /// Number of statements; a bin without any shows in the counts only.
    pub count: usize,
}

/// A reliability diagram: points on the diagonal mean what they say.
#[derive(Debug, Clone, PartialEq)]
pub struct Reliability {
    title: String,
    bins: Vec<ReliabilityBin>,
}

const SIZE_PX: [f64; 2] = [460.0, 540.0];
const COUNTS_PX: f64 = 120.0;

impl Reliability {
    /// A diagram of bins in any order.
    pub fn new(title: impl Into<String>, bins: Vec<ReliabilityBin>) -> Self {
        Self { title: title.into(), bins }
    }

    /// The diagram as SVG, 460 x 540 px.
    ///
    /// # Errors
    /// [`PlotError::NotFinite`], [`PlotError::Empty`].
    pub fn to_svg(&self) -> Result<String, PlotError> {
        not_empty(&self.title, self.bins.iter().map(|b| b.count).sum())?;
        for (i, b) in self.bins.iter().enumerate().filter(|(_, b)| b.count > 0) {
            let numbers = [b.edges[0], b.edges[1], b.stated, b.observed, b.interval[0], b.interval[1]];
            finite(&self.title, &format!("bin {}", i + 1), &numbers)?;
        }
        svg(SIZE_PX, &self.title, |canvas| {
            let room = SIZE_PX[0] - 2.0 * MARGIN_PX;
            let top = title(canvas, &self.title, [MARGIN_PX, MARGIN_PX], room)? + 4.0;
            let (right, bottom) = (SIZE_PX[0] - MARGIN_PX - 8.0, SIZE_PX[1] - MARGIN_PX);
            let split = bottom - COUNTS_PX;
            let left = self.draw_points(canvas, Rect { left: MARGIN_PX, top, right, bottom: split })?;
            let below = Rect { left: MARGIN_PX, top: split + 10.0, right, bottom };
            self.draw_counts(canvas, below, left)
        })
    }

    /// Returns the left edge of the frame.
    fn draw_points(&self, canvas: &Canvas, outer: Rect) -> Result<f64, PlotError> {
        let axis = Axis::new("", "").with_range(0.0, 1.0).with_ticks(fifths());
        let frame = Frame::new(outer, axis.scale([], 6), axis.scale([], 6)).with_left(outer.left + 58.0);
        frame.draw(canvas, "Stated probability", "Observed frequency")?;
        let diagonal = [[0.0, 0.0], [1.0, 1.0]].map(|p| frame.place(p));
        let reference = Look::reference();
        canvas.line(&diagonal, reference.colour, 1.3, reference.dash)?;
        let mut filled: Vec<&ReliabilityBin> = self.bins.iter().filter(|b| b.count > 0).collect();
        filled.sort_by(|a, b| a.stated.total_cmp(&b.stated));
        let look = Look::nth(0);
        let points: Vec<_> = filled.iter().map(|b| frame.place([b.stated, b.observed])).collect();
        canvas.line(&points, look.colour, 1.2, None)?;
        for (bin, point) in filled.iter().zip(&points) {
            let ends = [bin.interval[1], bin.interval[0]].map(|y| frame.place([bin.stated, y])[1]);
            error_bar(canvas, point[0], ends, look)?;
            marker(canvas, *point, look, Marker::Circle)?;
        }
        Ok(frame.inner.left)
    }

    fn draw_counts(&self, canvas: &Canvas, outer: Rect, left: f64) -> Result<(), PlotError> {
        let x = Axis::new("", "").with_range(0.0, 1.0).with_ticks(fifths());
        let most = self.bins.iter().map(|b| b.count).max().unwrap_or(0) as f64;
        let y = Axis::new("", "").with_range(0.0, 1.08 * most);
        let frame = Frame::new(outer, x.scale([], 6), y.scale([], 3)).with_left(left);
        frame.draw(canvas, "Stated probability", "Count")?;
        for bin in self.bins.iter().filter(|b| b.count > 0) {
            let [from, foot] = frame.place([bin.edges[0], 0.0]);
            let [to, top] = frame.place([bin.edges[1], bin.count as f64]);
            canvas.rectangle([from + 1.0, top], [to - 1.0, foot], Look::nth(0).colour)?;
        }
        Ok(())
    }
}

fn fifths() -> Vec<f64> {
    (0..=5).map(|k| f64::from(k) / 5.0).collect()
}
