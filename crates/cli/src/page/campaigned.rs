//! Readings made of balls and loads, in words.

use std::path::Path;

use hexbench_model::machine::registration::{BallCampaign, InstrumentAxes, MovedBall, RecordsRead};
use hexbench_report::number::significant;
use hexbench_report::words::as_word;
use hexbench_report::{Block, Definition, Page, Section};
use serde_json::{Value, json};

use crate::commands::campaign::moved_in_words;

/// What the page is about.
pub(crate) struct Campaigned<'a> {
    /// The readings.
    pub(crate) found: &'a BallCampaign,
    /// How the records were read.
    pub(crate) how: &'a RecordsRead<'a>,
    /// The program whose layout the balls were in, if it is not that of `balls.csv`.
    pub(crate) layout: Option<&'static str>,
    /// Where the files are.
    pub(crate) folder: &'a Path,
    /// Their names and texts.
    pub(crate) files: &'a [(&'static str, String)],
}

/// The page.
pub(crate) fn page(about: &Campaigned<'_>) -> Page {
    let found = about.found;
    let names: Vec<&str> = about.files.iter().map(|(name, _)| *name).collect();
    let entries = [
        ("readings", readings(found)),
        ("balls", balls(found)),
        ("axes", axes(about)),
        ("noise", noise(about)),
        ("weights", format!("g = {} m/s^2", about.how.gravity)),
        ("moved", moved(found)),
        ("written", format!("{} in {}", names.join(" and "), about.folder.display())),
    ];
    let layout = about.layout.map(|name| ("read as", name.to_owned()));
    let entries = layout.into_iter().chain(entries).map(|(label, text)| Definition::new(label, text));
    let section = Section::new("Campaign from balls").with(Block::entries(entries));
    let page = Page::default().with(section);
    let next = Section::new("Next").with(Block::code(next(about)));
    if found.moved.is_empty() {
        return page.with(next);
    }
    let all = found.moved.iter().map(|ball| format!("line {}: {}", ball.line, moved_in_words(ball)));
    let list = all.fold(Section::new("Balls that moved"), |section, text| section.paragraph(&text));
    page.with(list).with(next)
}

/// The same for other programs.
pub(crate) fn json(about: &Campaigned<'_>) -> Value {
    let found = about.found;
    let um = |sigma: f64| (sigma > 0.0).then_some(sigma * 1e6);
    let moved = |ball: &MovedBall| {
        json!({
            "line": ball.line,
            "records": ball.records,
            "balls": ball.balls,
            "change_um": ball.change * 1e6,
        })
    };
    let axes = |axes: &InstrumentAxes| {
        json!({
            "angle_deg": axes.angle.to_degrees(),
            "uncertainty_deg": axes.uncertainty.to_degrees(),
            "shift_mm": axes.shift * 1e3,
            "turned_back": about.how.align,
        })
    };
    json!({
        "format": "campaign/1",
        "layout": about.layout,
        "absolute": found.dataset.is_absolute(),
        "readings": found.covariances.len(),
        "balls": found.balls.iter().map(|ball| &ball.ball).collect::<Vec<_>>(),
        "base_balls": found.base.iter().map(|ball| &ball.ball).collect::<Vec<_>>(),
        "placed_by_commands": found.placed_by_commands,
        "sigma_um": um(found.sigma),
        "sigma_of_residuals_um": found.estimated_sigma.and_then(um),
        "axes": found.axes.as_ref().map(axes),
        "gravity_m_per_s2": about.how.gravity,
        "moved": found.moved.iter().map(moved).collect::<Vec<_>>(),
        "unused_records": found.unused,
        "files": about.files.iter().map(|(name, _)| about.folder.join(name)).collect::<Vec<_>>(),
    })
}

fn readings(found: &BallCampaign) -> String {
    let count = found.covariances.len();
    format!("{count} {}", found.dataset.measurand.readings())
}

fn balls(found: &BallCampaign) -> String {
    let platform = format!("{} on the platform", found.balls.len());
    match (found.base.len(), found.placed_by_commands) {
        (0, true) => format!("{platform}, located from the commanded poses of the reference records"),
        (0, false) => platform,
        (base, _) => format!("{platform}, {base} on the base"),
    }
}

fn axes(about: &Campaigned<'_>) -> String {
    let Some(axes) = about.found.axes else { return "those of the balls on the base".into() };
    let apart = format!(
        "{} deg and {} mm from the hexapod's axes according to its commanded poses",
        significant(axes.angle.to_degrees(), 2),
        significant(axes.shift * 1e3, 3)
    );
    let done = if about.how.align { "turned back" } else { "left as they are" };
    format!("those of the measuring machine, {apart}; {done}")
}

fn noise(about: &Campaigned<'_>) -> String {
    let um = |sigma: f64| significant(sigma * 1e6, 3);
    let used = about.found.sigma;
    match about.found.estimated_sigma {
        _ if used <= 0.0 => "unknown: none is stated, and there are no residuals to estimate it".into(),
        Some(estimated) => {
            format!("{} um per coordinate; the residuals give {} um", um(used), um(estimated))
        }
        None => format!("{} um per coordinate", um(used)),
    }
}

fn moved(found: &BallCampaign) -> String {
    match found.moved.len() {
        0 => super::NONE_MOVED.into(),
        1 => "a ball, in 1 row".into(),
        rows => format!("a ball, in {rows} rows"),
    }
}

fn next(about: &Campaigned<'_>) -> String {
    let own = about.folder.join("hexapod.toml");
    let machine = if about.files.len() > 1 { own.as_path() } else { Path::new("hexapod.toml") };
    format!("hexbench diagnose {} {}", as_word(machine), as_word(about.folder.join("measurements.csv")))
}
