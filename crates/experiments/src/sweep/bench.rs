//! One drawn machine with its plan, its hidden effect and what an ideal instrument reads of it.

use hexbench_core::{Hexapod, Measurand, Sensor, Tolerances};
use hexbench_truth::campaign::{InputErrors, PlanRow, SimulatedCampaign, Yardstick, machines};
use hexbench_truth::laboratory::FaultEntry;
use hexbench_truth::metrology::{InstrumentFrames, InstrumentNoise};
use hexbench_truth::{Mechanism, World};
use rand_distr::{Distribution, StandardNormal};

use crate::keys::HiddenEffect;
use crate::sized::{size_of, with_size};
use crate::sweep::axes::{Drawings, Geometry, Sizes};
use crate::sweep::cells::GridCell;
use crate::sweep::columns::Status;
use crate::sweep::draw::{SweepPurpose, generator};
use crate::sweep::ideal::Ideal;
use crate::sweep::indices::INDICES;
use crate::sweep::plan::{self, Draws, Request};
use crate::sweep::runner::Runner;
use crate::sweep::shard::Value;

/// What a block of trials shares.
pub struct BlockSetup {
    /// Drawings, with the noise of the instrument stated.
    pub hexapod: Hexapod,
    /// True stiffness of each leg, N/m.
    pub true_stiffness: [f64; 6],
    /// Noise of one full pose.
    pub noise: InstrumentNoise,
    /// Readings to learn from, without noise.
    pub training: Ideal,
    /// Readings to judge by, without noise.
    pub holdout: Ideal,
    /// The same in full poses, where sensors read.
    pub holdout_poses: Option<Ideal>,
    /// What the laboratory does to the data.
    pub laboratory: &'static FaultEntry,
    /// Ids of the hidden effects.
    pub hidden: Vec<&'static str>,
    /// Size of the one hidden effect in the unit of its kind; none outside the catalogue, and of several.
    pub true_size: Option<f64>,
    /// Indices of its plan, where the study asks for them.
    pub indices: Option<[f64; INDICES]>,
}

impl BlockSetup {
    /// The machine, plan and effect of a block of trials of a cell.
    ///
    /// # Errors
    /// Why the whole block has no answer.
    pub fn draw(runner: &Runner, cell: &GridCell<'_>, block: u64) -> Result<Self, Status> {
        let seed = runner.study().seed;
        let noise = cell.noise();
        let (hexapod, true_stiffness) = machine_as_read(seed, cell, block);
        let space = space(cell.geometry(), &hexapod);
        let training = training(runner, cell, block, &hexapod, &space)?;
        let indices = runner.indices(cell, &hexapod, &space, &training)?;
        let judged =
            &mut draws(seed, cell, block, [SweepPurpose::Holdout, SweepPurpose::HoldoutSurroundings]);
        let holdout = plan::holdout(&space, &hexapod, judged).ok_or(Status::NoPlan)?;
        let bare = SimulatedCampaign {
            world: World::new(hexapod.clone(), &true_stiffness),
            frames: InstrumentFrames::default(),
            noise,
        };
        let mechanisms = effects(seed, cell, &bare, &training, block)?;
        let true_size = if let [one] = &mechanisms[..] { size_of(&**one, &hexapod) } else { None };
        let mut world = World { mechanisms, ..bare.world.without_effects() };
        let laboratory = cell.laboratory();
        let mut alters = generator(seed, SweepPurpose::LaboratoryMachine, cell.position[0], block);
        laboratory.fault.alter(&mut world, &mut alters);
        let campaign = SimulatedCampaign { world, ..bare };
        let (tolerances, errors) = inputs(seed, cell, &hexapod, block);
        let ideal = |rows| Ideal::of(&campaign, errors.as_ref(), rows).map_err(|_| Status::NoRest);
        let in_poses = |rows| Ideal::in_poses(&campaign, None, rows).map_err(|_| Status::NoRest);
        Ok(Self {
            training: ideal(training)?,
            holdout_poses: cell.geometry().has_sensors().then(|| in_poses(holdout.clone())).transpose()?,
            holdout: ideal(holdout)?,
            hexapod: Hexapod { tolerances, ..stated(hexapod, laboratory) },
            true_stiffness,
            noise,
            laboratory,
            hidden: cell.effects().iter().map(|effect| effect.id).collect(),
            true_size,
            indices,
        })
    }
}

impl BlockSetup {
    /// Indices of the plan as results of a trial; empty where the study does not ask for them.
    pub fn index_values(&self) -> Vec<Value> {
        self.indices.into_iter().flatten().map(Value::Number).collect()
    }
}

/// The readings to learn from that a block of trials of a cell takes.
///
/// # Errors
/// Why there are none.
pub fn training_rows(runner: &Runner, cell: &GridCell<'_>, block: u64) -> Result<Vec<PlanRow>, Status> {
    let (hexapod, _) = machine_as_read(runner.study().seed, cell, block);
    let space = space(cell.geometry(), &hexapod);
    training(runner, cell, block, &hexapod, &space)
}

fn training(
    runner: &Runner,
    cell: &GridCell<'_>,
    block: u64,
    hexapod: &Hexapod,
    space: &hexbench_design::Space,
) -> Result<Vec<PlanRow>, Status> {
    let designed = runner.designed(cell, hexapod, space)?;
    let request = Request {
        source: &cell.plan().source,
        poses: cell.poses(),
        repeats: cell.repeats(),
        hexapod,
        space,
        designed: &designed,
    };
    let purposes = [SweepPurpose::Plan, SweepPurpose::Surroundings];
    plan::rows(&request, &mut draws(runner.study().seed, cell, block, purposes)).ok_or(Status::NoPlan)
}

fn draws(seed: u64, cell: &GridCell<'_>, block: u64, [plan, surroundings]: [SweepPurpose; 2]) -> Draws {
    let own = |purpose| generator(seed, purpose, cell.position[0], block);
    Draws { plan: own(plan), surroundings: own(surroundings) }
}

/// A machine with the noise of the cell stated, and its leg stiffness, N/m.
pub(super) fn machine_as_read(seed: u64, cell: &GridCell<'_>, block: u64) -> (Hexapod, [f64; 6]) {
    let (hexapod, true_stiffness) = machine(seed, cell, block);
    let with_noise = |s: &Sensor| s.clone().with_noise(cell.noise_scale());
    let sensors = hexapod.sensors.iter().map(with_noise).collect();
    (Hexapod { metrology: Some(cell.noise().metrology()), sensors, ..hexapod }, true_stiffness)
}

/// A machine as its file states it where a laboratory writes it.
fn stated(mut hexapod: Hexapod, laboratory: &FaultEntry) -> Hexapod {
    if let Some(metrology) = &mut hexapod.metrology {
        laboratory.fault.state(metrology);
    }
    hexapod
}

/// The tolerances that are stated, and how far inputs are off; the same errors in units of the tolerances for all values of the axis.
fn inputs(
    seed: u64,
    cell: &GridCell<'_>,
    hexapod: &Hexapod,
    block: u64,
) -> (Tolerances, Option<InputErrors>) {
    /// What is stated of exact inputs: tolerances are never zero.
    const EXACT: f64 = 1e-3;
    let Some(scale) = cell.tolerance() else { return (hexapod.tolerances, None) };
    let mut rng = generator(seed, SweepPurpose::InputErrors, cell.position[0], block);
    let errors = InputErrors::sampled(hexapod, &of_inputs(&hexapod.tolerances, scale), &mut rng);
    (of_inputs(&hexapod.tolerances, scale.max(EXACT)), (scale > 0.0).then_some(errors))
}

/// Tolerances of joints, loads and axes so many times as large.
fn of_inputs(stated: &Tolerances, scale: f64) -> Tolerances {
    Tolerances {
        joints: scale * stated.joints,
        load_gain: scale * stated.load_gain,
        load_direction: scale * stated.load_direction,
        load_point: scale * stated.load_point,
        frame: scale * stated.frame,
        ..*stated
    }
}

/// Where poses may lie on a machine.
pub fn space(geometry: &Geometry, hexapod: &Hexapod) -> hexbench_design::Space {
    geometry.space.clone().unwrap_or_else(|| plan::usual_space(hexapod))
}

/// Drawings and leg stiffness (N/m): of the family, or as the file states it with 10 % scatter.
fn machine(seed: u64, cell: &GridCell<'_>, block: u64) -> (Hexapod, [f64; 6]) {
    const SCATTER: f64 = 0.1;
    let mut rng = generator(seed, SweepPurpose::Machine, cell.position[0], block);
    match &cell.geometry().source {
        Drawings::Family(name) => {
            let hexapod = machines::draw(name, &mut rng);
            let stiffness = machines::leg_stiffness(name, &mut rng);
            (hexapod, stiffness)
        }
        Drawings::File(hexapod) => {
            let stiffness = match hexapod.nominal_stiffness {
                None => machines::leg_stiffness("ring_a", &mut rng),
                Some(nominal) => nominal.map(|k| {
                    let scatter: f64 = StandardNormal.sample(&mut rng);
                    k * (SCATTER * scatter).exp()
                }),
            };
            (hexapod.as_ref().clone(), stiffness)
        }
    }
}

/// Drawings of a geometry before anything is drawn: those of a fixed one.
pub fn drawings(seed: u64, cell: &GridCell<'_>) -> Hexapod {
    machine(seed, cell, 0).0
}

/// The hidden effects, each in its own size, or as large as if it were alone.
fn effects(
    seed: u64,
    cell: &GridCell<'_>,
    bare: &SimulatedCampaign,
    training: &[PlanRow],
    block: u64,
) -> Result<Vec<Box<dyn Mechanism>>, Status> {
    let mut rng = generator(seed, SweepPurpose::Effect, cell.position[5], block);
    let one = |effect: &HiddenEffect| {
        let usual = effect.sampled(&bare.world.hexapod, &mut rng).map_err(|_| Status::NotVisible)?;
        sized(cell, &*usual, bare, training)
    };
    cell.effects().iter().map(one).collect()
}

/// An effect in the size of a cell.
fn sized(
    cell: &GridCell<'_>,
    usual: &dyn Mechanism,
    bare: &SimulatedCampaign,
    training: &[PlanRow],
) -> Result<Box<dyn Mechanism>, Status> {
    Ok(match (&cell.axes.size, cell.size()) {
        (Sizes::Sigmas(_), Some(distance)) => {
            let yardstick = if bare.world.hexapod.sensors.is_empty() {
                Yardstick::new(bare, training, Measurand::DeflectionEuler)
            } else {
                Yardstick::of_sensors(bare, training)
            };
            let scaled = yardstick.and_then(|y| y.scale_to(usual, distance));
            usual.scaled(scaled.map_err(|_| Status::NotVisible)?.0)
        }
        (Sizes::Physical(..), Some(size)) => {
            with_size(usual, size, &bare.world.hexapod).ok_or(Status::NotVisible)?
        }
        (_, factor) => usual.scaled(factor.unwrap_or(1.0)),
    })
}
