//! The campaigns of trials.

use std::path::Path;

use hexbench_core::streams::{Purpose, derived_seed};
use hexbench_core::{Dataset, Hexapod};
use hexbench_truth::campaign::{CaseKind, SimulatedCase};
use hexbench_truth::scene::{Existing, PartName, VirtualBench};
use hexbench_truth::{Scene, TruthError};

use super::job::SIZES;
use super::{MisreadJob, MisreadProtocol, MisreadScene};
use crate::trial::TrialError;

/// A simulated campaign, its files as the trial has them.
#[derive(Debug)]
pub enum MisreadCampaign {
    /// Drawn as for the calibration.
    Case(Box<SimulatedCase>),
    /// Measured in a scene.
    Scene {
        /// The scene, its effects scaled.
        scene: Box<Scene>,
        /// Its effects over those of the scene as it is bundled.
        size: f64,
        /// Readings to learn from and held out.
        parts: Box<[Dataset; 2]>,
    },
}

/// The campaign of one trial by its name, such as `fz-negated/ring_a-clean-0000` or `sound/single-10x-0002`, as its files are written;
/// none of a name that is no trial.
pub fn case(name: &str, protocol: &MisreadProtocol) -> Option<Result<MisreadCampaign, TrialError>> {
    let written = |job: MisreadJob| {
        let mut campaign = job.meant(protocol.seed)?;
        job.write(&mut campaign)?;
        Ok(campaign)
    };
    MisreadJob::parse(name, &protocol.scenes).map(written)
}

impl MisreadCampaign {
    /// Machine, readings to learn from, readings held out.
    pub(super) fn files(&self) -> (&Hexapod, [&Dataset; 2]) {
        match self {
            Self::Case(case) => (&case.hexapod, [&case.measurements, &case.holdout]),
            Self::Scene { scene, parts, .. } => (&scene.hexapod, [&parts[0], &parts[1]]),
        }
    }

    /// Writes the files to a folder, which is made.
    ///
    /// # Errors
    /// [`TrialError::Truth`].
    pub fn write(&self, folder: &Path) -> Result<(), TrialError> {
        match self {
            Self::Case(case) => Ok(case.write(folder)?),
            Self::Scene { scene, .. } => {
                let written = VirtualBench::new(scene, false).write(folder, Existing::Replaced, &|_| ());
                Ok(written.map_err(|why| unread(folder, &why))?)
            }
        }
    }
}

fn unread(folder: &Path, why: &dyn ToString) -> TruthError {
    TruthError::File { path: folder.display().to_string(), why: why.to_string() }
}

impl MisreadJob {
    /// The campaign as it is meant.
    pub(super) fn meant(&self, seed: u64) -> Result<MisreadCampaign, TruthError> {
        let case = |case| MisreadCampaign::Case(Box::new(case));
        match self {
            Self::Misread { family, kind, index, .. } => {
                SimulatedCase::draw_on(family, *kind, *index, seed).map(case)
            }
            Self::Sound { kind, size, index } => sound(*kind, *size, *index, seed).map(case),
            Self::Scene { scene, size, index } => in_scene(scene, *size, *index, seed),
        }
    }

    /// Writes its files as the trial has it.
    pub(super) fn write(&self, campaign: &mut MisreadCampaign) -> Result<(), TruthError> {
        match (self, campaign) {
            (Self::Misread { entry, .. }, MisreadCampaign::Case(case)) => entry.apply(case),
            _ => Ok(()),
        }
    }
}

/// Effects of a size; of the next smaller one where no machine, plan or scene lets them be so large.
fn as_large<T>(size: u32, of_size: impl Fn(u32) -> Result<T, TruthError>) -> Result<T, TruthError> {
    let smaller = SIZES.into_iter().rev().filter(|s| *s < size);
    smaller.fold(of_size(size), |made, size| made.or_else(|_| of_size(size)))
}

fn sound(kind: CaseKind, size: u32, index: usize, seed: u64) -> Result<SimulatedCase, TruthError> {
    as_large(size, |size| {
        let distance = kind.usual_distance() * f64::from(size);
        SimulatedCase::draw(kind, index, seed, Some([distance; 2]))
    })
}

/// A scene with plan, surroundings and noise of another seed.
fn in_scene(scene: &MisreadScene, size: u32, index: usize, seed: u64) -> Result<MisreadCampaign, TruthError> {
    let seed = derived_seed(seed, Purpose::MisreadScene, [index as u64]);
    as_large(size, |size| {
        let size = f64::from(size);
        let mut scene = Scene::read_with_seed(&scene.folder, Some(seed))
            .map_err(|why| unread(&scene.folder, &why.message()))?;
        for effect in &mut scene.mechanisms {
            *effect = effect.scaled(size.min(effect.largest_factor()));
        }
        let bench = VirtualBench::new(&scene, false);
        let part = |name| bench.dataset(name).map_err(|row| row.cause);
        let parts = Box::new([part(PartName::Training)?, part(PartName::Holdout)?]);
        Ok(MisreadCampaign::Scene { scene: Box::new(scene), size, parts })
    })
}
