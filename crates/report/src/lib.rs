//! Charts of the bench, as SVG text.
//!
//! Takes plain numbers and knows neither world: what is drawn was computed elsewhere, in the units that the axis titles
//! state. Nothing here writes a file.

pub mod plot;
