//! A measurement campaign as the model sees it: readings averaged per condition, with leg geometry.
//!
//! Averaging readings that share every input is exact for least squares: the mean carries all the information on
//! the model, the scatter about it (pure error) only on the noise.

mod condition;
mod readings;
mod seen;

use std::sync::Arc;

use hexbench_core::{
    Channel, Columns, Dataset, Hexapod, Matrix6, Measurand, NumberKind, Observation, StatedTolerances, UNREAD,
};
use nalgebra::{DMatrix, DVector, SMatrix};

pub use self::condition::{Condition, LoadPath, LoadState, PastState};
use self::readings::group;
pub use self::readings::{ConditionReadings, count_conditions, row_sigma};
use crate::error::ModelError;
use crate::estimation::equilibrium::Tangents;
use crate::estimation::frames::{Frames, ReadingAxes};
use crate::estimation::linearization::ModelPoint;
use crate::estimation::noise::{Noise, NoiseLevel, NoiseSource, Structure, stated_or_repeated};
use crate::estimation::reading_weights::freed_of;
use crate::estimation::whitening::Inexact;
use crate::machine::geometry::Machine;

/// A noise level known as well as this is exact for every probability; beyond it differences of evidence lose their digits.
const EXACT_NOISE: f64 = 1e-4;

/// Relative difference of noise levels that are equal.
const ROUNDING: f64 = 1e-9;

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
        Self::of_groups(&like, groups).freed_of_correlation()
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

    /// With the correlation of the numbers of every group, where the noise has one.
    fn freed_of_correlation(mut self) -> Result<Self, ModelError> {
        match self.noise.structure {
            Structure::Axes { covariance } => {
                let freed = freed_of(&covariance.matrix());
                self.groups.iter_mut().for_each(|group| group.freed.clone_from(&freed));
            }
            Structure::Loads { scatter, response } => {
                self.free_of_motions(|at| response.motion(at) * scatter.of(&at.wrench.to_vector()))?;
            }
            Structure::Lengths { strain } => {
                self.free_of_motions(|at| at.legs.platform_jacobian * at.legs.lengths * strain)?;
            }
            _ => {}
        }
        Ok(self)
    }

    /// Frees readings of motions that differ from condition to condition: of twists at the mobile origin, per standard deviation of each.
    fn free_of_motions<const N: usize>(
        &mut self,
        motions: impl Fn(&Condition) -> SMatrix<f64, 6, N>,
    ) -> Result<(), ModelError> {
        let start = ModelPoint::start(self);
        let conditions = self.conditions(&start.machine, &start.compliances, &[], Tangents::ForFit)?;
        for (group, at) in self.groups.iter_mut().zip(&conditions) {
            let s = at.weights.of(at.observer * motions(at));
            group.freed = freed_of(&(Matrix6::identity() + s * s.transpose()));
        }
        Ok(())
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
            Some(all) => {
                let rows = rows_of(groups.iter().copied());
                part.with_inexact(all.columns.select_rows(&rows), Arc::clone(&all.machine))
            }
            None => part,
        }
    }

    /// These readings and later ones of the same machine and instrument, which share no error with them.
    #[must_use]
    pub(crate) fn followed_by(&self, later: &Self) -> Self {
        let records = self.groups.iter().map(|g| g.record + 1).max().unwrap_or(0);
        let lines = self.groups.iter().map(|g| g.mean.line).max().unwrap_or(0);
        let mut groups = self.groups.clone();
        groups.extend(later.groups.iter().zip(lines + 1..).map(|(group, line)| ConditionReadings {
            mean: Observation { line, ..group.mean },
            record: records + group.record,
            ..group.clone()
        }));
        self.with_groups(groups)
    }

    /// Some of the groups with nothing in common between their readings, each weighed by what is its own.
    pub(crate) fn unwhitened_part(&self, groups: &[usize]) -> Self {
        self.chosen(groups).unwhitened()
    }

    /// Some groups, each weighed by the noise of its own numbers, their inputs exact.
    pub(crate) fn chosen(&self, groups: &[usize]) -> Self {
        self.with_groups(groups.iter().map(|&g| self.groups[g].clone()).collect())
    }

    fn with_groups(&self, groups: Vec<ConditionReadings>) -> Self {
        let (measurand, columns, noise, frames) = (self.measurand, self.columns, self.noise, self.frames);
        let like = Like { hexapod: &self.hexapod, measurand, columns, blocks: &self.blocks, noise, frames };
        // What a condition is taken for does not depend on the others.
        Self { reads_poses: self.reads_poses, ..Self::of_groups(&like, groups) }
    }

    /// The same with inputs known to a tolerance only: what a standard deviation of each does to every reading over the standard
    /// deviation of its own noise, six rows for each group, on this machine.
    #[must_use]
    pub(crate) fn with_inexact(mut self, columns: DMatrix<f64>, machine: Arc<ModelPoint>) -> Self {
        self.inexact = Inexact::of(&self.groups, &self.noise, columns, machine).map(Arc::new);
        self
    }

    /// The same with nothing in common between its readings or their numbers, each weighed by what is its own.
    #[must_use]
    pub(crate) fn unwhitened(mut self) -> Self {
        self.groups.iter_mut().for_each(|group| group.freed = None);
        self.noise = self.noise.independent();
        self.inexact = None;
        self
    }

    /// The same with every reading weighed by all of its noise, as if nothing were shared.
    #[must_use]
    pub fn independent(mut self) -> Self {
        for group in &mut self.groups {
            let own = group.own_deviations();
            group.sigma = std::array::from_fn(|k| own[k].hypot(group.shared[k]));
            (group.shared, group.freed) = ([0.0; 6], None);
        }
        self.noise = self.noise.independent();
        self.inexact = None;
        self
    }

    /// Standard deviation of what is its own over that of all of the noise, of every averaged number.
    pub(crate) fn own_shares(&self) -> DVector<f64> {
        let of_group = |g: &ConditionReadings| -> [f64; 6] {
            std::array::from_fn(|k| g.sigma[k] / g.sigma[k].hypot(g.shared[k]))
        };
        DVector::from_iterator(6 * self.groups.len(), self.groups.iter().flat_map(of_group))
    }

    /// Averaged numbers that were read.
    pub(crate) fn averaged_numbers(&self) -> f64 {
        self.groups.iter().map(ConditionReadings::numbers).sum::<usize>() as f64
    }

    /// What repeats and the statement tell of the noise level. Repeats that share an error tell nothing of its size.
    pub fn noise_level(&self) -> NoiseLevel {
        let stated = self.stated_level();
        if self.noise.source == NoiseSource::Repeats {
            return stated;
        }
        let (repeats, dof) = match self.noise.structure {
            Structure::Independent | Structure::Loads { .. } | Structure::Lengths { .. } => {
                (self.pure_error, self.pure_error_dof)
            }
            _ => (0.0, 0.0),
        };
        NoiseLevel { sum: stated.sum + repeats, dof: stated.dof + dof }
    }

    /// What the statement alone tells of the noise level; of a level that comes from repeats, what those do.
    pub fn stated_level(&self) -> NoiseLevel {
        let worth = match self.noise.source {
            NoiseSource::Repeats => self.noise.dof,
            NoiseSource::Residuals => 0.0,
            // A chi-square of so many degrees of freedom scatters as much as the stated standard deviation may.
            NoiseSource::Columns | NoiseSource::Sensors | NoiseSource::Metrology => {
                0.5 / self.hexapod.tolerances.noise.max(EXACT_NOISE).powi(2)
            }
        };
        NoiseLevel { sum: worth, dof: worth }
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

    /// True where the noise is the one stated in `[metrology]`.
    pub fn has_noise_of_metrology(&self) -> bool {
        let Some(stated) = self.hexapod.metrology else { return false };
        let levels = [
            (stated.sigma_translation, self.noise.translation),
            (stated.sigma_rotation, self.noise.rotation),
        ];
        levels.into_iter().all(|(stated, used)| (used / stated - 1.0).abs() <= ROUNDING)
    }

    /// True where the noise is no longer the one stated in `[metrology]`: the findings have changed it.
    pub fn has_adjusted_noise(&self) -> bool {
        self.noise.source == NoiseSource::Metrology
            && self.hexapod.metrology.is_some()
            && !self.has_noise_of_metrology()
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

#[cfg(test)]
mod tests;
