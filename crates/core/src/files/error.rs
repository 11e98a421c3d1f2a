//! Why a file cannot be used.

use super::{FilePlace, FileProblem};
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// A file that cannot be read or written: which, where, why, and what to do next.
///
/// `Display` is one line, `FILE: line L, column C (NAME): "VALUE": what is wrong`, without the next step.
#[derive(Debug)]
pub struct FileError {
    /// The file, as the caller named it.
    pub path: PathBuf,
    /// Where in the file.
    pub place: Box<FilePlace>,
    /// What is wrong there.
    pub problem: Box<FileProblem>,
}

impl FileError {
    /// What to do next, one sentence.
    pub fn next_step(&self) -> String {
        self.problem.next_step()
    }

    /// True when the trouble is with the disk or the name of the file rather than with what the file says.
    pub fn is_input_output(&self) -> bool {
        matches!(
            *self.problem,
            FileProblem::NoSuchFile
                | FileProblem::Folder
                | FileProblem::FileForFolder
                | FileProblem::Read(_)
                | FileProblem::Write(_)
        )
    }

    /// The message without the name of the file.
    pub fn message(&self) -> String {
        located(&self.place, &self.problem)
    }

    pub(crate) fn reading(path: &Path, cause: io::Error) -> Self {
        Fault::from(cause).in_file(path)
    }

    pub(crate) fn writing(path: &Path, cause: io::Error) -> Self {
        Fault::new(FilePlace::file(), FileProblem::Write(cause)).in_file(path)
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}: {}", self.path.display(), self.message())
    }
}

impl std::error::Error for FileError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &*self.problem {
            FileProblem::Read(cause) | FileProblem::Write(cause) => Some(cause),
            _ => None,
        }
    }
}

/// `place: "value": message`, each part when there is one.
pub(crate) fn located(place: &FilePlace, message: &dyn fmt::Display) -> String {
    let at = place.to_string();
    let value = place
        .value
        .as_ref()
        .filter(|value| !value.is_empty())
        .map(|value| format!("\"{value}\""))
        .unwrap_or_default();
    let parts = [at, value, message.to_string()];
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(": ")
}

/// A problem at a place, before the name of the file is known.
#[derive(Debug)]
pub struct Fault {
    /// Where in the file.
    pub place: Box<FilePlace>,
    /// What is wrong there.
    pub problem: Box<FileProblem>,
}

impl Fault {
    /// A problem at a place.
    pub fn new(place: FilePlace, problem: FileProblem) -> Self {
        Self { place: Box::new(place), problem: Box::new(problem) }
    }

    /// A rule of the format that is broken at a place, and what to do.
    pub(crate) fn rule(place: FilePlace, rule: impl Into<String>, next: impl Into<String>) -> Self {
        Self::new(place, FileProblem::Rule { rule: rule.into(), next: next.into() })
    }

    /// The same with the name of the file.
    pub fn in_file(self, path: &Path) -> FileError {
        FileError { path: path.to_owned(), place: self.place, problem: self.problem }
    }
}

impl From<io::Error> for Fault {
    fn from(cause: io::Error) -> Self {
        let problem = match cause.kind() {
            io::ErrorKind::NotFound => FileProblem::NoSuchFile,
            io::ErrorKind::IsADirectory => FileProblem::Folder,
            io::ErrorKind::NotADirectory => FileProblem::FileForFolder,
            _ => FileProblem::Read(cause),
        };
        Self::new(FilePlace::file(), problem)
    }
}
