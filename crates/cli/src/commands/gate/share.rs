//! A gate shared among processes: its cases in parts, each in a folder of its own.

use std::path::Path;

use hexbench_experiments::gate::{GateShare, GateWork};

use crate::commands::challenge::options::ShareOptions;
use crate::failure::Failure;

impl ShareOptions {
    /// Where the answers come from; a part needs a folder that keeps them.
    pub(super) fn of_gate(&self, work: Option<&Path>) -> Result<GateShare<'_>, Failure> {
        match (self.shard, work) {
            (Some(_), None) => Err(Failure::usage(
                "--shard needs a folder that keeps the answers of the part",
                "Add --work DIR, another one for each part.",
            )),
            (Some(part), Some(_)) => Ok(GateShare::Part(part)),
            (None, _) if self.parts.is_empty() => Ok(GateShare::Whole),
            (None, _) => Ok(GateShare::Parts(&self.parts)),
        }
    }
}

/// What is said of a part that is answered; none where there is more to do than a part.
pub(super) fn answered(work: &GateWork<'_>) -> Option<String> {
    let GateShare::Part(part) = work.share else { return None };
    let all = work.challenge.manifest().cases.len();
    Some(format!("Part {part}: {} of {all} cases answered.\n", work.own_cases()))
}
