//! Whose journal it is.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use hexbench_core::files::atomic_write;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::error::ExperimentError;

/// What the results of an experiment depend on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Identity {
    /// Name of the experiment, and of the file of its journal that says whose it is.
    pub name: &'static str,
    /// Format of the records with version; another one when trials are drawn, computed or kept otherwise.
    pub format: &'static str,
    /// Settings as they are written, files and other long inputs by their SHA-256.
    pub inputs: BTreeMap<String, String>,
}

impl Identity {
    /// Of an experiment with these settings.
    pub fn new<const N: usize>(
        name: &'static str,
        format: &'static str,
        settings: [(&str, String); N],
    ) -> Self {
        Self { name, format, inputs: settings.map(|(key, value)| (key.to_owned(), value)).into() }
    }
}

/// What the records of a journal were computed from, by which program.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Origin {
    #[serde(skip)]
    name: String,
    format: String,
    program: String,
    inputs: BTreeMap<String, String>,
}

impl Origin {
    pub(super) fn of(identity: Identity) -> Self {
        Self {
            name: identity.name.to_owned(),
            format: identity.format.to_owned(),
            program: env!("CARGO_PKG_VERSION").to_owned(),
            inputs: identity.inputs,
        }
    }

    /// Writes itself to a new journal; compares itself with what an old one says.
    pub(super) fn settle(&self, folder: &Path, journal: &Path) -> Result<(), ExperimentError> {
        match self.check(folder, journal) {
            Err(ExperimentError::Read { path, cause }) if cause.kind() == io::ErrorKind::NotFound => {
                self.write(&path)
            }
            checked => checked,
        }
    }

    /// Compares itself with what the journal of another folder says.
    pub(super) fn check(&self, folder: &Path, journal: &Path) -> Result<(), ExperimentError> {
        let path = self.path(journal);
        self.compare(folder, &fs::read(&path).map_err(ExperimentError::reading(&path))?)
    }

    fn path(&self, journal: &Path) -> PathBuf {
        journal.join(format!("{}.json", self.name))
    }

    fn write(&self, path: &Path) -> Result<(), ExperimentError> {
        let others = path.parent().into_iter().flat_map(fs::read_dir).flatten().flatten();
        let foreign = others.map(|entry| entry.path()).find(|p| p.extension().is_some_and(|e| e == "json"));
        if let (Some(other), Some(folder)) = (foreign, path.parent().and_then(Path::parent)) {
            let what = format!("its journal belongs to another experiment ({})", other.display());
            return Err(ExperimentError::Foreign { folder: folder.to_owned(), what });
        }
        let text = serde_json::to_string_pretty(self).map_err(io::Error::from);
        let written = text.and_then(|text| atomic_write(path, |out| writeln!(out, "{text}")));
        written.map_err(ExperimentError::writing(path))
    }

    fn compare(&self, folder: &Path, bytes: &[u8]) -> Result<(), ExperimentError> {
        let difference = self.difference(bytes);
        difference.map_or(Ok(()), |what| Err(ExperimentError::Foreign { folder: folder.to_owned(), what }))
    }

    /// What does not fit, in words.
    fn difference(&self, bytes: &[u8]) -> Option<String> {
        // The format first: another one may have other keys.
        let format = serde_json::from_slice::<serde_json::Value>(bytes).ok();
        let Some(format) = format.as_ref().and_then(|v| v.get("format")?.as_str()) else {
            return Some(format!("journal/{}.json does not identify the experiment", self.name));
        };
        if format != self.format {
            return Some(format!(
                "its journal has the format {format}, but this program uses {}",
                self.format
            ));
        }
        let Ok(known) = serde_json::from_slice::<Self>(bytes) else {
            return Some(format!("journal/{}.json is damaged", self.name));
        };
        if known.program != self.program {
            return Some(format!(
                "begun with version {} of the program, but this is {}",
                known.program, self.program
            ));
        }
        self.changed_input(&known).map(|name| self.changed(&known, name))
    }

    fn changed_input<'a>(&'a self, known: &'a Self) -> Option<&'a String> {
        // The file of the experiment itself first: it decides which others there are.
        let names = self.inputs.keys().chain(known.inputs.keys());
        let changed: Vec<&String> = names.filter(|n| self.inputs.get(*n) != known.inputs.get(*n)).collect();
        changed.iter().find(|n| ***n == self.name).or(changed.first()).copied()
    }

    /// A setting is told with its values, a file is not.
    fn changed(&self, known: &Self, name: &str) -> String {
        const SHA256_DIGITS: usize = 64;
        match (known.inputs.get(name), self.inputs.get(name)) {
            (Some(there), Some(here)) if there.len().max(here.len()) < SHA256_DIGITS => {
                format!("there {name} is {there}, here it is {here}")
            }
            _ if name == self.name => format!("the {name} file has changed since this {name} began"),
            _ => format!("\"{name}\" has changed since this {} began", self.name),
        }
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
