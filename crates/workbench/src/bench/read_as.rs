//! Files read differently from what they say, as a finding names it.

use hexbench_model::inference::examination::Finding;
use hexbench_model::inference::misread::{ChangeError, names};
use hexbench_model::results::diagnose::DiagnoseOptions;

use super::LoadedCampaign;
use super::counted::ranges;
use super::files::{Contents, Files};
use super::refusal::Refusal;

impl Files {
    /// The same, read with these changes after those there are.
    ///
    /// # Errors
    /// [`Refusal`] for what is no change.
    pub(super) fn read_as(mut self, changes: &[String]) -> Result<Self, Refusal> {
        for name in changes {
            self.changes.push(name.parse()?);
        }
        Ok(self)
    }
}

impl LoadedCampaign {
    /// What the files say, word for word.
    pub(super) fn as_written(&self) -> &Contents {
        self.written.as_ref().unwrap_or(&self.contents)
    }

    /// Settings of a diagnosis of [`Self::as_written`], which reads the files as they are read here.
    pub(super) fn options(&self, exclude: &[u64]) -> DiagnoseOptions {
        let changes = self.files.changes.iter().copied();
        DiagnoseOptions::default().with_exclude(ranges(exclude)).with_read_as(changes)
    }

    /// Changes as results record them.
    pub(super) fn read_as(&self) -> Vec<String> {
        names(&self.files.changes)
    }
}

/// Ways to read the files that findings name.
pub(super) fn ways(findings: &[Finding]) -> Vec<Vec<String>> {
    findings.iter().map(|finding| names(&finding.read_as)).filter(|way| !way.is_empty()).collect()
}

impl From<ChangeError> for Refusal {
    fn from(cause: ChangeError) -> Self {
        Self::bad_input(cause.to_string(), "Take a way to read the files that a finding names.")
    }
}
