//! The machine of a scene on its bench: rows in, readings out.

use std::ops::Range;

use hexbench_core::{
    Channel, Columns, Dataset, LoadSequence, LoadSequences, Measurand, Observation, Pose, UNREAD, Vector6,
};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::{Instrument, PartName, PlanPart, PoseNumbersRead, Scene, ScenePurpose};
use crate::{
    TruthError, World,
    campaign::{PlanRow, rounded},
    metrology::{Cmm, CmmRecord, InstrumentFrames, InstrumentNoise, Surroundings, read_sensors},
    world::difference,
};

/// A scene ready to be measured.
#[derive(Debug)]
pub struct VirtualBench<'a> {
    scene: &'a Scene,
    world: World,
    frames: InstrumentFrames,
    noise_free: bool,
}

/// One row as measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// The reading, or the first six numbers of it.
    pub observation: Observation,
    /// Further numbers of the same row, six at a time: only sensors give more.
    pub further: Vec<Observation>,
    /// What the measuring machine wrote down, reference state first; empty for an instrument that reads numbers.
    pub records: Vec<CmmRecord>,
}

impl Measured {
    /// All numbers of the row, six at a time.
    pub fn observations(&self) -> impl Iterator<Item = Observation> {
        std::iter::once(self.observation).chain(self.further.iter().copied())
    }
}

/// A row whose state of rest does not exist.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{part} row {row} (pose {pose_id}): {cause}")]
pub struct RowError {
    /// `training` or `holdout`.
    pub part: &'static str,
    /// Row of the part, from 1.
    pub row: u64,
    /// Number of the pose.
    pub pose_id: i64,
    /// Why not.
    pub cause: TruthError,
}

/// The states of a row, seen without error. In absolute mode only the second one is.
type Ideal = [Pose; 2];

impl<'a> VirtualBench<'a> {
    /// Sets a scene up; without noise the instrument reads what there is.
    pub fn new(scene: &'a Scene, noise_free: bool) -> Self {
        Self::of_world(scene, scene.world(), noise_free)
    }

    /// The same with a machine that is not quite that of the scene.
    pub(super) fn of_world(scene: &'a Scene, world: World, noise_free: bool) -> Self {
        Self { scene, world, frames: scene.frames(), noise_free }
    }

    pub(super) fn set_noise_free(&mut self, noise_free: bool) {
        self.noise_free = noise_free;
    }

    /// The scene.
    pub fn scene(&self) -> &'a Scene {
        self.scene
    }

    /// Frames of the instrument.
    pub fn frames(&self) -> &InstrumentFrames {
        &self.frames
    }

    /// Optional columns its tables have.
    pub fn columns(&self) -> Columns {
        let deflections = !self.is_absolute();
        Columns {
            reference: deflections,
            approach: deflections,
            overload: deflections && self.scene.plan.states_overload(),
            delta_t: true,
            elapsed: true,
            reference_age: deflections && self.scene.plan.states_reference_age(),
            reference_record: deflections && self.scene.plan.states_reference_record(),
            order: deflections && self.scene.plan.states_order(),
            sigma: !matches!(self.scene.instrument, Instrument::Numbers(_)),
        }
    }

    fn is_absolute(&self) -> bool {
        self.scene.measurand() == Measurand::AbsolutePose
    }

    /// Measures some rows of a part. A row does not depend on which others are asked for.
    ///
    /// # Errors
    /// [`RowError`].
    pub fn measure(&self, name: PartName, range: Range<u64>) -> Result<Vec<Measured>, RowError> {
        let part = self.scene.part(name);
        let mut last: Option<(PlanRow, Ideal)> = None;
        let mut measured = Vec::new();
        for (index, row) in range.filter_map(|index| part.row(index).map(|row| (index, row))) {
            let failed = |cause| RowError { part: name.word(), row: index + 1, pose_id: row.pose_id, cause };
            let ideal = match last {
                Some((before, ideal)) if before.situation == row.situation && row.order.is_none() => ideal,
                _ => self.ideal(&part, &row).map_err(failed)?,
            };
            last = Some((row, ideal));
            let mut rng = self.scene.streams().of(ScenePurpose::Noise(name), index);
            measured.push(self.read(name, &row, index, ideal, &mut rng).map_err(failed)?);
        }
        Ok(measured)
    }

    /// All rows of a part, measured, as its file would hold them.
    ///
    /// # Errors
    /// [`RowError`].
    pub fn dataset(&self, name: PartName) -> Result<Dataset, RowError> {
        let rows = self.measure(name, 0..self.scene.part(name).len())?;
        let observations: Vec<Observation> = rows.iter().flat_map(Measured::observations).collect();
        Ok(Dataset {
            sequences: LoadSequences::of(&observations),
            observations,
            source: name.file().to_owned(),
            ..self.empty()
        })
    }

    /// A table of what is read, without rows.
    pub(super) fn empty(&self) -> Dataset {
        let blocks = match &self.scene.instrument {
            Instrument::Sensors(read) => Channel::in_blocks(&read.channels(&self.scene.hexapod)),
            Instrument::Numbers(_) | Instrument::Balls(_) => Dataset::pose_blocks(),
        };
        Dataset {
            blocks,
            source: String::new(),
            measurand: self.scene.measurand(),
            columns: self.columns(),
            sequences: LoadSequences::default(),
            drawn_from: None,
            observations: Vec::new(),
        }
    }

    fn ideal(&self, part: &PlanPart<'_>, row: &PlanRow) -> Result<Ideal, TruthError> {
        if self.is_absolute() {
            return self.world.pose(&row.situation).map(|pose| [pose, pose]);
        }
        let earlier: Vec<Observation> = part.earlier(row).iter().map(PlanRow::unread).collect();
        let sequence = LoadSequence::to(&earlier, &row.unread()).unwrap_or_default();
        self.world.before_and_after_loads(&row.situation, &sequence)
    }

    /// Error of a reading; half of its variance is that of the reference where others share it.
    fn error(&self, noise: &InstrumentNoise, row: &PlanRow, part: PartName, rng: &mut Pcg64) -> Vector6 {
        let own = noise.draw(rng);
        let Some(record) = row.reference_record else { return own };
        let of_record = u64::try_from(record).unwrap_or_default();
        let mut rng = self.scene.streams().of(ScenePurpose::ReferenceNoise(part), of_record);
        (own + noise.draw(&mut rng)) * std::f64::consts::FRAC_1_SQRT_2
    }

    fn read(
        &self,
        part: PartName,
        row: &PlanRow,
        index: u64,
        ideal: Ideal,
        rng: &mut Pcg64,
    ) -> Result<Measured, TruthError> {
        if let Instrument::Sensors(read) = &self.scene.instrument {
            return Ok(self.sensed(read, row, index, &ideal, rng));
        }
        let (measured, sigma, records) = match &self.scene.instrument {
            Instrument::Sensors(_) => (Vector6::zeros(), None, Vec::new()),
            Instrument::Numbers(noise) => {
                let error =
                    if self.noise_free { Vector6::zeros() } else { self.error(noise, row, part, rng) };
                (self.numbers(ideal) + error, None, Vec::new())
            }
            Instrument::Balls(cmm) => {
                let (measured, sigma, records) = self.touched(cmm, row, ideal, rng)?;
                (measured, Some(sigma.into()), records)
            }
        };
        let sigma = sigma.map(|six: [f64; 6]| six.map(|s: f64| rounded(s * 1e6) / 1e6));
        let observation = row.read(index + 2, self.written(measured), sigma);
        Ok(Measured { observation, further: Vec::new(), records })
    }

    /// What sensors read, beside some of the six numbers.
    fn sensed(
        &self,
        read: &PoseNumbersRead,
        row: &PlanRow,
        index: u64,
        ideal: &Ideal,
        rng: &mut Pcg64,
    ) -> Measured {
        let hexapod = &self.scene.hexapod;
        let (pose, sensors) = (self.numbers(*ideal), read_sensors(hexapod, ideal));
        let mut of_sensors = sensors.into_iter();
        let mut number = |channel: Channel| {
            let exact = match channel {
                Channel::Pose(k) => pose[k],
                _ => of_sensors.next().unwrap_or_default(),
            };
            let sigma = read.sigma(channel, hexapod);
            let error: f64 = StandardNormal.sample(rng);
            let value = if self.noise_free { exact } else { exact + sigma * error };
            (rounded(value * 1e6) / 1e6, sigma)
        };
        let all: Vec<(f64, f64)> = read.channels(hexapod).into_iter().map(&mut number).collect();
        let observation = |(block, numbers): (usize, &[(f64, f64)])| {
            let (mut measured, mut sigma) = ([0.0; 6], [UNREAD; 6]);
            for (k, &(value, own)) in numbers.iter().enumerate() {
                (measured[k], sigma[k]) = (value, own);
            }
            Observation { block, ..row.read(index + 2, measured, Some(sigma)) }
        };
        let mut observations: Vec<Observation> = all.chunks(6).enumerate().map(observation).collect();
        let observation = observations.remove(0);
        Measured { observation, further: observations, records: Vec::new() }
    }

    fn numbers(&self, [before, after]: Ideal) -> Vector6 {
        if self.is_absolute() { self.frames.seen(&after).to_vector() } else { difference(&after, &before) }
    }

    /// Measured values, their standard deviations, and the records they come from.
    fn touched(
        &self,
        cmm: &Cmm,
        row: &PlanRow,
        [before, after]: Ideal,
        rng: &mut Pcg64,
    ) -> Result<(Vector6, Vector6, Vec<CmmRecord>), TruthError> {
        let quiet = self.noise_free.then(|| cmm.without_errors());
        let acting = quiet.as_ref().unwrap_or(cmm);
        let later = Surroundings { elapsed: row.situation.elapsed, delta_t: row.situation.delta_t };
        let mut touch = |pose, at| acting.record(&self.frames, pose, at, rng);
        let records = if self.is_absolute() {
            vec![touch(&after, later)]
        } else {
            vec![touch(&before, Surroundings::default()), touch(&after, later)]
        };
        let located = records.iter().map(|r| cmm.locate(r)).collect::<Result<Vec<_>, _>>()?;
        let variance = located.iter().map(|l| l.covariance.diagonal()).sum::<Vector6>();
        let values = match located.as_slice() {
            [first, second] => difference(&second.pose, &first.pose),
            all => all.first().map(|l| l.pose.to_vector()).unwrap_or_default(),
        };
        Ok((values, variance.map(f64::sqrt), records))
    }

    /// A value with the digits the files carry: 1 pm and 1 prad, for absolute poses 0.1 nm and 1e-9 deg.
    pub(super) fn written(&self, value: Vector6) -> [f64; 6] {
        let decimals = |k: usize, x: f64| match (self.is_absolute(), k < 3) {
            (false, _) => rounded(x * 1e6) / 1e6,
            (true, true) => (x * 1e10).round() / 1e10,
            (true, false) => ((x.to_degrees() * 1e9).round() / 1e9).to_radians(),
        };
        std::array::from_fn(|k| decimals(k, value[k]))
    }
}
