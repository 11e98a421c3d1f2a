//! The words of every page: each section is written once.
//!
//! Computing and judging are `hexbench-model`'s, layout is [`crate::render`]'s, charts are [`crate::charts`]'s.

mod check;
pub mod comparison;
pub mod conclusion;
pub mod confidence;
mod demo;
mod discovery;
pub mod effect;
pub mod effects;
mod findings;
pub mod fitted;
pub mod ladder;
mod leg_space;
mod limits;
pub mod next;
pub mod notes;
mod pattern;
pub mod provenance;
mod readings;
pub mod runs;
mod size;
mod spread;
mod stiffness;
pub mod subject;

pub use check::check;
pub use comparison::comparison;
pub use demo::demo;
pub use discovery::discovery;
pub(crate) use leg_space::by_load;
pub use provenance::Provenance;
pub use readings::readings;
pub use runs::runs;
pub use spread::spread;
pub use subject::ReportSubject;

use crate::page::Page;

/// What every document that a command writes begins with.
pub fn written_by(command: &str) -> String {
    format!("Written by `{command}`; do not edit.")
}

/// The diagnosis.
pub fn diagnosis(subject: &ReportSubject<'_>) -> Page {
    let d = &subject.study.diagnosis;
    let page =
        Page { subject: subject.entries(), ..Page::new(format!("Diagnosis of {}", subject.hexapod.name)) };
    let page = page.with(findings::section(d)).with(conclusion::section(d));
    if d.is_misread() {
        return page.with(notes::conventions());
    }
    page.with(confidence::section(d))
        .with(ladder::section(d))
        .with(size::section(d))
        .with(stiffness::section(subject.hexapod, d))
        .with(next::section(d))
        .with(pattern::section(d))
        .with(limits::untestable(d))
        .with(limits::section(d))
        .with(notes::section(d))
        .with(notes::conventions())
}
