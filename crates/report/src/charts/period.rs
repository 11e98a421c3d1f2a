//! What repeats with the length of the legs: the periodogram, and the residuals folded at its peak.

use crate::number::{chance, significant};
use crate::page::{Block, Figure, Section};
use crate::plot::{Axis, Chart, Series};
use hexbench_core::Approach;
use hexbench_model::results::compare::periodogram::{Peak, Spectra, Spectrum};

use super::ReportError;
use super::data::{Data, Shown};
use super::figures::{Dot, EXPLAIN, FINAL, SPRINGS, cloud, panels, sheet};
use crate::words::comparison::who;

/// Points of a drawn spectrum.
const MOST: f64 = 220.0;
/// Changes of leg force below this share of the largest tell nothing of a compliance.
const LEAST_FORCE: f64 = 0.2;

/// The spectrum with the most significant peak; nothing when no peak is beyond chance.
pub(crate) fn section(data: &Data<'_>) -> Result<Option<Section>, ReportError> {
    if !data.tells_of_legs() {
        return Ok(None);
    }
    let Some(spectra) = Spectra::of(&data.before.judged) else { return Ok(None) };
    let Some(peak) = &spectra.peak else { return Ok(None) };
    let same = |s: &&Spectrum| s.leg == peak.leg && s.of == peak.of;
    let Some(before) = spectra.all.iter().find(same) else { return Ok(None) };
    let after = data.after.as_ref().and_then(|a| before.again(&a.judged));
    let section = Section::new("What repeats with leg length")
        .id("period")
        .remark(remark(peak))
        .with(spectrum(data, before, after.as_ref(), spectra.level)?)
        .with(folded(data, peak.of == "compliance", peak.period_mm)?);
    Ok(Some(section))
}

fn remark(peak: &Peak) -> String {
    let per_force = if peak.of == "compliance" {
        "compliance (elongation per change of leg force)"
    } else {
        "elongation"
    };
    format!(
        "Residual {per_force} of {}: a period of {} mm explains most (F {}, chance {}).",
        who(peak.leg),
        significant(peak.period_mm, 3),
        significant(peak.f, 3),
        chance(peak.false_alarm)
    )
}

fn spectrum(
    data: &Data<'_>,
    before: &Spectrum,
    after: Option<&Spectrum>,
    level: f64,
) -> Result<Block, ReportError> {
    let ends = [before.points.last(), before.points.first()].map(|p| p.map_or(1.0, |p| p[0]));
    let x = Axis::new("period in leg length", "mm").with_logarithm();
    let mut chart = Chart::new("", x, Axis::new("F of the period", ""))
        .with_size(900.0, 300.0)
        .with(Series::line("1 % chance from noise", ends.map(|x| [x, level]).to_vec()).as_reference())
        .with(Series::line(data.words.name, envelope(&before.points)).with_look(SPRINGS));
    if let Some(after) = after {
        chart = chart.with(Series::line("with the added effects", envelope(&after.points)).with_look(FINAL));
    }
    let caption = "Periodogram: how much better a wave of each period explains the residuals than no wave.";
    Ok(Block::Figure(Figure::laid_out(chart.laid_out()?, caption).named("spectrum")))
}

/// The highest point of each of many stretches of equal ratio.
fn envelope(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Vec::new() };
    let all = (first[0] / last[0]).ln().max(f64::MIN_POSITIVE);
    let stretch = |p: &[f64; 2]| ((first[0] / p[0]).ln() / all * MOST).floor();
    let same = |a: &[f64; 2], b: &[f64; 2]| stretch(a) >= stretch(b);
    let highest = |s: &[[f64; 2]]| s.iter().copied().max_by(|a, b| a[1].total_cmp(&b[1]));
    points.chunk_by(same).filter_map(highest).collect()
}

/// Every leg over its length within one period.
fn folded(data: &Data<'_>, compliance: bool, period: f64) -> Result<Block, ReportError> {
    let (what, unit) = if compliance { ("compliance of leg", "nm/N") } else { ("leg", "um") };
    let mut all = panels();
    for leg in 0..6 {
        let largest = data.conditions().map(|s| s.at.force_change()[leg].abs()).fold(0.0, f64::max);
        let enough = |s: &Shown<'_>| !compliance || s.at.force_change()[leg].abs() > LEAST_FORCE * largest;
        let dots: Vec<Dot> =
            data.conditions().filter(enough).map(|s| dot(&s, leg, compliance, period)).collect();
        if dots.is_empty() {
            continue;
        }
        let x = Axis::new(format!("leg length within {} mm", significant(period, 3)), "mm")
            .with_range(0.0, period);
        all = all.with(cloud(
            [data.words.leaves, EXPLAIN],
            &dots,
            x,
            Axis::new(format!("{what} {}", leg + 1), unit),
        ));
    }
    let caption = "The same residuals: each leg against its commanded length, folded at that period.";
    Ok(sheet("folded", &all, caption)?)
}

fn dot(shown: &Shown<'_>, leg: usize, compliance: bool, period: f64) -> Dot {
    let per = if compliance { 1e-3 * shown.at.force_change()[leg] } else { 1.0 };
    let x = (1e3 * shown.at.commanded_lengths[leg]).rem_euclid(period);
    let explained = shown.explained.map(|e| e[leg] / per);
    Dot { x, left: shown.left[leg] / per, explained, approach: Approach::Direct }
}
