//! The sealed part of a case, read for scoring.

use std::path::Path;

use hexbench_core::files::{read_hexapod, read_measurements};
use hexbench_core::{Hexapod, Measurand};

use crate::challenge::folder::{HEXAPOD, MEASURED, TRUE_READINGS, TRUTH};
use crate::challenge::stored::read_json;
use crate::challenge::{Challenge, ChallengeError, Truth};

/// What the answer to a case is compared with.
#[derive(Debug, Clone)]
pub struct AnswerKey {
    /// What was hidden.
    pub truth: Truth,
    /// What was read.
    pub measurand: Measurand,
    /// Held-out readings without noise, m and rad.
    pub true_readings: Vec<[f64; 6]>,
    /// Held-out readings as measured, m and rad.
    pub measured: Vec<[f64; 6]>,
    /// The machine as it is handed out.
    pub hexapod: Hexapod,
    /// Digest of the public files.
    pub case_sha256: String,
}

impl AnswerKey {
    pub(super) fn read(challenge: &Challenge, id: &str) -> Result<Self, ChallengeError> {
        let folder = challenge.sealed(id);
        let truth: Truth = read_json(&folder.join(TRUTH))?;
        let (measurand, true_readings) = readings(&folder.join(TRUE_READINGS))?;
        let (_, measured) = readings(&folder.join(MEASURED))?;
        let hexapod = read_hexapod(&challenge.case(id).join(HEXAPOD))?;
        Ok(Self {
            truth,
            measurand,
            true_readings,
            measured,
            hexapod,
            case_sha256: challenge.case_sha256(id),
        })
    }
}

fn readings(path: &Path) -> Result<(Measurand, Vec<[f64; 6]>), ChallengeError> {
    let dataset = read_measurements(path)?.dataset;
    Ok((dataset.measurand, dataset.observations.iter().map(|o| o.measured).collect()))
}
