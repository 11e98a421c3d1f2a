//! Control charts of a book.

use hexbench_model::results::book::{CampaignBook, ChartPoint, ChartSubject, ControlChart};

use super::ReportError;
use super::figures::{FINAL, MEASURED, SPRINGS, sheet};
use crate::page::{Block, Figure, Page, Section};
use crate::plot::{Axis, Chart, Panels, Series};
use crate::words::{self, Provenance};

/// Charts of effects in a page; every number is in the table.
const MOST: usize = 12;
/// Ticks of an axis of campaigns.
const TICKS: usize = 8;

/// The page of a book with its charts.
///
/// # Errors
/// [`ReportError`] when a chart cannot be made.
pub fn book(book: &CampaignBook, from: &Provenance) -> Result<Page, ReportError> {
    let of = |about: ChartSubject| book.charts.iter().filter(move |c| c.about == about);
    let shown = [
        section(book, "Leg stiffness", "stiffness", &of(ChartSubject::Stiffness).collect::<Vec<_>>())?,
        section(book, "Error", "error", &of(ChartSubject::Error).collect::<Vec<_>>())?,
        section(book, "Effects", "effects", &of(ChartSubject::Effect).take(MOST).collect::<Vec<_>>())?,
    ];
    let before = if book.charts.iter().any(|c| !c.changes.is_empty()) { "changes" } else { "verdict" };
    Ok(words::book(book).with_after(before, shown.into_iter().flatten()).with(from.read_section()))
}

fn section(
    book: &CampaignBook,
    title: &str,
    id: &str,
    charts: &[&ControlChart],
) -> Result<Option<Section>, ReportError> {
    if charts.is_empty() {
        return Ok(None);
    }
    let caption = "Error bars: plus and minus two standard uncertainties. Band: what noise allows a single campaign about the level before any \
                   change. Line: the level with the changes found.";
    let drawn = |one: &&ControlChart| chart(book, one);
    let figure = if let [alone] = charts {
        Block::Figure(Figure::laid_out(drawn(alone).with_size(720.0, 300.0).laid_out()?, caption))
    } else {
        let all = charts.iter().map(drawn);
        sheet("", &all.fold(Panels::new("", 3).with_panel_size(300.0, 210.0), Panels::with), caption)?
    };
    Ok(Some(Section::new(title).id(id).with(figure)))
}

fn chart(book: &CampaignBook, chart: &ControlChart) -> Chart {
    let place = |p: &ChartPoint| book.campaigns[p.campaign - 1].place;
    let band = chart.points.iter().map(|p| [place(p), p.band[0], p.band[1]]).collect();
    let numbers = |alarm: bool| -> (Vec<[f64; 2]>, Vec<f64>) {
        let those = chart.points.iter().filter(|p| p.alarm == alarm);
        those.map(|p| ([place(p), p.value], 2.0 * p.std)).unzip()
    };
    let mut drawn = Chart::new(words::book_name(chart), axis(book), Axis::new("", chart.unit.as_str()))
        .with(Series::band("allowed by noise", band).with_look(FINAL))
        .with(Series::line("level", level(book, chart)).with_look(FINAL));
    for (name, look, alarm) in [("campaign", MEASURED, false), ("at another level", SPRINGS, true)] {
        let (points, errors) = numbers(alarm);
        if !points.is_empty() {
            drawn = drawn.with(Series::markers(name, points).with_errors(errors).with_look(look));
        }
    }
    drawn
}

/// The level, with steps half way between two campaigns.
fn level(book: &CampaignBook, chart: &ControlChart) -> Vec<[f64; 2]> {
    let place = |p: &ChartPoint| book.campaigns[p.campaign - 1].place;
    let mut line: Vec<[f64; 2]> = Vec::new();
    let drifts = chart.changes.iter().any(|c| c.kind == hexbench_model::results::book::ChangeKind::Drift);
    for p in &chart.points {
        let here = [place(p), p.level];
        if let Some(&[x, y]) = line.last()
            && !drifts
        {
            let middle = f64::midpoint(x, here[0]);
            line.extend([[middle, y], [middle, here[1]]]);
        }
        line.push(here);
    }
    line
}

fn axis(book: &CampaignBook) -> Axis {
    let first = book.campaigns.first().and_then(|c| c.date).filter(|_| book.is_dated());
    if let Some(first) = first {
        return Axis::new(format!("days since {first}"), "");
    }
    let count = book.campaigns.len();
    let step = count.div_ceil(TICKS);
    let ticks = (1..=count).step_by(step).map(|k| k as f64).collect();
    Axis::new("campaign", "").with_range(0.5, count as f64 + 0.5).with_ticks(ticks)
}
