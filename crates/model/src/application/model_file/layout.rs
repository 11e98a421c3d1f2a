//! `model/1`: the file as written. Numbers marked `si` are the model; the others are for people and are checked
//! against them.

use std::collections::BTreeMap;

use hexbench_core::Tolerances;
use hexbench_core::files::text_hash;
use hexbench_core::parser_words::of_toml;
use serde::{Deserialize, Serialize};

use super::{DataOrigin, ModelFileError};
use crate::application::reach::Reach;

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    pub(super) format: String,
    pub(super) program: String,
    pub(super) estimator: String,
    pub(super) mode: String,
    pub(super) settled: bool,
    pub(super) chi2: f64,
    pub(super) degrees_of_freedom: f64,
    pub(super) data: DataOrigin,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) reach: Option<Reach>,
    pub(super) noise: NoiseTable,
    pub(super) hexapod: HexapodTable,
    #[serde(rename = "leg")]
    pub(super) legs: Vec<LegTable>,
    #[serde(rename = "term", default, skip_serializing_if = "Vec::is_empty")]
    pub(super) terms: Vec<TermTable>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) frames: Option<Frames>,
    pub(super) covariance: Covariance,
    /// SHA-256 of all the rest, see [`File::digest`].
    #[serde(default, skip_serializing_if = "Seal::is_absent")]
    pub(super) seal: Seal,
}

impl File {
    pub(super) fn of(text: &str) -> Result<Self, ModelFileError> {
        toml::from_str(text).map_err(|wrong| {
            let is_machine = text.lines().any(|line| line.trim() == "[geometry]");
            if is_machine { ModelFileError::Machine } else { ModelFileError::Toml(of_toml(text, &wrong)) }
        })
    }

    /// SHA-256 of the file as `fit` writes it, without the seal: comments, blanks and the order of keys do not matter, every number does.
    pub(super) fn digest(&self) -> Result<String, toml::ser::Error> {
        let unsealed = Self { seal: Seal::default(), ..self.clone() };
        Ok(text_hash(&toml::to_string(&unsealed)?))
    }
}

/// What shows that nobody changed the file by hand.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Seal {
    pub(super) sha256: String,
}

impl Seal {
    fn is_absent(&self) -> bool {
        self.sha256.is_empty()
    }
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct NoiseTable {
    pub(super) translation_m: f64,
    pub(super) rotation_rad: f64,
    pub(super) source: String,
    /// Absent when the level is stated and not estimated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) degrees_of_freedom: Option<f64>,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct HexapodTable {
    pub(super) name: String,
    pub(super) base_joints_m: Vec<[f64; 3]>,
    pub(super) platform_joints_m: Vec<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) sigma_translation_m: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) sigma_rotation_rad: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) nominal_stiffness_n_per_m: Option<[f64; 6]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) stroke_m: Option<[f64; 2]>,
    /// Pairs of legs from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) brackets: Option<Vec<[usize; 2]>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) mounting_plane_z_m: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) payload_centre_m: Option<[f64; 3]>,
    /// Absent when they are the usual ones.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) tolerances: Option<Tolerances>,
    /// Absent when it is the usual one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) angles: Option<String>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) sensors: Vec<SensorTable>,
}

/// A sensor, SI.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SensorTable {
    pub(super) name: String,
    pub(super) kind: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) point_m: Option<[f64; 3]>,
    /// Direction of a distance, axis of an inclination.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) direction: Option<[f64; 3]>,
    /// From one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) leg: Option<usize>,
    /// What it shows over what it should; absent where that is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) gain: Option<f64>,
    /// Of each of its numbers, m or rad.
    pub(super) sigma: Vec<f64>,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LegTable {
    #[serde(rename = "stiffness_N_per_um", default, skip_serializing_if = "Option::is_none")]
    pub(super) stiffness: Option<f64>,
    #[serde(rename = "standard_error_N_per_um", default, skip_serializing_if = "Option::is_none")]
    pub(super) standard_error: Option<f64>,
    #[serde(rename = "compliance_si")]
    pub(super) compliance: f64,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TermTable {
    pub(super) id: String,
    /// `ideal`, `rich`, or the word of another version of the term.
    pub(super) form: String,
    /// The term's own file when it is a user's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) definition: Option<String>,
    /// Absent when the term has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) shape: Option<ParameterTable>,
    /// By name.
    pub(super) parameters: BTreeMap<String, ParameterTable>,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ParameterTable {
    pub(super) value: f64,
    pub(super) standard_error: f64,
    pub(super) unit: String,
    pub(super) determined: bool,
    pub(super) si: f64,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Frames {
    pub(super) metrology: Frame,
    pub(super) target: Frame,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Frame {
    pub(super) translation_m: [f64; 3],
    /// `[i, j, k, w]`.
    pub(super) quaternion: [f64; 4],
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Covariance {
    /// Names of rows and columns; a shape enters by its logarithm, everything in SI.
    pub(super) order: Vec<String>,
    pub(super) matrix: Vec<Vec<f64>>,
}
