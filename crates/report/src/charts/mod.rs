//! The pages with charts, for a browser.
//!
//! Charts are added to the sections of [`crate::words`], which are neither shortened nor repeated.

mod book;
mod correlation;
mod data;
mod drawing;
mod explained;
mod figures;
mod follows;
mod leg_map;
mod machine;
mod period;
mod predicted;
mod residual_sheet;
mod runs;
mod scatter;
mod story;

use hexbench_core::{Dataset, Hexapod};
use hexbench_model::error::ModelError;
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::compare::ComparedModel;
use hexbench_model::results::diagnose::Diagnosis;
use hexbench_model::results::discover::DiscoveryStudy;

use self::data::Data;
use crate::page::{Page, Section};
use crate::plot::PlotError;
use crate::words::{self, LawFiles, Provenance, ReportSubject, subject};

pub use self::book::book;
pub use self::drawing::{drawing, sensors, view_from_above};
pub use self::runs::runs;
pub use self::story::{StoryChart, story, story_of_fits};

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A chart that cannot be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// A page that cannot be laid out.
    #[error(transparent)]
    Page(#[from] crate::render::PageError),
    /// A model that cannot be computed again.
    #[error(transparent)]
    Model(#[from] ModelError),
}

/// The page of a diagnosis with its charts.
///
/// # Errors
/// [`ReportError`] when a chart cannot be made.
pub fn diagnosis(subject: &ReportSubject<'_>, provenance: &Provenance) -> Result<Page, ReportError> {
    let data = Data::of_study(subject)?;
    if subject.study.diagnosis.is_misread() {
        let looked_at = [predicted::section(&data)?, machine::section(&data, None)?];
        let page = looked_at.into_iter().flatten().fold(words::diagnosis(subject), Page::with);
        return Ok(page.with(provenance.section(subject.study.diagnosis.noise.source)));
    }
    let found = &subject.study.diagnosis;
    let story = if tells_a_story(found) { machine::section(&data, Some(found))? } else { None };
    let sections = [
        follows::section(&data)?,
        explained::section(&data)?,
        predicted::section(&data)?,
        leg_map::section(&data)?,
        period::section(&data)?,
        Some(scatter::section(&data)?),
        legs_unseen(&data),
    ];
    let charts = correlation::section(subject)?.into_iter().chain(sections.into_iter().flatten());
    Ok(words::diagnosis(subject)
        .with_after("verdict", story)
        .with_after("stiffness", charts)
        .with(residual_sheet::section(&data)?)
        .with(provenance.section(subject.study.diagnosis.noise.source)))
}

/// False where the springs leave nothing but noise: of many loads, the one they miss most would look like a fault.
fn tells_a_story(found: &Diagnosis) -> bool {
    found.verdict != Verdict::Adequate
}

/// The page of a search for laws with its charts; `subject`: the readings diagnosed with the law, or without one where none was found.
///
/// # Errors
/// [`ReportError`] when a chart cannot be made.
pub fn discovery(
    subject: &ReportSubject<'_>,
    found: &DiscoveryStudy,
    files: &LawFiles,
    provenance: &Provenance,
) -> Result<Page, ReportError> {
    let words = words::discovery(subject.hexapod, subject.data, subject.holdout, found, files);
    let provenance = provenance.section(subject.study.diagnosis.noise.source);
    if subject.study.diagnosis.is_misread() {
        return Ok(words.with(provenance));
    }
    let data = Data::of_study(subject)?;
    let sections =
        [predicted::section(&data)?, explained::section(&data)?, period::section(&data)?, legs_unseen(&data)];
    Ok(words
        .with_after("ladder", sections.into_iter().flatten())
        .with(residual_sheet::section(&data)?)
        .with(provenance))
}

/// The page of a comparison with its charts.
///
/// # Errors
/// [`ReportError`] when a chart cannot be made.
pub fn comparison(
    hexapod: &Hexapod,
    readings: &Dataset,
    holdout: Option<&Dataset>,
    compared: &ComparedModel,
    provenance: &Provenance,
) -> Result<Page, ReportError> {
    let c = &compared.comparison;
    let data = Data::of_comparison(readings, holdout, compared)?;
    let about = subject::entries(readings, holdout, &compared.campaign);
    let seen: [Option<Section>; 3] =
        [predicted::section(&data)?, machine::section(&data, None)?, leg_map::section(&data)?];
    let residuals = [period::section(&data)?, Some(scatter::section(&data)?)];
    let mut page = words::comparison(&hexapod.name, about, c);
    if let Some(section) = page.section_mut("follows") {
        section.blocks.extend(follows::of_these(&data, &c.associations)?);
    }
    Ok(page
        .with_after("adequacy", seen.into_iter().flatten())
        .with_after("follows", residuals.into_iter().flatten())
        .with(residual_sheet::section(&data)?)
        .with(provenance.section(c.noise_source)))
}

/// Why single legs have no charts, or fewer.
fn legs_unseen(data: &Data<'_>) -> Option<Section> {
    let space = &data.before.judged.space;
    if space.is_complete() {
        return None;
    }
    let determined = space.determined().len();
    let text = if determined == 0 {
        "Not determined by these readings: no condition has readings that determine the elongation of every leg. What is left of each sensor \
         stands above."
            .to_owned()
    } else {
        format!(
            "{determined} conditions have readings that determine the elongation of every leg; charts of legs show only these."
        )
    };
    Some(Section::new("Single legs").id("single-legs").paragraph(text))
}
