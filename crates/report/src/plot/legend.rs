//! The legend: samples and names in rows above the data.

use super::canvas::{Canvas, Type};
use super::error::PlotError;
use super::series::Series;
use super::style::{LABEL_PX, Look, text_width};

const SAMPLE_PX: f64 = 26.0;
const GAP_PX: f64 = 6.0;
const BETWEEN_PX: f64 = 22.0;
const ROW_PX: f64 = 18.0;

/// What a legend shows of a series.
pub(super) trait Entry {
    /// Its name.
    fn name(&self) -> &str;
    /// Its sample between two ends at a height.
    fn sample(&self, canvas: &Canvas, ends: [f64; 2], y: f64) -> Result<(), PlotError>;
}

impl Entry for (&Series, Look) {
    fn name(&self) -> &str {
        &self.0.name
    }

    fn sample(&self, canvas: &Canvas, ends: [f64; 2], y: f64) -> Result<(), PlotError> {
        self.0.sample(canvas, ends, y, self.1)
    }
}

/// Series in order of first appearance, one for each name that is not empty.
pub(super) fn distinct<'a>(series: impl IntoIterator<Item = (&'a Series, Look)>) -> Vec<(&'a Series, Look)> {
    let mut entries: Vec<(&Series, Look)> = Vec::new();
    for (s, look) in series {
        if !s.name.is_empty() && entries.iter().all(|(e, _)| e.name != s.name) {
            entries.push((s, look));
        }
    }
    entries
}

fn width(name: &str) -> f64 {
    SAMPLE_PX + GAP_PX + text_width(name, LABEL_PX)
}

/// Left end and row of each entry when rows are `room` px wide.
fn places<E: Entry>(entries: &[E], room: f64) -> Vec<(f64, f64)> {
    let (mut x, mut row) = (0.0, 0.0);
    let mut places = Vec::with_capacity(entries.len());
    for entry in entries {
        let width = width(entry.name());
        if x > 0.0 && x + width > room {
            (x, row) = (0.0, row + 1.0);
        }
        places.push((x, row));
        x += width + BETWEEN_PX;
    }
    places
}

/// Height of the legend in px; nothing for no entry.
pub(super) fn height<E: Entry>(entries: &[E], room: f64) -> f64 {
    places(entries, room).last().map_or(0.0, |(_, row)| (row + 1.0) * ROW_PX + GAP_PX)
}

/// Draws the legend with its upper left corner at a point.
pub(super) fn draw<E: Entry>(
    canvas: &Canvas,
    entries: &[E],
    [left, top]: [f64; 2],
    room: f64,
) -> Result<(), PlotError> {
    for (entry, (x, row)) in entries.iter().zip(places(entries, room)) {
        let y = top + (row + 0.5) * ROW_PX;
        let from = left + x;
        entry.sample(canvas, [from, from + SAMPLE_PX], y)?;
        canvas.text([from + SAMPLE_PX + GAP_PX, y], entry.name(), Type::new(LABEL_PX))?;
    }
    Ok(())
}
