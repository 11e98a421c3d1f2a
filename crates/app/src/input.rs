//! Models and terms from files.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use hexbench_core::files::read_text;
use hexbench_model::application::model_file::Model;
use hexbench_model::effects::term::Term;
use hexbench_model::effects::user_term;
use hexbench_model::terms::catalogue;

use crate::Failure;

/// A fitted model; with `trust` also one that was changed by hand since.
///
/// # Errors
/// [`Failure::File`], [`Failure::InFile`].
pub fn model(path: &Path, trust: bool) -> Result<Model, Failure> {
    let text = read_text(path)?;
    if trust {
        Model::from_changed_toml(&text).map_err(Failure::in_file(path))
    } else {
        model_of(&text, path)
    }
}

/// The same from text; `path` names it in messages.
///
/// # Errors
/// [`Failure::InFile`].
pub fn model_of(text: &str, path: &Path) -> Result<Model, Failure> {
    Model::from_toml(text).map_err(Failure::in_file(path))
}

/// Terms from files of the user.
///
/// # Errors
/// [`Failure::File`], [`Failure::InFile`].
pub fn user_terms(paths: &[PathBuf]) -> Result<Vec<Arc<dyn Term>>, Failure> {
    let read = |path: &PathBuf| user_term::parse(&read_text(path)?).map_err(Failure::in_file(path));
    paths.iter().map(read).collect()
}

/// The catalogue and the user's own terms.
pub fn catalogue_with(own: &[Arc<dyn Term>]) -> Vec<Arc<dyn Term>> {
    catalogue().into_iter().chain(own.iter().map(Arc::clone)).collect()
}
