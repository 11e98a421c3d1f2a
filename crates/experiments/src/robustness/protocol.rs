//! The protocol: every fault meets the same campaigns.

use hexbench_truth::campaign::CaseKind;
use hexbench_truth::laboratory::{self, FaultEntry};

use crate::trial::numbered;

/// Seed of the committed figures.
pub const SEED: u64 = 3_301;
/// Campaigns of each fault, half of them on clean machines.
pub const TRIALS: u32 = 32;
/// Distance of the hidden effect: nobody overlooks it in good data.
pub const DISTANCE: f64 = 30.0;

/// Distances from which that of a campaign is drawn; none of a clean machine.
pub(crate) fn distances(kind: CaseKind) -> Option<[f64; 2]> {
    (kind == CaseKind::Single).then_some([DISTANCE; 2])
}

/// What is run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RobustnessProtocol {
    /// Decides everything that is drawn.
    pub seed: u64,
    /// Campaigns of each fault: on a clean machine and with one effect of the catalogue in turn.
    pub trials: usize,
    /// Ids of the faults, in their order; unknown ones are left out.
    pub faults: Vec<&'static str>,
}

impl Default for RobustnessProtocol {
    fn default() -> Self {
        let faults = laboratory::registry().map(|fault| fault.id).collect();
        Self { seed: SEED, trials: TRIALS as usize, faults }
    }
}

/// A campaign in the hands of a laboratory.
#[derive(Debug, Clone, Copy)]
pub struct RobustnessJob {
    /// What the laboratory does.
    pub(crate) fault: &'static FaultEntry,
    /// A clean machine, or one effect.
    pub(crate) kind: CaseKind,
    /// Number within the kind; the same number is the same campaign whatever the fault.
    pub(crate) index: usize,
}

impl RobustnessJob {
    /// Fault, kind and number.
    pub(crate) fn name(self) -> String {
        format!("{}/{}-{:04}", self.fault.id, self.kind.name(), self.index)
    }

    /// The trial of a name.
    pub(super) fn parse(name: &str) -> Option<Self> {
        let (fault, rest) = name.split_once('/')?;
        let (kind, index) = numbered(rest)?;
        let kind = [CaseKind::Clean, CaseKind::Single].into_iter().find(|k| k.name() == kind)?;
        Some(Self { fault: laboratory::entry(fault)?, kind, index })
    }
}

impl RobustnessProtocol {
    /// The control and these faults only.
    #[must_use]
    pub fn with_faults(self, ids: &[&str]) -> Self {
        let wanted = |id: &&str| *id == laboratory::CAREFUL.id || ids.contains(id);
        Self { faults: self.faults.into_iter().filter(wanted).collect(), ..self }
    }
}
