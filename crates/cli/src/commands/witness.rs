//! `hexbench witness SCENE [--mujoco REST.json]`.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::{Args, value_parser};
use hexbench_core::Vector3;
use hexbench_core::parser_words::of_json;
use hexbench_rapier::RapierStatics;
use hexbench_truth::campaign::PlanRow;
use hexbench_truth::equilibrium::Body;
use hexbench_truth::scene::Scene;
use hexbench_truth::{Statics, World};
use nalgebra::{Quaternion, UnitQuaternion};
use serde::Deserialize;

use super::export::{files, model_name, spread};
use crate::failure::Failure;
use crate::output::{PageFiles, Screen, refuse_overlaps_of};
use crate::page::worlds::{LARGEST_SHARE, RestInWorld, StateOfWorlds, Worlds};

/// Compare the rest states of a scene's machine in independent simulations: the simulated world and others that share no equation
/// with it
///
/// The simulated world solves for static equilibrium; Rapier lets bodies and joints move until they come to rest. MuJoCo, as a third
/// world, needs Python: export the same states, let `scripts/mujoco_check.py` bring them to rest, and name the file it writes. The
/// exit code is 1 if the worlds differ by more than a ten-thousandth of the deflection.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench witness scenes/paper-rich --html worlds.html\n\n\
    With MuJoCo as the third:\n  \
    hexbench export scenes/paper-rich --mjcf --states 8 -o states\n  \
    python scripts/mujoco_check.py states\n  \
    hexbench witness scenes/paper-rich --states 8 --mujoco states/rest-mujoco.json --html worlds.html")]
pub(crate) struct Arguments {
    /// Folder of the scene
    scene: PathBuf,
    /// Number of conditions, spread over the plan
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = value_parser!(u16).range(1..=999))]
    states: u16,
    /// Rest states from MuJoCo for the same conditions: the file that `scripts/mujoco_check.py` writes
    #[arg(long, value_name = "FILE")]
    mujoco: Option<PathBuf>,
    #[command(flatten)]
    page: PageFiles,
}

/// Where another program came to rest.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RestFile {
    format: String,
    program: String,
    states: Vec<RestOfModel>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct RestOfModel {
    model: String,
    #[serde(rename = "load_N_Nm")]
    load: [f64; 6],
    #[serde(rename = "position_m")]
    position: [f64; 3],
    /// Quaternion, scalar first.
    orientation: [f64; 4],
    #[serde(rename = "forces_N")]
    forces: [f64; 6],
}

/// Bring every world to rest, tell.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    refuse_overlaps_of(&files(&arguments.scene), &arguments.page.files())?;
    let scene = Scene::read(&arguments.scene)?;
    let plan = scene.plan();
    let chosen = spread(&plan.training, &plan.holdout, usize::from(arguments.states));
    let third = arguments.mujoco.as_deref().map(|path| read(path, &chosen)).transpose()?;
    let first = scene.world();
    let second = World { statics: Arc::new(RapierStatics::default()) as Arc<dyn Statics>, ..scene.world() };
    let mut states = Vec::with_capacity(chosen.len());
    for (k, (_, row)) in chosen.iter().enumerate() {
        let failed = |cause| Failure::SceneState {
            scene: arguments.scene.clone(),
            place: format!("state {}", k + 1),
            cause,
        };
        let mut rests = Vec::with_capacity(3);
        for world in [&first, &second] {
            let rest = world.reading(&row.situation).map_err(failed)?.equilibrium;
            rests.push(RestInWorld { platform: rest.platform, forces: rest.forces });
        }
        rests.extend(third.iter().map(|file| file.1[k]));
        let deflection = first.deflection(&row.situation).map_err(failed)?;
        states.push(StateOfWorlds { situation: row.situation, deflection, rests });
    }
    let names = ["hexbench".to_owned(), "Rapier".to_owned()].into_iter().chain(third.map(|file| file.0));
    let worlds = Worlds {
        scene: scene.name.clone(),
        radius: scene.hexapod.platform_radius(),
        names: names.collect(),
        states,
    };
    let page = worlds.page()?;
    arguments.page.write(screen, || Ok(page.clone()))?;
    screen.show(&page)?;
    let apart = worlds.apart();
    if apart <= LARGEST_SHARE {
        return Ok(());
    }
    Err(Failure::Check(format!(
        "the worlds are {apart:.1e} of the deflection apart, more than {LARGEST_SHARE:e}"
    )))
}

fn is_other(a: &[f64; 6], b: &[f64; 6]) -> bool {
    a.iter().zip(b).any(|(a, b)| (a - b).abs() > 0.0)
}

const HOW_TO_REST: &str = "Export the same number of states of the same scene (`hexbench export SCENE --mjcf --states N -o DIR`), then run \
     scripts/mujoco_check.py DIR.";

/// The program, and where it came to rest in these states.
fn read<T>(path: &Path, chosen: &[(T, &PlanRow)]) -> Result<(String, Vec<RestInWorld>), Failure> {
    let refused = |why: String| Failure::unusable(path, why, HOW_TO_REST);
    let text = hexbench_core::files::read_text(path)?;
    let file: RestFile = serde_json::from_str(&text).map_err(|cause| refused(of_json(&cause)))?;
    if file.format != "rest/1" {
        return Err(refused(format!("the format must be \"rest/1\", found \"{}\"", file.format)));
    }
    if file.states.len() != chosen.len() {
        let counts = format!("{} states, {} are compared", file.states.len(), chosen.len());
        return Err(refused(counts));
    }
    let rests = file.states.iter().zip(chosen).enumerate().map(|(k, (state, (_, row)))| {
        let load = row.situation.wrench.to_array();
        let of_state = |what: &str| refused(format!("state {}: {what}", k + 1));
        if state.model != model_name(k) || is_other(&state.load, &load) {
            return Err(of_state("another model or another load than that of the plan"));
        }
        let [w, x, y, z] = state.orientation;
        let length = Quaternion::new(w, x, y, z).norm();
        let numbers = state.position.iter().chain(&state.orientation).chain(&state.forces);
        if !numbers.copied().all(f64::is_finite) || (length - 1.0).abs() > 1e-6 {
            return Err(of_state("an orientation that is no unit quaternion, or a number that is none"));
        }
        let axes = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_rotation_matrix();
        let platform = Body { origin: Vector3::from(state.position), axes: *axes.matrix() };
        Ok(RestInWorld { platform, forces: state.forces })
    });
    Ok((file.program, rests.collect::<Result<_, _>>()?))
}
