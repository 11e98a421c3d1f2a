//! One trial in numbers.

use hexbench_truth::campaign::{SensorFault, SensorSet};
use serde::{Deserialize, Serialize};

use super::information::SHOWN;
use crate::robustness::RobustnessRecord;

/// How a campaign was read, and what was said about machine and data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SensorRecord {
    /// With what it was read.
    pub set: SensorSet,
    /// What was done and said; its fault is the way of reading, or what is wrong with the first sensor.
    pub of: RobustnessRecord,
    /// Chi-square that the fault adds to readings without noise; none without a fault.
    pub information: Option<f64>,
}

impl SensorRecord {
    /// True where the readings can show the fault.
    pub fn shows_fault(&self) -> bool {
        self.information.is_some_and(|chi2| chi2 > SHOWN)
    }

    /// What is wrong with the first sensor.
    pub fn fault(&self) -> Option<SensorFault> {
        SensorFault::named(self.of.fault)
    }

    /// True when the first finding calls the fault by its name.
    pub fn is_named(&self) -> bool {
        self.fault().is_some_and(|fault| self.of.findings.first().is_some_and(|kind| kind == fault.word()))
    }

    /// True when a sensor is said to be wrong.
    pub fn accuses_a_sensor(&self) -> bool {
        self.of.findings.iter().any(|kind| SensorFault::ALL.iter().any(|fault| fault.word() == kind))
    }

    /// True when something else than poses is read, and nothing is wrong with it.
    pub fn has_sound_sensors(&self) -> bool {
        self.fault().is_none()
            && !matches!(self.set, SensorSet::Poses | SensorSet::PosesWithGaps | SensorSet::Translations)
    }
}
