//! The panels that carry the story: what the residuals of the first model follow most significantly.

use hexbench_core::spread_of;
use hexbench_model::results::compare::association::{Association, associations};
use hexbench_model::results::compare::legs::LegSpace;
use hexbench_model::results::compare::story::{StoryPanel, StoryPoint, story};

use super::ReportError;
use super::data::Data;
use super::figures::{Dot, EXPLAIN, MEASURED, cloud, sheet};
use crate::number::{chance, significant};
use crate::page::{Block, Section};
use crate::plot::{Axis, Chart, Panels, Series};
use crate::words::comparison::who;

/// Points of a panel.
const MOST: usize = 360;

/// The panels with what they show; a paragraph where nothing is followed, nothing where legs are not determined.
pub(crate) fn section(data: &Data<'_>) -> Result<Option<Section>, ReportError> {
    let Some(found) = associations_of(data) else { return Ok(None) };
    let section = Section::new("What the residuals follow").id("follows").remark(format!(
        "Variables that the leg residuals of {} follow, most significant first; chance corrected for the number of tests.",
        data.words.subject()
    ));
    if found.is_empty() {
        return Ok(Some(section.paragraph("They follow no variable significantly.")));
    }
    let panels = story(&data.before.judged, &found);
    let items = panels.iter().map(|panel| sentence(&panel.association, panel.title));
    Ok(Some(section.list(items).with(figure(data, &panels)?)))
}

/// What the first model's residuals follow; none where the legs are not determined.
fn associations_of(data: &Data<'_>) -> Option<Vec<Association>> {
    let judged = &data.before.judged;
    (judged.space.is_complete()).then(|| associations(judged))
}

/// `compliance of leg 3 follows leg length (rank correlation -0.62, F 41, chance 2e-9)`.
fn sentence(a: &Association, title: &str) -> String {
    let what = if a.of == "compliance" { "compliance" } else { "elongation" };
    format!(
        "The {what} of {} follows {title} (rank correlation {:+.2}, F {}, chance {}).",
        who(a.leg),
        a.rank_correlation,
        significant(a.f, 3),
        chance(a.p)
    )
}

/// The panels of associations that are reported already.
pub(crate) fn of_these(data: &Data<'_>, found: &[Association]) -> Result<Option<Block>, ReportError> {
    figure(data, &story(&data.before.judged, found))
}

/// The panels side by side.
fn figure(data: &Data<'_>, panels: &[StoryPanel]) -> Result<Option<Block>, ReportError> {
    if panels.is_empty() {
        return Ok(None);
    }
    let columns = panels.len();
    let all = Panels::new("", columns).with_panel_size(900.0 / columns as f64, 270.0);
    let all = panels.iter().fold(all, |all, panel| all.with(chart(data, panel)));
    let explained = if data.after.is_some() { ", and what the added effects explain of it" } else { "" };
    let caption = format!(
        "Each point is a leg under one condition{explained}. Black with bars: means of bins with twice their standard uncertainty. Black, dashed: \
         the course that the test asks about."
    );
    Ok(Some(sheet("story", &all, caption)?))
}

fn chart(data: &Data<'_>, panel: &StoryPanel) -> Chart {
    let shown = spread_of(panel.points.iter().collect::<Vec<_>>(), MOST);
    let dots: Vec<Dot> = shown.map(|p| dot(data, p)).collect();
    let (what, unit) = if panel.is_compliance() { ("compliance", "nm/N") } else { ("elongation", "um") };
    let x = Axis::new(panel.title, panel.unit);
    let y = Axis::new(format!("{what} of {}", who(panel.association.leg)), unit);
    let (means, errors) = panel.bins.iter().map(|b| ([b.x, b.mean], 2.0 * b.std)).unzip();
    let mut chart = cloud([data.words.leaves, EXPLAIN], &dots, x, y);
    if let [[left, _], .., [right, _]] = panel.course[..] {
        let zero = vec![[left, 0.0], [right, 0.0]];
        chart = chart
            .with(Series::line("zero", zero).as_reference())
            .with(Series::line("tested trend", panel.course.clone()).with_look(MEASURED));
    }
    chart.with(Series::markers("mean", means).with_errors(errors).with_look(MEASURED))
}

fn dot(data: &Data<'_>, p: &StoryPoint) -> Dot {
    let left = |space: &LegSpace| space.elongation[p.condition][p.leg] * 1e6;
    let before = left(&data.before.judged.space);
    let explained = data.after.as_ref().map(|a| (before - left(&a.judged.space)) / p.per);
    let approach = data.before.judged.lin.conditions[p.condition].approach;
    Dot { x: p.x, left: p.y, explained, approach }
}
