//! Charts that several sections share.

use crate::page::{Block, Figure};
use crate::plot::{Axis, Chart, Panels, PlotError, Series};
use hexbench_core::Approach;

/// Look of what was measured, of the first model, and of the final one: the same on the whole page.
pub(crate) const MEASURED: usize = 6;
pub(crate) const SPRINGS: usize = 1;
pub(crate) const FINAL: usize = 0;

/// Half-width of the markers of residuals, and of what explains them: smaller, so that both are seen where they meet, px.
const DOT_PX: f64 = 2.4;
const EXPLAINED_PX: f64 = 1.4;
/// Points of a line that the eye takes for a curve.
const MOST_ON_A_LINE: usize = 60;
/// Ups and downs of a curve, in multiples of its range: a whole wave has 2.
const CURVED: f64 = 2.5;
/// Places without which points are no curve.
const FEWEST_PLACES: usize = 12;

/// Places closer than this share of the range are one place.
const SAME: f64 = 1e-3;
/// Share of the range by which a curve may differ from itself at one place.
const FORKED: f64 = 0.1;

/// A residual over something, with what the added effects explain of it.
pub(crate) struct Dot {
    pub(crate) x: f64,
    pub(crate) left: f64,
    pub(crate) explained: Option<f64>,
    /// Direction of the load: a curve may have a branch for each.
    pub(crate) approach: Approach,
}

/// What explains the residuals of a page.
pub(crate) const EXPLAIN: &str = "the added effects explain";

/// Panels side by side, three in a row.
pub(crate) fn panels() -> Panels {
    Panels::new("", 3).with_panel_size(300.0, 190.0)
}

/// Panels as a figure of a section, beside each other as far as there is room; `name`: empty for the only one.
pub(crate) fn sheet(name: &str, panels: &Panels, caption: impl Into<String>) -> Result<Block, PlotError> {
    Ok(Block::Figure(Figure::in_panels(panels, caption)?.named(name)))
}

/// Residuals as small markers.
pub(crate) fn residuals(name: &str, points: Vec<[f64; 2]>) -> Series {
    Series::markers(name, points).with_look(SPRINGS).with_marker_size(DOT_PX)
}

/// The residuals as dots; what explains them as a line where it is a curve, else as dots.
pub(crate) fn cloud([leaves, explain]: [&str; 2], dots: &[Dot], x: Axis, y: Axis) -> Chart {
    let left = dots.iter().map(|d| [d.x, d.left]).collect();
    let mut chart = Chart::new("", x, y).with(residuals(leaves, left));
    for points in branches(dots).into_iter().filter(|p| !p.is_empty()) {
        let series = match curve(&points) {
            Some(line) => Series::line(explain, line),
            None => Series::markers(explain, points).with_marker_size(EXPLAINED_PX),
        };
        chart = chart.with(series.with_look(FINAL));
    }
    chart
}

/// What is explained, for each direction of the load.
fn branches(dots: &[Dot]) -> [Vec<[f64; 2]>; 2] {
    Approach::ALL.map(|side| {
        let on = |d: &Dot| (d.approach == side).then_some([d.x, d.explained?]);
        dots.iter().filter_map(on).collect()
    })
}

/// True when what is explained is a curve in every branch.
pub(crate) fn is_curve(dots: &[Dot]) -> bool {
    let found = branches(dots);
    found.iter().any(|b| !b.is_empty()) && found.iter().all(|b| b.is_empty() || curve(b).is_some())
}

/// The points in order, when they lie on a curve.
fn curve(points: &[[f64; 2]]) -> Option<Vec<[f64; 2]>> {
    let mut line = points.to_vec();
    line.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let rise: f64 = line.windows(2).map(|w| (w[1][1] - w[0][1]).abs()).sum();
    let [low, high] = line.iter().fold([f64::MAX, f64::MIN], |[l, h], p| [l.min(p[1]), h.max(p[1])]);
    let step = line.len().div_ceil(MOST_ON_A_LINE).max(1);
    let ends = |i: &usize| i.is_multiple_of(step) || *i + 1 == line.len();
    let same =
        |a: &[f64; 2], b: &[f64; 2]| (b[0] - a[0]).abs() <= SAME * (line[line.len() - 1][0] - line[0][0]);
    let places: Vec<&[[f64; 2]]> = line.chunk_by(same).collect();
    // Different answers at one place are no curve.
    let forked = places.iter().any(|at| at[at.len() - 1][1] - at[0][1] > FORKED * (high - low));
    (places.len() >= FEWEST_PLACES && high > low && !forked && rise <= CURVED * (high - low))
        .then(|| (0..line.len()).filter(ends).map(|i| line[i]).collect())
}

#[cfg(test)]
mod tests {
    use super::curve;

    #[test]
    fn a_curve_is_a_line_and_a_scatter_is_none() {
        let smooth: Vec<[f64; 2]> = (0..200).rev().map(f64::from).map(|k| [k, (k / 60.0).sin()]).collect();
        let line = curve(&smooth).unwrap_or_default();
        assert!(line.len() <= 62 && line.is_sorted_by(|a, b| a[0] < b[0]), "{} points", line.len());
        assert!(line[0][0] < 1.0 && line[line.len() - 1][0] > 198.0, "both ends are kept");
        let scatter: Vec<[f64; 2]> = (0..200).map(f64::from).map(|k| [k, (k * 37.0).sin()]).collect();
        assert!(curve(&scatter).is_none());
        let forked: Vec<[f64; 2]> = (0..40).map(f64::from).map(|k| [(k / 20.0).floor(), k % 20.0]).collect();
        assert!(curve(&forked).is_none(), "two columns of points are no curve");
    }
}
