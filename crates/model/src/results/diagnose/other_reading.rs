//! What files say of the machine, read as they seem to be meant.

use std::sync::Arc;

use hexbench_core::{Dataset, Hexapod};
use serde::Serialize;

use super::{DiagnoseOptions, Diagnosis, diagnosed};
use crate::effects::term::Term;
use crate::inference::misread::names;
use crate::inference::verdict::Verdict;

/// The answer to files that do not seem to mean what they say, read as the first finding has them. It is told and not taken: nobody but
/// their author knows what they mean.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OtherReading {
    /// How they are read, as `KIND=VALUE`.
    pub read_as: Vec<String>,
    /// The verdict.
    pub verdict: Verdict,
    /// Effects named.
    pub added: Vec<String>,
    /// Held-out error of the springs alone and of the model with all effects, over the noise; absent where nothing can be held out.
    pub times_noise: Option<[f64; 2]>,
}

impl OtherReading {
    /// Of misread files; none where no finding says how they may be read, where somebody says so already, and where they seem misread
    /// that way too.
    pub(super) fn of(
        misread: &Diagnosis,
        (hexapod, data, holdout): (&Hexapod, &Dataset, Option<&Dataset>),
        terms: &[Arc<dyn Term>],
        options: &DiagnoseOptions,
    ) -> Option<Self> {
        if !misread.is_misread() || !options.read_as.is_empty() {
            return None;
        }
        let changes = misread.findings.iter().map(|f| &f.read_as).find(|changes| !changes.is_empty())?;
        let options = options.clone().with_read_as(changes.iter().copied());
        let read_so = diagnosed(hexapod, data, holdout, terms, &options).ok()?.diagnosis;
        let ends = || Some([read_so.steps.first()?.holdout?, read_so.steps.last()?.holdout?]);
        (!read_so.is_misread()).then(|| Self {
            read_as: names(changes),
            verdict: read_so.verdict,
            times_noise: ends().map(|ends| ends.map(|error| error.times_noise())),
            added: read_so.added,
        })
    }
}
