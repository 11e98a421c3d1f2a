//! What is told of a comparison, a fit and a diagnosis: pages of text, and pages for a browser.
//!
//! The words and the order of what is said are here, once for every place that says it. Laying out is `hexbench-report`'s, computing is
//! `hexbench-model`'s.

pub mod comparison;
pub mod conclusion;
pub mod confidence;
mod demo;
pub mod effect;
pub mod effects;
pub mod fitted;
pub mod html;
pub mod ladder;
mod leg_space;
mod limits;
pub mod next;
pub mod notes;
mod pattern;
mod readings;
pub mod runs;
mod size;
mod spread;
mod stiffness;
pub mod subject;
pub mod text;

pub use demo::demo;
pub use readings::readings;
pub use spread::spread;
pub use subject::Subject;

use crate::text::{Ink, Paper};

/// The diagnosis on one page.
pub fn diagnosis(subject: &Subject<'_>, verbose: bool, ink: Ink) -> String {
    let mut paper = Paper::new(ink);
    let d = &subject.study.diagnosis;
    subject.head(&mut paper);
    conclusion::section(&mut paper, d);
    confidence::section(&mut paper, d);
    ladder::section(&mut paper, d);
    size::section(&mut paper, d, verbose);
    stiffness::section(&mut paper, subject.hexapod, d, verbose);
    next::section(&mut paper, d);
    pattern::section(&mut paper, d);
    limits::section(&mut paper, d, verbose);
    notes::section(&mut paper, d);
    notes::conventions(&mut paper);
    paper.into_text()
}
