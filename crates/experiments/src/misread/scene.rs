//! Scenes whose machines take part in the sound campaigns.

use std::path::{Path, PathBuf};

use hexbench_core::files::{FileError, content_hash};
use hexbench_truth::Scene;

/// A scene in its folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MisreadScene {
    /// Name of its folder.
    pub name: String,
    /// The folder.
    pub folder: PathBuf,
    /// Digests of its files.
    pub digest: String,
}

impl MisreadScene {
    /// The scene of a folder.
    ///
    /// # Errors
    /// What cannot be read.
    pub fn of(folder: &Path) -> Result<Self, FileError> {
        let scene = Scene::read(folder)?;
        let digests: Vec<String> =
            scene.files.iter().map(|file| content_hash(&folder.join(file))).collect::<Result<_, _>>()?;
        Ok(Self { name: scene.name, folder: folder.to_owned(), digest: digests.join(" ") })
    }
}
