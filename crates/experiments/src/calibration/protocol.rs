//! The frozen protocol: which truths, how large, how many.

use hexbench_truth::campaign::Kind;

/// Seed of the committed figures.
pub const SEED: u64 = 20_260;

/// Distances of the hidden effects, log-uniform: from what no test could see to what nobody overlooks.
pub const DISTANCES: [f64; 2] = [2.0, 60.0];

/// Trials of one kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Portion {
    /// Kind of campaign.
    pub kind: Kind,
    /// How many.
    pub trials: usize,
}

/// What is run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Protocol {
    /// Decides everything that is drawn.
    pub seed: u64,
    /// Kinds and counts.
    pub portions: Vec<Portion>,
}

/// Counts of the committed study. Single effects are many because each of the sixteen gets a curve of its own.
const STANDARD: [Portion; 7] = [
    Portion { kind: Kind::Single, trials: 2400 },
    Portion { kind: Kind::Pair, trials: 800 },
    Portion { kind: Kind::Outside, trials: 900 },
    Portion { kind: Kind::Clean, trials: 1000 },
    Portion { kind: Kind::SeedProtocol, trials: 400 },
    Portion { kind: Kind::Absolute, trials: 200 },
    Portion { kind: Kind::RichForm, trials: 300 },
];

impl Default for Protocol {
    fn default() -> Self {
        Self { seed: SEED, portions: STANDARD.to_vec() }
    }
}

impl Protocol {
    /// The same mix with about so many trials; every kind keeps at least one.
    #[must_use]
    pub fn with_trials(self, trials: usize) -> Self {
        let all = self.trials();
        let share = |p: Portion| Portion { trials: (p.trials * trials).div_ceil(all).max(1), ..p };
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

    /// Kind and number within the kind of a trial.
    pub(super) fn job(&self, number: u64) -> (Kind, usize) {
        let mut jobs = self.portions.iter().flat_map(|p| (0..p.trials).map(|index| (p.kind, index)));
        let number = usize::try_from(number).unwrap_or(usize::MAX);
        jobs.nth(number).unwrap_or((Kind::Single, number))
    }
}
