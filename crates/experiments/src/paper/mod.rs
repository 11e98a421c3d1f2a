//! The paper, reproduced as far as its published numbers allow.
//!
//! Its machine's geometry is not published; a machine that agrees with the published numbers stands in for it, with the
//! published stiffnesses as the truth. The procedure is the paper's: poses of the largest observability index, deflections read
//! by a coordinate measuring machine, compliances by least squares, errors at other poses. Then it answers the question that
//! the paper leaves open: which effect could cause its errors, and which measurement would have shown it.
//!
//! | step | file |
//! |---|---|
//! | what the paper prints | [`published`] |
//! | the simulated experiment | [`mod@bench`], [`experiment`] |
//! | poses | [`search`] |
//! | springs and predictions | [`identify`] |
//! | errors that noise alone explains | [`chances`] |
//! | what could be missing | [`suspects`], [`missing`] |
//! | the same again under other noise | [`Again`] |
//! | figures | [`curves`] |
//! | the page, its charts and tables | [`report`] |

mod again;
pub mod bench;
pub mod chances;
pub mod curves;
pub mod error;
pub mod experiment;
pub mod identify;
pub mod missing;
pub mod published;
pub mod report;
pub mod search;
mod study;
pub mod suspects;

pub use again::{Again, NamedVerdict};
pub use error::PaperError;
pub use study::Reproduction;
