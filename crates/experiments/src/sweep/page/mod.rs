//! The results as a page: tables, charts, and what follows from them.

mod charts;
mod equal;
mod laws;
mod marginal;
mod response;
mod sections;
mod write;

use hexbench_report::Page;
use hexbench_report::words::written_by;

use crate::sweep::results::CellStatistics;
use crate::sweep::study::Study;

pub use charts::{Picture, pictures};
pub use equal::{Equal, Matching, equals};
pub use laws::{Law, laws};
pub use marginal::{Marginal, marginal};
pub use write::write;

/// What is told on the screen.
pub fn summary(study: &Study, cells: &[CellStatistics]) -> Page {
    let mut page = Page::default();
    sections::head(&mut page, study, cells);
    sections::by_axis(&mut page, study, cells, None);
    sections::conclusions(&mut page, study, cells);
    page
}

/// The whole page; charts are in `folder` beside it.
pub fn document(study: &Study, cells: &[CellStatistics], pictures: &[Picture], folder: &str) -> Page {
    let mut page = Page::default();
    page.paragraph(written_by("hexbench study FILE -o DIR"));
    sections::head(&mut page, study, cells);
    sections::axes(&mut page, study);
    let charts: Vec<(&Picture, String)> =
        pictures.iter().map(|p| (p, format!("{folder}/{}.svg", p.name))).collect();
    sections::conclusions(&mut page, study, cells);
    sections::by_axis(&mut page, study, cells, Some(&charts));
    sections::all_cells(&mut page, study, cells);
    sections::reading(&mut page, study);
    page
}
