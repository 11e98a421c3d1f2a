//! What was hidden in a case: `truth.json`.

use hexbench_truth::campaign::SimulatedCase;
use hexbench_truth::laboratory::{CAREFUL, FaultEntry};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::challenge::CasePortion;
use crate::challenge::stored::Stored;

/// What was hidden in a case, and how it was made.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Truth {
    /// `challenge-truth/1`.
    pub format: String,
    /// Id of the case.
    pub id: String,
    /// Group of the suite.
    pub group: String,
    /// Kind of campaign.
    pub kind: String,
    /// Ids of the hidden effects; those outside the catalogue begin with `out:`.
    pub effects: Vec<String>,
    /// Stiffness of each leg, N/um.
    #[serde(rename = "leg_stiffness_N_per_um")]
    pub leg_stiffness_n_per_um: [f64; 6],
    /// Standard deviation of one reading.
    pub noise: SealedNoise,
    /// Length of the signature of all effects in standard deviations of the noise, beside six springs.
    pub distance: f64,
    /// Family of the machine.
    pub machine: String,
    /// Make of the plan.
    pub plan: String,
    /// What the laboratory does to the data; none of a careful one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub laboratory: Option<String>,
    /// Seed of the case.
    pub seed: u64,
    /// Numbers of the effects as the simulated world names them, SI.
    pub parameters: Map<String, Value>,
}

/// Standard deviation of one reading.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SealedNoise {
    /// Of each translation, um.
    pub translation_um: f64,
    /// Of each rotation, urad.
    pub rotation_urad: f64,
}

impl Stored for Truth {
    const FORMAT: &'static str = "challenge-truth/1";

    fn format(&self) -> &str {
        &self.format
    }
}

impl SealedNoise {
    /// Standard deviations of the six numbers, m and rad.
    pub fn sigma(self) -> [f64; 6] {
        let (t, r) = (self.translation_um * 1e-6, self.rotation_urad * 1e-6);
        [t, t, t, r, r, r]
    }
}

impl Truth {
    pub(crate) fn of(id: &str, portion: &CasePortion, case: &SimulatedCase, laboratory: &FaultEntry) -> Self {
        let spec = &case.spec;
        Self {
            format: Self::FORMAT.to_owned(),
            id: id.to_owned(),
            group: portion.group.clone(),
            kind: spec.kind.name().to_owned(),
            effects: spec.hidden_effects().into_iter().map(str::to_owned).collect(),
            leg_stiffness_n_per_um: case.campaign.world.leg_stiffness_n_per_um(),
            noise: SealedNoise {
                translation_um: spec.noise.sigma_translation * 1e6,
                rotation_urad: spec.noise.sigma_rotation * 1e6,
            },
            distance: case.truth["distance"].as_f64().unwrap_or(0.0),
            machine: spec.family.to_owned(),
            plan: spec.plan.name().to_owned(),
            laboratory: (laboratory.id != CAREFUL.id).then(|| laboratory.id.to_owned()),
            seed: spec.seed,
            parameters: case.truth["parameters"].as_object().cloned().unwrap_or_default(),
        }
    }
}
