//! The command that brings the loaded platform to the wanted pose.
//!
//! `X_c <- X_c + (X_wanted - P(X_c))` with `P` the model's pose of the loaded platform in the fixed frame, until the two
//! agree. The deflection is that from the unloaded machine to the total wrench: through the reference state when one is
//! given (terms with a memory of the way there feel the difference), else directly. What only the measurement sees
//! (metrology drift, target offset, frames) is not corrected: the platform is meant, not its reading.
//!
//! The wanted pose and the command are poses of the mobile frame in the fixed frame of the machine.

use hexbench_core::{Approach, Matrix6, Measurand, Observation, Pose, Vector6, Wrench};

use crate::application::model_file::Model;
use crate::application::predict::{
    Answer, PredictError, Prediction, Uncertain, kept_covariance, predict_as, predict_with_slopes,
};
use crate::error::ModelError;

/// Rounds after which a command counts as not found.
const MOST_ROUNDS: usize = 80;
/// A command is found when the model's own loaded pose is this near, m and rad.
const FOUND: f64 = 1e-12;
/// Largest error that counts as found when the rounds end: 1 nm and 1 nrad.
const ENOUGH: f64 = 1e-9;

/// A corrected command.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Correction {
    /// What to command.
    pub command: Pose,
    /// Loaded platform minus wanted pose by the model's own prediction, m and rad: what the iteration left.
    pub remaining: [f64; 6],
    /// Standard uncertainty of the loaded pose at that command, m and rad.
    pub sigma: [f64; 6],
    /// Loaded platform minus wanted pose if the wanted pose itself were commanded, m and rad.
    pub without: [f64; 6],
}

/// Corrected commands for rows whose `pose` is the wanted pose and whose `wrench` is the total load.
///
/// # Errors
/// [`PredictError`] with the first row that is singular or for which no command is found.
pub fn compensate(model: &Model, rows: &[Observation]) -> Result<Vec<Correction>, PredictError> {
    let model = model.without_metrology();
    let wanted: Vec<Vector6> = rows.iter().map(|o| o.pose.to_vector()).collect();
    let mut commands = rows.to_vec();
    let mut without = None;
    for round in 0..MOST_ROUNDS {
        let poses = loaded_poses(&model, &commands, Uncertain::Parameters)?;
        let errors: Vec<Vector6> = poses.iter().zip(&wanted).map(|(p, w)| difference(&p.value, w)).collect();
        let worst = errors.iter().map(nalgebra::Matrix::amax).fold(0.0, f64::max);
        let first = without.get_or_insert_with(|| errors.clone()).clone();
        let last = round + 1 == MOST_ROUNDS;
        if worst < FOUND || (last && worst < ENOUGH) {
            // Tolerances move no command: only where the search ends do they count.
            let poses = loaded_poses(&model, &commands, Uncertain::Platform)?;
            return Ok(corrections(&commands, &poses, &errors, &first));
        }
        if last {
            return Err(not_found(rows, &errors));
        }
        for (command, error) in commands.iter_mut().zip(&errors) {
            command.pose = shifted(&command.pose, error);
        }
    }
    Ok(Vec::new())
}

fn corrections(
    commands: &[Observation],
    poses: &[Prediction],
    errors: &[Vector6],
    first: &[Vector6],
) -> Vec<Correction> {
    let array = |v: &Vector6| std::array::from_fn(|k| v[k]);
    let one = |i: usize| Correction {
        command: commands[i].pose,
        remaining: array(&errors[i]),
        sigma: poses[i].sigma,
        without: array(&first[i]),
    };
    (0..commands.len()).map(one).collect()
}

fn not_found(rows: &[Observation], errors: &[Vector6]) -> PredictError {
    let far = |e: &Vector6| e.amax() >= ENOUGH || !e.amax().is_finite();
    let row = errors.iter().position(far).unwrap_or(0);
    let cause = ModelError::NotConverged { iterations: MOST_ROUNDS, last_step: errors[row].amax() };
    PredictError { line: rows[row].line, cause }
}

/// Pose of the loaded platform in the fixed frame for every command.
fn loaded_poses(
    model: &Model,
    commands: &[Observation],
    uncertain: Uncertain,
) -> Result<Vec<Prediction>, PredictError> {
    if model.is_absolute() {
        absolute(model, commands, uncertain)
    } else {
        deflected(model, commands, uncertain)
    }
}

fn absolute(
    model: &Model,
    commands: &[Observation],
    uncertain: Uncertain,
) -> Result<Vec<Prediction>, PredictError> {
    let bare = model.in_machine_frames();
    Ok(without_covariance(predict_as(&bare, commands, Measurand::AbsolutePose, uncertain)?))
}

fn deflected(
    model: &Model,
    commands: &[Observation],
    uncertain: Uncertain,
) -> Result<Vec<Prediction>, PredictError> {
    let predicted =
        |rows: &[Observation]| predict_with_slopes(model, rows, Measurand::DeflectionEuler, uncertain);
    // From the unloaded machine to the reference, then from there to the load.
    let to_reference: Vec<Observation> = commands
        .iter()
        .map(|o| Observation {
            wrench: o.reference,
            reference: Wrench::default(),
            approach: Approach::Direct,
            delta_t: 0.0,
            elapsed: 0.0,
            ..*o
        })
        .collect();
    let covariance = kept_covariance(model, uncertain);
    let sum = |((command, preload), load): ((&Observation, Answer), Answer)| {
        // One set of parameters is behind both steps, and what it is wrong by may cancel.
        let both = preload + load;
        let (pose, (moved, _)) = (command.pose.to_array(), both.with_covariance(&covariance));
        Prediction { value: std::array::from_fn(|k| pose[k] + moved.value[k]), ..moved }
    };
    Ok(commands.iter().zip(predicted(&to_reference)?).zip(predicted(commands)?).map(sum).collect())
}

fn without_covariance(predicted: Vec<(Prediction, Matrix6)>) -> Vec<Prediction> {
    predicted.into_iter().map(|(reading, _)| reading).collect()
}

/// `found - wanted`, angles within half a turn.
fn difference(found: &[f64; 6], wanted: &Vector6) -> Vector6 {
    let turn = std::f64::consts::TAU;
    Vector6::from_fn(|k, _| {
        let d = found[k] - wanted[k];
        if k < 3 { d } else { d - turn * (d / turn).round() }
    })
}

fn shifted(pose: &Pose, error: &Vector6) -> Pose {
    let x = pose.to_array();
    Pose::from_array(std::array::from_fn(|k| x[k] - error[k]))
}
