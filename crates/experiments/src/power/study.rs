//! Everything about one plan: computed, and simulated where asked for.

use hexbench_core::statistics::Proportion;
use hexbench_design::DesignError;
use hexbench_design::power::PowerStudy;
use hexbench_model::error::ModelError;
use hexbench_truth::TruthError;
use hexbench_truth::scene::RowError;
use serde::Serialize;

use super::simulate::Simulated;

/// How much is simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Simulation {
    /// Campaigns of every effect and size, and without effects.
    pub campaigns: usize,
    /// True when the whole diagnosis is asked too.
    pub diagnoses: bool,
}

/// Power of one plan.
#[derive(Debug, Serialize)]
pub struct Power {
    /// `power/1`.
    pub format: &'static str,
    /// As computed.
    #[serde(flatten)]
    pub study: PowerStudy,
    /// How much was simulated.
    pub simulation: Simulation,
    /// What was simulated, for every effect.
    pub checks: Vec<PowerCheck>,
}

/// Simulation of one effect.
#[derive(Debug, Clone, Default, Serialize)]
pub struct PowerCheck {
    /// Campaigns without effects in which its test saw something.
    pub false_alarms: Option<Proportion>,
    /// At the usual size.
    pub usual: Option<Simulated>,
    /// At the size that is seen with the wanted power.
    pub when_seen: Option<Simulated>,
    /// Why it was not simulated.
    pub why_not: Option<String>,
}

/// Why a plan could not be studied.
#[derive(Debug, thiserror::Error)]
pub enum PowerError {
    /// By the model.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// In the simulated world.
    #[error("the plan cannot be simulated: {0}")]
    Truth(#[from] TruthError),
    /// A row of a scene.
    #[error(transparent)]
    Row(#[from] RowError),
    /// Nothing states the noise.
    #[error("neither the rows nor the machine of the plan state how well readings are taken")]
    NoNoise,
    /// Simulated readings without noise.
    #[error("a simulated campaign cannot be fitted: {0}")]
    Model(#[from] ModelError),
    /// A simulated campaign.
    #[error("a simulated campaign cannot be fitted: {0}")]
    Campaign(String),
}
