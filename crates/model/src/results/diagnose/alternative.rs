//! The answer the other way: with readings that were left out, or without readings that were kept.

use std::collections::BTreeSet;

use hexbench_core::{Dataset, Hexapod};
use serde::Serialize;

use super::answer::Answer;
use super::context::Context;
use super::judged::Judged;
use crate::error::ModelError;
use crate::estimation::estimate::{Estimate, stiffness_of};
use crate::inference::examination::Finding;
use crate::inference::verdict::Verdict;

/// What a diagnosis of the same readings says when those that were found wrong are treated the other way.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct Alternative {
    /// Lines of the readings concerned: kept here where the answer leaves them out, left out here where it keeps them.
    pub rows: Vec<u64>,
    /// The verdict.
    pub verdict: Verdict,
    /// Effects named.
    pub added: Vec<String>,
    /// Stiffness of every leg; absent where the data do not determine it.
    pub stiffness: [Option<Estimate>; 6],
    /// Chi-square per degree of freedom of the last step, on the readings fitted.
    pub chi2_reduced: f64,
}

/// The other answer, or a warning that there is none.
pub(super) fn of(
    hexapod: &Hexapod,
    holdout: Option<&Dataset>,
    other: Option<Result<Judged, ModelError>>,
) -> (Option<Alternative>, Option<String>) {
    let computed = |judged: Judged| alternative(hexapod, holdout, &judged);
    match other.map(|judged| judged.and_then(computed)) {
        None => (None, None),
        Some(Ok(found)) => (found, None),
        Some(Err(cause)) => {
            (None, Some(format!("the influence of the readings left out is unknown: {cause}")))
        }
    }
}

fn alternative(
    hexapod: &Hexapod,
    holdout: Option<&Dataset>,
    judged: &Judged,
) -> Result<Option<Alternative>, ModelError> {
    let Judged { data, campaign, outcome, findings, .. } = judged;
    let answer = Answer::of(&Context { hexapod, data, holdout, campaign, outcome }, findings)?;
    let stiffness = |leg| stiffness_of(&answer.numbers.determined, leg).cloned();
    let found = |chi2_reduced| Alternative {
        rows: rows(findings),
        verdict: answer.judgement.verdict,
        added: answer.added.clone(),
        stiffness: std::array::from_fn(stiffness),
        chi2_reduced,
    };
    Ok(answer.steps.last().map(|step| found(step.fitted.chi2_reduced)))
}

/// Lines of the findings that leave readings out, in the order of the file.
fn rows(findings: &[Finding]) -> Vec<u64> {
    let lines: BTreeSet<u64> =
        findings.iter().filter(|f| f.excludes()).flat_map(|f| f.rows.clone()).collect();
    lines.into_iter().collect()
}
