//! Running the protocol.

use hexbench_truth::campaign::{CaseKind, SimulatedCase};
use serde_json::Value;

use super::protocol::Job;
use super::{DISTANCE, RobustnessProtocol, RobustnessRecord};
use crate::harness::{self, Field, Study};
use crate::journal::Identity;
use crate::trial::TrialError;

/// All trials of a protocol.
pub type Robustness = Study<RobustnessProtocol>;

/// The campaign of one trial by its name, such as `outlier-20/single-0003`; none of a name that is no trial.
pub fn case(name: &str, seed: u64) -> Option<Result<SimulatedCase, TrialError>> {
    Job::parse(name).map(|job| drawn(job, seed))
}

/// The campaign of a trial; its truth says what the laboratory did.
pub(super) fn drawn(job: Job, seed: u64) -> Result<SimulatedCase, TrialError> {
    let distance = (job.kind == CaseKind::Single).then_some([DISTANCE; 2]);
    let mut case = SimulatedCase::draw_in(job.fault, job.kind, job.index, seed, distance)?;
    case.truth["laboratory"] = Value::from(job.fault.id);
    Ok(case)
}

impl harness::Protocol for RobustnessProtocol {
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

    fn trials(&self) -> u64 {
        self.all() as u64
    }

    fn trial(&self, number: u64) -> Result<RobustnessRecord, TrialError> {
        RobustnessRecord::of(self.job(number), self.seed)
    }

    fn name(&self, number: u64) -> String {
        self.job(number).name()
    }

    fn fields(&self) -> Vec<Field<RobustnessRecord>> {
        fields("fault", "what the laboratory does")
    }
}

/// Columns of the table of trials; `name` and `meaning` of the first one.
pub(crate) fn fields(name: &'static str, meaning: &'static str) -> Vec<Field<RobustnessRecord>> {
    let p = |name| (name, "1");
    vec![
        Field::text(name, meaning, |r: &RobustnessRecord| r.fault),
        Field::text("hidden", "hidden effect", |r: &RobustnessRecord| r.answer.hidden_words()),
        Field::text("family", "family of the machine", |r: &RobustnessRecord| r.answer.family),
        Field::text("plan", "plan of the measurements", |r: &RobustnessRecord| r.answer.plan.name()),
        Field::text("verdict", "the verdict", |r: &RobustnessRecord| r.answer.verdict.word()),
        Field::text("added", "effects named", |r: &RobustnessRecord| r.answer.added.join("+")),
        Field::text("findings", "kinds of the findings", |r: &RobustnessRecord| r.findings.join("+")),
        Field::text("outcome", "right, honest or wrong about the machine", |r: &RobustnessRecord| {
            r.outcome().word()
        }),
        Field::number(
            p("is_right"),
            "clean machine called so, hidden effect named first",
            |r: &RobustnessRecord| f64::from(u8::from(r.is_right())),
        ),
        Field::number(
            p("outside"),
            "probability of something outside the catalogue",
            |r: &RobustnessRecord| r.answer.outside,
        ),
        Field::number(
            p("stiffness_covered"),
            "share of the stiffnesses within 1.96 std",
            |r: &RobustnessRecord| r.stiffness_coverage().rate(),
        ),
        Field::number(
            p("holdout_springs"),
            "held-out chi-square per number, springs",
            |r: &RobustnessRecord| r.answer.holdout[0],
        ),
        Field::number(p("holdout_final"), "the same of the final model", |r: &RobustnessRecord| {
            r.answer.holdout[1]
        }),
    ]
}
