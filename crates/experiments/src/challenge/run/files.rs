//! The files that answers depend on: an edited program is another one.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use hexbench_core::files::{content_hash, text_hash};
use serde::{Deserialize, Serialize};

use super::Program;
use crate::challenge::ChallengeError;
use crate::error::ExperimentError;

/// Folders that hold nothing a program is made of: caches; those with a dot in front are passed over too.
const CACHES: [&str; 2] = ["__pycache__", "node_modules"];
/// More files are probably the wrong folder.
const MOST_FILES: usize = 20_000;
/// Digits of a digest that a message shows.
const SHOWN: usize = 12;

/// Files of a program with the SHA-256 of each, by absolute path.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ProgramFiles(BTreeMap<String, String>);

impl ProgramFiles {
    /// The program itself, every argument that is a file, what it depends on besides, and the sources of a function that stands in no file.
    ///
    /// # Errors
    /// [`ChallengeError::File`], [`ChallengeError::TooManyFiles`], [`ExperimentError::Read`].
    pub fn of(program: &Program) -> Result<Self, ChallengeError> {
        let arguments = program.line().iter().filter(|_| !program.is_inside());
        let mut paths: Vec<PathBuf> = arguments.filter_map(|word| file_in(word)).collect();
        for root in program.depends() {
            add(root, root, &mut paths)?;
        }
        let digest = |path: PathBuf| Ok((path.display().to_string(), content_hash(&path)?));
        let sources = program.sources().clone().into_iter().map(Ok);
        paths.into_iter().map(digest).chain(sources).collect::<Result<_, _>>().map(Self)
    }

    /// One digest of all of them.
    pub fn sha256(&self) -> String {
        let lines: Vec<String> = self.0.iter().map(|(path, digest)| format!("{digest}  {path}\n")).collect();
        text_hash(&lines.concat())
    }

    /// Digests by the path from a folder; of files elsewhere, which have another path on another machine, by the name.
    pub fn named_from(&self, folder: &Path) -> BTreeMap<String, String> {
        let name = |path: &str| {
            let path = Path::new(path);
            let from_folder = path.strip_prefix(folder).ok().or_else(|| path.file_name().map(Path::new));
            from_folder.unwrap_or(path).display().to_string()
        };
        self.0.iter().map(|(path, digest)| (name(path), digest.clone())).collect()
    }

    /// What became of these files: one sentence for each that is another one now.
    pub fn changes(&self, now: &Self) -> Vec<String> {
        let gone = self.0.keys().filter(|path| !now.0.contains_key(*path));
        let gone = gone.map(|path| format!("{path} belonged to the program"));
        let others = now.0.iter().filter_map(|(path, digest)| match self.0.get(path) {
            Some(before) if before == digest => None,
            Some(before) => Some(format!(
                "{path} was edited: its SHA-256 was {before:.SHOWN$}..., it is {digest:.SHOWN$}..."
            )),
            None => Some(format!("{path} did not belong to the program")),
        });
        others.chain(gone).collect()
    }
}

/// The file that an argument names, alone or as in `--option=FILE`.
fn file_in(word: &str) -> Option<PathBuf> {
    let behind = word.split_once('=').map(|(_, path)| path);
    [Some(word), behind].into_iter().flatten().map(PathBuf::from).find(|path| path.is_file())
}

/// The files of a folder and of those below it; links to folders are not followed, they may lead around.
fn add(root: &Path, path: &Path, found: &mut Vec<PathBuf>) -> Result<(), ChallengeError> {
    if path.is_file() {
        found.push(path.to_owned());
        let too_many = || ChallengeError::TooManyFiles { folder: root.to_owned(), most: MOST_FILES };
        return if found.len() > MOST_FILES { Err(too_many()) } else { Ok(()) };
    }
    for entry in fs::read_dir(path).map_err(ExperimentError::reading(path))? {
        let entry = entry.map_err(ExperimentError::reading(path))?;
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let is_link_to_folder = entry.file_type().is_ok_and(|t| t.is_symlink()) && entry.path().is_dir();
        if !name.starts_with('.') && !CACHES.contains(&&*name) && !is_link_to_folder {
            add(root, &entry.path(), found)?;
        }
    }
    Ok(())
}
