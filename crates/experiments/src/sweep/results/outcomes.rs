//! Answers of the diagnosis in a cell: what became of the truth, and what was said.

use hexbench_core::statistics::{ClusteredShare, Welford};

use crate::calibration::Fate;
use crate::sweep::shard::{EMPTY, Shard};

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
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AnswerStatistics {
    /// Hits of each kind over the blocks that are complete.
    shares: [ClusteredShare; KINDS],
    /// The block whose trials are being counted.
    open: Block,
    /// Answers by their code, in the order of [`answers`](crate::sweep::columns::answers).
    said: Vec<u64>,
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

impl AnswerStatistics {
    /// Hits and trials with an answer, in blocks.
    pub fn share(&self, of: Counted) -> ClusteredShare {
        let kind = SHARES.iter().position(|known| *known == of).unwrap_or(0);
        let mut share = self.shares[kind];
        share.add(self.open.hits[kind], self.open.trials);
        share
    }

    /// How often an answer was given, by its place among [`answers`](crate::sweep::columns::answers).
    pub fn said(&self, answer: usize) -> u64 {
        self.said.get(answer).copied().unwrap_or(0)
    }

    fn of_code(&mut self, answer: usize) -> &mut u64 {
        if self.said.len() <= answer {
            self.said.resize(answer + 1, 0);
        }
        &mut self.said[answer]
    }

    /// Answers of both.
    #[must_use]
    pub fn and(mut self, other: &Self) -> Self {
        self.close();
        for (k, share) in self.shares.iter_mut().enumerate() {
            *share = share.and(other.shares[k]);
            share.add(other.open.hits[k], other.open.trials);
        }
        for (code, count) in other.said.iter().enumerate() {
            *self.of_code(code) += count;
        }
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
        let said = shard.columns[3].codes()[row];
        if said != EMPTY {
            *self.of_code(usize::from(said)) += 1;
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
