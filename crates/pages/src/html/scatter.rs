//! Are the residuals noise? Histogram and normal plot of the whitened residuals.

use hexbench_report::html::{Block, Section};
use hexbench_report::plot::{Axis, Chart, Panels, Series};
use statrs::distribution::{Continuous, ContinuousCDF, Normal};

use super::ReportError;
use super::data::{Data, Seen};

/// Width of a class, standard deviations of one reading.
const CLASS: f64 = 0.5;
/// Residuals beyond count in the outermost class.
const FURTHEST: f64 = 6.0;
/// Quantiles drawn.
const QUANTILES: usize = 60;

/// Both charts, a curve for each model.
pub(crate) fn section(data: &Data<'_>) -> Result<Section, ReportError> {
    let mut histogram =
        Chart::new("", Axis::new("residual in units of the noise", ""), Axis::new("share per unit", ""))
            .with(Series::line("noise alone", bell()).as_reference());
    let mut normal =
        Chart::new("", Axis::new("expected of noise", ""), Axis::new("residual in units of the noise", ""))
            .with(Series::line("noise alone", vec![[-3.0, -3.0], [3.0, 3.0]]).as_reference());
    for (name, look, seen) in data.models() {
        histogram = histogram.with(Series::line(name, shares(seen)).with_look(look));
        normal = normal.with(Series::markers(name, quantiles(seen)).with_look(look));
    }
    let panels = Panels::new("", 2).with_panel_size(450.0, 280.0).with(histogram).with(normal);
    let caption =
        "Left: how often residuals of a size occur. Right: normal plot; noise alone lies on the line.";
    let remark = "Residuals of single readings over the stated noise.";
    Ok(Section::new("scatter", "Are the residuals noise?", remark)
        .with(Block::figure(panels.to_svg()?, caption)))
}

fn sorted(seen: &Seen<'_>) -> Vec<f64> {
    let mut all: Vec<f64> =
        seen.judged.rows.iter().flat_map(|r| r.whitened.iter().copied().collect::<Vec<_>>()).collect();
    all.sort_by(f64::total_cmp);
    all
}

fn bell() -> Vec<[f64; 2]> {
    let law = Normal::standard();
    (-24..=24).map(|k| f64::from(k) * 0.25).map(|x| [x, law.pdf(x)]).collect()
}

/// Outline of a histogram.
fn shares(seen: &Seen<'_>) -> Vec<[f64; 2]> {
    let all = sorted(seen);
    let n = all.len().max(1) as f64;
    let classes = (2.0 * FURTHEST / CLASS).round();
    let mut outline = Vec::new();
    let mut from = -FURTHEST;
    while from < FURTHEST - 0.5 * CLASS {
        let to = from + CLASS;
        let clamped = all.iter().map(|x| x.clamp(-FURTHEST, FURTHEST - 1e-9));
        let share = clamped.filter(|x| (from..to).contains(x)).count() as f64 / n / CLASS;
        outline.extend([[from, share], [to, share]]);
        from = to;
    }
    debug_assert!(outline.len() as f64 <= 2.0 * classes);
    outline
}

fn quantiles(seen: &Seen<'_>) -> Vec<[f64; 2]> {
    let all = sorted(seen);
    let n = all.len();
    let law = Normal::standard();
    let count = QUANTILES.min(n);
    let at = |k: usize| {
        // Both ends are kept: outliers are what the plot is for.
        let i = if count > 1 { k * (n - 1) / (count - 1) } else { 0 };
        [law.inverse_cdf((i as f64 + 0.5) / n as f64), all[i]]
    };
    (0..count).map(at).collect()
}
