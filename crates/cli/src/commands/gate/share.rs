//! A gate shared among processes: its cases in parts, each in a folder of its own.

use std::path::Path;

use hexbench_experiments::gate::{GateShare, GateWork};

use crate::commands::challenge::options::ShareOptions;
use crate::failure::Failure;
use crate::output::Screen;

impl ShareOptions {
    /// Where the answers come from; a part needs a folder that keeps them.
    pub(super) fn of_gate(&self, work: Option<&Path>) -> Result<GateShare<'_>, Failure> {
        match (self.shard, work) {
            (Some(_), None) => Err(Failure::Usage {
                message: "--shard needs a folder that keeps the answers of the part".into(),
                next: "Add --work DIR, another one for each part.".into(),
            }),
            (Some(part), Some(_)) => Ok(GateShare::Part(part)),
            (None, _) if self.parts.is_empty() => Ok(GateShare::Whole),
            (None, _) => Ok(GateShare::Parts(&self.parts)),
        }
    }
}

/// Says that a part is answered; false where there is more to do than a part.
pub(super) fn told(work: &GateWork<'_>, screen: &Screen) -> Result<bool, Failure> {
    let GateShare::Part(part) = work.share else { return Ok(false) };
    let all = work.challenge.manifest().cases.len();
    screen.tell(&format!("Part {part}: {} of {all} cases answered.\n", work.own_cases()))?;
    Ok(true)
}
