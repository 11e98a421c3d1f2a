//! Whose journal it is.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::Path;

use hexbench_core::files::atomic_write;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::sweep::error::StudyError;
use crate::sweep::study::{STUDY_FILE, Study};

/// Format of the journal: of its files, and of how results are drawn and computed.
pub const FORMAT: &str = "study-journal/1";

/// What the records of a journal were computed from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Origin {
    format: String,
    program: String,
    /// SHA-256 of the study file and of every file it names.
    inputs: BTreeMap<String, String>,
}

impl Origin {
    pub(super) fn of(study: &Study) -> Self {
        Self {
            format: FORMAT.to_owned(),
            program: env!("CARGO_PKG_VERSION").to_owned(),
            inputs: study.inputs.clone(),
        }
    }

    /// Writes itself to a new journal; compares itself with what an old one says.
    pub(super) fn settle(&self, folder: &Path, path: &Path) -> Result<(), StudyError> {
        match fs::read(path) {
            Ok(bytes) => self.compare(folder, &bytes),
            Err(cause) if cause.kind() == io::ErrorKind::NotFound => self.write(path),
            Err(cause) => Err(StudyError::Read { path: path.to_owned(), cause }),
        }
    }

    /// Compares itself with what the journal of another folder says.
    pub(super) fn check(&self, folder: &Path, path: &Path) -> Result<(), StudyError> {
        let bytes = fs::read(path).map_err(|cause| StudyError::Read { path: path.to_owned(), cause })?;
        self.compare(folder, &bytes)
    }

    fn write(&self, path: &Path) -> Result<(), StudyError> {
        let text = serde_json::to_string_pretty(self).map_err(io::Error::from);
        let written = text.and_then(|text| atomic_write(path, |out| writeln!(out, "{text}")));
        written.map_err(|cause| StudyError::Write { path: path.to_owned(), cause })
    }

    fn compare(&self, folder: &Path, bytes: &[u8]) -> Result<(), StudyError> {
        let foreign = |what: String| Err(StudyError::Foreign { folder: folder.to_owned(), what });
        // The format first: another one may have other keys.
        let format = serde_json::from_slice::<serde_json::Value>(bytes).ok();
        let format = format.as_ref().and_then(|v| v.get("format")?.as_str());
        match format {
            Some(format) if format == self.format => {}
            Some(other) => {
                return foreign(format!(
                    "its journal has the format {other}, this program has {}",
                    self.format
                ));
            }
            None => return foreign("journal/study.json does not say whose journal this is".into()),
        }
        let Ok(known) = serde_json::from_slice::<Self>(bytes) else {
            return foreign("journal/study.json is damaged".into());
        };
        if known.program != self.program {
            return foreign(format!(
                "begun by version {} of the program, this is {}",
                known.program, self.program
            ));
        }
        self.changed_input(&known).map_or(Ok(()), |name| {
            let what = if name == STUDY_FILE { "the study file".to_owned() } else { format!("\"{name}\"") };
            foreign(format!("{what} has changed since this study began"))
        })
    }

    fn changed_input<'a>(&'a self, known: &'a Self) -> Option<&'a String> {
        // The study file first: it decides which others there are.
        let study = STUDY_FILE.to_owned();
        let names = self.inputs.keys().chain(known.inputs.keys());
        let changed: Vec<&String> = names.filter(|n| self.inputs.get(*n) != known.inputs.get(*n)).collect();
        changed.iter().find(|n| ***n == study).or(changed.first()).copied()
    }

    /// Binds records to this origin.
    pub(super) fn digest(&self) -> [u8; 32] {
        let mut digest = Sha256::new();
        for text in
            [&self.format, &self.program].into_iter().chain(self.inputs.iter().flat_map(|(n, h)| [n, h]))
        {
            digest.update((text.len() as u64).to_le_bytes());
            digest.update(text.as_bytes());
        }
        digest.finalize().into()
    }
}
