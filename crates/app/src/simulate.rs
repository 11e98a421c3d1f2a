//! A scene as somebody wants it measured.

use std::path::Path;

use hexbench_truth::Scene;
use hexbench_truth::scene::{Instrument, PlanError};

use crate::Failure;

/// What may differ from what the scene says.
#[derive(Debug, Clone, Copy, Default)]
pub struct Choices {
    /// Draws plan and noise by this seed.
    pub seed: Option<u64>,
    /// Number of training poses, for a scene whose poses are drawn.
    pub poses: Option<u64>,
    /// Readings of each training condition.
    pub repeats: Option<u64>,
    /// Touches balls that tell a pose as well as the instrument of the scene.
    pub balls: bool,
}

/// The scene in a folder, with these choices.
///
/// # Errors
/// [`Failure::File`], [`Failure::Usage`] for a choice that the scene does not leave.
pub fn scene(folder: &Path, choices: Choices) -> Result<Scene, Failure> {
    let mut scene = Scene::read_with_seed(folder, choices.seed)?;
    if let Some(poses) = choices.poses {
        scene.plan = scene.plan.with_poses(poses).map_err(|wrong| usage(&wrong))?;
    }
    if let Some(repeats) = choices.repeats {
        scene.plan = scene.plan.with_repeats(repeats).map_err(|wrong| usage(&wrong))?;
    }
    if choices.balls && !matches!(scene.instrument, Instrument::Balls(_)) {
        if scene.plan.states_order() || scene.plan.states_reference_record() {
            return Err(no_balls(
                "readings of this scene share their reference, but balls are measured again for each reading",
            ));
        }
        let balls = scene.instrument.as_balls(scene.measurand());
        scene.instrument = balls.ok_or_else(|| no_balls("the sensors of this scene read no poses"))?;
    }
    Ok(scene)
}

fn no_balls(why: &str) -> Failure {
    Failure::usage(
        format!("--balls: {why}"),
        "Omit --balls, or choose a scene whose instrument reads six numbers.",
    )
}

fn usage(wrong: &PlanError) -> Failure {
    let next = match wrong {
        PlanError::ListedPoses => "Omit --poses; use --repeats for more readings.",
        PlanError::Size { .. } => "Choose another number for --poses or --repeats.",
    };
    Failure::usage(wrong.to_string(), next)
}
