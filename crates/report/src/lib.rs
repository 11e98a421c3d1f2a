//! Pages and charts of the bench.
//!
//! A [`page::Page`] has the content of a page once for all media: [`words`] writes its sections, [`charts`] adds charts to them,
//! [`render`] shows it in every medium. [`plot`] draws a chart as SVG, [`table`] writes numbers for other programs. This crate neither
//! computes nor judges: the model computes everything shown, in the units that titles state. It writes no files.

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
