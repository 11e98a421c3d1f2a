//! `--read-as`: files that mean something else than they say.

use clap::Args;
use hexbench_model::inference::misread::{Change, names};

/// How files are read.
#[derive(Debug, Args)]
pub(crate) struct ReadAs {
    /// Read machine, data and holdout differently from what they say: KIND=VALUE as a finding names it
    /// (deflection-sign=reversed); may be given several times, applied in order
    #[arg(long = "read-as", value_name = "KIND=VALUE")]
    pub(crate) changes: Vec<Change>,
}

impl ReadAs {
    /// As results record it.
    pub(crate) fn names(&self) -> Vec<String> {
        names(&self.changes)
    }
}
