//! The results as a page: tables, charts, conclusions.

mod answer;
mod charts;
mod confusion;
mod equal;
mod follows;
mod laws;
mod marginal;
mod response;
mod sections;
mod write;

use hexbench_report::words::written_by;
use hexbench_report::{Page, Section};

use crate::sweep::results::CellStatistics;
use crate::sweep::study::SweepStudy;

pub use answer::{
    AskedPlan, AskedPlans, IndexRank, Meets, groups, judged, rank_correlation, ranks, sentences,
};
pub use charts::{SweepChart, pictures};
pub use equal::{Equal, Matching, equals};
pub use laws::{PowerLaw, laws};
pub use marginal::{Marginal, marginal};
pub use write::{HTML, write};

/// What is told on the screen.
pub fn summary(study: &SweepStudy, cells: &[CellStatistics]) -> Page {
    Page::new(&study.title)
        .with(sections::head(study, cells))
        .with(answer::answer(study, cells))
        .with(confusion::confusion(study, cells))
        .with(follows::follows(study, cells))
        .with_all(sections::by_axis(study, cells, None))
        .with(sections::scaling(study, cells))
        .with(sections::designed(study, cells))
}

/// The whole page; charts are in `folder` beside it.
pub fn document(study: &SweepStudy, cells: &[CellStatistics], pictures: &[SweepChart], folder: &str) -> Page {
    let charts: Vec<(&SweepChart, String)> =
        pictures.iter().map(|p| (p, format!("{folder}/{}.svg", p.name))).collect();
    Page::new(&study.title)
        .with(Section::lead().paragraph(written_by("hexbench study FILE -o DIR")))
        .with(sections::head(study, cells))
        .with(answer::answer(study, cells))
        .with(sections::axes(study))
        .with(confusion::confusion(study, cells))
        .with(follows::follows(study, cells))
        .with(sections::scaling(study, cells))
        .with(sections::designed(study, cells))
        .with_all(sections::by_axis(study, cells, Some(&charts)))
        .with(sections::all_cells(study, cells))
        .with(sections::reading(study))
}
