//! Counterparts of the paper's figures 7 to 10.

use hexbench_core::{Hexapod, Pose, Wrench};
use hexbench_model::error::ModelError;
use hexbench_truth::campaign::PlanRow;
use hexbench_truth::{Situation, World};

use super::bench::{Covariates, PaperMachine, effective_load, ideal, level_pose};
use super::error::PaperError;
use super::identify::Identified;
use super::published::FIGURE_7_LOADS_N;
use super::search::{IndexedPoses, observability};
use hexbench_core::Observation;

/// Stream of the noise of the trials of fig. 8.
const TRIALS: u64 = 6;
/// Number of trials of fig. 8.
const TRIAL_COUNT: usize = 3;
/// Loads of fig. 8, N.
pub const FIGURE_8_LOADS_N: [f64; 11] =
    [0.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0, 210.0, 240.0, 270.0, 300.0];

/// Observability index over the load for one pose set.
#[derive(Debug, Clone, PartialEq)]
pub struct IndexOverLoad {
    /// Name of the pose set.
    pub name: &'static str,
    /// `[load in N, O1 in SI units]`.
    pub points: Vec<[f64; 2]>,
}

/// Fig. 7: O1 over the load for the paper's set, the best one found, and one without rotation.
pub(crate) fn figure_7(
    hexapod: &Hexapod,
    sets: [(&'static str, &IndexedPoses); 3],
) -> Result<Vec<IndexOverLoad>, ModelError> {
    let index = |set: &IndexedPoses, load: f64| {
        Ok([load, observability(hexapod, &set.poses.map(level_pose), load / effective_load())?.o1])
    };
    let curve = |(name, set): (&'static str, &IndexedPoses)| {
        let points = FIGURE_7_LOADS_N.iter().map(|&load| index(set, load)).collect::<Result<_, _>>()?;
        Ok(IndexOverLoad { name, points })
    };
    sets.into_iter().map(curve).collect()
}

/// Fig. 8: deflection along Z over the load at the zero pose, downwards positive, um.
#[derive(Debug, Clone, PartialEq)]
pub struct Linearity {
    /// `[load in N, deflection in um]` of the world itself.
    pub ideal: Vec<[f64; 2]>,
    /// The same as read, trial by trial.
    pub trials: Vec<Vec<[f64; 2]>>,
    /// Largest distance of the ideal points from the straight line through zero, um.
    pub departure_um: f64,
}

/// Fig. 8 of a world.
pub(crate) fn figure_8(bench: &PaperMachine, world: &World) -> Result<Linearity, PaperError> {
    let situation =
        |load: f64| Situation::new(Pose::default(), Wrench::from_array([0.0, 0.0, -load, 0.0, 0.0, 0.0]));
    let rows: Vec<PlanRow> = (1..)
        .zip(FIGURE_8_LOADS_N)
        .map(|(pose_id, load)| PlanRow::alone(pose_id, 1, situation(load)))
        .collect();
    let points = |data: &hexbench_core::Dataset| -> Vec<[f64; 2]> {
        data.observations.iter().map(|o| [-o.wrench.force.z, -o.measured[2] * 1e6]).collect()
    };
    let ideal = points(&ideal(world, &rows)?);
    let mut trials = Vec::new();
    for stream in (TRIALS..).take(TRIAL_COUNT) {
        trials.push(points(&bench.measure(world, &rows, Covariates::None, "trial", stream)?));
    }
    let departure_um = departure(&ideal);
    Ok(Linearity { ideal, trials, departure_um })
}

/// Largest distance from the line through zero that fits best.
fn departure(points: &[[f64; 2]]) -> f64 {
    let square: f64 = points.iter().map(|p| p[0] * p[0]).sum();
    let slope = points.iter().map(|p| p[0] * p[1]).sum::<f64>() / square;
    points.iter().map(|p| (p[1] - slope * p[0]).abs()).fold(0.0, f64::max)
}

/// One validation pose of fig. 9 or 10.
#[derive(Debug, Clone, PartialEq)]
pub struct ValidationPose {
    /// Position along the axis, mm.
    pub position_mm: f64,
    /// Predicted deflection, um and urad.
    pub predicted: [f64; 6],
    /// Standard uncertainty of the prediction, um and urad.
    pub predicted_std: [f64; 6],
    /// Measured deflection, um and urad.
    pub measured: [f64; 6],
}

/// Figs. 9 and 10: predicted and measured deflection along X and along Y.
pub(crate) fn figures_9_and_10(
    bench: &PaperMachine,
    springs: &Identified,
    data: &hexbench_core::Dataset,
) -> Result<[Vec<ValidationPose>; 2], ModelError> {
    let half = data.observations.len() / 2;
    let predicted = springs.predict(bench, data)?;
    let compare = |axis: usize, (o, p): (&Observation, &hexbench_core::Vector6)| {
        let a = hexbench_model::estimation::paper::block(&bench.hexapod, o, data.measurand)?;
        let spread = (a * springs.covariance * a.transpose()).diagonal();
        Ok(ValidationPose {
            position_mm: o.pose.translation[axis] * 1e3,
            predicted: (p * 1e6).into(),
            predicted_std: spread.map(|v| v.sqrt() * 1e6).into(),
            measured: o.measured.map(|x| x * 1e6),
        })
    };
    let along = |axis: usize| {
        let pairs = data.observations.iter().zip(&predicted).skip(axis * half).take(half);
        pairs.map(|pair| compare(axis, pair)).collect::<Result<Vec<_>, ModelError>>()
    };
    Ok([along(0)?, along(1)?])
}
