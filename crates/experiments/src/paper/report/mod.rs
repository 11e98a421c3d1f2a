//! The study as a page, charts and tables.
//!
//! [`page`] is the page; [`files`] is everything to be written: the page, and a folder of charts and of the numbers
//! behind every table and figure, with units in the names of the columns.

mod charts;
mod data;
mod differences;
mod question;
mod sections;

use hexbench_report::Page;
use hexbench_report::number::fixed as number;
use hexbench_report::render::markdown;

use super::error::PaperError;
use super::study::Reproduction;

/// Folder of charts and data beside the page.
const FOLDER: &str = "paper";

/// The page.
pub fn page(study: &Reproduction) -> Page {
    Page::new("The paper, reproduced")
        .with(sections::lead(study))
        .with(sections::constraints(study))
        .with(sections::poses(study))
        .with(sections::measurement(study))
        .with(sections::stiffness(study))
        .with(sections::prediction(study))
        .with(question::suspects(study))
        .with(question::hidden(study))
        .with(question::diagnosis(study))
        .with(differences::reasons(study))
        .with(differences::limits())
}

/// Names (relative, with `/`) and contents of all files.
///
/// # Errors
/// [`PaperError::Plot`] when a number of the study cannot be drawn, [`PaperError::Table`].
pub fn files(study: &Reproduction) -> Result<Vec<(String, String)>, PaperError> {
    let mut files = vec![("paper.md".to_owned(), markdown(&page(study)))];
    let inside = |(name, text): (&str, String)| (format!("{FOLDER}/{name}"), text);
    files.extend(charts::all(study)?.into_iter().map(inside));
    files.extend(data::all(study)?.into_iter().map(inside));
    Ok(files)
}

/// Names of the six coordinates and their units.
const COORDINATES: [(&str, &str); 6] =
    [("da", "um"), ("db", "um"), ("dc", "um"), ("dalpha", "urad"), ("dbeta", "urad"), ("dgamma", "urad")];

/// A chance in words that never claim certainty.
fn chance(p: f64) -> String {
    match p {
        p if p < 1e-3 => "< 0.1 %".to_owned(),
        p if p < 0.1 => format!("{:.1} %", 100.0 * p),
        p if p > 0.99 => "> 99 %".to_owned(),
        p => format!("{:.0} %", 100.0 * p),
    }
}
