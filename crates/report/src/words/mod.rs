//! The words of all pages: each section is written once.
//!
//! `hexbench-model` computes and judges, [`crate::render`] does the layout, [`crate::charts`] the charts.

mod book;
mod book_advice;
mod cartesian;
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
mod plus_minus;
pub mod provenance;
mod readings;
mod remainder;
pub mod run_sheet;
pub mod runs;
pub mod session;
mod shell;
mod size;
mod stiffness;
pub mod subject;
mod units;

pub use book::book;
pub(crate) use book::name as book_name;
pub use cartesian::{about as about_stiffness, cartesian, lopsided as lopsided_stiffness};
pub use check::check;
pub use comparison::comparison;
pub use demo::demo;
pub use discovery::{LawFiles, discovery, files_asked};
pub(crate) use leg_space::by_load;
pub use plus_minus::{PlusMinus, Wide};
pub use provenance::Provenance;
pub use readings::readings;
pub use runs::runs;
pub use shell::{as_option, as_word, command_line};
pub use subject::ReportSubject;

use hexbench_model::results::diagnose::Diagnosis;

use crate::page::{Page, Section};

/// What every document that a command writes begins with.
pub fn written_by(command: &str) -> String {
    format!("Written by `{command}`; do not edit.")
}

/// What the fitted model leaves of every sensor.
fn sensors(d: &Diagnosis) -> Option<Section> {
    let table = comparison::coordinate_table(&d.sensors);
    let section =
        Section::new("Sensors").remark("what the fitted model leaves: root mean square, the noise as a line across the bars, bias and its t test");
    (!d.sensors.is_empty()).then(|| section.table(table))
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
        .with(ladder::section(d, subject.data.measurand))
        .with(sensors(d))
        .with(size::section(subject))
        .with(stiffness::section(subject.hexapod, d, &subject.wide()))
        .with(remainder::section(d))
        .with(next::section(d))
        .with(pattern::section(d))
        .with(limits::untestable(d))
        .with(limits::section(d))
        .with(notes::section(d))
        .with(notes::conventions())
}
