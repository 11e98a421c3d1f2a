//! A diagnosis and a comparison as pages for a browser.

mod comparison;
mod data;
mod explained;
mod figures;
mod leg_map;
mod machine;
mod numbers;
mod period;
mod predicted;
mod residual_sheet;
mod runs;
mod scatter;
mod verdict;

use hexbench_core::{Dataset, Hexapod};
use hexbench_model::compare::Compared;
use hexbench_model::error::ModelError;
use hexbench_report::html::{Page, PageError, Section};
use hexbench_report::plot::PlotError;

pub use self::runs::runs;

use self::data::Data;
use crate::{Subject, subject};

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A chart that cannot be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// A page that cannot be laid out.
    #[error(transparent)]
    Page(#[from] PageError),
    /// A model that cannot be computed again.
    #[error(transparent)]
    Model(#[from] ModelError),
}

/// What made the page, for its foot.
pub struct Provenance {
    /// The command line.
    pub command: String,
    /// Files read, each with its digest.
    pub files: Vec<(String, String)>,
}

/// The page of a diagnosis.
///
/// # Errors
/// [`ReportError`] when a chart cannot be made.
pub fn diagnosis(subject: &Subject<'_>, provenance: &Provenance) -> Result<Page, ReportError> {
    let d = &subject.study.diagnosis;
    let data = Data::of_study(subject)?;
    let sections = [
        Some(verdict::verdict(d)),
        Some(verdict::ladder(d)),
        Some(verdict::confidence(d)),
        Some(predicted::section(&data)?),
        machine::section(&data)?,
        Some(leg_map::section(&data)?),
        explained::section(&data)?,
        Some(residual_sheet::section(&data)?),
        period::section(&data)?,
        Some(scatter::section(&data)?),
        numbers::effects(d),
        Some(numbers::stiffness(subject.hexapod, d)),
        numbers::correlation(subject)?,
        numbers::next(d),
        Some(numbers::limits(d)),
        numbers::look_at(d),
        Some(numbers::provenance(provenance, d.noise.source)),
    ];
    Ok(page(subject.hexapod, &subject.lines(), sections))
}

/// The page of a comparison.
///
/// # Errors
/// [`ReportError`] when a chart cannot be made.
pub fn comparison(
    hexapod: &Hexapod,
    readings: &Dataset,
    holdout: Option<&Dataset>,
    compared: &Compared,
    provenance: &Provenance,
) -> Result<Page, ReportError> {
    let c = &compared.comparison;
    let data = Data::of_comparison(hexapod, readings, holdout, compared)?;
    let sections = [
        Some(comparison::verdict(c)),
        Some(comparison::errors(c)),
        Some(comparison::coordinates(c)),
        Some(predicted::section(&data)?),
        machine::section(&data)?,
        Some(leg_map::section(&data)?),
        Some(comparison::follows(c)),
        Some(residual_sheet::section(&data)?),
        period::section(&data)?,
        Some(scatter::section(&data)?),
        Some(comparison::adequacy(c)),
        Some(comparison::stands_out(c)),
        Some(comparison::plan(c)),
        comparison::hidden(c),
        Some(numbers::provenance(provenance, c.noise_source)),
    ];
    Ok(page(hexapod, &subject::lines(readings, holdout, &compared.campaign.noise), sections))
}

fn page<const N: usize>(hexapod: &Hexapod, subject: &[String], sections: [Option<Section>; N]) -> Page {
    Page {
        title: hexapod.name.clone(),
        subject: subject.join(" · "),
        sections: sections.into_iter().flatten().collect(),
    }
}
