//! Answers of the diagnosis in a cell: what became of the truth, and what was said.

use hexbench_core::statistics::{ClusteredShare, Welford};

use crate::calibration::Fate;
use crate::sweep::columns::answers;
use crate::sweep::shard::Shard;

/// What an answer counts as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Counted {
    /// This fate.
    Of(Fate),
    /// Right or honest: the truth is named, or among what is not excluded.
    Seen,
}

impl Counted {
    /// A word for tables.
    pub fn word(self) -> &'static str {
        match self {
            Self::Of(fate) => fate.word(),
            Self::Seen => "seen",
        }
    }

    fn holds(self, fate: Fate) -> bool {
        match self {
            Self::Of(own) => own == fate,
            Self::Seen => matches!(fate, Fate::Right | Fate::Honest),
        }
    }
}

/// Everything that is counted.
pub const SHARES: [Counted; 8] = [
    Counted::Seen,
    Counted::Of(Fate::Right),
    Counted::Of(Fate::Honest),
    Counted::Of(Fate::Undecided),
    Counted::Of(Fate::Missed),
    Counted::Of(Fate::Incomplete),
    Counted::Of(Fate::FalseOutside),
    Counted::Of(Fate::FalseName),
];
const KINDS: usize = SHARES.len();

/// Answers of the diagnosis.
#[derive(Debug, Clone, PartialEq)]
pub struct AnswerStatistics {
    /// Hits of each kind over the blocks that are complete.
    shares: [ClusteredShare; KINDS],
    /// The block whose trials are being counted.
    open: Block,
    /// Answers by their code, in the order of [`answers`].
    pub said: Vec<u64>,
    /// Held-out chi-square: springs alone, final model.
    pub holdout: [Welford; 2],
}

/// Trials that share machine, plan and effect.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Block {
    number: u64,
    trials: u64,
    hits: [u64; KINDS],
}

impl Default for AnswerStatistics {
    fn default() -> Self {
        Self {
            shares: Default::default(),
            open: Block::default(),
            said: vec![0; answers().len()],
            holdout: Default::default(),
        }
    }
}

impl AnswerStatistics {
    /// Hits and trials with an answer, in blocks.
    pub fn share(&self, of: Counted) -> ClusteredShare {
        let kind = SHARES.iter().position(|known| *known == of).unwrap_or(0);
        let mut share = self.shares[kind];
        share.add(self.open.hits[kind], self.open.trials);
        share
    }

    /// Answers of both.
    #[must_use]
    pub fn and(mut self, other: &Self) -> Self {
        self.close();
        for (k, share) in self.shares.iter_mut().enumerate() {
            *share = share.and(other.shares[k]);
            share.add(other.open.hits[k], other.open.trials);
        }
        self.said.iter_mut().zip(&other.said).for_each(|(a, b)| *a += b);
        for (own, new) in self.holdout.iter_mut().zip(other.holdout) {
            *own = own.and(new);
        }
        self
    }

    fn close(&mut self) {
        let Block { trials, hits, .. } = std::mem::take(&mut self.open);
        self.shares.iter_mut().zip(hits).for_each(|(share, hits)| share.add(hits, trials));
    }

    /// Takes a trial of a block in; blocks come in order.
    pub(super) fn add(&mut self, block: u64, shard: &Shard, row: usize) {
        if block != self.open.number {
            self.close();
            self.open.number = block;
        }
        let fate = Fate::ALL.get(usize::from(shard.columns[1].codes()[row]));
        self.open.trials += 1;
        for (hits, kind) in self.open.hits.iter_mut().zip(SHARES) {
            *hits += u64::from(fate.is_some_and(|fate| kind.holds(*fate)));
        }
        if let Some(said) = self.said.get_mut(usize::from(shard.columns[3].codes()[row])) {
            *said += 1;
        }
        for (k, holdout) in self.holdout.iter_mut().enumerate() {
            let chi2 = shard.columns[HOLDOUT + k].numbers()[row];
            if chi2.is_finite() {
                holdout.add(chi2);
            }
        }
    }
}

/// Column of the first held-out chi-square.
const HOLDOUT: usize = 9;
