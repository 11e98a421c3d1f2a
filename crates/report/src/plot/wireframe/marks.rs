//! What stands beside the bodies: arrows, a bar of scale, places of short texts.

use super::EDGE_PX;
use crate::plot::canvas::{Across, Along, Canvas, Type};
use crate::plot::error::PlotError;
use crate::plot::style::{INK, LABEL_PX, TICK_PX};

/// From a point to the middle of its mark, px.
const MARK_PX: f64 = 11.0;

/// A line with a head; its text stands beyond the end that is farther up.
pub(super) fn arrow(canvas: &Canvas, text: &str, [from, to]: [[f64; 2]; 2]) -> Result<(), PlotError> {
    const HEAD_PX: f64 = 11.0;
    const SHAFT_PX: f64 = 2.4;
    let [x, y] = [to[0] - from[0], to[1] - from[1]];
    let length = x.hypot(y);
    // Seen along its axis an arrow is a point.
    let [x, y] = if length > 1.0 { [x / length, y / length] } else { [0.0, -1.0] };
    let back = [to[0] - HEAD_PX * x, to[1] - HEAD_PX * y];
    let side = |s: f64| [back[0] - s * 0.4 * HEAD_PX * y, back[1] + s * 0.4 * HEAD_PX * x];
    canvas.line(&[from, back], INK, SHAFT_PX, None)?;
    canvas.polygon(&[to, side(1.0), side(-1.0)], INK, 1.0)?;
    let (end, out) = if y > 0.0 { (from, [-x, -y]) } else { (to, [x, y]) };
    let across = match out[0] {
        right if right > 0.5 => Across::Left,
        left if left < -0.5 => Across::Right,
        _ => Across::Middle,
    };
    let at = [end[0] + 6.0 * out[0], end[1] + 10.0 * out[1]];
    canvas.text(at, text, Type::new(LABEL_PX).bold().at(across, Along::Middle))
}

/// A bar with ends, its text beside it.
pub(super) fn scale_bar(canvas: &Canvas, text: &str, [x, y]: [f64; 2], length: f64) -> Result<(), PlotError> {
    const END_PX: f64 = 4.0;
    canvas.line(&[[x, y], [x + length, y]], INK, EDGE_PX, None)?;
    for x in [x, x + length] {
        canvas.line(&[[x, y - END_PX], [x, y + END_PX]], INK, EDGE_PX, None)?;
    }
    canvas.text([x + length + 8.0, y], text, Type::new(TICK_PX))
}

/// A little farther from the middle than a point.
pub(super) fn beside([x, y]: [f64; 2], middle: [f64; 2]) -> [f64; 2] {
    let out = [x - middle[0], y - middle[1]];
    let step = MARK_PX / out[0].hypot(out[1]).max(1.0);
    [x + step * out[0], y + step * out[1]]
}
