//! The main results over every axis with more than one value.

use hexbench_report::plot::{Axis, Bars, Chart, Panels, PlotError, Series};

use super::marginal::{Marginal, group_of, marginal, varying};
use super::response::{Response, responses};
use crate::sized::SIZE_UNITS;
use crate::sweep::cells::{AXES, AxisLevel, AxisLevels, TOLERANCE_SCALE};
use crate::sweep::results::CellStatistics;
use crate::sweep::study::SweepStudy;

/// A chart.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SweepChart {
    /// Name of its file, without folder and ending.
    pub name: String,
    /// Name of the axis it is about.
    pub axis: &'static str,
    /// What it shows.
    pub caption: String,
    /// SVG text.
    pub svg: String,
}

/// From this ratio of the largest to the smallest number on, an axis is logarithmic.
const WIDE: f64 = 3.0;

/// One chart for each axis of numbers with more than one value, one for each result over each axis of names.
///
/// # Errors
/// [`PlotError`].
pub fn pictures(study: &SweepStudy, cells: &[CellStatistics]) -> Result<Vec<SweepChart>, PlotError> {
    let levels = study.axes.levels();
    let responses = responses(study, cells);
    let mut all = Vec::new();
    for axis in varying(&levels) {
        let found = marginal(study, cells, axis, group_of(study, &levels, axis));
        if let Some(numbers) = levels[axis].numbers() {
            let is_ranged = study.axes.is_ranged(axis);
            all.extend(over_numbers(&responses, &levels, &found, (&numbers, is_ranged)).transpose()?);
        } else {
            // Bars of coverage are all alike.
            for response in responses.iter().filter(|r| r.key != "coverage") {
                all.extend(over_names(&levels, &found, response).transpose()?);
            }
        }
    }
    Ok(all)
}

fn over_numbers(
    responses: &[Response],
    levels: &[AxisLevels; AXES],
    found: &Marginal,
    numbers: (&[f64], bool),
) -> Option<Result<SweepChart, PlotError>> {
    let axis = &levels[found.axis];
    let charts: Vec<Chart> = responses.iter().filter_map(|r| panel(levels, found, numbers, r)).collect();
    if charts.is_empty() {
        return None;
    }
    let columns = charts.len();
    let title = format!("Over {}{}", spoken(axis.name), by(levels, found));
    let panels = charts.into_iter().fold(Panels::new(title.clone(), columns), Panels::with);
    let svg = panels.with_panel_size(300.0, 260.0).to_svg();
    Some(svg.map(|svg| SweepChart {
        name: axis.name.replace('_', "-"),
        axis: axis.name,
        caption: title,
        svg,
    }))
}

/// One result over an axis: lines over values that are combined with all others, markers over points.
fn panel(
    levels: &[AxisLevels; AXES],
    found: &Marginal,
    (numbers, is_ranged): (&[f64], bool),
    r: &Response,
) -> Option<Chart> {
    let lines: Vec<Vec<[f64; 4]>> = found.groups.iter().map(|cells| points(cells, numbers, r)).collect();
    let values = || lines.iter().flatten().map(|p| p[1]);
    values().next()?;
    let x = Axis::new(spoken(levels[found.axis].name), "");
    let x = with_air(if is_ranged { x } else { x.with_ticks(sorted(numbers)) }, numbers);
    let y = upright(Axis::new("", r.unit), r, &values().collect::<Vec<_>>());
    let mut chart = Chart::new(r.title.as_str(), x, y);
    if r.key == "coverage" {
        let ends = extremes(numbers);
        chart = chart.with(Series::line("as it should be", ends.map(|x| [x, 95.0]).to_vec()).as_reference());
    }
    for (k, line) in lines.iter().enumerate().filter(|(_, line)| !line.is_empty()) {
        let name = found.group.map_or("all trials".to_owned(), |g| named(&levels[g], k));
        let points = line.iter().map(|p| [p[0], p[1]]).collect();
        if is_ranged {
            chart = chart.with(Series::markers(name, points).with_look(k));
            continue;
        }
        if line.iter().all(|p| p[2].is_finite()) {
            let band = line.iter().map(|p| [p[0], p[2], p[3]]).collect();
            chart = chart.with(Series::band("95 % bounds", band).with_look(k));
        }
        chart = chart.with(Series::marked_line(name, points).with_look(k));
    }
    Some(chart)
}

/// `[x, value, low, high]` wherever there is a value.
fn points(cells: &[CellStatistics], numbers: &[f64], r: &Response) -> Vec<[f64; 4]> {
    let at = |(x, cell): (&f64, &CellStatistics)| {
        let [value, low, high] = (r.of)(cell);
        [*x, value, low, high]
    };
    let mut all: Vec<[f64; 4]> = numbers.iter().zip(cells).map(at).filter(|p| p[1].is_finite()).collect();
    all.sort_by(|a, b| a[0].total_cmp(&b[0]));
    all
}

fn over_names(
    levels: &[AxisLevels; AXES],
    found: &Marginal,
    r: &Response,
) -> Option<Result<SweepChart, PlotError>> {
    let axis = &levels[found.axis];
    let value = |cell: &CellStatistics| Some((r.of)(cell)[0]).filter(|x| x.is_finite()).unwrap_or(0.0);
    let all: Vec<Vec<f64>> = found.groups.iter().map(|cells| cells.iter().map(value).collect()).collect();
    if all.iter().flatten().all(|x| *x <= 0.0) {
        return None;
    }
    let title = format!("{} over {}{}", r.title, spoken(axis.name), by(levels, found));
    let y = Axis::new(r.title.as_str(), r.unit);
    let y = if r.is_share { y.with_range(0.0, 100.0) } else { y };
    let mut bars = Bars::new(title.clone(), axis.levels.iter().map(AxisLevel::text).collect(), y);
    for (k, values) in all.into_iter().enumerate() {
        bars = bars.with(found.group.map_or("all trials".to_owned(), |g| named(&levels[g], k)), values);
    }
    let name = format!("{}-{}", axis.name, r.key).replace('_', "-");
    Some(bars.to_svg().map(|svg| SweepChart { name, axis: axis.name, caption: title, svg }))
}

fn extremes(values: &[f64]) -> [f64; 2] {
    [values.iter().copied().fold(f64::INFINITY, f64::min), values.iter().copied().fold(0.0, f64::max)]
}

/// The axis below: logarithmic where its numbers span much, a little wider than they are.
fn with_air(axis: Axis, values: &[f64]) -> Axis {
    const AIR: f64 = 0.06;
    let [low, high] = extremes(values);
    if low > 0.0 && high / low >= WIDE {
        let margin = (high / low).powf(AIR);
        return axis.with_logarithm().with_range(low / margin, high * margin);
    }
    axis.with_range(low - AIR * (high - low), high + AIR * (high - low))
}

/// The axis of a result: shares from 0 to 100 % (coverage about its 95 %), errors from zero or between round numbers.
fn upright(axis: Axis, r: &Response, values: &[f64]) -> Axis {
    const COVERAGE: [f64; 2] = [90.0, 100.0];
    let [low, high] = extremes(values);
    if r.key == "coverage" && low >= COVERAGE[0] {
        return axis.with_range(COVERAGE[0], COVERAGE[1]);
    }
    if r.is_share {
        return axis.with_range(0.0, 100.0);
    }
    if low > 0.0 && high / low >= WIDE {
        return axis.with_logarithm().with_range(round_below(low), 1.0 / round_below(1.0 / high));
    }
    axis.with_range(0.0, 1.05 * high)
}

/// The largest of 1, 2, 5 times a power of ten that is not above a positive number.
fn round_below(x: f64) -> f64 {
    let ten = 10.0_f64.powf(x.log10().floor());
    [5.0, 2.0, 1.0].into_iter().map(|k| k * ten).find(|round| *round <= x).unwrap_or(ten)
}

fn sorted(numbers: &[f64]) -> Vec<f64> {
    let mut all = numbers.to_vec();
    all.sort_by(f64::total_cmp);
    all
}

fn by(levels: &[AxisLevels; AXES], found: &Marginal) -> String {
    found.group.map(|g| format!(", by {}", spoken(levels[g].name))).unwrap_or_default()
}

/// A name says what it is; a number needs its axis.
fn named(axis: &AxisLevels, level: usize) -> String {
    let text = axis.levels[level].text();
    if axis.numbers().is_some() { format!("{} {text}", spoken(axis.name)) } else { text }
}

/// Name of an axis in words.
pub(super) fn spoken(name: &str) -> String {
    if let Some(size) = SIZE_UNITS.iter().find(|size| size.key == name) {
        return format!("size of the effect ({})", size.unit);
    }
    let words = match name {
        "noise_scale" => "noise (times the usual)",
        "noise_um_urad" => "noise",
        TOLERANCE_SCALE => "errors of inputs (times the tolerances)",
        "size_sigmas" => "size of the effect (sigmas)",
        "size_factor" => "size of the effect (times the usual)",
        other => other,
    };
    words.to_owned()
}
