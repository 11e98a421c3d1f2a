//! A measurement campaign as the model sees it: readings under equal conditions averaged, with their legs.
//!
//! Averaging readings that share every input is exact for least squares: the mean carries all the information on
//! the model, the scatter about it (pure error) only on the noise.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use hexbench_core::{
    Approach, Channel, Columns, Dataset, Hexapod, LoadSequence, Matrix6, Measurand, NumberKind, Observation,
    PastLoad, Pose, StatedTolerances, UNREAD, Vector3, Vector6, Wrench,
};
use nalgebra::{DMatrix, Rotation3};

use crate::error::ModelError;
use crate::estimation::equilibrium::Tangent;
use crate::estimation::frames::{Frames, ReadingAxes};
use crate::estimation::noise::{
    Noise, NoiseLevel, NoiseSource, SharedReference, Structure, stated_or_repeated,
};
use crate::estimation::whitening::Inexact;
use crate::machine::geometry::Machine;
use crate::machine::kinematics::Legs;
use crate::machine::placement::Placement;

/// A noise level known as well as this is exact for every probability; beyond it differences of evidence lose their digits.
const EXACT_NOISE: f64 = 1e-4;

/// Readings that share pose, loads, approach, temperature and time, averaged.
#[derive(Debug, Clone)]
pub struct ConditionReadings {
    /// Inputs, as of the first reading; `measured` is the weighted mean.
    pub mean: Observation,
    /// Loads that came before; none where the file states no sequence, or only the reference load came before.
    pub sequence: Option<Arc<LoadSequence>>,
    /// What the six numbers are.
    pub channels: [Channel; 6],
    /// How many readings each number was read in.
    pub reads: [u32; 6],
    /// Standard deviation of each mean value, without what it shares with others of its record.
    pub sigma: [f64; 6],
    /// Standard deviation of what it shares with them.
    pub shared: [f64; 6],
    /// Number of its record.
    pub record: usize,
    /// Indices of the readings in the dataset.
    pub rows: Vec<u32>,
    /// Sum of squared whitened differences between the readings and their mean.
    pub pure_error: f64,
}

/// Least share of the best seen motion of the legs that the worst seen one has where all of them are told: beyond it, rounding takes the
/// digits that people read.
const TOLD: f64 = 1e-9;

/// One group with the legs and forces of its pose. Fixed frame, SI.
#[derive(Debug, Clone)]
pub struct Condition {
    /// Pose at which the legs stand: commanded (deflections) or measured, brought back to the platform (absolute).
    pub place: Placement,
    /// Legs of the calibrated machine at that pose.
    pub legs: Legs,
    /// Lengths the controller commanded, m.
    pub commanded_lengths: Vector6,
    /// Commanded lengths minus those of the zero pose, m.
    pub extension: Vector6,
    /// Wrench in the loaded state.
    pub wrench: Wrench,
    /// Wrench in the reference state.
    pub reference: Wrench,
    /// What acts in the reference state and under the load, and where.
    pub states: [LoadState; 2],
    /// Forces in the legs under the load, N, tension positive: what nothing beside the legs holds.
    pub force: Vector6,
    /// Forces in the legs in the reference state, N.
    pub reference_force: Vector6,
    /// Forces in the leg springs in the two states, N: the leg forces, less what friction holds.
    pub spring_forces: [Vector6; 2],
    /// Leg forces along the way from the reference to the reading.
    pub path: LoadPath,
    /// Loads that came before, those before the reference state first; empty where the file states no sequence.
    pub past: Vec<PastState>,
    /// When the load was put on, s from the reference reading.
    pub put_on: f64,
    /// Factor by which an overloaded approach exceeded the change of load first.
    pub overload: f64,
    /// Motion of the legs' platform against their base in the reference state, geometric twist.
    pub sag: Vector6,
    /// Change of leg force between reference and load that stands beside the legs and that the forces here are without, N.
    pub relief: Vector6,
    /// How the structure yields about these forces; none: by its springs alone.
    pub tangent: Option<Box<Tangent>>,
    /// How the load was reached.
    pub approach: Approach,
    /// Temperature difference, K.
    pub delta_t: f64,
    /// Time since the reference reading, s.
    pub elapsed: f64,
    /// Time the reference load had rested when the reference was read, s; none when the file does not say.
    pub reference_age: Option<f64>,
    /// Measured values minus what an unloaded perfect machine would show, in measured coordinates.
    pub reading: Vector6,
    /// Measured coordinates from the platform's geometric twist at the mobile origin (6x6).
    pub observer: Matrix6,
    /// 1 / sigma of each averaged value.
    pub weight: Vector6,
    /// How many of the six numbers were read.
    pub numbers: usize,
    /// True when they are those of a pose.
    pub reads_pose: bool,
    /// Compliances of the leg springs where the model is linearised, m/N.
    pub springs: Vector6,
}

/// What acts on the platform in one state. Fixed frame, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadState {
    /// Where the platform is, to second order in the deflection.
    pub place: Placement,
    /// The wrench `[F; M]` that acts at its origin, fixed axes: offsets and tilts of the load included.
    pub wrench: Vector6,
    /// Unit vectors along the legs, from base joint to platform joint.
    pub directions: [Vector3; 6],
    /// Lengths of the legs, m.
    pub lengths: Vector6,
}

/// An earlier load of the sequence that ends in the reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PastState {
    /// The load.
    pub load: PastLoad,
    /// Forces in the legs minus those in the reference state, N.
    pub change: Vector6,
    /// Forces in the leg springs, N.
    pub spring_forces: Vector6,
}

/// Leg forces (N, tension positive) along the way from the reference state to the reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadPath {
    /// In the reference state.
    pub reference: Vector6,
    /// At the largest load on the way: the load itself, or the overshoot.
    pub extreme: Vector6,
    /// Under the load.
    pub load: Vector6,
}

/// Spring force of one leg in the reference state and under the load of a path when a slider beside the spring holds up to `limit`
/// against the last motion; `passed` takes the one under each earlier load.
fn along(
    path: &LoadPath,
    past: &[PastState],
    leg: usize,
    limit: f64,
    mut passed: impl FnMut(f64),
) -> [f64; 2] {
    let play = |spring: f64, force: f64| spring.max(force - limit).min(force + limit);
    let (before, since) = past.split_at(past.partition_point(|state| state.load.before_reference));
    let mut pass = |spring: f64, state: &PastState| {
        let spring = play(spring, path.reference[leg] + state.change[leg]);
        passed(spring);
        spring
    };
    let rest = play(before.iter().fold(0.0, &mut pass), path.reference[leg]);
    let last = since.iter().fold(rest, &mut pass);
    [rest, play(play(last, path.extreme[leg]), path.load[leg])]
}

/// A dataset prepared for one hexapod.
#[derive(Debug, Clone)]
pub struct Campaign {
    /// The machine as drawn.
    pub hexapod: Hexapod,
    /// What was measured.
    pub measurand: Measurand,
    /// Optional columns present.
    pub columns: Columns,
    /// What the six numbers of a reading are.
    pub blocks: Vec<[Channel; 6]>,
    /// Averaged readings in order of first appearance.
    pub groups: Vec<ConditionReadings>,
    /// Number of readings.
    pub readings: usize,
    /// Numbers read in all of them: six each, unless something else was read than a full pose.
    pub numbers: usize,
    /// True when every reading is a full pose.
    pub reads_poses: bool,
    /// Noise of one reading.
    pub noise: Noise,
    /// Sum of squared whitened differences between readings and their mean.
    pub pure_error: f64,
    /// Degrees of freedom of the pure error.
    pub pure_error_dof: f64,
    /// Frames from which a fit to absolute poses starts; those of the machine for deflections.
    pub frames: Frames,
    /// Coordinates of the readings.
    pub axes: ReadingAxes,
    /// Inputs that are known to a tolerance only; none when all are taken as exact.
    pub inexact: Option<Arc<Inexact>>,
}

/// Equations of some groups of readings, of which each has six.
pub(crate) fn rows_of(groups: impl Iterator<Item = usize>) -> Vec<usize> {
    groups.flat_map(|g| 6 * g..6 * g + 6).collect()
}

/// Bits of the commanded pose: readings of equal bits are readings of one pose.
pub(crate) fn pose_key(group: &ConditionReadings) -> [u64; 6] {
    group.mean.pose.to_array().map(|x| (x + 0.0).to_bits())
}

impl Condition {
    /// True where the six numbers of a reading tell how the platform moved, and with it the elongation of every leg. A pose does; only at
    /// beta = +-90 deg it says nothing of two rotations.
    pub fn tells_motion(&self) -> bool {
        self.numbers == 6
            && (self.reads_pose || {
                let shares = self.seen().singular_values();
                shares.min() > TOLD * shares.max()
            })
    }

    /// What an elongation of each leg does to the numbers read, in standard deviations.
    pub(crate) fn seen(&self) -> Matrix6 {
        Matrix6::from_diagonal(&self.weight) * self.observer * self.legs.platform_jacobian
    }

    /// Geometric twist of the platform at the mobile origin that reads like this; zero where a reading does not tell it.
    pub fn motion(&self, reading: &Vector6) -> Vector6 {
        if !self.tells_motion() {
            return Vector6::zeros();
        }
        self.observer.try_inverse().map_or_else(Vector6::zeros, |h| h * reading)
    }

    /// Sets the forces in the legs (N) in the reference state and under the load; the largest ones on the way as the load is exceeded.
    pub fn set_forces(&mut self, [reference, load]: [Vector6; 2], limits: &Vector6) {
        let extreme = match self.approach {
            Approach::Direct => load,
            Approach::Overloaded => reference + self.overload * (load - reference),
        };
        self.set_path(LoadPath { reference, extreme, load }, limits);
    }

    /// Sets the forces in the legs, and with them those in the springs, beside which friction holds up to `limits` (N).
    pub fn set_path(&mut self, path: LoadPath, limits: &Vector6) {
        (self.reference_force, self.force, self.path) = (path.reference, path.load, path);
        let mut of_leg = [[0.0; 2]; 6];
        for (leg, ends) in of_leg.iter_mut().enumerate() {
            let mut passed = Vec::with_capacity(self.past.len());
            *ends = along(&path, &self.past, leg, limits[leg].max(0.0), |spring| passed.push(spring));
            self.past.iter_mut().zip(passed).for_each(|(state, spring)| state.spring_forces[leg] = spring);
        }
        self.spring_forces = [0, 1].map(|state| Vector6::from_fn(|leg, _| of_leg[leg][state]));
    }

    /// Spring force of one leg in the reference state and under the load when a slider beside the spring holds up to
    /// `limit` against the last motion, on the whole way from the unloaded machine.
    pub fn spring_forces_under(&self, leg: usize, limit: f64) -> [f64; 2] {
        along(&self.path, &self.past, leg, limit, |_| ())
    }

    /// Change of the pull of a leg on its base joint between reference and load, fixed axes, N.
    pub fn pull_change(&self, leg: usize) -> Vector3 {
        let [reference, loaded] = &self.states;
        loaded.directions[leg] * self.force[leg] - reference.directions[leg] * self.reference_force[leg]
    }

    /// Elongations of the legs, m, per standard deviation of six numbers that determine them.
    pub(crate) fn legs_of_reading(&self, group: &ConditionReadings) -> Matrix6 {
        // Only at beta = +-90 deg, where the reading says nothing of two rotations.
        let to_legs = self.observer.try_inverse().map_or_else(Matrix6::zeros, |h| self.legs.leg_jacobian * h);
        to_legs * Matrix6::from_diagonal(&Vector6::from_column_slice(&group.sigma))
    }

    /// Change of the forces in the leg springs between reference and load, N.
    pub fn spring_change(&self) -> Vector6 {
        self.spring_forces[1] - self.spring_forces[0]
    }

    /// Change of leg force between reference and load, N.
    pub fn force_change(&self) -> Vector6 {
        self.force - self.reference_force
    }

    /// Change of all leg forces (N) under the same wrench when the platform end of one leg moves by `end` against its base
    /// end, and its arm from the mobile origin by `arm`. Fixed axes, m.
    pub fn force_response(&self, leg: usize, end: &Vector3, arm: &Vector3) -> Vector6 {
        let (n, length) = (self.legs.directions[leg], self.legs.lengths[leg]);
        let turn = (end - n * n.dot(end)) / length;
        let moment = arm.cross(&n) + self.legs.arms[leg].cross(&turn);
        let wrench = Vector6::new(turn.x, turn.y, turn.z, moment.x, moment.y, moment.z);
        -self.legs.forces(&(wrench * self.force[leg]))
    }
}

impl Campaign {
    /// Prepare a dataset with the noise the files state or the repeats show; without either, `sigma` is a guess
    /// that [`Campaign::with_noise`] replaces after a first fit.
    ///
    /// # Errors
    /// [`ModelError::TooFewEquations`] for an empty dataset.
    pub fn new(hexapod: &Hexapod, dataset: &Dataset) -> Result<Self, ModelError> {
        let noise = stated_or_repeated(hexapod, dataset).unwrap_or_else(|| Noise {
            translation: 1e-6,
            rotation: 1e-6 / hexapod.platform_radius().max(1e-6),
            source: NoiseSource::Residuals,
            dof: 0.0,
            structure: Structure::Independent,
        });
        Self::with_noise(hexapod, dataset, noise)
    }

    /// Prepare a dataset with a given noise level; `sigma_*` columns still win where the noise comes from them.
    ///
    /// # Errors
    /// [`ModelError::TooFewEquations`] for an empty dataset.
    pub fn with_noise(hexapod: &Hexapod, dataset: &Dataset, noise: Noise) -> Result<Self, ModelError> {
        Self::in_frames(hexapod, dataset, noise, frames_of(hexapod, dataset))
    }

    /// Prepare a dataset read in frames that are known, as those of a fitted model.
    ///
    /// # Errors
    /// [`ModelError::TooFewEquations`] for an empty dataset.
    pub fn in_frames(
        hexapod: &Hexapod,
        dataset: &Dataset,
        noise: Noise,
        frames: Frames,
    ) -> Result<Self, ModelError> {
        if dataset.observations.is_empty() {
            return Err(ModelError::TooFewEquations { equations: 0, unknowns: 6 });
        }
        let axes = ReadingAxes::of(&frames);
        let groups = group(dataset, &noise, &axes);
        let (measurand, columns, blocks) = (dataset.measurand, dataset.columns, &dataset.blocks);
        let like = Like { hexapod, measurand, columns, blocks, noise, frames };
        Ok(Self::of_groups(&like, groups))
    }

    /// Prepare readings held out from a fit: in the frames of the fit, each weighed by all of its noise.
    ///
    /// # Errors
    /// [`ModelError::TooFewEquations`] for an empty dataset, [`ModelError::Astray`] when it was read in other frames.
    pub fn held_out(
        hexapod: &Hexapod,
        holdout: &Dataset,
        noise: Noise,
        machine: &Machine,
    ) -> Result<Self, ModelError> {
        let frames = known_frames(holdout, machine);
        let campaign = Self::in_frames(hexapod, holdout, noise, frames)?;
        campaign.refuse_astray(&Frames::of(machine), &holdout.source)?;
        Ok(campaign)
    }

    fn of_groups(like: &Like<'_>, groups: Vec<ConditionReadings>) -> Self {
        let Like { hexapod, measurand, columns, blocks, noise, frames } = *like;
        let readings: usize = groups.iter().map(|g| g.rows.len()).sum();
        let pure_error = groups.iter().map(|g| g.pure_error).sum();
        let numbers: usize = groups.iter().flat_map(|g| g.reads).map(|reads| reads as usize).sum();
        let means: usize = groups.iter().map(ConditionReadings::numbers).sum();
        let reads_poses = numbers == 6 * readings && groups.iter().all(|g| g.channels == Channel::POSE);
        let pure_error_dof = (numbers - means) as f64;
        let hexapod = hexapod.clone();
        Self {
            hexapod,
            measurand,
            columns,
            blocks: blocks.clone(),
            groups,
            readings,
            numbers,
            reads_poses,
            noise,
            pure_error,
            pure_error_dof,
            frames,
            axes: ReadingAxes::of(&frames),
            inexact: None,
        }
    }

    /// Refuses absolute poses that do not follow the commanded ones whatever the frames are: no fit could converge.
    ///
    /// # Errors
    /// [`ModelError::Astray`].
    pub fn refuse_astray(&self, frames: &Frames, file: &str) -> Result<(), ModelError> {
        if !self.is_absolute() {
            return Ok(());
        }
        let rows: Vec<Observation> = self.groups.iter().map(|g| g.mean).collect();
        let astray = |left| ModelError::Astray { file: file.to_owned(), left };
        frames.astray(&self.hexapod, &rows).map_or(Ok(()), |left| Err(astray(left)))
    }

    /// Some of the groups; their readings keep their indices in the dataset.
    #[must_use]
    pub fn part(&self, groups: &[usize]) -> Self {
        let part = self.chosen(groups);
        match &self.inexact {
            Some(all) => part.with_inexact(all.columns.select_rows(&rows_of(groups.iter().copied()))),
            None => part,
        }
    }

    /// Some of the groups with nothing in common between their readings, each weighed by what is its own.
    pub(crate) fn unwhitened_part(&self, groups: &[usize]) -> Self {
        self.chosen(groups).unwhitened()
    }

    fn chosen(&self, groups: &[usize]) -> Self {
        let kept = groups.iter().map(|&g| self.groups[g].clone()).collect();
        let (measurand, columns, noise, frames) = (self.measurand, self.columns, self.noise, self.frames);
        let like = Like { hexapod: &self.hexapod, measurand, columns, blocks: &self.blocks, noise, frames };
        // What a condition is taken for does not depend on the others.
        Self { reads_poses: self.reads_poses, ..Self::of_groups(&like, kept) }
    }

    /// The same with inputs known to a tolerance only: what a standard deviation of each does to every reading over the standard
    /// deviation of its own noise, six rows for each group.
    #[must_use]
    pub fn with_inexact(mut self, columns: DMatrix<f64>) -> Self {
        self.inexact = Inexact::of(&self.groups, &self.noise, columns).map(Arc::new);
        self
    }

    /// The same with nothing in common between its readings, each weighed by what is its own.
    #[must_use]
    pub(crate) fn unwhitened(mut self) -> Self {
        self.noise = self.noise.independent();
        self.inexact = None;
        self
    }

    /// The same with every reading weighed by all of its noise, as if nothing were shared.
    #[must_use]
    pub fn independent(mut self) -> Self {
        for group in &mut self.groups {
            group.sigma = std::array::from_fn(|k| group.sigma[k].hypot(group.shared[k]));
            group.shared = [0.0; 6];
        }
        self.noise = self.noise.independent();
        self.inexact = None;
        self
    }

    /// Averaged numbers that were read.
    pub(crate) fn averaged_numbers(&self) -> f64 {
        self.groups.iter().map(ConditionReadings::numbers).sum::<usize>() as f64
    }

    /// What repeats and the statement tell of the noise level. Repeats that share an error tell nothing of its size.
    pub fn noise_level(&self) -> NoiseLevel {
        let worth = match self.noise.source {
            NoiseSource::Repeats => return NoiseLevel { sum: self.noise.dof, dof: self.noise.dof },
            NoiseSource::Residuals => 0.0,
            // A chi-square of so many degrees of freedom scatters as much as the stated standard deviation may.
            NoiseSource::Columns | NoiseSource::Sensors | NoiseSource::Metrology => {
                0.5 / self.hexapod.tolerances.noise.max(EXACT_NOISE).powi(2)
            }
        };
        let (repeats, dof) = match self.noise.structure {
            Structure::Independent => (self.pure_error, self.pure_error_dof),
            _ => (0.0, 0.0),
        };
        NoiseLevel { sum: worth + repeats, dof: worth + dof }
    }

    /// The tolerances of the inputs; none where they count as exact, because no error of them shows.
    pub fn assumed_tolerances(&self) -> Option<StatedTolerances> {
        self.inexact.as_ref().map(|_| StatedTolerances::of(&self.hexapod.tolerances, self.measurand))
    }

    /// Noise of one length, m, and of one angle, rad; none of what this campaign does not read.
    pub fn noise_read(&self) -> [Option<f64>; 2] {
        let read = |angles: bool| {
            let is_it = |c: &Channel| *c != Channel::Nothing && c.is_angle(&self.hexapod.sensors) == angles;
            self.blocks.iter().flatten().any(is_it)
        };
        [read(false).then_some(self.noise.translation), read(true).then_some(self.noise.rotation)]
    }

    /// What the numbers of a reading with these standard deviations are.
    pub fn kinds_of(&self, group: &ConditionReadings, sigma: &[f64; 6]) -> [NumberKind; 6] {
        std::array::from_fn(|k| match group.channels[k] {
            Channel::Nothing => NumberKind::Unread,
            _ if sigma[k] >= UNREAD => NumberKind::Unread,
            channel if channel.is_angle(&self.hexapod.sensors) => NumberKind::Angle,
            _ => NumberKind::Length,
        })
    }

    /// Name of a number of a group: its column, without unit.
    pub fn name_of(&self, group: usize, number: usize) -> String {
        self.groups[group].channels[number].name(&self.hexapod.sensors, self.measurand)
    }

    /// True in absolute mode.
    pub fn is_absolute(&self) -> bool {
        self.measurand == Measurand::AbsolutePose
    }
}

/// A pose after a share of a small geometric twist; the same motion in whatever axes it is written.
pub(crate) fn moved(pose: &Pose, twist: &Vector6, share: f64) -> Pose {
    let turn = Rotation3::new(share * twist.fixed_rows::<3>(3));
    let translation = pose.translation + share * twist.fixed_rows::<3>(0);
    Pose::from_rotation(translation, &(turn.matrix() * pose.rotation()))
}

impl ConditionReadings {
    fn of(first: &Observation, channels: [Channel; 6], sequence: Option<Arc<LoadSequence>>) -> Self {
        let rows = Vec::with_capacity(1);
        Self {
            mean: *first,
            sequence,
            channels,
            reads: [0; 6],
            sigma: [0.0; 6],
            shared: [0.0; 6],
            record: 0,
            rows,
            pure_error: 0.0,
        }
    }

    /// How many of the six numbers were read at all.
    pub fn numbers(&self) -> usize {
        self.reads.iter().filter(|reads| **reads > 0).count()
    }
}

/// What campaigns of the same instrument and machine share.
struct Like<'a> {
    hexapod: &'a Hexapod,
    measurand: Measurand,
    columns: Columns,
    blocks: &'a Vec<[Channel; 6]>,
    noise: Noise,
    frames: Frames,
}

/// Frames from which a fit to a dataset starts.
pub(crate) fn frames_of(hexapod: &Hexapod, dataset: &Dataset) -> Frames {
    if dataset.is_absolute() { Frames::between(hexapod, &dataset.observations) } else { Frames::default() }
}

/// Refuses absolute poses held out that were read in other frames than the data, before anything is fitted.
///
/// # Errors
/// [`ModelError::Astray`].
pub fn same_frames(hexapod: &Hexapod, data: &Dataset, holdout: &Dataset) -> Result<(), ModelError> {
    if !data.is_absolute() {
        return Ok(());
    }
    let frames = frames_of(hexapod, data);
    let astray = |rows: &Dataset, file: &str| {
        let error = |left| ModelError::Astray { file: file.to_owned(), left };
        frames.astray(hexapod, &rows.observations).map_or(Ok(()), |left| Err(error(left)))
    };
    astray(data, "")?;
    astray(holdout, &holdout.source)
}

/// Frames of a machine in which a dataset was read; only absolute poses have any.
fn known_frames(dataset: &Dataset, machine: &Machine) -> Frames {
    if dataset.is_absolute() { Frames::of(machine) } else { Frames::default() }
}

/// Under how many conditions readings were taken: what a fit keeps memory of.
pub fn count_conditions(data: &Dataset) -> usize {
    let keys = data.observations.iter().map(|row| key(row, data.sequences.to(row).map(Arc::as_ref)));
    keys.collect::<HashSet<_>>().len()
}

fn group(data: &Dataset, noise: &Noise, axes: &ReadingAxes) -> Vec<ConditionReadings> {
    let rows = &data.observations;
    let mut index: HashMap<(ConditionKey, Option<i64>), usize> = HashMap::new();
    let mut groups: Vec<ConditionReadings> = Vec::new();
    // Neighbors that resemble each other are no repeats of each other.
    let drifts = matches!(noise.structure, Structure::Drift { .. });
    let is_named = noise.structure.has_named_records();
    for (i, row) in rows.iter().enumerate() {
        let next = groups.len();
        let sequence = data.sequences.to(row);
        let slot = if drifts {
            next
        } else {
            let key = (key(row, sequence.map(Arc::as_ref)), row.reference_record.filter(|_| is_named));
            *index.entry(key).or_insert(next)
        };
        if slot == next {
            groups.push(ConditionReadings::of(row, data.channels(row), sequence.cloned()));
        }
        groups[slot].rows.push(u32::try_from(i).unwrap_or(u32::MAX));
    }
    let mut records: HashMap<(Record, usize), usize> = HashMap::new();
    for g in &mut groups {
        average(g, rows, noise, axes);
        let record = (Record::of(g, is_named), g.mean.block);
        let next = records.len();
        g.record = *records.entry(record).or_insert(next);
    }
    groups
}

/// What readings with a reference in common have in common.
#[derive(PartialEq, Eq, Hash)]
enum Record {
    Pose([u64; 6]),
    Named(i64),
    /// A file that names none says nothing of what its readings share.
    Own(u32),
}

impl Record {
    fn of(group: &ConditionReadings, is_named: bool) -> Self {
        match group.mean.reference_record {
            _ if !is_named => Self::Pose(pose_key(group)),
            Some(number) => Self::Named(number),
            None => Self::Own(group.rows[0]),
        }
    }
}

fn average(group: &mut ConditionReadings, rows: &[Observation], noise: &Noise, axes: &ReadingAxes) {
    let (mut weights, mut sums) = ([0.0; 6], [0.0; 6]);
    // Differences from the first reading keep the digits of absolute poses.
    let first = rows[group.rows[0] as usize].measured;
    for &i in &group.rows {
        let row = &rows[i as usize];
        let sigma = row_sigma(row, noise);
        let off = axes.difference(&first, &row.measured);
        for k in 0..6 {
            let w = sigma[k].powi(-2);
            weights[k] += w;
            sums[k] += w * off[k];
            group.reads[k] += u32::from(sigma[k] < UNREAD);
        }
    }
    let mean = axes.moved(&first, &std::array::from_fn(|k| sums[k] / weights[k]));
    group.mean.measured = mean;
    group.sigma = weights.map(|w| w.sqrt().recip());
    let square = |&i: &u32| whitened_square(&rows[i as usize], &mean, noise, axes);
    group.pure_error = group.rows.iter().map(square).sum();
    share_out(group, noise);
}

/// Splits the variance of a mean of independent readings into what is its own and what is shared.
fn share_out(group: &mut ConditionReadings, noise: &Noise) {
    let own = noise.structure.own_share();
    let each_has_its_own = match noise.structure {
        Structure::Reference { record: SharedReference::Named, .. } => group.mean.reference_record.is_none(),
        Structure::Reference { record, .. } => record == SharedReference::Repeat,
        _ => false,
    };
    for k in 0..6 {
        // As if every reading had the same level, which those of a record have to have.
        let readings = f64::from(group.reads[k].max(1));
        let one = group.sigma[k] * readings.sqrt();
        let (mean, shared) = match noise.structure {
            Structure::Independent | Structure::Axes { .. } => continue,
            Structure::Drift { share, .. } => (own.sqrt(), share.sqrt()),
            Structure::Setup { share } => ((own / readings + share).sqrt(), 0.0),
            Structure::Reference { share, .. } if !each_has_its_own => {
                ((own / readings).sqrt(), share.sqrt())
            }
            Structure::Reference { share, .. } => ((own / readings).sqrt(), (share / readings).sqrt()),
        };
        group.sigma[k] = one * mean;
        group.shared[k] = one * shared;
    }
    // Repeats of one reference each scatter by all of their noise.
    if !each_has_its_own {
        group.pure_error /= own;
    }
}

/// Standard deviation of the six values of one reading.
pub fn row_sigma(row: &Observation, noise: &Noise) -> [f64; 6] {
    row.sigma.unwrap_or_else(|| noise.sigma())
}

fn whitened_square(row: &Observation, mean: &[f64; 6], noise: &Noise, axes: &ReadingAxes) -> f64 {
    let sigma = row_sigma(row, noise);
    let off = axes.difference(mean, &row.measured);
    (0..6).map(|k| (off[k] / sigma[k]).powi(2)).sum()
}

/// Inputs of a reading, bit by bit, and what came before.
type ConditionKey = ([u64; 25], Option<Vec<u64>>);

fn key(row: &Observation, sequence: Option<&LoadSequence>) -> ConditionKey {
    let mut key = [0; 25];
    key[21] = row.block as u64;
    key[22] = u64::from(row.reference_age.is_some());
    key[23] = (row.reference_age.unwrap_or(0.0) + 0.0).to_bits();
    key[24] = row.overload.to_bits();
    let parts = [row.pose.to_array(), row.wrench.to_array(), row.reference.to_array()];
    let rest = [row.approach.sign(), row.delta_t, row.elapsed];
    for (k, x) in key.iter_mut().zip(parts.iter().flatten().chain(&rest)) {
        *k = (x + 0.0).to_bits();
    }
    (key, sequence.map(LoadSequence::bits))
}
