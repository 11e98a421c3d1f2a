//! A program and how it is called.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use hexbench_core::files::text_hash;

use crate::challenge::ChallengeError;

/// A program with its arguments, all paths absolute; or a function of the program at work.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Program {
    line: Vec<String>,
    depends: Vec<PathBuf>,
    /// What is no file but belongs to it, with the SHA-256 of each.
    sources: BTreeMap<String, String>,
    is_inside: bool,
}

impl Program {
    /// Finds a program by path or on the PATH. Arguments that name a file here are made absolute, because the program runs
    /// elsewhere.
    ///
    /// # Errors
    /// [`ChallengeError::NoProgram`], [`ChallengeError::NotExecutable`].
    pub fn find(line: &[String]) -> Result<Self, ChallengeError> {
        let name = line.first().map_or("", String::as_str);
        let path = located(name).ok_or_else(|| missing(name))?;
        let mut found = vec![path.display().to_string()];
        found.extend(line.iter().skip(1).map(|argument| absolute_file(argument)));
        Ok(Self { line: found, depends: Vec::new(), sources: BTreeMap::new(), is_inside: false })
    }

    /// A function of the program at work, by its name, with texts it is made of that stand in no file, each under a name.
    pub fn inside(name: &str, sources: &[(String, String)]) -> Self {
        let digest = |(name, text): &(String, String)| (name.clone(), text_hash(text));
        let sources = sources.iter().map(digest).collect();
        Self { line: vec![name.to_owned()], depends: Vec::new(), sources, is_inside: true }
    }

    /// The same with files and folders that it depends on besides, such as the modules it imports.
    ///
    /// # Errors
    /// [`ChallengeError::NoDependency`].
    pub fn with_depends(mut self, paths: &[PathBuf]) -> Result<Self, ChallengeError> {
        for path in paths {
            let absolute = std::path::absolute(path).ok().filter(|path| path.exists());
            self.depends.push(absolute.ok_or_else(|| ChallengeError::NoDependency(path.clone()))?);
        }
        Ok(self)
    }

    /// Program and arguments.
    pub fn line(&self) -> &[String] {
        &self.line
    }

    /// What it depends on besides, absolute.
    pub fn depends(&self) -> &[PathBuf] {
        &self.depends
    }

    /// Digests of what is no file but belongs to it.
    pub fn sources(&self) -> &BTreeMap<String, String> {
        &self.sources
    }

    /// True for a function of the program at work.
    pub fn is_inside(&self) -> bool {
        self.is_inside
    }
}

fn located(name: &str) -> Option<PathBuf> {
    if name.contains('/') {
        return std::path::absolute(name).ok().filter(|path| is_program(path));
    }
    let folders = std::env::var_os("PATH")?;
    std::env::split_paths(&folders)
        .map(|folder| folder.join(OsStr::new(name)))
        .filter_map(|path| std::path::absolute(path).ok())
        .find(|path| !name.is_empty() && is_program(path))
}

/// Why there is no program of this name.
fn missing(name: &str) -> ChallengeError {
    let is_file = Path::new(name).is_file();
    if is_file {
        ChallengeError::NotExecutable(name.into())
    } else {
        ChallengeError::NoProgram(name.to_owned())
    }
}

fn absolute_file(argument: &str) -> String {
    let path = Path::new(argument);
    let absolute = std::path::absolute(path).ok().filter(|_| path.is_file());
    absolute.map_or_else(|| argument.to_owned(), |path| path.display().to_string())
}

#[cfg(unix)]
fn is_program(path: &Path) -> bool {
    use std::os::unix::fs::PermissionsExt;
    path.metadata().is_ok_and(|m| m.is_file() && m.permissions().mode() & 0o111 != 0)
}

#[cfg(not(unix))]
fn is_program(path: &Path) -> bool {
    path.is_file()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &[&str]) -> Vec<String> {
        line.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_program_is_found_on_the_path_and_files_become_absolute() {
        let program = Program::find(&words(&["sh", "Cargo.toml", "--flag", "no-such-file"])).unwrap();
        let line = program.line();
        assert!(Path::new(&line[0]).is_absolute() && line[0].ends_with("/sh"), "{line:?}");
        assert!(Path::new(&line[1]).is_absolute() && line[1].ends_with("/Cargo.toml"), "{line:?}");
        assert_eq!(line[2..], words(&["--flag", "no-such-file"]));
    }

    #[test]
    fn what_cannot_be_run_is_no_program() {
        for name in ["", "no-such-program-anywhere", "/"] {
            assert!(matches!(Program::find(&words(&[name])), Err(ChallengeError::NoProgram(_))), "{name}");
        }
        for name in ["Cargo.toml", "./Cargo.toml"] {
            assert!(
                matches!(Program::find(&words(&[name])), Err(ChallengeError::NotExecutable(_))),
                "{name}"
            );
        }
    }
}
