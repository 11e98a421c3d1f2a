//! Cases of a user's own scene: machine, plan, instrument and true springs from its folder, effects from there or from the catalogue.

use std::path::Path;

use hexbench_core::Hexapod;
use hexbench_core::streams::{Purpose, derived_seed, stream};
use hexbench_truth::campaign::{SimulatedCampaign, SizeOf, Yardstick, sized_by};
use hexbench_truth::metrology::InstrumentNoise;
use hexbench_truth::scene::{Instrument, PartName, VirtualBench};
use hexbench_truth::{Mechanism, Scene, TruthError, mechanisms};
use rand::RngExt;
use serde_json::Map;

use super::drawn::sizing;
use super::stored::Stored;
use super::{CasePortion, ChallengeError, Drawn, SealedNoise, Truth};

/// Distance of an effect where neither scene nor suite says one.
const USUAL_DISTANCE: f64 = 22.0;

/// The `index`-th case of a group with scenes: they take turns; rows, surroundings and noise are drawn anew in each.
pub(super) fn drawn(
    id: String,
    portion: &CasePortion,
    index: usize,
    seed: u64,
) -> Result<Drawn, ChallengeError> {
    let folder = &portion.scenes[index % portion.scenes.len()];
    let seed = derived_seed(seed, Purpose::ChallengeGroup, [index as u64]);
    let mut scene = Scene::read_with_seed(folder, Some(seed))?;
    let failed = |cause| ChallengeError::Case { group: portion.group.clone(), number: index + 1, cause };
    if let Some(ids) = portion.effects.get(index % portion.effects.len().max(1)) {
        scene.mechanisms = match portion.sizes {
            None => sized(&scene, ids, portion.distance, seed),
            Some(sizes) => of_size(&scene, ids, &sizing(sizes, seed, index), seed),
        }
        .map_err(failed)?;
    }
    let truth = truth(&id, portion, &scene, folder).map_err(failed)?;
    let read = |scene: &Scene, name, noise_free| {
        VirtualBench::new(scene, noise_free).dataset(name).map_err(|error| failed(error.cause))
    };
    let mut measurements = read(&scene, PartName::Training, false)?;
    if let Some(most) = portion.repeats {
        measurements.observations.retain(|o| u64::try_from(o.repeat).is_ok_and(|n| n <= most));
    }
    let hexapod = Hexapod { name: id.clone(), ..scene.hexapod.clone() };
    // What is held out is the motion of the platform, also where sensors read.
    if matches!(scene.instrument, Instrument::Sensors(_)) {
        scene.instrument = Instrument::Numbers(noise(&scene));
    }
    let measured = read(&scene, PartName::Holdout, false)?;
    let true_readings = read(&scene, PartName::Holdout, true)?;
    Ok(Drawn { id, hexapod, measurements, measured, true_readings, truth })
}

/// What the instrument states of one reading; usual noise where it states none.
fn noise(scene: &Scene) -> InstrumentNoise {
    let usual = InstrumentNoise::default();
    scene.hexapod.metrology.map_or(usual, |stated| InstrumentNoise {
        sigma_translation: stated.sigma_translation,
        sigma_rotation: stated.sigma_rotation,
        ..usual
    })
}

/// Effects of the catalogue at a distance, in the plan of the scene.
fn sized(
    scene: &Scene,
    ids: &[&'static str],
    distance: Option<[f64; 2]>,
    seed: u64,
) -> Result<Vec<Box<dyn Mechanism>>, TruthError> {
    let mut rng = stream(seed, Purpose::CaseEffectShapes, []);
    let (bare, plan) = (bare(scene), scene.plan());
    let yardstick = Yardstick::new(&bare, &plan.training, plan.measurand)?;
    let wanted = match distance {
        Some([low, high]) if low < high => rng.random_range(low.ln()..high.ln()).exp(),
        Some([low, _]) => low,
        None => USUAL_DISTANCE,
    };
    let one = |id: &&'static str| {
        let usual = (mechanisms::effect(id)?.draw)(&scene.hexapod, &mut rng);
        Ok(usual.scaled(yardstick.scale_to(&*usual, wanted)?.0))
    };
    ids.iter().map(one).collect()
}

/// Effects of the catalogue in a size that is stated.
fn of_size(
    scene: &Scene,
    ids: &[&'static str],
    sizing: &SizeOf<'_>,
    seed: u64,
) -> Result<Vec<Box<dyn Mechanism>>, TruthError> {
    let mut rng = stream(seed, Purpose::CaseEffectShapes, []);
    let one = |id: &&'static str| {
        let usual = (mechanisms::effect(id)?.draw)(&scene.hexapod, &mut rng);
        sized_by(&*usual, sizing, &scene.hexapod)
    };
    ids.iter().map(one).collect()
}

/// The machine without effects, and the instrument.
fn bare(scene: &Scene) -> SimulatedCampaign {
    SimulatedCampaign { world: scene.world().without_effects(), frames: scene.frames(), noise: noise(scene) }
}

fn truth(id: &str, portion: &CasePortion, scene: &Scene, folder: &Path) -> Result<Truth, TruthError> {
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
        laboratory: None,
        seed: scene.seed,
        parameters,
    })
}
