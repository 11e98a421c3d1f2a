//! Sessions of the workbench, opened beside the files that they were made with.

use std::path::{Path, PathBuf};

use hexbench_core::files::{content_hash, read_text};
use hexbench_core::{Dataset, Hexapod};
use hexbench_model::application::session::{Session, SessionError};
use hexbench_model::estimation::fit_named::Added;
use hexbench_model::results::diagnose::prepare;

use crate::Failure;
use crate::fit::ToFit;

/// A session with its file.
#[derive(Debug, Clone)]
pub struct SessionFile {
    /// Where it is.
    path: PathBuf,
    /// What is in it.
    pub session: Session,
}

impl SessionFile {
    /// Reads it.
    ///
    /// # Errors
    /// [`Failure::File`], [`Failure::InFile`].
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let session = Session::parse(&read_text(path)?).map_err(Failure::in_file(path))?;
        Ok(Self { path: path.to_owned(), session })
    }

    /// The same, beside these files: machine, measurements and, where there are any, held-out measurements.
    ///
    /// # Errors
    /// [`Failure::InFile`] where one of them is not the file that the session was made with.
    pub fn beside<'a>(path: &Path, files: impl IntoIterator<Item = &'a Path>) -> Result<Self, Failure> {
        let file = Self::read(path)?;
        let digests = files.into_iter().map(content_hash).collect::<Result<Vec<_>, _>>()?;
        file.refuse_others(&digests)?;
        Ok(file)
    }

    /// The same where a session is given.
    ///
    /// # Errors
    /// As [`Self::beside`].
    pub fn given(
        path: Option<&Path>,
        [hexapod, data]: [&Path; 2],
        holdout: Option<&Path>,
    ) -> Result<Option<Self>, Failure> {
        path.map(|path| Self::beside(path, [hexapod, data].into_iter().chain(holdout))).transpose()
    }

    /// Refuses files of other digests than those that the session was made with.
    ///
    /// # Errors
    /// [`Failure::InFile`].
    pub fn refuse_others(&self, digests: &[String]) -> Result<(), Failure> {
        self.session.made_with(digests).map_err(|cause| self.failure(cause))
    }

    /// The model it shows, of these readings, which are read as the session reads them ([`Session::changes`]); numbers come out as in the
    /// workbench.
    ///
    /// # Errors
    /// [`Failure::InFile`], [`Failure::Model`] for a line without a reading, a term that is none, a campaign that cannot be fitted.
    pub fn to_fit<'a>(&self, hexapod: &Hexapod, data: &'a Dataset) -> Result<ToFit<'a>, Failure> {
        let failed = Failure::of_model(&data.source);
        let terms = self.session.terms().map_err(|cause| self.failure(cause))?;
        let named = self.session.shown().terms.iter().map(|id| Added::named(id, &terms).map_err(failed));
        let added = named.collect::<Result<_, _>>()?;
        let (data, exclude) = self.session.options().applied(data).map_err(failed)?;
        // As the workbench prepares it: the same campaign whatever is ticked.
        let campaign = prepare(hexapod, &data).map_err(failed)?;
        Ok(ToFit { data, exclude, campaign, added })
    }

    /// What stands in the way, with the file.
    pub fn failure(&self, cause: SessionError) -> Failure {
        Failure::in_file(&self.path)(cause)
    }
}
