//! Output: where it goes, colour, pages of 80 columns, numbers for people, error reports.

mod bar;
mod colour;
mod excerpt;
pub(crate) use hexbench_report::number;
mod paper;
mod progress;
pub(crate) mod report;
mod screen;
mod table;

pub(crate) use bar::bar;
pub(crate) use colour::{Colour, Ink};
pub(crate) use paper::{Paper, WIDTH};
pub(crate) use progress::Progress;
pub(crate) use screen::Screen;
pub(crate) use table::Table;
