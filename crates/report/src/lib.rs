//! Pages and charts of the bench, as text, Markdown, HTML and SVG.
//!
//! Takes plain numbers and knows neither world: what is drawn was computed elsewhere, in the units that the axis titles
//! state. Nothing here writes a file.

pub mod document;
pub mod html;
pub mod number;
pub mod plot;
pub mod png;

pub use document::Document;
