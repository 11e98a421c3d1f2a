//! A small set of charts that are readable on a page, in print and in gray.
//!
//! | chart | shows |
//! |---|---|
//! | [`Chart`] | lines, markers with error bars, bands over a number |
//! | [`Panels`] | several charts in a grid with one legend, such as the six coordinates of a deflection |
//! | [`Bars`] | groups of bars over names |
//! | [`HeatMap`] | a table whose cells are shaded, such as a confusion matrix |
//! | [`Raster`] | signed sizes over many columns, such as residuals of every leg in every condition |
//! | [`Wireframe`] | a machine in space, from several sides |
//! | [`Rungs`] | bars below each other with a line to compare with, such as how an error falls to the noise |
//! | [`Reliability`] | stated probability against observed frequency, with counts |
//!
//! Every chart has `to_svg`. The text of an SVG is text, the background is white so that it also reads on a dark page,
//! and equal input gives equal bytes. Colors are those of Okabe and Ito (2008), safe for color-blind readers; each
//! series also has its own marker and dash, so that nothing rests on color alone. A number that is not finite is
//! refused with its place: it would leave a gap that nobody sees.
//!
//! # Example
//! ```
//! use hexbench_report::plot::{Axis, Chart, Series};
//!
//! let chart = Chart::new("Deflection under load", Axis::new("Load", "N"), Axis::new("Deflection", "µm"))
//!     .with(Series::line("linear", vec![[0.0, 0.0], [300.0, 18.0]]))
//!     .with(Series::markers("read", vec![[100.0, 6.2], [200.0, 11.7]]).with_errors(vec![0.8, 0.8]));
//! assert!(chart.to_svg().is_ok_and(|svg| svg.contains("Deflection (µm)")));
//! ```

mod axis;
mod bars;
mod canvas;
mod chart;
mod error;
mod frame;
mod heat_map;
mod legend;
mod panels;
mod raster;
mod reliability;
mod rungs;
mod series;
mod style;
mod wireframe;

pub use axis::Axis;
pub use bars::Bars;
pub use chart::Chart;
pub use error::PlotError;
pub use heat_map::HeatMap;
pub use panels::Panels;
pub use raster::Raster;
pub use reliability::{Reliability, ReliabilityBin};
pub use rungs::Rungs;
pub use series::Series;
pub use wireframe::{Edge, Wireframe};
