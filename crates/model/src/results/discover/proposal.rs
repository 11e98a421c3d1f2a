//! A diagnosis that ends outside the catalogue proposes the law behind it.

use std::sync::Arc;

use hexbench_core::{Dataset, Hexapod};

use super::{Attempts, part};
use crate::effects::term::Term;
use crate::error::ModelError;
use crate::inference::pattern::Pattern;
use crate::inference::verdict::Verdict;
use crate::results::diagnose::{DiagnoseOptions, DiagnosisStudy, diagnose_with};

/// A diagnosis; where it says "outside", with the law that explains what the catalogue leaves, if one convinces.
///
/// # Errors
/// As [`diagnose_with`].
pub fn diagnose_with_proposal(
    hexapod: &Hexapod,
    data: &Dataset,
    holdout: Option<&Dataset>,
    terms: &[Arc<dyn Term>],
    options: &DiagnoseOptions,
) -> Result<DiagnosisStudy, ModelError> {
    let mut study = diagnose_with(hexapod, data, holdout, terms, options)?;
    // No law of the grammar moves the frame of the readings: one that imitates it would contradict the verdict.
    let is_of_the_frame = matches!(study.outcome.simplest_pattern(), Some(Pattern::WarmFrame(_)));
    if study.diagnosis.verdict != Verdict::Outside || is_of_the_frame {
        return Ok(study);
    }
    let found = if part::of(data).is_some() {
        // Where a part of a large file shows no law, a search in all of it is too long to come unasked.
        part::found_in_part(hexapod, data, holdout, terms, options, &|| ()).map(|found| found.discovery)
    } else {
        let attempts = Attempts { hexapod, holdout, terms, diagnosis: &study, watch: &|| () };
        Some(attempts.made(data, options)?.said(&study.diagnosis))
    };
    study.diagnosis.law = found.filter(|found| found.found).and_then(|found| found.laws.into_iter().next());
    Ok(study)
}
