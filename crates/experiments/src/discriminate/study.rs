//! Running the protocol.

use rayon::prelude::*;

use super::{Confusion, Record};

/// Seed of the committed figures.
pub const SEED: u64 = 20_261;
/// Campaigns per pair in the committed figures.
const TRIALS: usize = 200;
/// Machines tried for one trial: not every effect shows on every machine.
const ATTEMPTS: usize = 8;

/// What is run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Protocol {
    /// Decides everything that is drawn.
    pub seed: u64,
    /// Campaigns per pair.
    pub trials: usize,
}

impl Default for Protocol {
    fn default() -> Self {
        Self { seed: SEED, trials: TRIALS }
    }
}

/// All trials.
#[derive(Debug)]
pub struct Discrimination {
    /// What was run.
    pub protocol: Protocol,
    /// Every pair with its trials.
    pub pairs: Vec<(Confusion, Vec<Record>)>,
    /// Trials without an answer.
    pub failures: usize,
}

impl Discrimination {
    /// The trials of all pairs.
    pub fn records(&self) -> Vec<Record> {
        self.pairs.iter().flat_map(|(_, records)| records.iter().cloned()).collect()
    }
}

/// Runs every trial; `done` is called after each. One stream of random numbers per trial: the same seed gives the same records on
/// any number of threads.
pub fn discriminate(
    protocol: Protocol,
    confusions: &[Confusion],
    done: &(dyn Fn() + Sync),
) -> Discrimination {
    let jobs: Vec<(usize, usize)> =
        (0..confusions.len()).flat_map(|c| (0..protocol.trials).map(move |t| (c, t))).collect();
    let one = |&(c, t): &(usize, usize)| {
        let attempts = (0..ATTEMPTS).map(|a| ATTEMPTS * (protocol.trials.max(TRIALS) * c + t) + a);
        let record = attempts.map(|n| Record::of(&confusions[c], n, protocol.seed)).find_map(Result::ok);
        done();
        record
    };
    let records: Vec<Option<Record>> = jobs.par_iter().map(one).collect();
    let failures = records.iter().filter(|r| r.is_none()).count();
    let of = |c: usize| {
        let own = &records[c * protocol.trials..(c + 1) * protocol.trials];
        (confusions[c], own.iter().flatten().cloned().collect())
    };
    Discrimination { protocol, pairs: (0..confusions.len()).map(of).collect(), failures }
}
