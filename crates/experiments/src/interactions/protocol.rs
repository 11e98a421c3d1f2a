//! Which effects meet.

use hexbench_core::streams::{Purpose, stream};
use hexbench_truth::mechanisms::{REGISTRY, Shows};
use rand::RngExt;

use super::trial::InteractionRecord;
use crate::TrialError;
use crate::harness::{Field, Protocol, Study};
use crate::journal::Identity;

/// Seed of the committed figures.
pub const SEED: u64 = 17;
/// Triples in the committed figures.
pub const TRIPLES: usize = 60;
/// Sizes as multiples of the usual one.
const SIZES: [f64; 2] = [1.0, 10.0];

/// Sets of effects, each at every size.
#[derive(Debug, Clone, PartialEq)]
pub struct InteractionsProtocol {
    /// Decides everything that is drawn.
    pub seed: u64,
    /// Ids of the effects of each set.
    pub sets: Vec<Vec<&'static str>>,
}

impl InteractionsProtocol {
    /// Every effect alone, every pair, and this many triples.
    pub fn new(seed: u64, triples: usize) -> Self {
        let all = effects();
        let pairs = all.iter().enumerate().flat_map(|(i, a)| all[i + 1..].iter().map(move |b| vec![*a, *b]));
        let alone = all.iter().map(|a| vec![*a]);
        let mut drawn: Vec<Vec<&'static str>> = Vec::new();
        let mut numbers = 0..;
        while drawn.len() < triples {
            let next = numbers.next().map(|n| triple(&all, seed, n)).filter(|t| !drawn.contains(t));
            drawn.extend(next);
        }
        Self { seed, sets: alone.chain(pairs).chain(drawn).collect() }
    }
}

/// Ids of the effects that deflections show.
fn effects() -> Vec<&'static str> {
    REGISTRY.iter().filter(|e| e.shows == Shows::Deflection).map(|e| e.id).collect()
}

/// Three different effects in the order of the catalogue.
fn triple(all: &[&'static str], seed: u64, number: u64) -> Vec<&'static str> {
    let mut rng = stream(seed, Purpose::InteractionTriple, [number]);
    let mut left: Vec<usize> = (0..all.len()).collect();
    let mut chosen: Vec<usize> = (0..3).map(|_| left.swap_remove(rng.random_range(0..left.len()))).collect();
    chosen.sort_unstable();
    chosen.into_iter().map(|k| all[k]).collect()
}

/// A column of the table of trials.
type Column = Field<InteractionRecord>;

impl Protocol for InteractionsProtocol {
    /// Ids of the effects, and their size.
    type Job = (Vec<&'static str>, f64);
    type Record = InteractionRecord;
    type Error = TrialError;

    fn identity(&self) -> Identity {
        let sets: Vec<String> = self.sets.iter().map(|set| set.join(" + ")).collect();
        Identity::new(
            "interactions",
            "interactions-trials/1",
            [("seed", self.seed.to_string()), ("sets", sets.join(", "))],
        )
    }

    fn jobs(&self) -> Vec<Self::Job> {
        self.sets.iter().flat_map(|set| SIZES.map(|size| (set.clone(), size))).collect()
    }

    fn trial(&self, (set, size): &Self::Job) -> Result<InteractionRecord, TrialError> {
        InteractionRecord::of(set, *size, self.seed)
    }

    fn name(&self, (set, size): &Self::Job) -> String {
        format!("{} x{size}", set.join(" + "))
    }

    fn fields(&self) -> Vec<Column> {
        vec![
            Column::number("size", "multiple of the usual size", |r| r.size),
            Column::number("stiffness_error", "largest relative error of a leg stiffness", |r| {
                r.stiffness.error
            }),
            Column::number("stiffness_bound", "what it may be", |r| r.stiffness.bound),
            Column::number("parameter_error", "relative error of the parameter closest to its bound", |r| {
                r.parameter.error
            }),
            Column::number("parameter_bound", "what it may be", |r| r.parameter.bound),
            Column::text("parameter", "its name", |r| r.name.clone()),
            Column::number("open", "numbers that the data leave open", |r| r.open as f64),
            Column::number("resting", "readings in which a leg rests within its play", |r| r.resting as f64),
        ]
    }
}

/// What all sets gave.
pub type Interactions = Study<InteractionsProtocol>;

impl Interactions {
    /// Answers with a number beyond its bound.
    pub fn broken(&self) -> impl Iterator<Item = &InteractionRecord> {
        self.records.iter().filter(|r| !r.holds())
    }
}
