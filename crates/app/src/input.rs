//! Models and terms from files.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use hexbench_model::application::model_file::Model;
use hexbench_model::effects::term::Term;
use hexbench_model::effects::user_term;
use hexbench_model::terms::catalogue;

use crate::Failure;

/// A fitted model.
///
/// # Errors
/// [`Failure::Unreadable`], [`Failure::ModelFile`].
pub fn model(path: &Path) -> Result<Model, Failure> {
    let unreadable = |cause| Failure::Unreadable { path: path.to_owned(), cause };
    let text = std::fs::read_to_string(path).map_err(unreadable)?;
    model_of(&text, path)
}

/// The same from text; `path` names it in messages.
///
/// # Errors
/// [`Failure::ModelFile`].
pub fn model_of(text: &str, path: &Path) -> Result<Model, Failure> {
    Model::from_toml(text)
        .map_err(|cause| Failure::ModelFile { path: path.to_owned(), cause: Box::new(cause) })
}

/// Terms from files of the user.
///
/// # Errors
/// [`Failure::UserTerm`].
pub fn user_terms(paths: &[PathBuf]) -> Result<Vec<Arc<dyn Term>>, Failure> {
    let read = |path: &PathBuf| {
        user_term::read(path)
            .map_err(|cause| Failure::UserTerm { path: path.clone(), cause: Box::new(cause) })
    };
    paths.iter().map(read).collect()
}

/// The catalogue and the user's own terms.
pub fn catalogue_with(own: &[Arc<dyn Term>]) -> Vec<Arc<dyn Term>> {
    catalogue().into_iter().chain(own.iter().map(Arc::clone)).collect()
}
