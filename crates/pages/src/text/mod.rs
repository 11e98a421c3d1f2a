//! Pages of text, 80 columns wide: headings, paragraphs, tables, bars.

mod bar;
mod ink;
mod paper;
mod table;

pub use bar::bar;
pub use ink::Ink;
pub use paper::{Paper, WIDTH};
pub use table::Table;
