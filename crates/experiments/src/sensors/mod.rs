//! What is said of campaigns that are read with gauges, balls, levels or scales, and of sensors that are not what the file says.
//!
//! Machines, plans and effects are those of the calibration; each campaign is read in every way ([`SensorSet`]), by the exact finite
//! displacement of the points between the two states. Beside them campaigns whose first sensor is wrong ([`SensorFault`]).

mod document;

use hexbench_core::statistics::Proportion;
use hexbench_truth::campaign::{CaseKind, SensorFault, SensorSet, SimulatedCase};

pub use document::{headlines, page, table};

use crate::calibration::CalibrationRecord;
use crate::harness::{self, Field, Gathered};
use crate::journal::Identity;
use crate::robustness::{RobustnessRecord, fields};
use crate::trial::{Trial, TrialError, kinds};

/// Seed of the committed figures.
pub const SEED: u64 = 5_519;
/// Campaigns of each way of reading, and of each fault.
pub const TRIALS: u32 = 60;
/// Distance of the hidden effect, as six pose numbers would show it.
pub const DISTANCE: f64 = 30.0;
/// Ways of reading in which a sensor can be wrong.
const FAULTY: [SensorSet; 4] =
    [SensorSet::SixGauges, SensorSet::ThreeGauges, SensorSet::BallAndGauges, SensorSet::ThreeBalls];

/// What is run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SensorProtocol {
    /// Decides everything that is drawn.
    pub seed: u64,
    /// Campaigns of each way of reading, and of each fault: on a clean machine and with one effect in turn.
    pub trials: usize,
}

impl Default for SensorProtocol {
    fn default() -> Self {
        Self { seed: SEED, trials: TRIALS as usize }
    }
}

/// A campaign: how it is read, and what is wrong with a sensor.
#[derive(Debug, Clone, Copy)]
struct Job {
    set: SensorSet,
    fault: Option<SensorFault>,
    kind: CaseKind,
    index: usize,
}

impl SensorProtocol {
    fn groups() -> usize {
        SensorSet::ALL.len() + SensorFault::ALL.len()
    }

    fn job(&self, number: u64) -> Job {
        let number = usize::try_from(number).unwrap_or(usize::MAX);
        let (group, campaign) = (number / self.trials, number % self.trials);
        let kind = if campaign.is_multiple_of(2) { CaseKind::Clean } else { CaseKind::Single };
        let index = campaign / 2;
        let Some(&set) = SensorSet::ALL.get(group) else {
            let fault = SensorFault::ALL.get(group - SensorSet::ALL.len()).copied();
            return Job { set: FAULTY[index % FAULTY.len()], fault, kind, index };
        };
        Job { set, fault: None, kind, index }
    }
}

impl Job {
    /// What is read, or what is wrong with it.
    fn group(&self) -> &'static str {
        self.fault.map_or(self.set.word(), SensorFault::word)
    }

    fn name(&self) -> String {
        format!("{}/{}-{}-{:04}", self.group(), self.set.word(), self.kind.name(), self.index)
    }

    fn run(&self, seed: u64) -> Result<RobustnessRecord, TrialError> {
        let distance = (self.kind == CaseKind::Single).then_some([DISTANCE; 2]);
        let mut case = SimulatedCase::draw(self.kind, self.index, seed, distance)?;
        case.read_with(self.set, self.fault)?;
        let trial = Trial::run(&case)?;
        Ok(RobustnessRecord {
            fault: self.group(),
            index: self.index as u64,
            findings: kinds(&trial.study.diagnosis),
            answer: CalibrationRecord::of_trial(&case, &trial),
        })
    }
}

impl harness::Protocol for SensorProtocol {
    type Record = RobustnessRecord;
    type Error = TrialError;

    fn identity(&self) -> Identity {
        let settings = [("trials", self.trials.to_string()), ("seed", self.seed.to_string())];
        Identity::new("sensors", "sensor-trials/1", settings)
    }

    fn trials(&self) -> u64 {
        (Self::groups() * self.trials) as u64
    }

    fn trial(&self, number: u64) -> Result<RobustnessRecord, TrialError> {
        self.job(number).run(self.seed)
    }

    fn name(&self, number: u64) -> String {
        self.job(number).name()
    }

    fn fields(&self) -> Vec<Field<RobustnessRecord>> {
        fields("read", "what is read, or what is wrong with the first sensor")
    }
}

/// All trials of a protocol.
#[derive(Debug)]
pub struct SensorStudy {
    /// What was run.
    pub protocol: SensorProtocol,
    /// Trials with an answer.
    pub records: Vec<RobustnessRecord>,
    /// Trials without one: name and reason.
    pub failures: Vec<(String, String)>,
}

impl SensorStudy {
    /// What the trials of a protocol gave.
    pub fn of(protocol: SensorProtocol, gathered: Gathered<RobustnessRecord>) -> Self {
        let (records, failures) = gathered.split(&protocol);
        Self { protocol, records, failures }
    }

    /// The records of a way of reading, or of a fault.
    pub fn of_group(&self, group: &str) -> Vec<&RobustnessRecord> {
        self.records.iter().filter(|r| r.fault == group).collect()
    }
}

/// Share of faults of a kind that are called by their name first.
pub fn named(records: &[&RobustnessRecord], fault: SensorFault) -> Proportion {
    Proportion::count(records.iter(), |r| r.findings.first().is_some_and(|kind| kind == fault.word()))
}
