//! `sealed/truth.json`: what was hidden, for whoever scores the answer.

use serde_json::{Map, Value, json};

use super::{Instrument, PartName, VirtualBench};
use crate::{
    TruthError,
    campaign::{PlanRow, SimulatedCampaign, Yardstick, rms},
    mechanisms::is_outside,
    metrology::InstrumentNoise,
};

/// Most rows for which the visibility of the effects is worked out.
const MOST_ROWS: u64 = 2000;

/// The truth under the keys of the case folders; distance and sizes only for plans of moderate size.
pub(super) fn of(bench: &VirtualBench<'_>) -> Value {
    let scene = bench.scene();
    let mut parameters = Map::new();
    scene.mechanisms.iter().for_each(|m| parameters.extend(m.parameters()));
    let noise = stated(bench);
    let mut truth = json!({
        "id": scene.name,
        "kind": kind(&scene.hidden_effects()),
        "effects": scene.hidden_effects(),
        "parameters": parameters,
        "geometry": scene.hexapod.name,
        "plan": if bench.columns().reference { "deflections" } else { "absolute" },
        "seed": scene.seed,
        "leg_stiffness_N_per_um": scene.leg_stiffness.map(|k| k * 1e-6),
        "noise": scene.hexapod.metrology.map(|_| [noise.sigma_translation * 1e6, noise.sigma_rotation * 1e6]),
        "repeats": scene.part(PartName::Training).iter().take(64).map(|row| row.repeat).max(),
        "metrology_frame": bench.frames().metrology.to_array(),
        "target_frame": bench.frames().target.to_array(),
    });
    if let (Value::Object(truth), Ok(sizes)) = (&mut truth, sizes(bench, noise)) {
        truth.extend(sizes);
    }
    truth
}

fn kind(effects: &[&str]) -> &'static str {
    match effects {
        [] => "clean",
        all if all.iter().any(|id| is_outside(id)) => "outside",
        [_] => "single",
        [_, _] => "pair",
        _ => "several",
    }
}

/// The instrument as independent noise on six numbers.
fn stated(bench: &VirtualBench<'_>) -> InstrumentNoise {
    match (&bench.scene().instrument, bench.scene().hexapod.metrology) {
        (Instrument::Numbers(noise), _) => *noise,
        (Instrument::Sensors(read), _) => read.noise.unwrap_or_default(),
        (Instrument::Balls(_), Some(m)) => InstrumentNoise {
            sigma_translation: m.sigma_translation,
            sigma_rotation: m.sigma_rotation,
            ..InstrumentNoise::default()
        },
        (Instrument::Balls(_), None) => InstrumentNoise::default(),
    }
}

/// How visible the effects are, and what they add to the readings, root mean square in um and urad.
fn sizes(bench: &VirtualBench<'_>, noise: InstrumentNoise) -> Result<Map<String, Value>, TruthError> {
    let scene = bench.scene();
    let parts = [PartName::Training, PartName::Holdout].map(|name| scene.part(name));
    if scene.mechanisms.is_empty() || parts.iter().any(|part| part.len() > MOST_ROWS) {
        return Ok(Map::new());
    }
    let bare = SimulatedCampaign { world: scene.world().without_effects(), frames: *bench.frames(), noise };
    let all = || scene.mechanisms.iter().map(|m| m.scaled(1.0)).collect();
    let mut sizes = Map::new();
    for (part, key) in parts.iter().zip(["raw_effect_rms", "holdout_effect_rms"]) {
        let rows: Vec<PlanRow> = part.iter().collect();
        let yardstick = Yardstick::new(&bare, &rows, scene.measurand())?;
        let (translation, rotation) = rms(&yardstick.signature(all())?);
        sizes.insert(key.to_owned(), json!([translation * 1e6, rotation * 1e6]));
        // In units of a noise that only the six numbers have.
        if part.name() == PartName::Training && !matches!(scene.instrument, Instrument::Sensors(_)) {
            sizes.insert("distance".to_owned(), json!(yardstick.distance(all())?));
        }
    }
    Ok(sizes)
}
