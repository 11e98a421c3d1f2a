//! A challenge that was made: opened, checked against its digests.

use std::path::{Path, PathBuf};

use hexbench_core::files::{content_hash, text_hash};

use crate::challenge::folder::{CASES, PUBLIC, SEALED};
use crate::challenge::stored::read_toml;
use crate::challenge::{ChallengeError, MANIFEST, Manifest};

/// A challenge in its folder.
#[derive(Debug, Clone)]
pub struct Challenge {
    folder: PathBuf,
    manifest: Manifest,
    sha256: String,
}

impl Challenge {
    /// Opens a challenge; its files are not looked at yet.
    ///
    /// # Errors
    /// [`crate::ExperimentError::Read`], [`ChallengeError::Malformed`].
    pub fn open(folder: &Path) -> Result<Self, ChallengeError> {
        let (manifest, text) = read_toml(&folder.join(MANIFEST))?;
        Ok(Self { folder: folder.to_owned(), manifest, sha256: text_hash(&text) })
    }

    /// What it is made of.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// SHA-256 of `challenge.toml`: the challenge in one word.
    pub fn sha256(&self) -> &str {
        &self.sha256
    }

    /// Suite, version and digest, for messages.
    pub fn name(&self) -> String {
        let Manifest { suite, version, .. } = &self.manifest;
        format!("{suite} version {version}, {:.12}", self.sha256)
    }

    /// Folder of a public case.
    pub(crate) fn case(&self, id: &str) -> PathBuf {
        self.folder.join(CASES).join(id)
    }

    /// Folder of a sealed case.
    pub(crate) fn sealed(&self, id: &str) -> PathBuf {
        self.folder.join(SEALED).join(id)
    }

    /// Compares every file with its digest.
    ///
    /// # Errors
    /// [`ChallengeError::Tampered`] for the first file that changed or is missing.
    pub fn verify(&self) -> Result<(), ChallengeError> {
        self.manifest.files.keys().try_for_each(|name| self.verify_file(name))
    }

    /// Compares the public files with their digests; the truth need not be there.
    ///
    /// # Errors
    /// As [`Self::verify`].
    pub fn verify_public(&self) -> Result<(), ChallengeError> {
        let sealed = format!("{SEALED}/");
        let public = self.manifest.files.keys().filter(|name| !name.starts_with(&sealed));
        public.into_iter().try_for_each(|name| self.verify_file(name))
    }

    fn verify_file(&self, name: &str) -> Result<(), ChallengeError> {
        let (path, expected) = (self.folder.join(name), &self.manifest.files[name]);
        let tampered = |found: String| ChallengeError::Tampered {
            path: path.clone(),
            found,
            expected: expected.clone(),
        };
        match content_hash(&path) {
            Ok(found) if found == *expected => Ok(()),
            Ok(found) => Err(tampered(format!("it was changed, its SHA-256 is {found}"))),
            Err(error) => Err(tampered(error.message())),
        }
    }

    /// One digest of the files of all cases, public and sealed; the contract for entrants does not count.
    pub fn cases_sha256(&self) -> String {
        let folders = [format!("{CASES}/"), format!("{SEALED}/")];
        let of_cases = |name: &&String| folders.iter().any(|folder| name.starts_with(folder));
        let line = |name: &String| format!("{}  {name}\n", self.manifest.files[name]);
        text_hash(&self.manifest.files.keys().filter(of_cases).map(line).collect::<String>())
    }

    /// One digest of the public files of a case, as the manifest has them.
    pub(crate) fn case_sha256(&self, id: &str) -> String {
        let digest = |name: &&str| self.manifest.files.get(&format!("{CASES}/{id}/{name}")).cloned();
        text_hash(&PUBLIC.iter().filter_map(digest).collect::<Vec<_>>().join("\n"))
    }
}
