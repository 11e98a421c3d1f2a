//! One simulated bench with a hidden effect, on which further readings can be taken.

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Dataset, Hexapod, Observation};
use hexbench_truth::campaign::{PlanRow, SimulatedCampaign, Yardstick, machines, measure};
use hexbench_truth::metrology::{InstrumentFrames, InstrumentNoise};
use hexbench_truth::{TruthError, World, mechanisms};
use rand_pcg::Pcg64;

use super::ConfusedPair;

/// A machine with an effect, and what was measured of it.
#[derive(Debug)]
pub struct MeasuredMachine {
    /// The machine as its file describes it.
    pub hexapod: Hexapod,
    /// Measurements by the confusing plan.
    pub measurements: Dataset,
    campaign: SimulatedCampaign,
}

impl MeasuredMachine {
    /// A machine of a family with an effect of such a distance, measured by the confusing plan; everything that is drawn comes
    /// from the seed.
    ///
    /// # Errors
    /// [`TruthError::NotVisible`] when no sensible size of the effect reaches the distance; else as [`World::reading`].
    pub fn draw(
        confusion: &ConfusedPair,
        effect: &str,
        family: &str,
        distance: f64,
        seed: u64,
    ) -> Result<Self, TruthError> {
        let of = |purpose| stream(seed, purpose, []);
        let (mut of_machine, mut of_plan) = (of(Purpose::ConfusionMachine), of(Purpose::ConfusionPlan));
        let (mut of_effect, mut of_noise) = (of(Purpose::ConfusionEffect), of(Purpose::ConfusionNoise));
        let noise = InstrumentNoise::default();
        let mut hexapod = machines::draw(family, &mut of_machine);
        hexapod.metrology = Some(noise.metrology());
        let stiffness = machines::leg_stiffness(family, &mut of_machine);
        let scheme = confusion.scheme(&hexapod);
        let rows = scheme.draw(&mut of_plan);
        let bare = SimulatedCampaign {
            world: World::new(hexapod.clone(), &stiffness),
            frames: InstrumentFrames::default(),
            noise,
        };
        let usual = (mechanisms::effect(effect)?.draw)(&hexapod, &mut of_effect);
        let (scale, _) = Yardstick::new(&bare, &rows, scheme.measurand)?.scale_to(&*usual, distance)?;
        let mut world = bare.world.without_effects();
        world.mechanisms = vec![usual.scaled(scale)];
        let campaign = SimulatedCampaign { world, ..bare };
        let measurements = measure(&campaign, &rows, scheme.measurand, "measurements.csv", &mut of_noise)?;
        Ok(Self { hexapod, measurements, campaign })
    }

    /// The measurements with further readings, each taken as often as it is listed.
    pub(crate) fn with(&self, further: &[Observation], rng: &mut Pcg64) -> Result<Dataset, TruthError> {
        let known = self.measurements.observations.iter().map(|o| o.pose_id).max().unwrap_or(0);
        let number = |(k, o): (usize, &Observation)| {
            let repeat = (1..).zip(further[..=k].iter().filter(|p| *p == o)).last().map_or(1, |(n, _)| n);
            PlanRow::from(&Observation { repeat, ..*o })
        };
        let rows = (known + 1..).zip(further.iter().enumerate().map(number));
        let rows: Vec<PlanRow> = rows.map(|(pose_id, row)| PlanRow { pose_id, ..row }).collect();
        let taken = measure(&self.campaign, &rows, self.measurements.measurand, "further.csv", rng)?;
        let mut all = self.measurements.clone();
        let lines = all.observations.len() as u64;
        all.observations
            .extend(taken.observations.into_iter().map(|o| Observation { line: o.line + lines, ..o }));
        Ok(all)
    }
}
