//! session.json: what somebody did with some measurements in the workbench, to be gone on with there, in the command or in Python.
//!
//! It names the measurements by their digests and holds none of them: a session opens with the very files it was made with.

use std::sync::Arc;

use hexbench_core::LineRange;
use hexbench_core::files::text_hash;
use hexbench_core::parser_words::of_json;
use serde::{Deserialize, Serialize};

use super::foresight::SessionForesight;
use crate::effects::term::Term;
use crate::effects::user_term;
use crate::inference::misread::Change;
use crate::results::diagnose::DiagnoseOptions;
use crate::terms::catalogue;

/// Its format.
const FORMAT: &str = "session/1";

/// A model that was asked about: its terms, and the readings it is fitted to.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(deny_unknown_fields)]
pub struct Selection {
    /// Ids in the order of ticking, of the catalogue and of one's own; `:richer` behind an id asks for the richer form.
    #[serde(default)]
    pub terms: Vec<String>,
    /// Term files (term/1) of one's own, as text.
    #[serde(default)]
    pub own: Vec<String>,
    /// Lines of the measurements that are left out of the fit.
    #[serde(default)]
    pub exclude: Vec<u64>,
}

/// A model of a session, and what it gave.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(deny_unknown_fields)]
pub struct SessionStep {
    /// The model.
    pub selection: Selection,
    /// Held-out error (else fitted) as a multiple of the noise.
    pub times_noise: f64,
}

/// A file that a session was made with.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SessionInput {
    /// Its name, for messages.
    pub file: String,
    /// SHA-256 of its bytes, hexadecimal.
    pub sha256: String,
}

/// A session.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Session {
    format: String,
    /// Program that wrote it.
    pub program: String,
    /// Files it was made with: machine, measurements and, where there are any, held-out measurements.
    pub inputs: Vec<SessionInput>,
    /// How the files are read differently from what they say, as `--read-as` takes it, in this order; empty: as they are written.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub read_as: Vec<String>,
    /// Every step, the springs alone first.
    pub steps: Vec<SessionStep>,
    /// The step that was shown, from zero.
    pub at: usize,
    /// What somebody wrote beside it.
    pub notes: String,
    /// What readings that were brought back were foreseen to tell; absent where none were.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub foreseen: Option<SessionForesight>,
}

/// Why a session cannot be opened.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SessionError {
    /// No JSON of this shape.
    #[error("this is not a session file: {0}")]
    Unreadable(String),
    /// Another format.
    #[error("its format is `{0}`, not `{FORMAT}`")]
    Format(String),
    /// Without the step that it says was shown.
    #[error("it shows step {at} of {steps}, counted from zero")]
    NoStep {
        /// The step.
        at: usize,
        /// How many there are.
        steps: usize,
    },
    /// Made with other files.
    #[error("{file} is not the file of the session: its SHA-256 is {now}, not {was}")]
    OtherInput {
        /// The file as the session calls it.
        file: String,
        /// Its digest then.
        was: String,
        /// The digest of the file that is there now.
        now: String,
    },
    /// Made with held-out measurements, which are missing now, or without.
    #[error("the session was made {}", if *.was { "with held-out measurements, but now there are none" } else { "without held-out measurements" })]
    Holdout {
        /// Whether it was made with any.
        was: bool,
    },
    /// A way to read its files that is none.
    #[error("its files are read as `{0}`, which is no way to read files")]
    ReadAs(String),
    /// A term file in it that is none.
    #[error("term file {number} in the session: {cause}")]
    OwnTerm {
        /// Its place, from 1.
        number: usize,
        /// What is wrong.
        cause: String,
    },
}

impl SessionError {
    /// What to do.
    pub fn next_step(&self) -> &'static str {
        match self {
            Self::Unreadable(_)
            | Self::Format(_)
            | Self::NoStep { .. }
            | Self::ReadAs(_)
            | Self::OwnTerm { .. } => "Open a session.json file that the workbench saved.",
            Self::OtherInput { .. } => {
                "Use the unchanged file; for another file, start a new session in `hexbench workbench`."
            }
            Self::Holdout { was: true } => "Add the holdout file.",
            Self::Holdout { was: false } => "Omit the holdout file.",
        }
    }
}

impl SessionInput {
    /// A file by its text.
    pub fn of(file: &str, text: &str) -> Self {
        Self { file: file.to_owned(), sha256: text_hash(text) }
    }
}

impl Session {
    /// A session of these steps.
    ///
    /// # Errors
    /// [`SessionError::NoStep`].
    pub fn new(
        program: &str,
        inputs: Vec<SessionInput>,
        steps: Vec<SessionStep>,
        at: usize,
        notes: String,
    ) -> Result<Self, SessionError> {
        let (format, program) = (FORMAT.to_owned(), program.to_owned());
        Self { format, program, inputs, read_as: Vec::new(), steps, at, notes, foreseen: None }.checked()
    }

    /// The same of files that are read with these changes.
    #[must_use]
    pub fn with_read_as(self, read_as: Vec<String>) -> Self {
        Self { read_as, ..self }
    }

    /// The same with what was foreseen of readings that came since.
    #[must_use]
    pub fn with_foreseen(self, foreseen: Option<SessionForesight>) -> Self {
        Self { foreseen, ..self }
    }

    /// From the text of its file.
    ///
    /// # Errors
    /// All of [`SessionError`] but what is about other files.
    pub fn parse(text: &str) -> Result<Self, SessionError> {
        let session: Self =
            serde_json::from_str(text).map_err(|cause| SessionError::Unreadable(of_json(&cause)))?;
        session.checked()
    }

    fn checked(self) -> Result<Self, SessionError> {
        if self.format != FORMAT {
            return Err(SessionError::Format(self.format));
        }
        if let Some(name) = self.read_as.iter().find(|name| name.parse::<Change>().is_err()) {
            return Err(SessionError::ReadAs(name.clone()));
        }
        let (at, steps) = (self.at, self.steps.len());
        if at < steps { Ok(self) } else { Err(SessionError::NoStep { at, steps }) }
    }

    /// Refuses files other than those that the session was made with; `now`: digests of machine, measurements, held-out measurements.
    ///
    /// # Errors
    /// [`SessionError::OtherInput`], [`SessionError::Holdout`].
    pub fn made_with(&self, now: &[String]) -> Result<(), SessionError> {
        if self.inputs.len() != now.len() {
            return Err(SessionError::Holdout { was: self.inputs.len() > now.len() });
        }
        let differs = self.inputs.iter().zip(now).find(|(was, now)| was.sha256 != **now);
        differs.map_or(Ok(()), |(was, now)| {
            let (file, was, now) = (was.file.clone(), was.sha256.clone(), now.clone());
            Err(SessionError::OtherInput { file, was, now })
        })
    }

    /// The model that was shown.
    pub fn shown(&self) -> &Selection {
        // Its place was checked.
        &self.steps[self.at].selection
    }

    /// How its files are read.
    pub fn changes(&self) -> Vec<Change> {
        // Each was checked.
        self.read_as.iter().filter_map(|name| name.parse().ok()).collect()
    }

    /// The catalogue, and the terms of one's own behind it.
    ///
    /// # Errors
    /// [`SessionError::OwnTerm`].
    pub fn terms(&self) -> Result<Vec<Arc<dyn Term>>, SessionError> {
        let parsed = |(k, text): (usize, &String)| {
            user_term::parse(text)
                .map_err(|cause| SessionError::OwnTerm { number: k + 1, cause: cause.to_string() })
        };
        let own = self.shown().own.iter().enumerate().map(parsed);
        catalogue().into_iter().map(Ok).chain(own).collect()
    }

    /// How files and readings are treated.
    pub fn options(&self) -> DiagnoseOptions {
        DiagnoseOptions::default()
            .with_exclude(self.shown().exclude.iter().copied().map(LineRange::from))
            .with_read_as(self.changes())
    }
}

#[cfg(test)]
mod tests {
    use super::super::foresight::{CandidateBefore, DiagnosisBefore, SeparationBefore};
    use super::*;
    use crate::inference::verdict::Verdict;

    fn session() -> Session {
        let step = SessionStep { selection: Selection::default(), times_noise: 1.5 };
        let inputs = vec![SessionInput::of("hexapod.toml", "a"), SessionInput::of("measurements.csv", "b")];
        Session::new("hexbench 1", inputs, vec![step], 0, "warm day".to_owned()).unwrap()
    }

    #[test]
    fn a_session_is_read_as_it_was_written() {
        let text = serde_json::to_string(&session()).unwrap();
        assert_eq!(Session::parse(&text), Ok(session()));
        let small = Session::parse(&text.replace("1.5", "1e-30")).unwrap();
        assert_eq!(small.steps[0].times_noise.to_bits(), 1e-30_f64.to_bits(), "to the last bit");
    }

    #[test]
    fn what_was_foreseen_is_kept() {
        let before = DiagnosisBefore {
            verdict: Verdict::Ambiguous,
            added: Vec::new(),
            credible_set: vec!["creep".to_owned(), "metrology-drift".to_owned()],
            candidates: vec![CandidateBefore { term: "creep".to_owned(), probability: 0.6 }],
            separation: vec![SeparationBefore {
                between: ["creep".to_owned(), "metrology-drift".to_owned()],
                log10_bayes_factor: [1.5, 2.0],
                right: 0.97,
            }],
        };
        let with = session().with_foreseen(Some(SessionForesight { before, readings: 8 }));
        let text = serde_json::to_string(&with).unwrap();
        assert_eq!(Session::parse(&text), Ok(with));
        assert!(!serde_json::to_string(&session()).unwrap().contains("foreseen"), "absent where none came");
    }

    #[test]
    fn how_files_are_read_is_kept_and_absent_where_they_are_read_as_written() {
        let with = session().with_read_as(vec!["deflection-sign=reversed".to_owned()]);
        let text = serde_json::to_string(&with).unwrap();
        let read = Session::parse(&text).unwrap();
        assert_eq!((read.changes().len(), read.options().read_as.len()), (1, 1));
        assert_eq!(read, with);
        assert!(!serde_json::to_string(&session()).unwrap().contains("read_as"));
        let unknown = Session::parse(&text.replace("=reversed", "=sideways")).unwrap_err();
        assert_eq!(unknown, SessionError::ReadAs("deflection-sign=sideways".to_owned()));
    }

    #[test]
    fn another_format_a_missing_step_and_a_foreign_text_are_refused() {
        let text = serde_json::to_string(&session()).unwrap();
        let refused = |from: &str, to: &str| Session::parse(&text.replace(from, to)).unwrap_err();
        assert_eq!(refused("session/1", "session/9"), SessionError::Format("session/9".to_owned()));
        assert_eq!(refused("\"at\":0", "\"at\":1"), SessionError::NoStep { at: 1, steps: 1 });
        assert!(matches!(refused("warm day\"", "\", \"x\": 1"), SessionError::Unreadable(_)));
        assert!(matches!(Session::parse("pose,a_mm"), Err(SessionError::Unreadable(_))));
    }

    #[test]
    fn files_changed_since_are_refused_by_name() {
        let session = session();
        let own: Vec<String> = session.inputs.iter().map(|input| input.sha256.clone()).collect();
        assert_eq!(session.made_with(&own), Ok(()));
        let other = [own[0].clone(), text_hash("c")];
        let refused = session.made_with(&other).unwrap_err();
        assert!(refused.to_string().starts_with("measurements.csv is not the file"), "{refused}");
        let more = [own.clone(), vec![text_hash("d")]].concat();
        assert_eq!(session.made_with(&more), Err(SessionError::Holdout { was: false }));
        assert_eq!(session.made_with(&own[..1]), Err(SessionError::Holdout { was: true }));
    }

    #[test]
    fn a_term_file_that_is_none_is_refused_by_its_place() {
        let mut session = session();
        session.steps[0].selection.own.push("format = \"term/1\"".to_owned());
        assert!(matches!(session.terms(), Err(SessionError::OwnTerm { number: 1, .. })));
    }
}
