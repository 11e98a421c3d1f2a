//! Output: destinations, color, pages and charts, tables, error reports.

mod colour;
mod compared;
mod excerpt;
mod out_file;
mod pages;
mod progress;
mod quiet;
pub(crate) mod report;
mod screen;
mod table;
mod trials;

pub(crate) use colour::Colour;
pub(crate) use compared::{ComparisonFiles, refuse_worse};
pub(crate) use out_file::{OutFile, OutPlace, refuse_misplaced, refuse_overlaps, refuse_overlaps_of};
pub(crate) use pages::{PageFiles, origin, provenance, write_json, write_markdown};
pub(crate) use progress::Progress;
pub(crate) use quiet::set_quiet;
pub(crate) use screen::Screen;
pub(crate) use table::TableFile;
pub(crate) use trials::TrialFiles;
