//! The protocol: effects outside the catalogue, effects of the catalogue, clean machines.

use hexbench_truth::campaign::CaseKind;

use super::DiscoveryRecord;
use crate::harness::{self, Field};
use crate::journal::Identity;
use crate::trial::TrialError;

/// Seed of the committed figures.
pub const SEED: u64 = 1_801;
/// Distances of hidden effects: from what the diagnosis just sees to what nobody overlooks.
pub const DISTANCES: [f64; 2] = [10.0, 60.0];

/// What is run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DiscoveryProtocol {
    /// Decides everything that is drawn.
    pub seed: u64,
    /// Campaigns with an effect outside the catalogue.
    pub outside: usize,
    /// Campaigns with an effect of the catalogue.
    pub listed: usize,
    /// Campaigns on clean machines.
    pub clean: usize,
}

impl Default for DiscoveryProtocol {
    fn default() -> Self {
        Self { seed: SEED, outside: 182, listed: 60, clean: 800 }
    }
}

/// A column of the table of trials.
type Column = Field<DiscoveryRecord>;

impl harness::Protocol for DiscoveryProtocol {
    /// Kind, and number within the kind.
    type Job = (CaseKind, usize);
    type Record = DiscoveryRecord;
    type Error = TrialError;

    fn identity(&self) -> Identity {
        let settings = [
            ("seed", self.seed.to_string()),
            ("outside", self.outside.to_string()),
            ("listed", self.listed.to_string()),
            ("clean", self.clean.to_string()),
        ];
        Identity::new("discover", "discover-trials/2", settings)
    }

    fn jobs(&self) -> Vec<(CaseKind, usize)> {
        let counts = [
            (CaseKind::Outside, self.outside),
            (CaseKind::Single, self.listed),
            (CaseKind::Clean, self.clean),
        ];
        counts.into_iter().flat_map(|(kind, count)| (0..count).map(move |index| (kind, index))).collect()
    }

    fn trial(&self, &(kind, index): &(CaseKind, usize)) -> Result<DiscoveryRecord, TrialError> {
        DiscoveryRecord::of(kind, index, self.seed)
    }

    fn name(&self, (kind, index): &(CaseKind, usize)) -> String {
        format!("{}-{index:04}", kind.name())
    }

    fn fields(&self) -> Vec<Column> {
        vec![
            Column::text("hidden", "hidden effect", |r| r.hidden.join("+")),
            Column::text("family", "family of the machine", |r| r.family),
            Column::number("distance", "distance of the hidden effect", |r| r.distance),
            Column::text("fate", "what it came to", |r| r.fate().word()),
            Column::text("formula", "formula of the law found", |r| {
                r.formulas.first().cloned().unwrap_or_default()
            }),
            Column::text("beside", "catalogue effects beside it", |r| r.beside.join("+")),
            Column::number("probability", "probability of a law", |r| r.probability),
            Column::number("before", "held-out error of the springs, times the noise", |r| r.held_out[0]),
            Column::number("after", "the same of the final model", |r| r.held_out[1]),
            Column::number(
                "left",
                "what the final model leaves of held-out readings without noise, times the noise",
                |r| r.left[1],
            ),
        ]
    }
}
