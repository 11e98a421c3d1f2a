//! `--read-as`: files that mean something else than they say.

use clap::Args;
use hexbench_model::inference::misread::{Change, names};

/// How files are read.
#[derive(Debug, Clone, Args)]
pub(crate) struct ReadAs {
    /// Correct how machine, data and holdout are read: KIND=VALUE as a finding names it
    /// (deflection-sign=reversed); may be given several times and is applied in order
    #[arg(long = "read-as", value_name = "KIND=VALUE")]
    pub(crate) changes: Vec<Change>,
}

impl ReadAs {
    /// As results record it.
    pub(crate) fn names(&self) -> Vec<String> {
        names(&self.changes)
    }
}
