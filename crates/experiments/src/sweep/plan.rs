//! The readings of a cell on a drawn machine.

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Hexapod, Pose, Wrench};
use hexbench_design::nominal;
use hexbench_design::regressor::{ModelRegressor, PoseRegressor, SpringRegressor, Weights};
use hexbench_design::space::{Conditions, Loading};
use hexbench_design::{Budget, Criterion, DesignError, PoseProblem, Space, noise_to_come};
use hexbench_truth::campaign::{PlanKind, PlanRow, Poses, Scheme, usual_half_range_mm_deg};
use rand::RngExt;
use rand_pcg::Pcg64;

use crate::sweep::axes::PlanSource;

/// Held-out poses.
const HELD_OUT: usize = 12;
/// Draws of a pose before a space counts as empty.
const PATIENCE: usize = 10_000;

/// Where poses of a machine may lie when the study does not say so: the ranges and loads of the plan "rich".
pub fn usual_space(hexapod: &Hexapod) -> Space {
    let half = usual_half_range_mm_deg(hexapod);
    let si = |k: usize| if k < 3 { half[k] * 1e-3 } else { half[k].to_radians() };
    let high: [f64; 6] = std::array::from_fn(si);
    // The generator decides nothing of this plan but its poses, which are not drawn here.
    let rich = PlanKind::Rich.schemes(hexapod, &mut stream(0, Purpose::Example, [])).training;
    let loading = |load: &Wrench| Loading { reference: rich.reference, load: *load };
    Space {
        low: high.map(|x| -x),
        high,
        stroke: hexapod.stroke,
        joint_angle: None,
        least_dexterity: 0.0,
        loads: rich.loads.iter().map(loading).collect(),
        load_ranges: Vec::new(),
        conditions: Conditions::default(),
        budget: Budget::default(),
    }
}

/// A pose drawn evenly from a space; none when hardly any keeps its limits.
pub fn random_pose(space: &Space, hexapod: &Hexapod, rng: &mut Pcg64) -> Option<Pose> {
    let coordinate = |k: usize, rng: &mut Pcg64| {
        let [low, high] = [space.low[k], space.high[k]];
        if high > low { rng.random_range(low..high) } else { low }
    };
    (0..PATIENCE).find_map(|_| {
        let pose = Pose::from_array(std::array::from_fn(|k| coordinate(k, rng)));
        let kept = space.worst_limit(hexapod, &pose).is_none_or(|limit| limit.excess <= 0.0);
        kept.then_some(pose)
    })
}

/// Poses that are best by a criterion for the six leg springs, rows weighted by the noise, of full poses where no sensor reads.
pub(crate) fn designed_poses(
    criterion: Criterion,
    poses: u64,
    hexapod: &Hexapod,
    space: &Space,
    noise: [f64; 2],
    starts: u64,
) -> Result<Vec<Pose>, DesignError> {
    let compliance = nominal::compliance(hexapod);
    if let Some(noise) = noise_to_come(hexapod).filter(|_| !hexapod.sensors.is_empty()) {
        let regressor = ModelRegressor::new(hexapod, compliance, noise, &[], &space.settings(), 1)?;
        return best_poses(criterion, poses, hexapod, space, &regressor, starts);
    }
    let [translation, rotation] = noise.map(f64::recip);
    let weights = Weights { translation, rotation, compliance: compliance.into() };
    let regressor = SpringRegressor::new(hexapod, &space.settings(), 1, weights);
    best_poses(criterion, poses, hexapod, space, &regressor, starts)
}

fn best_poses(
    criterion: Criterion,
    poses: u64,
    hexapod: &Hexapod,
    space: &Space,
    regressor: &impl PoseRegressor,
    starts: u64,
) -> Result<Vec<Pose>, DesignError> {
    const SEED: u32 = 1;
    let criterion = criterion.objective(hexapod, space, regressor)?;
    let poses = usize::try_from(poses).unwrap_or(usize::MAX);
    let problem = PoseProblem { hexapod, space, regressor, criterion: &criterion, poses, known: None };
    let starts = usize::try_from(starts).unwrap_or(usize::MAX);
    Ok(problem.search(starts, SEED, &|| ())?.best.poses)
}

/// Streams of random numbers for a plan.
pub struct Draws {
    /// Poses and loads.
    pub plan: Pcg64,
    /// Approach, temperature, waiting time.
    pub surroundings: Pcg64,
}

/// What a plan is drawn for.
pub struct Request<'a> {
    /// The plan.
    pub source: &'a PlanSource,
    /// Number of poses, unless the plan has its own.
    pub poses: Option<u64>,
    /// Readings of each condition, unless the plan has its own.
    pub repeats: Option<u64>,
    /// The machine.
    pub hexapod: &'a Hexapod,
    /// Where poses may lie.
    pub space: &'a Space,
    /// Poses of a designed plan.
    pub designed: &'a [Pose],
}

/// The rows of a plan; none when the space is empty.
pub fn rows(request: &Request<'_>, draws: &mut Draws) -> Option<Vec<PlanRow>> {
    match request.source {
        PlanSource::Make(kind) => Some(of_make(*kind, request, draws)),
        PlanSource::Rows(rows) => Some(repeated(rows, request.repeats)),
        PlanSource::Designed(_) => {
            Some(scheme(request, request.designed.to_vec()).draw(&mut draws.surroundings))
        }
        PlanSource::Random => {
            let one = |_| random_pose(request.space, request.hexapod, &mut draws.plan);
            let poses: Option<Vec<Pose>> = (0..request.poses.unwrap_or(1)).map(one).collect();
            Some(scheme(request, poses?).draw(&mut draws.surroundings))
        }
    }
}

/// Held-out readings of a space: poses drawn evenly under all its loads, once each.
pub fn holdout(space: &Space, hexapod: &Hexapod, draws: &mut Draws) -> Option<Vec<PlanRow>> {
    let poses: Option<Vec<Pose>> =
        (0..HELD_OUT).map(|_| random_pose(space, hexapod, &mut draws.plan)).collect();
    Some(of_space(space, poses?, 1).draw(&mut draws.surroundings))
}

fn of_make(kind: PlanKind, request: &Request<'_>, draws: &mut Draws) -> Vec<PlanRow> {
    let mut scheme = kind.schemes(request.hexapod, &mut draws.plan).training;
    if let (Some(wanted), Poses::Drawn { count, .. }) = (request.poses, &mut scheme.poses) {
        *count = wanted;
    }
    scheme.repeats = request.repeats.unwrap_or(scheme.repeats);
    scheme.draw(&mut draws.surroundings)
}

fn scheme(request: &Request<'_>, poses: Vec<Pose>) -> Scheme {
    const USUAL_REPEATS: u64 = 3;
    of_space(request.space, poses, request.repeats.unwrap_or(USUAL_REPEATS))
}

/// Every pose under every load of the space, surroundings as in the plan "rich".
fn of_space(space: &Space, poses: Vec<Pose>, repeats: u64) -> Scheme {
    Scheme {
        poses: Poses::Listed(poses),
        loads: space.loads.iter().map(|l| l.load).collect(),
        reference: space.loads.first().map(|l| l.reference).unwrap_or_default(),
        repeats,
        ..Scheme::varied()
    }
}

/// Rows of a table, each condition read so many times.
fn repeated(rows: &[PlanRow], repeats: Option<u64>) -> Vec<PlanRow> {
    let Some(repeats) = repeats else { return rows.to_vec() };
    let mut conditions: Vec<PlanRow> = Vec::new();
    for row in rows {
        if conditions.iter().all(|known| known.situation != row.situation) {
            conditions.push(*row);
        }
    }
    let read = |row: &PlanRow| {
        (1..).zip(0..repeats).map(|(repeat, _)| PlanRow { repeat, ..*row }).collect::<Vec<_>>()
    };
    conditions.iter().flat_map(read).collect()
}
