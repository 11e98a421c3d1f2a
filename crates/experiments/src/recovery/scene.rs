//! A campaign whose truth is known: a machine, a plan, hidden effects, and its readings without noise.

use std::sync::Arc;

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Dataset, Hexapod, Metrology, Observation, Vector6};
use hexbench_model::effects::term::Term;
use hexbench_model::terms::catalogue;
use hexbench_truth::campaign::{
    CaseKind, CaseSpec, PlanKind, PlanRow, SimulatedCampaign, SimulatedCase, machines,
};
use hexbench_truth::mechanisms::{REGISTRY, Shows, build};
use hexbench_truth::metrology::InstrumentNoise;
use hexbench_truth::{Situation, TruthError};
use rand::RngExt;
use serde_json::json;

use super::correspondence::{Equivalent, equivalent};

/// Machines and plans tried until an effect shows.
const ATTEMPTS: u64 = 24;
/// Distances to which effects are scaled: plain, clear, large.
const DISTANCES: [f64; 3] = [11.0, 22.0, 45.0];
/// Noise of the instrument as multiples of 0.5 um and 3 urad.
const NOISE_FACTORS: [f64; 3] = [0.4, 1.0, 2.5];
/// Plans of deflections.
const PLANS: [PlanKind; 5] =
    [PlanKind::Rich, PlanKind::OtherLoads, PlanKind::FewPoses, PlanKind::VerticalOnly, PlanKind::NoReference];

/// What is hidden in a campaign: one row of the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HiddenSubject {
    /// Name in tables.
    pub name: &'static str,
    /// Ids of the hidden effects.
    pub effects: &'static [&'static str],
    /// True for absolute poses.
    pub absolute: bool,
}

/// Springs alone, springs in absolute poses, all 42 numbers of the geometry, and every effect of the catalogue.
pub fn subjects() -> Vec<HiddenSubject> {
    let mut all = vec![
        HiddenSubject { name: "springs", effects: &[], absolute: false },
        HiddenSubject { name: "springs (absolute)", effects: &[], absolute: true },
        HiddenSubject {
            name: "geometry, 42 numbers",
            effects: &["joint-geometry", "leg-offset"],
            absolute: true,
        },
    ];
    let known = REGISTRY.iter().filter(|e| e.shows != Shows::Outside);
    all.extend(known.map(|e| HiddenSubject {
        name: e.id,
        effects: std::slice::from_ref(&e.id),
        absolute: e.shows == Shows::Absolute,
    }));
    all
}

impl HiddenSubject {
    /// The terms that stand for the hidden effects.
    pub fn terms(&self) -> Vec<Arc<dyn Term>> {
        let all = catalogue();
        self.effects.iter().filter_map(|id| all.iter().find(|t| t.info().id == *id).map(Arc::clone)).collect()
    }

    fn is_geometry(&self) -> bool {
        self.effects.contains(&"joint-geometry")
    }
}

/// A campaign with its truth.
pub struct RecoveryCampaign {
    /// World, instrument and truth.
    pub case: SimulatedCase,
}

impl RecoveryCampaign {
    /// The `index`-th campaign of a subject; `distance` as given, else one of three in turn. Effects that do not show in
    /// one machine and plan are tried in others.
    ///
    /// # Errors
    /// The last failure when no machine and plan will do.
    pub fn draw(
        subject: &HiddenSubject,
        index: usize,
        seed: u64,
        distance: Option<f64>,
    ) -> Result<Self, TruthError> {
        let attempt = |n| spec(subject, index, seed, n, distance).build();
        let case = (1..ATTEMPTS).fold(attempt(0), |made, n| made.or_else(|_| attempt(n)))?;
        Ok(Self { case })
    }

    /// The machine as drawn, with the noise of the instrument stated.
    pub fn hexapod(&self) -> &Hexapod {
        &self.case.hexapod
    }

    /// Noise of the instrument.
    pub fn noise(&self) -> InstrumentNoise {
        self.case.campaign.noise
    }

    /// Stiffness of the legs, N/m.
    pub fn leg_stiffness(&self) -> [f64; 6] {
        self.case.campaign.world.leg_compliance.map(f64::recip)
    }

    /// What the model should find for each hidden effect.
    pub fn equivalents(&self) -> Vec<(&'static str, Equivalent)> {
        let mechanisms = &self.case.campaign.world.mechanisms;
        let of = |(id, parameters)| Some((id, equivalent(id, &parameters, self.hexapod())?));
        mechanisms.iter().map(|m| (m.id(), m.parameters())).filter_map(of).collect()
    }

    /// The training part under loads scaled by a factor, as an ideal instrument reads it.
    ///
    /// # Errors
    /// As [`SimulatedCampaign::ideal`].
    pub fn ideal_under(&self, factor: f64) -> Result<Dataset, TruthError> {
        let mut plan = rows(&self.case.measurements);
        for Situation { wrench, reference, .. } in plan.iter_mut().map(|row| &mut row.situation) {
            for w in [wrench, reference] {
                w.force *= factor;
                w.moment *= factor;
            }
        }
        self.reread(&self.case.campaign, &plan)
    }

    /// The training part without noise of a world of exactly the model's physics: dry sliders are rigid until they give way.
    pub(crate) fn ideal_of_same_form(&self) -> Result<Dataset, TruthError> {
        let bare = &self.case.campaign;
        let mut world = bare.world.without_effects();
        for mechanism in &bare.world.mechanisms {
            let slider_force = mechanism.parameters().get("friction").cloned();
            world.mechanisms.push(match slider_force {
                Some(force) => build(mechanism.id(), json!({ "slider_force": force, "stick_ratio": null }))?,
                None => mechanism.scaled(1.0),
            });
        }
        let campaign = SimulatedCampaign { world, frames: bare.frames, noise: bare.noise };
        self.reread(&campaign, &rows(&self.case.measurements))
    }

    fn reread(&self, campaign: &SimulatedCampaign, plan: &[PlanRow]) -> Result<Dataset, TruthError> {
        let ideal = campaign.ideal(plan, self.case.measurements.measurand)?;
        let data = &self.case.measurements;
        let read = |((o, row), r): ((&Observation, &PlanRow), &Vector6)| Observation {
            wrench: row.situation.wrench,
            reference: row.situation.reference,
            measured: (*r).into(),
            ..*o
        };
        let observations = data.observations.iter().zip(plan).zip(&ideal).map(read).collect();
        Ok(Dataset { observations, ..data.clone() })
    }

    /// The machine with another stated noise; `None`: nothing stated.
    pub fn hexapod_stating(&self, metrology: Option<Metrology>) -> Hexapod {
        Hexapod { metrology, ..self.hexapod().clone() }
    }
}

fn spec(subject: &HiddenSubject, index: usize, seed: u64, attempt: u64, distance: Option<f64>) -> CaseSpec {
    let name = subject.name.bytes().fold(0_u64, |h, b| h.wrapping_mul(131).wrapping_add(u64::from(b)));
    let mut rng = stream(seed, Purpose::RecoveryCampaign, [name, attempt, index as u64]);
    let plan = match (subject.absolute, subject.effects.is_empty()) {
        (true, _) => PlanKind::Absolute,
        (false, true) if index % 4 == 3 => PlanKind::Paper,
        _ => PLANS[rng.random_range(0..PLANS.len())],
    };
    let usual = DISTANCES[index % DISTANCES.len()];
    let factor = NOISE_FACTORS[rng.random_range(0..NOISE_FACTORS.len())];
    let InstrumentNoise { sigma_translation, sigma_rotation, .. } = InstrumentNoise::default();
    CaseSpec {
        id: format!("{}-{index}", subject.name),
        kind: if subject.absolute { CaseKind::Absolute } else { CaseKind::Single },
        family: machines::FAMILIES[rng.random_range(0..machines::FAMILIES.len())],
        plan,
        effects: subject.effects.to_vec(),
        distance: (!subject.effects.is_empty() && !subject.is_geometry())
            .then_some(distance.unwrap_or(usual)),
        noise: InstrumentNoise {
            sigma_translation: factor * sigma_translation,
            sigma_rotation: factor * sigma_rotation,
            ..InstrumentNoise::default()
        },
        seed: u64::from(rng.random::<u32>()),
    }
}

/// The plan behind readings.
fn rows(data: &Dataset) -> Vec<PlanRow> {
    data.observations.iter().map(PlanRow::from).collect()
}
