//! Running the protocol.

use hexbench_truth::campaign::{Case, Kind};

use super::{DISTANCES, Protocol, Record};
use crate::harness::{self, Field, Gathered};
use crate::journal::Identity;
use crate::trial::TrialError;

/// All trials of a protocol.
#[derive(Debug)]
pub struct Calibration {
    /// What was run.
    pub protocol: Protocol,
    /// Trials with an answer, in the order of the protocol.
    pub records: Vec<Record>,
    /// Trials without one: name and reason.
    pub failures: Vec<(String, String)>,
}

impl Calibration {
    /// What the trials of a protocol gave.
    pub fn of(protocol: Protocol, gathered: Gathered<Record>) -> Self {
        let name = |n| harness::Protocol::name(&protocol, n);
        let failures = gathered.failures().map(|(n, why)| (name(n), why.clone())).collect();
        Self { records: gathered.answers.into_iter().flatten().collect(), failures, protocol }
    }
}

/// The campaign of one trial.
///
/// # Errors
/// [`TrialError::Truth`] when the effect shows in no plan and machine tried.
pub fn case(kind: Kind, index: usize, seed: u64) -> Result<Case, TrialError> {
    Ok(Case::draw(kind, index, seed, Some(DISTANCES))?)
}

impl harness::Protocol for Protocol {
    type Record = Record;
    type Error = TrialError;

    fn identity(&self) -> Identity {
        let portions = self.portions.iter().map(|p| format!("{} {}", p.kind.name(), p.trials));
        let portions = portions.collect::<Vec<_>>().join(", ");
        let settings = [("portions", portions), ("seed", self.seed.to_string())];
        Identity::new("calibration", "calibration-trials/2", settings)
    }

    fn trials(&self) -> u64 {
        self.trials() as u64
    }

    fn trial(&self, number: u64) -> Result<Record, TrialError> {
        let (kind, index) = self.job(number);
        Record::of(&case(kind, index, self.seed)?)
    }

    fn name(&self, number: u64) -> String {
        let (kind, index) = self.job(number);
        format!("{}-{index:04}", kind.name())
    }

    fn fields(&self) -> Vec<Field<Record>> {
        let p = |name| (name, "1");
        vec![
            Field::text("hidden", "hidden effects", Record::hidden_words),
            Field::text("family", "family of the machine", |r: &Record| r.family),
            Field::text("plan", "plan of the measurements", |r: &Record| r.plan.name()),
            Field::number(p("distance"), "distance of the effects together", |r: &Record| r.total_distance),
            Field::text("answer", "effects named, or the verdict", Record::answer),
            Field::text("fate", "what became of the truth", |r: &Record| r.fate.word()),
            Field::number(p("confidence"), "probability of exactly the verdict", |r: &Record| r.confidence),
            Field::number(p("truth"), "probability of exactly the truth", |r: &Record| r.truth),
            Field::number(p("outside"), "probability of something outside the catalogue", |r: &Record| {
                r.outside
            }),
            Field::number(p("none"), "probability of no effect", |r: &Record| r.none),
            Field::number(p("holdout_springs"), "held-out chi-square per number, springs", |r: &Record| {
                r.holdout[0]
            }),
            Field::number(p("holdout_final"), "the same of the final model", |r: &Record| r.holdout[1]),
        ]
    }
}
