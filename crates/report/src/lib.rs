//! Pages and charts of the bench.
//!
//! A [`page::Page`] says what there is to say, once: [`words`] writes its sections, [`charts`] adds charts to them, [`render`] shows it
//! in every medium. [`plot`] draws a chart as SVG, [`table`] writes numbers for other programs. Nothing here computes or judges; what is
//! shown was computed by the model, in the units that titles state. Nothing here writes a file.

mod body;
pub mod charts;
pub mod number;
pub mod page;
pub mod plot;
pub mod png;
pub mod render;
pub mod space;
pub mod table;
pub mod words;

pub use page::{Block, Cell, Definition, Figure, Mood, Page, PageColumn, Section, Table};
