//! Discovery: the law that no catalogue has, from files to a term file.
//!
//! The readings are diagnosed with the catalogue first. Where it leaves something, or where a simple law may do better than what it
//! names, the laws of [`discovery`](crate::inference::discovery) are scanned beside the springs and beside the catalogue's own best
//! explanations; the survivors compete with all effects of the catalogue, each set at its own optimum. Held-out poses have the last
//! word.

mod judgement;
mod report;
mod search;

use std::sync::Arc;

use hexbench_core::{Dataset, Hexapod};
use serde::Serialize;

use self::judgement::Judged;
pub use self::report::{AllLegs, Discovery, HeldOutFall, LawLegs, LawReport};
use self::search::{Searched, search};
use crate::effects::term::Term;
use crate::effects::user_term::{self, UserTermError};
use crate::error::ModelError;
use crate::estimation::fit::Fit;
use crate::inference::diagnosis::RankedSets;
use crate::inference::verdict::Verdict;
use crate::results::diagnose::{Context, DiagnoseOptions, DiagnosisStudy, diagnose_with};

/// What a search for laws came to, in one word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Reason {
    /// A law explains what is left, and held-out poses agree.
    Law,
    /// The springs explain the readings.
    NothingMissing,
    /// Effects of the catalogue explain them.
    Catalogue,
    /// What is wrong is in the data, or they cannot judge.
    Readings,
    /// Laws were weighed, and none convinces.
    NoLawConvinces,
}

/// Everything behind a discovery.
pub struct DiscoveryStudy {
    /// What people read.
    pub discovery: Discovery,
    /// The diagnosis with the catalogue.
    pub diagnosis: DiagnosisStudy,
    /// The search with laws; none where there was nothing to search for.
    pub outcome: Option<RankedSets>,
    /// Fits of the steps.
    pub fits: Vec<Fit>,
    /// The best law as a term file; none without any law.
    pub term_file: Option<String>,
}

impl DiscoveryStudy {
    /// The law as a term, where one was found.
    ///
    /// # Errors
    /// [`UserTermError`] for a file that is none, which is a mistake of this program.
    pub fn law(&self) -> Result<Option<Arc<dyn Term>>, UserTermError> {
        let file = self.term_file.as_deref().filter(|_| self.discovery.found);
        file.map(user_term::parse).transpose()
    }
}

/// Searches a law for what springs and catalogue leave; held-out poses come from `holdout`, else poses are left out in turn.
///
/// # Errors
/// As [`diagnose_with`].
pub fn discover(
    hexapod: &Hexapod,
    data: &Dataset,
    holdout: Option<&Dataset>,
    terms: &[Arc<dyn Term>],
    options: &DiagnoseOptions,
) -> Result<DiscoveryStudy, ModelError> {
    let diagnosis = diagnose_with(hexapod, data, holdout, terms, options)?;
    let verdict = diagnosis.diagnosis.verdict;
    if matches!(verdict, Verdict::Adequate | Verdict::Measurement | Verdict::Undecided) {
        return Ok(nothing_to_search(diagnosis));
    }
    let Searched { outcome, laws, tried } = search(&diagnosis, terms)?;
    let context = Context {
        hexapod: diagnosis.as_meant.as_ref().map_or(hexapod, |meant| &*meant.hexapod),
        data: &diagnosis.data,
        holdout: held_out_as_meant(&diagnosis, holdout),
        campaign: &diagnosis.campaign,
        outcome: &outcome,
    };
    let judged = Judged::of(&context, &laws, &diagnosis.diagnosis)?;
    let term_file = judged.term_file(&laws, &outcome.lin, data);
    let discovery = judged.report(verdict, tried);
    let fits = judged.fits;
    Ok(DiscoveryStudy { discovery, outcome: Some(outcome), fits, term_file, diagnosis })
}

/// The readings held out, unless the diagnosis found that they are of another machine or in the data.
fn held_out_as_meant<'a>(diagnosis: &'a DiagnosisStudy, holdout: Option<&'a Dataset>) -> Option<&'a Dataset> {
    use crate::inference::selection::HeldOut;
    let meant = diagnosis.as_meant.as_ref().and_then(|meant| meant.holdout.as_deref());
    meant.or(holdout).filter(|_| diagnosis.diagnosis.holdout == HeldOut::File)
}

fn nothing_to_search(study: DiagnosisStudy) -> DiscoveryStudy {
    let diagnosis = &study.diagnosis;
    let (reason, text) = if diagnosis.verdict == Verdict::Adequate {
        (Reason::NothingMissing, "nothing is missing: the springs explain the readings to within the noise")
    } else if diagnosis.verdict == Verdict::Measurement {
        (
            Reason::Readings,
            "what is wrong is in the data, not in the machine: see the findings of `hexbench diagnose`",
        )
    } else {
        (Reason::Readings, "these readings cannot tell whether anything is missing")
    };
    let discovery = Discovery {
        format: "discovery/1",
        found: false,
        reason,
        text: text.to_owned(),
        verdict: diagnosis.verdict,
        beside: diagnosis.added.clone(),
        laws: Vec::new(),
        steps: diagnosis.steps.clone(),
        probability: 0.0,
        searched: 0,
        warnings: diagnosis.warnings.clone(),
    };
    let fits = study.fits.clone();
    DiscoveryStudy { discovery, diagnosis: study, outcome: None, fits, term_file: None }
}
