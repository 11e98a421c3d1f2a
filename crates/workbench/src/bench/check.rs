//! What is wrong with the files, before any effect is compared.

use std::time::Instant;

use hexbench_model::results::check::check;
use hexbench_report::words;

use super::counted::without;
use super::refusal::Refusal;
use super::{LoadedCampaign, files, read_as};
use crate::wire::{Ask, CheckedFiles};

/// Sections of the page of a check that ask for something.
const ASKING: [&str; 2] = ["findings", "remarks"];

impl LoadedCampaign {
    /// Checks the files as `hexbench check` does.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn check(&self, ask: &Ask) -> Result<CheckedFiles, Refusal> {
        let since = Instant::now();
        let terms = files::terms_with(&ask.own, &self.limits)?;
        let c = self.as_written();
        let data = without(&c.data, &ask.exclude)?;
        let found = check(&c.hexapod, Some(&data), c.holdout.as_ref(), &terms, &self.files.changes)
            .map_err(|cause| self.refused(&cause))?;
        let sections = words::check(&c.hexapod.name, &found).sections.into_iter();
        Ok(CheckedFiles {
            ready: found.ready,
            sections: sections.filter(|section| ASKING.contains(&section.id.as_str())).collect(),
            ways: read_as::ways(&found.findings),
            milliseconds: since.elapsed().as_secs_f64() * 1e3,
        })
    }
}
