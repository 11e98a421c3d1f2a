//! Sessions: saving what was done, and resuming it.

use hexbench_model::application::model_file::Estimator;
use hexbench_model::application::session::{Session, SessionError, SessionInput};
use hexbench_report::charts::ReportError;
use hexbench_report::page::Page;
use hexbench_report::render::{PROGRAM, html};
use hexbench_report::words::session::{self, StepTaken};
use hexbench_report::words::{PlusMinus, fitted};

use super::LoadedCampaign;
use super::counted::Counted;
use super::export::{exported, json};
use super::refusal::Refusal;

use crate::wire::{Exported, FileText, KeepSession, Resumed, SessionForm};

impl LoadedCampaign {
    /// What was done, as a file or as a page.
    ///
    /// # Errors
    /// [`Refusal`] for a session without the step it shows, or whose model cannot be fitted.
    pub fn keep(&self, kept: &KeepSession) -> Result<Exported, Refusal> {
        let (steps, notes) = (kept.steps.clone(), kept.notes.clone());
        let session = Session::new(PROGRAM, self.inputs(), steps, kept.at, notes)?;
        let session = session.with_read_as(self.read_as()).with_foreseen(kept.foreseen.clone());
        match kept.form {
            SessionForm::File => Ok(exported("session.json", "application/json", json(&session)?)),
            SessionForm::Report => Ok(exported("session.html", "text/html", self.session_report(&session)?)),
        }
    }

    /// Goes on with what was done with these very measurements; where the session reads them differently than they are read here, it
    /// says so.
    ///
    /// # Errors
    /// [`Refusal`] for a file that is no session, and for one made with other measurements.
    pub fn resume(&self, file: &FileText) -> Result<Resumed, Refusal> {
        let session = Session::parse(&file.text)?;
        session.made_with(&self.inputs().into_iter().map(|input| input.sha256).collect::<Vec<_>>())?;
        let Session { read_as, steps, at, notes, foreseen, .. } = session;
        Ok(Resumed { read_as, steps, at, notes, foreseen })
    }

    fn inputs(&self) -> Vec<SessionInput> {
        let f = &self.files;
        let texts = [Some(&f.hexapod), Some(&f.data), f.holdout.as_ref()];
        let named = f.names.iter().zip(texts);
        named.filter_map(|(name, text)| text.map(|t| SessionInput::of(name, t))).collect()
    }

    /// The page of a session: its steps, and the model shown with its numbers.
    fn session_report(&self, session: &Session) -> Result<String, Refusal> {
        let shown = session.shown();
        let counted = Counted::of(self, &shown.exclude)?;
        let task = counted.task();
        let judged = self.judged(&counted, shown)?;
        let taken: Vec<StepTaken<'_>> = session
            .steps
            .iter()
            .map(|step| StepTaken {
                terms: &step.selection.terms,
                excluded: &step.selection.exclude,
                times_noise: step.times_noise,
            })
            .collect();
        let model = fitted::page(&task, &judged, Estimator::Gls, PlusMinus::default());
        let page = Page::new(format!("Session on {}", self.contents.hexapod.name))
            .with(session::steps(&taken, session.at))
            .with(session::left_out(&shown.exclude))
            .with(session::notes(&session.notes))
            .with_all(model.sections)
            .with(self.provenance(shown).section(self.campaign.noise.source));
        Ok(html(&page).map_err(ReportError::from)?)
    }
}

impl From<SessionError> for Refusal {
    fn from(cause: SessionError) -> Self {
        Self::bad_input(cause.to_string(), cause.next_step())
    }
}
