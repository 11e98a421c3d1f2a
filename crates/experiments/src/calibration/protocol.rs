//! The frozen protocol: which truths, how large, how many.

use hexbench_truth::campaign::CaseKind;

/// Seed of the committed figures.
pub const SEED: u64 = 20_260;

/// Distances of the hidden effects, log-uniform: from what no test could see to what nobody overlooks.
pub const DISTANCES: [f64; 2] = [2.0, 60.0];

/// Trials of one kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TrialPortion {
    /// Kind of campaign.
    pub kind: CaseKind,
    /// How many.
    pub trials: usize,
}

/// What is run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CalibrationProtocol {
    /// Decides everything that is drawn.
    pub seed: u64,
    /// Kinds and counts.
    pub portions: Vec<TrialPortion>,
}

/// Counts of the committed study. Single effects are many because each of the sixteen gets a curve of its own.
const STANDARD: [TrialPortion; 8] = [
    TrialPortion { kind: CaseKind::Single, trials: 2400 },
    TrialPortion { kind: CaseKind::Pair, trials: 800 },
    TrialPortion { kind: CaseKind::Outside, trials: 900 },
    TrialPortion { kind: CaseKind::Clean, trials: 1000 },
    TrialPortion { kind: CaseKind::SeedProtocol, trials: 400 },
    TrialPortion { kind: CaseKind::Absolute, trials: 200 },
    TrialPortion { kind: CaseKind::RichForm, trials: 300 },
    TrialPortion { kind: CaseKind::Triple, trials: 400 },
];

impl Default for CalibrationProtocol {
    fn default() -> Self {
        Self { seed: SEED, portions: STANDARD.to_vec() }
    }
}

impl CalibrationProtocol {
    /// The same mix with about so many trials; every kind keeps at least one.
    #[must_use]
    pub fn with_trials(self, trials: usize) -> Self {
        let all = self.trials();
        let share = |p: TrialPortion| TrialPortion { trials: (p.trials * trials).div_ceil(all).max(1), ..p };
        Self { portions: self.portions.into_iter().map(share).collect(), ..self }
    }

    /// The same with another seed.
    #[must_use]
    pub fn with_seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// Trials of all kinds.
    pub fn trials(&self) -> usize {
        self.portions.iter().map(|p| p.trials).sum()
    }
}
