//! Which readings count, when somebody decides otherwise.

use std::borrow::Cow;

use hexbench_core::{Dataset, LineRange};

use crate::error::ModelError;
use crate::inference::misread::Change;

/// How a diagnosis treats the readings.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DiagnoseOptions {
    /// Lines of the file left out before anything else.
    pub exclude: Vec<LineRange>,
    /// Every other reading takes part in the fit; readings that seem wrong are told only.
    pub keep_all: bool,
    /// What the file means otherwise than it says, applied to machine, data and holdout in this order.
    pub read_as: Vec<Change>,
}

impl DiagnoseOptions {
    /// Without these lines of the file.
    #[must_use]
    pub fn with_exclude(mut self, lines: impl IntoIterator<Item = LineRange>) -> Self {
        self.exclude.extend(lines);
        self
    }

    /// With every reading that is not excluded by name.
    #[must_use]
    pub fn with_keep_all(mut self, keep_all: bool) -> Self {
        self.keep_all = keep_all;
        self
    }

    /// With the file read by these changes.
    #[must_use]
    pub fn with_read_as(mut self, changes: impl IntoIterator<Item = Change>) -> Self {
        self.read_as.extend(changes);
        self
    }

    /// The readings to be looked at, and the lines left out.
    ///
    /// # Errors
    /// [`ModelError::NoReading`] for lines that hold none.
    pub fn applied<'a>(&self, data: &'a Dataset) -> Result<(Cow<'a, Dataset>, Vec<u64>), ModelError> {
        if self.exclude.is_empty() {
            return Ok((Cow::Borrowed(data), Vec::new()));
        }
        let ends = || Some((data.observations.first()?.line, data.observations.last()?.line));
        let (rest, lines) =
            data.without(&self.exclude).map_err(|lines| ModelError::NoReading { lines, readings: ends() })?;
        Ok((Cow::Owned(rest), lines))
    }
}
