//! The diagnosis as a page for a browser.

mod data;
mod figures;
mod machine;
mod numbers;
mod predicted;
mod residual_sheet;
mod scatter;
mod verdict;

use hexbench_model::error::ModelError;
use hexbench_report::html::{Page, PageError};
use hexbench_report::plot::PlotError;

use crate::Subject;

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
/// [`ReportError`] when a chart or the page cannot be made.
pub fn diagnosis(subject: &Subject<'_>, provenance: &Provenance) -> Result<String, ReportError> {
    let d = &subject.study.diagnosis;
    let data = data::Data::of(subject)?;
    let sections = [
        Some(verdict::verdict(d)),
        Some(verdict::ladder(d)),
        Some(verdict::confidence(d)),
        Some(predicted::section(subject, &data)?),
        machine::section(&data)?,
        Some(residual_sheet::section(&data)?),
        Some(scatter::section(&data)?),
        numbers::effects(d),
        Some(numbers::stiffness(subject.hexapod, d)),
        numbers::correlation(subject)?,
        numbers::next(d),
        Some(numbers::limits(d)),
        numbers::look_at(d),
        Some(numbers::provenance(provenance, d)),
    ];
    let page = Page {
        title: subject.hexapod.name.clone(),
        subject: subject.lines().join(" · "),
        sections: sections.into_iter().flatten().collect(),
    };
    Ok(page.to_html()?)
}
