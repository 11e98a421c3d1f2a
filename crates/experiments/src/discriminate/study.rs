//! Running the protocol.

use super::{ConfusedPair, DiscriminateRecord};
use crate::harness::{self, Field, Gathered, TrialResult};
use crate::journal::Identity;
use crate::trial::{Outcome, TrialError};

/// Seed of the committed figures.
pub const SEED: u64 = 20_261;
/// Campaigns per pair in the committed figures.
const TRIALS: usize = 200;
/// Machines tried for one trial: not every effect shows on every machine.
const ATTEMPTS: usize = 8;

/// What is run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DiscriminateProtocol {
    /// Decides everything that is drawn.
    pub seed: u64,
    /// Campaigns per pair.
    pub trials: usize,
}

impl Default for DiscriminateProtocol {
    fn default() -> Self {
        Self { seed: SEED, trials: TRIALS }
    }
}

/// Trials of pairs of effects.
pub struct PairTrials<'a> {
    /// How many, and the seed.
    pub protocol: DiscriminateProtocol,
    /// The pairs.
    pub confusions: &'a [ConfusedPair],
}

/// What all trials gave.
#[derive(Debug)]
pub struct Discrimination {
    /// What was run.
    pub protocol: DiscriminateProtocol,
    /// Every pair with its trials.
    pub pairs: Vec<(ConfusedPair, Vec<DiscriminateRecord>)>,
    /// Trials without an answer.
    pub failures: usize,
}

impl Discrimination {
    /// What the trials of a protocol gave.
    pub fn of(trials: &PairTrials<'_>, gathered: &Gathered<DiscriminateRecord>) -> Self {
        let own = |answers: &[TrialResult<DiscriminateRecord>]| answers.iter().flatten().cloned().collect();
        let pairs = trials.confusions.iter().copied();
        let records = gathered.answers.chunks(trials.protocol.trials).map(own);
        Self {
            protocol: trials.protocol,
            pairs: pairs.zip(records).collect(),
            failures: gathered.failures().count(),
        }
    }

    /// The trials of all pairs.
    pub fn records(&self) -> Vec<DiscriminateRecord> {
        self.pairs.iter().flat_map(|(_, records)| records.iter().cloned()).collect()
    }
}

/// A column of the table of trials.
type Column = Field<DiscriminateRecord>;

impl harness::Protocol for PairTrials<'_> {
    /// Number of the pair, and of the trial within it.
    type Job = (usize, usize);
    type Record = DiscriminateRecord;
    type Error = TrialError;

    fn identity(&self) -> Identity {
        let DiscriminateProtocol { seed, trials } = self.protocol;
        let pairs = self.confusions.iter().map(ConfusedPair::name).collect::<Vec<_>>().join(", ");
        let settings = [("pairs", pairs), ("trials", trials.to_string()), ("seed", seed.to_string())];
        Identity::new("discriminate", "discriminate-trials/2", settings)
    }

    fn jobs(&self) -> Vec<(usize, usize)> {
        let pairs = 0..self.confusions.len();
        pairs.flat_map(|c| (0..self.protocol.trials).map(move |t| (c, t))).collect()
    }

    /// The last failure when no machine tried shows the effect.
    fn trial(&self, &(c, t): &(usize, usize)) -> Result<DiscriminateRecord, TrialError> {
        let first = ATTEMPTS * (self.protocol.trials.max(TRIALS) * c + t);
        let attempt = |n| DiscriminateRecord::of(&self.confusions[c], n, self.protocol.seed);
        (first + 1..first + ATTEMPTS).fold(attempt(first), |made, n| made.or_else(|_| attempt(n)))
    }

    fn name(&self, (c, t): &(usize, usize)) -> String {
        format!("{}-{t}", self.confusions[*c].name())
    }

    fn fields(&self) -> Vec<Column> {
        let stage = |name, meaning, of: fn(&DiscriminateRecord) -> Outcome| {
            Column::text(name, meaning, move |r| of(r).word())
        };
        vec![
            Column::text("hidden", "the hidden effect", |r| r.hidden),
            Column::text("family", "family of the machine", |r| r.family),
            stage("before", "by the confusing plan alone", |r| r.before),
            stage("proposed", "with the readings proposed", |r| r.proposed),
            stage("proposed_random", "with as many at random", |r| r.proposed_random),
            stage("asked", "with readings chosen for the pair", |r| r.asked),
            stage("asked_random", "with as many at random", |r| r.asked_random),
            Column::number("readings", "readings proposed", |r| r.readings as f64),
            Column::number("asked_readings", "readings chosen for the pair", |r| r.asked_readings as f64),
            Column::number("promised", "promised chance to favor the truth", |r| r.promised),
            Column::flag("favoured", "1 where all readings favor it", |r| r.favoured),
        ]
    }
}
