//! The frozen protocol of the first half: ways of reading, and sensors that are wrong.

use hexbench_truth::campaign::{CaseKind, SensorFault, SensorReadings, SensorSet, SimulatedCase};

use super::SensorRecord;
use super::information::information;
use crate::harness::{self, Field, Study};
use crate::journal::Identity;
use crate::robustness::{RobustnessRecord, distances, fields};
use crate::trial::{TrialError, clean_or_single};

/// Seed of the committed figures.
pub const SEED: u64 = 5_519;
/// Campaigns of each way of reading.
pub const TRIALS: u32 = 100;
/// Campaigns of each fault for one of a way of reading: some of a hundred show no sensor beside its place, whoever looks.
pub(super) const OF_A_FAULT: usize = 2;
/// Ways of reading in which a sensor can be wrong.
const FAULTY: [SensorSet; 4] =
    [SensorSet::SixGauges, SensorSet::ThreeGauges, SensorSet::BallAndGauges, SensorSet::ThreeBalls];

/// What is run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SensorProtocol {
    /// Decides everything that is drawn.
    pub seed: u64,
    /// Campaigns of each way of reading, and half of those of each fault: on a clean machine and with one effect in turn.
    pub trials: usize,
}

impl Default for SensorProtocol {
    fn default() -> Self {
        Self { seed: SEED, trials: TRIALS as usize }
    }
}

/// A campaign: how it is read, and what is wrong with a sensor.
#[derive(Debug, Clone, Copy)]
pub struct SensorJob {
    set: SensorSet,
    fault: Option<SensorFault>,
    kind: CaseKind,
    index: usize,
}

impl SensorProtocol {
    /// The campaign of one trial by its name, such as `six-gauges/six-gauges-clean-0003`, as its files are written; none of a name that
    /// is no trial.
    pub fn case(&self, name: &str) -> Option<Result<SimulatedCase, TrialError>> {
        let jobs = harness::Protocol::jobs(self);
        jobs.into_iter().find(|job| job.name() == name).map(|job| job.case(self.seed))
    }
}

impl SensorJob {
    /// What is read, or what is wrong with it.
    fn group(&self) -> &'static str {
        self.fault.map_or(self.set.word(), SensorFault::word)
    }

    fn name(&self) -> String {
        format!("{}/{}-{}-{:04}", self.group(), self.set.word(), self.kind.name(), self.index)
    }

    fn readings(&self) -> SensorReadings {
        SensorReadings { set: self.set, fault: self.fault, is_noisy: true }
    }

    /// The campaign in full poses.
    fn sampled(&self, seed: u64) -> Result<SimulatedCase, TrialError> {
        Ok(SimulatedCase::draw(self.kind, self.index, seed, distances(self.kind))?)
    }

    fn case(&self, seed: u64) -> Result<SimulatedCase, TrialError> {
        let mut case = self.sampled(seed)?;
        case.read_with(self.readings())?;
        Ok(case)
    }

    fn run(&self, seed: u64) -> Result<SensorRecord, TrialError> {
        let of = RobustnessRecord::of_case(self.group(), self.index, &self.case(seed)?)?;
        let shown = || information(self.sampled(seed)?, self.readings());
        Ok(SensorRecord { set: self.set, of, information: self.fault.map(|_| shown()).transpose()? })
    }
}

impl harness::Protocol for SensorProtocol {
    type Job = SensorJob;
    type Record = SensorRecord;
    type Error = TrialError;

    fn identity(&self) -> Identity {
        let settings = [("trials", self.trials.to_string()), ("seed", self.seed.to_string())];
        Identity::new("sensors", "sensor-trials/3", settings)
    }

    /// All ways of reading with sound sensors, then all faults; a way in turn where a sensor is wrong.
    fn jobs(&self) -> Vec<SensorJob> {
        let of = |set: Option<SensorSet>, fault, campaigns: usize| {
            (0..campaigns).map(clean_or_single).map(move |(kind, index)| {
                let set = set.unwrap_or(FAULTY[index % FAULTY.len()]);
                SensorJob { set, fault, kind, index }
            })
        };
        let sound = SensorSet::ALL.into_iter().flat_map(|set| of(Some(set), None, self.trials));
        let faulty = SensorFault::ALL.into_iter();
        sound.chain(faulty.flat_map(|fault| of(None, Some(fault), OF_A_FAULT * self.trials))).collect()
    }

    fn trial(&self, job: &SensorJob) -> Result<SensorRecord, TrialError> {
        job.run(self.seed)
    }

    fn name(&self, job: &SensorJob) -> String {
        job.name()
    }

    fn fields(&self) -> Vec<Field<SensorRecord>> {
        let all = fields("read", "what is read, or what is wrong with the first sensor");
        let information = Field::number(
            "information",
            "chi-square that the fault adds to readings without noise",
            |r: &SensorRecord| r.information,
        );
        all.into_iter().map(|field| field.of(|r: &SensorRecord| &r.of)).chain([information]).collect()
    }
}

/// All trials of a protocol.
pub type SensorStudy = Study<SensorProtocol>;

impl SensorStudy {
    /// The records of a way of reading, or of a fault.
    pub fn of_group(&self, group: &str) -> Vec<&SensorRecord> {
        self.records.iter().filter(|r| r.of.fault == group).collect()
    }
}
