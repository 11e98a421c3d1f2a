//! Pages of text for people: the diagnosis, the demo, the catalogue.

mod calibration;
pub(crate) mod comparison;
pub(crate) mod conclusion;
pub(crate) mod confidence;
mod demo;
pub(crate) mod designed;
pub(crate) mod discriminated;
pub(crate) mod effect;
pub(crate) mod effects;
pub(crate) mod fitted;
pub(crate) mod ladder;
mod leg_space;
mod limits;
pub(crate) mod located;
mod next;
pub(crate) mod notes;
mod pattern;
mod recovery;
pub(crate) mod simulated;
mod size;
mod stiffness;
mod subject;

pub(crate) use calibration::calibration;
pub(crate) use demo::demo;
pub(crate) use recovery::recovery;
pub(crate) use subject::Subject;

use crate::output::{Ink, Paper};

/// The diagnosis on one page.
pub(crate) fn diagnosis(subject: &Subject<'_>, verbose: bool, ink: Ink) -> String {
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
