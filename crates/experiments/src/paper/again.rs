//! The richer plan with other poses and other noise: is the missing effect named again?

use hexbench_core::streams::{Purpose, derived_seed};
use hexbench_model::inference::verdict::Verdict;

use super::bench::PaperMachine;
use super::error::PaperError;
use super::experiment::Experiment;
use super::missing::on_the_richer_plan;
use super::suspects::{skew_support, support_motion};
use crate::harness::{Field, Protocol};
use crate::journal::Identity;

/// Other noise under which the richer plan is tried again.
const OTHER_SEEDS: u64 = 12;

/// Verdict, and what was named.
pub type NamedVerdict = (Verdict, Vec<String>);

/// The diagnosis of a support that gives, over and over.
#[derive(Debug, Clone, Copy)]
pub struct Again {
    /// Seed of the study.
    pub seed: u64,
    /// How far the support gives along X, Y and Z under the load of the paper, m.
    pub support_motion: [f64; 3],
}

impl Again {
    /// Of the study with this seed: the support gives as far as the errors of the paper ask for.
    ///
    /// # Errors
    /// [`PaperError`].
    pub fn of(seed: u64) -> Result<Self, PaperError> {
        let bench = PaperMachine::new(seed);
        Self::after(&bench, &Experiment::run(&bench, &bench.world(Vec::new()))?)
    }

    /// After the experiment in which springs are all there is.
    pub(super) fn after(bench: &PaperMachine, springs: &Experiment) -> Result<Self, PaperError> {
        Ok(Self { seed: bench.seed, support_motion: support_motion(bench, &springs.paper.expected)? })
    }
}

impl Protocol for Again {
    /// Number of the noise.
    type Job = u64;
    type Record = NamedVerdict;
    type Error = PaperError;

    fn identity(&self) -> Identity {
        let motion = self.support_motion.map(|x| x.to_string()).join(", ");
        Identity::new(
            "paper",
            "paper-trials/2",
            [("seed", self.seed.to_string()), ("support_motion", motion)],
        )
    }

    fn jobs(&self) -> Vec<u64> {
        (1..=OTHER_SEEDS).collect()
    }

    fn trial(&self, number: &u64) -> Result<NamedVerdict, PaperError> {
        let bench = PaperMachine::new(derived_seed(self.seed, Purpose::PaperAgain, [*number]));
        let found = on_the_richer_plan(&bench, &bench.world(vec![skew_support(self.support_motion)]))?;
        Ok((found.verdict, found.added))
    }

    fn name(&self, number: &u64) -> String {
        format!("other noise {number}")
    }

    fn fields(&self) -> Vec<Field<NamedVerdict>> {
        vec![
            Field::text("verdict", "what the diagnosis said", |(verdict, _): &NamedVerdict| {
                format!("{verdict:?}").to_lowercase()
            }),
            Field::text("named", "effects named", |(_, named): &NamedVerdict| named.join("+")),
        ]
    }

    fn trials_of_a_shard(&self) -> u64 {
        1
    }
}
