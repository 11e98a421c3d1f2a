//! Output: where it goes, colour, error reports.

mod colour;
mod excerpt;
mod progress;
pub(crate) mod report;
mod screen;

pub(crate) use colour::Colour;
pub(crate) use progress::Progress;
pub(crate) use screen::Screen;
