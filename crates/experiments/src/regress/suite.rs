//! What is run: which machines, effects and plans, how many of each.

use hexbench_truth::campaign::CaseKind;

use crate::calibration::TrialPortion;
use crate::recovery::scene::{HiddenSubject, subjects};

/// Version of the suites: another one when anything that is drawn or measured changes, so that old baselines are refused.
pub const VERSION: u32 = 4;
/// Seed unless another is given, and of the first run behind a baseline.
pub const SEED: u64 = 1;
/// Runs behind a baseline: with so many its own luck is small beside that of the run compared with it.
pub const BASELINE_RUNS: usize = 8;
/// Seed of the machines of fits without noise: the same in every run, since without noise nothing averages out.
pub const MACHINES_SEED: u64 = 20_261;
/// Distances of the effects hidden from the diagnosis, log-uniform: from hardly visible to clear.
pub const DISTANCES: [f64; 2] = [6.0, 40.0];

/// What one run does.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RegressSuite {
    /// `full` or `quick`.
    pub name: &'static str,
    /// [`VERSION`].
    pub version: u32,
    /// What is hidden in the campaigns that are fitted by the right model.
    pub subjects: Vec<HiddenSubject>,
    /// Noisy campaigns of each subject.
    pub fits: usize,
    /// Campaigns of each subject without noise.
    pub machines: usize,
    /// Campaigns that are diagnosed.
    pub portions: Vec<TrialPortion>,
    /// Faults of laboratories whose campaigns are diagnosed.
    pub faults: Vec<&'static str>,
    /// Campaigns of each of them: as many on clean machines as with an effect.
    pub laboratory: usize,
    /// Misstatements whose files are diagnosed.
    pub misstatements: Vec<&'static str>,
    /// Campaigns of each of them.
    pub misread: usize,
    /// Sound campaigns whose files are looked at for misstatements.
    pub sound: usize,
}

/// One fault of each sort, in a size that laboratories have; the careful one first.
const FAULTS: [&str; 13] = [
    "none",
    "noise-1.3x",
    "student-3-variance",
    "correlated-0.8",
    "drift-1",
    "shared-reference",
    "setup-0.5",
    "rounded-0.1um",
    "outlier-20",
    "rows-swapped",
    "pose-1mm",
    "load-gain-1",
    "joints-0.05mm",
];
/// Those of the quick suite: none, and one that is found and taken out.
const FEW_FAULTS: usize = 2;

/// One misstatement of each sort, as users make them.
const MISSTATEMENTS: [&str; 16] = [
    "deflection-negated",
    "fz-negated",
    "moments-negated",
    "states-exchanged",
    "reference-missing",
    "translations-mm-as-um",
    "pose-angles-rad-as-deg",
    "forces-kg-as-n",
    "readings-yaw-90",
    "wrench-in-mobile-axes",
    "all-angles-intrinsic",
    "moments-about-base-center",
    "platform-joints-shifted-2",
    "joints-exchanged",
    "readings-shifted-row",
    "rows-copied-as-repeats",
];
/// Those of the quick suite.
const FEW_MISSTATEMENTS: usize = 2;

/// Diagnoses of the full suite: every effect twice alone, and what else a diagnosis can meet.
const DIAGNOSED: [TrialPortion; 7] = [
    TrialPortion { kind: CaseKind::Single, trials: 32 },
    TrialPortion { kind: CaseKind::Pair, trials: 12 },
    TrialPortion { kind: CaseKind::Outside, trials: 14 },
    TrialPortion { kind: CaseKind::Clean, trials: 16 },
    TrialPortion { kind: CaseKind::SeedProtocol, trials: 10 },
    TrialPortion { kind: CaseKind::Absolute, trials: 6 },
    TrialPortion { kind: CaseKind::RichForm, trials: 6 },
];
/// Diagnoses of the quick suite.
const FEW_DIAGNOSED: [TrialPortion; 3] = [
    TrialPortion { kind: CaseKind::Single, trials: 4 },
    TrialPortion { kind: CaseKind::Outside, trials: 2 },
    TrialPortion { kind: CaseKind::Clean, trials: 2 },
];
/// Subjects of the quick suite: springs, a linear effect, one with a shape, one of absolute poses.
const FEW_SUBJECTS: [&str; 4] = ["springs", "target-offset", "creep", "leg-offset"];

impl RegressSuite {
    /// The whole suite, or the part of it that is run for a quick look.
    pub fn chosen(quick: bool) -> Self {
        if quick { Self::quick() } else { Self::full() }
    }

    /// The suite that a baseline is committed for.
    pub fn full() -> Self {
        let portions = DIAGNOSED.to_vec();
        Self {
            name: "full",
            version: VERSION,
            subjects: subjects(),
            fits: 9,
            machines: 3,
            portions,
            faults: FAULTS.to_vec(),
            laboratory: 4,
            misstatements: MISSTATEMENTS.to_vec(),
            misread: 2,
            sound: 48,
        }
    }

    /// A small one that shows how everything works; it notices gross faults only.
    pub fn quick() -> Self {
        let chosen = subjects().into_iter().filter(|s| FEW_SUBJECTS.contains(&s.name)).collect();
        let portions = FEW_DIAGNOSED.to_vec();
        Self {
            name: "quick",
            version: VERSION,
            subjects: chosen,
            fits: 3,
            machines: 1,
            portions,
            faults: FAULTS[..FEW_FAULTS].to_vec(),
            laboratory: 2,
            misstatements: MISSTATEMENTS[..FEW_MISSTATEMENTS].to_vec(),
            misread: 1,
            sound: 2,
        }
    }

    /// The same without the campaigns that have no noise, and are thus the same in every run.
    #[must_use]
    pub fn without_machines(&self) -> Self {
        Self { machines: 0, ..self.clone() }
    }

    /// Campaigns of one run.
    pub fn campaigns(&self) -> usize {
        let diagnosed: usize = self.portions.iter().map(|p| p.trials).sum();
        let files = self.misstatements.len() * self.misread + self.sound;
        self.subjects.len() * (self.fits + self.machines)
            + diagnosed
            + self.faults.len() * self.laboratory
            + files
    }
}
