//! The story of the demo, step by step.

use hexbench_core::Observation;
use hexbench_model::error::ModelError;
use hexbench_model::results::discover::Discovery;

use super::conclusion::{error_statement, lacks};
use super::discovery::thousands;
use super::subject::{ReportSubject, describe};
use super::{confidence, ladder, leg_space, size, stiffness};
use crate::number::multiple;
use crate::page::{Block, Definition, Page, Section};

/// From measurements to the named effect; `elsewhere`: what was found on a machine whose effect no catalogue has.
///
/// # Errors
/// As the linearization of the model.
pub fn demo(subject: &ReportSubject<'_>, elsewhere: &Discovery) -> Result<Page, ModelError> {
    let d = &subject.study.diagnosis;
    Ok(Page::default()
        .with(measurements(subject))
        .with(springs(subject))
        .with(where_it_fails(subject)?)
        .with(diagnosis(subject))
        .with(confidence::section(d))
        .with(ladder::section(d, subject.data.measurand))
        .with(size::section(subject))
        .with(stiffness::section(subject.hexapod, d, &subject.wide()))
        .with(Section::new("Verdict").paragraph(format!(
            "{} {}",
            lacks(&d.added),
            error_statement(&d.steps, d.added.len())
        )))
        .with(law(elsewhere))
        .with(next(d.added.first().map_or("", String::as_str))))
}

fn measurements(subject: &ReportSubject<'_>) -> Section {
    let held =
        subject.holdout.map(|h| Definition::new("held out", format!("{}; never used in a fit", describe(h))));
    let first = subject.data.observations.first().map(|row| Definition::new("first row", reading(row)));
    let data = Definition::new("data", describe(subject.data));
    Section::new("1. What was measured")
        .paragraph(
            "A hexapod on a table is loaded with forces and moments. Every reading is the motion of the platform \
             between a reference load and the load: three translations, three rotations. The numbers were generated with \
             MuJoCo, which shares no code with this model; the diagnosis does not know what is hidden.",
        )
        .with(Block::entries(std::iter::once(data).chain(held).chain(first)))
}

fn reading(row: &Observation) -> String {
    let moved: Vec<String> = row.measured.iter().map(|x| format!("{:.1}", x * 1e6)).collect();
    let change = row.wrench.force.z - row.reference.force.z;
    format!(
        "{change:.0} N along z moved the platform by ({}) um and rotated it by ({}) urad",
        moved[..3].join(", "),
        moved[3..].join(", ")
    )
}

fn springs(subject: &ReportSubject<'_>) -> Section {
    let section = Section::new("2. One spring per leg").remark("the usual model");
    let Some(step) = subject.study.diagnosis.steps.first() else { return section };
    let fitted = multiple(step.fitted.times_noise());
    let held = step.holdout.map_or("-".to_owned(), |h| multiple(h.times_noise()));
    section.paragraph(format!(
        "Six stiffnesses are fitted to the data. If the machine were six springs and nothing else, the error would \
         equal the noise. It is {fitted} times the noise on the fitted readings and {held} times on the held-out poses: the model \
         lacks something."
    ))
}

fn where_it_fails(subject: &ReportSubject<'_>) -> Result<Section, ModelError> {
    Ok(Section::new("3. Where it fails")
        .remark("elongation of each leg left unexplained, um, root mean square")
        .paragraph(
            "Six legs measure six degrees of freedom, so the residuals of a reading can be written as six leg \
             elongations. The model explains some loads less well than others:",
        )
        .table(leg_space::table(subject)?))
}

fn diagnosis(subject: &ReportSubject<'_>) -> Section {
    let tested = hexbench_model::terms::catalogue().len() - subject.study.diagnosis.untestable.len();
    Section::new("4. Which effect is missing").paragraph(format!(
        "These data can test {tested} physical effects of the catalogue, and patterns outside it. Each \
         is weighed by how well it predicts the readings, given physically plausible sizes."
    ))
}

/// From OUTSIDE to a model file; README.md has the same lines.
const SECOND_STORY: &str = "\
cd data/cases/not-in-catalogue
hexbench diagnose hexapod.toml measurements.csv
hexbench discover hexapod.toml measurements.csv -o law.toml
hexbench diagnose hexapod.toml measurements.csv --term law.toml
hexbench fit hexapod.toml measurements.csv --term law.toml -o model.toml";

fn law(elsewhere: &Discovery) -> Option<Section> {
    let law = elsewhere.laws.first()?;
    let held = law.held_out?;
    let paragraph = format!(
        "On another machine no effect of the catalogue explains the readings, and the verdict is OUTSIDE. \
         `hexbench discover` compares {} laws and writes the best as a term like any other: {}. With \
         it, the error on held-out poses falls from {} to {} times the \
         noise. In a copy of the repository:",
        thousands(elsewhere.searched),
        law.text,
        multiple(held.before),
        multiple(held.after)
    );
    Some(
        Section::new("A law outside the catalogue")
            .paragraph(paragraph)
            .with(Block::code(SECOND_STORY.to_owned())),
    )
}

fn next(named: &str) -> Section {
    Section::new("Try next").with(Block::code(format!(
        "hexbench workbench\n\
         hexbench diagnose hexapod.toml measurements.csv --holdout holdout.csv\n\
         hexbench discover hexapod.toml measurements.csv -o law.toml\n\
         hexbench terms {named}"
    )))
}
