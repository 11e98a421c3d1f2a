//! Cases of a user's own scene: machine, plan, instrument and true springs from its folder, effects from there or from the suite, noise and
//! laboratory as the suite has them.

use std::path::Path;

use hexbench_core::Hexapod;
use hexbench_core::streams::{Purpose, derived_seed, stream};
use hexbench_truth::campaign::{SimulatedCampaign, Yardstick, resized};
use hexbench_truth::laboratory::{CAREFUL, FaultEntry};
use hexbench_truth::metrology::InstrumentNoise;
use hexbench_truth::scene::{Instrument, PartName, RowError, SceneLaboratory};
use hexbench_truth::{Mechanism, Scene, TruthError};
use rand::RngExt;
use serde_json::Map;

use super::sampled::{CaseEffects, chosen, laboratory_of};
use super::stored::Stored;
use super::{CasePortion, ChallengeError, SampledCase, SealedNoise, Truth};
use crate::keys::ReadingNoise;

/// Distance of an effect where neither scene nor suite says one.
const USUAL_DISTANCE: f64 = 22.0;

/// The `index`-th case of a group with scenes: they take turns; rows, surroundings and noise are drawn anew in each.
pub(super) fn sampled(
    id: String,
    portion: &CasePortion,
    index: usize,
    seed: u64,
) -> Result<SampledCase, ChallengeError> {
    let folder = &portion.scenes[index % portion.scenes.len()];
    let seed = derived_seed(seed, Purpose::ChallengeGroup, [index as u64]);
    let mut scene = Scene::read_with_seed(folder, Some(seed))?;
    let failed = |cause| ChallengeError::Case { group: portion.group.clone(), number: index + 1, cause };
    if let Some(stated) = portion.noise {
        read_with(&mut scene, stated);
    }
    if let Some(set) = chosen(portion, index) {
        let effects = CaseEffects { portion, set: set.clone(), seed, index };
        scene.mechanisms = sized(&scene, &effects).map_err(failed)?;
    }
    let laboratory = laboratory_of(portion, index);
    let truth = truth(&id, (portion, laboratory), &scene, folder).map_err(failed)?;
    let unread = |error: RowError| failed(error.cause);
    let mut training = SceneLaboratory::new(&scene, laboratory);
    let mut measurements = training.read(PartName::Training).map_err(unread)?;
    if let Some(most) = portion.repeats {
        measurements.observations.retain(|o| u64::try_from(o.repeat).is_ok_and(|n| n <= most));
    }
    let hexapod = Hexapod { name: id.clone(), metrology: training.stated(), ..scene.hexapod.clone() };
    // What is held out is the motion of the platform, also where sensors read.
    if matches!(scene.instrument, Instrument::Sensors(_)) {
        scene.instrument = Instrument::Numbers(noise(&scene));
    }
    let mut holdout = SceneLaboratory::new(&scene, laboratory);
    let measured = holdout.read(PartName::Holdout).map_err(unread)?;
    let true_readings = holdout.ideal(PartName::Holdout).map_err(unread)?;
    Ok(SampledCase { id, hexapod, measurements, measured, true_readings, truth })
}

/// Gives the instrument of a scene the noise of the suite.
fn read_with(scene: &mut Scene, stated: ReadingNoise) {
    scene.instrument = match &scene.instrument {
        Instrument::Numbers(own) => Instrument::Numbers(stated.of(*own)),
        other => other.clone().with_noise(stated.scale()),
    };
    if matches!(scene.instrument, Instrument::Sensors(_)) {
        let sensors = std::mem::take(&mut scene.hexapod.sensors);
        scene.hexapod.sensors = sensors.into_iter().map(|s| s.with_noise(stated.scale())).collect();
    }
    scene.hexapod.metrology = scene.instrument.metrology(scene.measurand()).ok().flatten();
}

/// What the instrument states of one reading; usual noise where it states none.
fn noise(scene: &Scene) -> InstrumentNoise {
    InstrumentNoise::stated_or_usual(scene.hexapod.metrology)
}

/// Effects that the suite names, in the plan of the scene.
fn sized(scene: &Scene, effects: &CaseEffects<'_>) -> Result<Vec<Box<dyn Mechanism>>, TruthError> {
    let mut rng = stream(effects.seed, Purpose::CaseEffectShapes, []);
    let (bare, plan) = (bare(scene), scene.plan());
    let yardstick = Yardstick::new(&bare, &plan.training, plan.measurand)?;
    let wanted = match effects.portion.distance {
        Some([low, high]) if low < high => rng.random_range(low.ln()..high.ln()).exp(),
        Some([low, _]) => low,
        None => USUAL_DISTANCE,
    };
    let one = |place| {
        let (made, factor) = effects.made(place, &scene.hexapod, &mut rng)?;
        match factor {
            Some(factor) => resized(&*made, Some(factor)),
            None => Ok(made.scaled(yardstick.scale_to(&*made, wanted)?.0)),
        }
    };
    (0..effects.set.len()).map(one).collect()
}

/// The machine without effects, and the instrument.
fn bare(scene: &Scene) -> SimulatedCampaign {
    SimulatedCampaign { world: scene.world().without_effects(), frames: scene.frames(), noise: noise(scene) }
}

fn truth(
    id: &str,
    (portion, laboratory): (&CasePortion, &FaultEntry),
    scene: &Scene,
    folder: &Path,
) -> Result<Truth, TruthError> {
    const N_PER_UM: f64 = 1e-6;
    let (bare, plan) = (bare(scene), scene.plan());
    let mut parameters = Map::new();
    for mechanism in &scene.mechanisms {
        parameters.extend(mechanism.parameters());
    }
    let distance = if scene.mechanisms.is_empty() {
        0.0
    } else {
        let all = scene.mechanisms.iter().map(|m| m.scaled(1.0)).collect();
        Yardstick::new(&bare, &plan.training, plan.measurand)?.distance(all)?
    };
    let name =
        folder.file_name().map_or_else(|| scene.name.clone(), |name| name.to_string_lossy().into_owned());
    Ok(Truth {
        format: Truth::FORMAT.to_owned(),
        id: id.to_owned(),
        group: portion.group.clone(),
        kind: "scene".to_owned(),
        effects: scene.hidden_effects().into_iter().map(str::to_owned).collect(),
        leg_stiffness_n_per_um: scene.leg_stiffness.map(|k| N_PER_UM * k),
        noise: SealedNoise {
            translation_um: bare.noise.sigma_translation * 1e6,
            rotation_urad: bare.noise.sigma_rotation * 1e6,
        },
        distance,
        machine: name,
        plan: "scene".to_owned(),
        laboratory: (laboratory.id != CAREFUL.id).then(|| laboratory.id.to_owned()),
        seed: scene.seed,
        parameters,
    })
}
