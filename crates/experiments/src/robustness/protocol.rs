//! The protocol: every fault meets the same campaigns.

use hexbench_truth::campaign::{CaseKind, SimulatedCase};
use hexbench_truth::laboratory::{self, FaultEntry};
use serde_json::Value;

use super::RobustnessRecord;
use crate::harness::{self, Field, Study};
use crate::journal::Identity;
use crate::trial::{TrialError, clean_or_single, numbered};

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

/// All trials of a protocol.
pub type Robustness = Study<RobustnessProtocol>;

/// The campaign of one trial by its name, such as `outlier-20/single-0003`; none of a name that is no trial.
pub fn case(name: &str, seed: u64) -> Option<Result<SimulatedCase, TrialError>> {
    RobustnessJob::parse(name).map(|job| sampled(job, seed))
}

/// The campaign of a trial; its truth says what the laboratory did.
pub(super) fn sampled(job: RobustnessJob, seed: u64) -> Result<SimulatedCase, TrialError> {
    let mut case = SimulatedCase::draw_in(job.fault, job.kind, job.index, seed, distances(job.kind))?;
    case.truth["laboratory"] = Value::from(job.fault.id);
    Ok(case)
}

/// A column of the table of trials.
type Column = Field<RobustnessRecord>;

impl harness::Protocol for RobustnessProtocol {
    type Job = RobustnessJob;
    type Record = RobustnessRecord;
    type Error = TrialError;

    fn identity(&self) -> Identity {
        let settings = [
            ("faults", self.faults.join(", ")),
            ("trials", self.trials.to_string()),
            ("seed", self.seed.to_string()),
        ];
        Identity::new("robustness", "robustness-trials/1", settings)
    }

    /// Campaign after campaign, each in the hands of all laboratories.
    fn jobs(&self) -> Vec<RobustnessJob> {
        let faults: Vec<_> = self.faults.iter().filter_map(|id| laboratory::entry(id)).collect();
        let of_campaign = |campaign| {
            let (kind, index) = clean_or_single(campaign);
            faults.iter().map(move |&fault| RobustnessJob { fault, kind, index })
        };
        (0..self.trials).flat_map(of_campaign).collect()
    }

    fn trial(&self, job: &RobustnessJob) -> Result<RobustnessRecord, TrialError> {
        RobustnessRecord::of(*job, self.seed)
    }

    fn name(&self, job: &RobustnessJob) -> String {
        job.name()
    }

    fn fields(&self) -> Vec<Column> {
        fields("fault", "what the laboratory does")
    }
}

/// Columns of the table of trials; `name` and `meaning` of the first one.
pub(crate) fn fields(name: &'static str, meaning: &'static str) -> Vec<Field<RobustnessRecord>> {
    vec![
        Column::text(name, meaning, |r| r.fault),
        Column::text("hidden", "hidden effect", |r| r.answer.hidden_words()),
        Column::text("family", "family of the machine", |r| r.answer.family),
        Column::text("plan", "plan of the measurements", |r| r.answer.plan.name()),
        Column::text("verdict", "the verdict", |r| r.answer.verdict.word()),
        Column::text("added", "effects named", |r| r.answer.added.join("+")),
        Column::text("findings", "kinds of the findings", |r| r.findings.join("+")),
        Column::text("outcome", "right, honest or wrong about the machine", |r| r.outcome().word()),
        Column::flag(
            "is_right",
            "clean machine called so, hidden effect named first",
            RobustnessRecord::is_right,
        ),
        Column::number("outside", "probability of something outside the catalogue", |r| r.answer.outside),
        Column::number("stiffness_covered", "share of the stiffnesses within 1.96 std", |r| {
            r.stiffness_coverage().rate()
        }),
        Column::number("holdout_springs", "held-out chi-square per number, springs", |r| r.answer.holdout[0]),
        Column::number("holdout_final", "the same of the final model", |r| r.answer.holdout[1]),
    ]
}
