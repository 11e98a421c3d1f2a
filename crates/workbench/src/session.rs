//! session.json: what somebody did with some measurements, to be gone on with in the page and fitted again by the command.
//!
//! It names the measurements by their digests and holds none of them: a session opens with the very files it was made with.

use hexbench_core::files::text_hash;
use serde::{Deserialize, Serialize};

use crate::wire::{Selection, SessionStep};

/// Its format.
const FORMAT: &str = "session/1";

/// A session.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Session {
    format: String,
    /// Program that wrote it.
    pub program: String,
    /// Files it was made with, in the order machine, measurements, held-out measurements.
    pub inputs: Vec<SessionInput>,
    /// Every step, the springs alone first.
    pub steps: Vec<SessionStep>,
    /// The step that was shown, from zero.
    pub at: usize,
    /// What somebody wrote beside it.
    pub notes: String,
}

/// A file a session was made with.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SessionInput {
    /// Its name, for messages.
    pub file: String,
    /// SHA-256 of its text.
    pub sha256: String,
}

/// Why a session cannot be opened.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SessionError {
    /// No JSON of this shape.
    #[error("this is no session: {0}")]
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
    #[error("it was made with another {file}: SHA-256 {was}, now {now}")]
    OtherInput {
        /// The file as the session calls it.
        file: String,
        /// Its digest then.
        was: String,
        /// The digest of the file beside it.
        now: String,
    },
    /// Made with more or fewer files.
    #[error("it was made with {was} files, there are {now}")]
    OtherInputs {
        /// How many then.
        was: usize,
        /// How many now.
        now: usize,
    },
}

impl SessionError {
    /// What to do.
    pub fn next_step(&self) -> &'static str {
        match self {
            Self::Unreadable(_) | Self::Format(_) | Self::NoStep { .. } => {
                "Open a session.json as the workbench writes it."
            }
            Self::OtherInput { .. } | Self::OtherInputs { .. } => {
                "Open it with the very files it was made with; with others, begin anew."
            }
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
        Self { format: FORMAT.to_owned(), program: program.to_owned(), inputs, steps, at, notes }.checked()
    }

    /// From its file.
    ///
    /// # Errors
    /// All of [`SessionError`] but what is about other files.
    pub fn parse(text: &str) -> Result<Self, SessionError> {
        let session: Self =
            serde_json::from_str(text).map_err(|cause| SessionError::Unreadable(cause.to_string()))?;
        session.checked()
    }

    fn checked(self) -> Result<Self, SessionError> {
        if self.format != FORMAT {
            return Err(SessionError::Format(self.format));
        }
        let (at, steps) = (self.at, self.steps.len());
        if at < steps { Ok(self) } else { Err(SessionError::NoStep { at, steps }) }
    }

    /// Refuses files that the session was not made with.
    ///
    /// # Errors
    /// [`SessionError::OtherInput`], [`SessionError::OtherInputs`].
    pub fn made_with(&self, now: &[SessionInput]) -> Result<(), SessionError> {
        if self.inputs.len() != now.len() {
            return Err(SessionError::OtherInputs { was: self.inputs.len(), now: now.len() });
        }
        let differs = self.inputs.iter().zip(now).find(|(was, now)| was.sha256 != now.sha256);
        differs.map_or(Ok(()), |(was, now)| {
            let (file, was, now) = (was.file.clone(), was.sha256.clone(), now.sha256.clone());
            Err(SessionError::OtherInput { file, was, now })
        })
    }

    /// The model that was shown.
    pub fn shown(&self) -> &Selection {
        // The place was checked.
        &self.steps[self.at].selection
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn session() -> Session {
        let step = SessionStep { selection: Selection::default(), times_noise: 1.5 };
        let inputs = vec![SessionInput::of("hexapod.toml", "a"), SessionInput::of("measurements.csv", "b")];
        Session::new("hexbench 1", inputs, vec![step], 0, "warm day".to_owned()).unwrap()
    }

    #[test]
    fn a_session_is_read_as_it_was_written() {
        let text = serde_json::to_string(&session()).unwrap();
        assert_eq!(Session::parse(&text), Ok(session()));
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
        let (session, own) = (session(), session().inputs);
        assert_eq!(session.made_with(&own), Ok(()));
        let other = [own[0].clone(), SessionInput::of("measurements.csv", "c")];
        let refused = session.made_with(&other).unwrap_err();
        assert!(refused.to_string().contains("another measurements.csv"), "{refused}");
        assert_eq!(session.made_with(&own[..1]), Err(SessionError::OtherInputs { was: 2, now: 1 }));
    }
}
