//! The diagnosis, the search for a law, and the truth of a game.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Instant;

use hexbench_model::effects::term::Term;
use hexbench_model::estimation::fit_named::form_asked;
use hexbench_model::inference::explanation::Explanation;
use hexbench_model::results::diagnose::{DiagnosisStudy, diagnose_with};
use hexbench_model::results::discover::discover;
use hexbench_report::charts::story;
use hexbench_report::words::{self, LawFiles, ReportSubject};
use hexbench_truth::mechanisms::is_outside;

use super::planned::Doubt;
use super::refusal::{Refusal, RefusalKind};
use super::{LoadedCampaign, files, read_as};
use crate::wire::{Ask, Diagnosed, Discovered, Guess, Revealed};

impl LoadedCampaign {
    /// Everything behind the diagnosis of these data by these terms.
    pub(super) fn study(&self, terms: &[Arc<dyn Term>], exclude: &[u64]) -> Result<DiagnosisStudy, Refusal> {
        let (c, options) = (self.as_written(), self.options(exclude));
        diagnose_with(&c.hexapod, &c.data, c.holdout.as_ref(), terms, &options)
            .map_err(|cause| self.refused(&cause))
    }

    /// What a page about these data is about.
    pub(super) fn subject<'a>(&'a self, study: &'a DiagnosisStudy) -> ReportSubject<'a> {
        let c = &self.contents;
        ReportSubject::of(&c.hexapod, &c.data, c.holdout.as_ref(), study)
    }

    /// Names the effect that is missing.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn diagnose(&self, ask: &Ask) -> Result<Diagnosed, Refusal> {
        let since = Instant::now();
        let terms = files::terms_with(&ask.own, &self.limits)?;
        let study = self.study(&terms, &ask.exclude)?;
        let subject = self.subject(&study);
        let (page, picture) = (words::diagnosis(&subject), story(&subject)?);
        let d = study.diagnosis.clone();
        self.doubts.keep(ask, Doubt::of(study, terms));
        Ok(Diagnosed {
            word: d.verdict,
            page,
            picture,
            ways: read_as::ways(&d.findings),
            diagnosis: d,
            milliseconds: since.elapsed().as_secs_f64() * 1e3,
        })
    }

    /// Searches the law that no catalogue has.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn discover(&self, ask: &Ask) -> Result<Discovered, Refusal> {
        let since = Instant::now();
        let terms = files::terms_with(&ask.own, &self.limits)?;
        let (c, options) = (self.as_written(), self.options(&ask.exclude));
        let found = discover(&c.hexapod, &c.data, c.holdout.as_ref(), &terms, &options)
            .map_err(|cause| self.refused(&cause))?;
        let meant = &self.contents;
        Ok(Discovered {
            page: words::discovery(
                &meant.hexapod,
                &meant.data,
                meant.holdout.as_ref(),
                &found,
                &LawFiles::default(),
            ),
            law: found.term_file().map(str::to_owned),
            beside: found.discovery.beside,
            milliseconds: since.elapsed().as_secs_f64() * 1e3,
        })
    }

    /// Compares a guess with what is hidden.
    ///
    /// # Errors
    /// [`RefusalKind::Conflict`] for measurements whose truth nobody here knows.
    pub fn reveal(&self, guess: &Guess) -> Result<Revealed, Refusal> {
        let unknown = || {
            Refusal::new(RefusalKind::Conflict, "the program has hidden nothing here", "Start a game first.")
        };
        let truth = self.truth.as_ref().ok_or_else(unknown)?;
        let hidden: BTreeSet<Explanation> = truth.hidden.iter().map(|h| explanation(&h.id)).collect();
        let guessed: BTreeSet<Explanation> = guess.guess.iter().map(|id| form_asked(id).0.into()).collect();
        Ok(Revealed {
            right: hidden == guessed,
            hidden: truth.hidden.clone(),
            leg_stiffness: truth.leg_stiffness,
        })
    }
}

/// What a guess calls an effect: those without a name are all outside.
fn explanation(id: &str) -> Explanation {
    if is_outside(id) { Explanation::Outside } else { id.into() }
}
