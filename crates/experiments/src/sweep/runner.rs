//! A study ready to run: designed plans are found, shards are counted.

use std::borrow::Cow;
use std::collections::BTreeMap;

use hexbench_core::{Hexapod, Pose};
use hexbench_design::Space;

use crate::sweep::axes::{Noises, PlanSource};
use crate::sweep::bench;
use crate::sweep::cells::Cell;
use crate::sweep::columns::{Column, Status, columns};
use crate::sweep::error::StudyError;
use crate::sweep::plan::designed_poses;
use crate::sweep::shard::Shard;
use crate::sweep::study::{Study, Task};
use crate::sweep::task::{diagnose, springs};

/// What a designed plan depends on: geometry, plan, poses, and the noise where its two levels are given.
type DesignKey = [usize; 4];

/// A study with everything that is computed once.
pub struct Runner {
    study: Study,
    columns: Vec<Column>,
    designs: BTreeMap<DesignKey, Vec<Pose>>,
}

impl Runner {
    /// Finds the designed plans of machines whose drawings are fixed.
    ///
    /// # Errors
    /// [`StudyError::Design`].
    pub fn new(study: Study) -> Result<Self, StudyError> {
        let mut designs = BTreeMap::new();
        for index in 0..study.axes.cells() {
            let cell = study.axes.cell(index);
            let key = design_key(&cell);
            let wanted = matches!(cell.plan().source, PlanSource::Designed(_)) && cell.geometry().is_fixed();
            if wanted && !designs.contains_key(&key) {
                let hexapod = bench::drawings(study.seed, &cell);
                let space = bench::space(cell.geometry(), &hexapod);
                designs.insert(key, design(&study, &cell, &hexapod, &space)?);
            }
        }
        let columns = columns(study.task);
        Ok(Self { study, columns, designs })
    }

    /// The study.
    pub fn study(&self) -> &Study {
        &self.study
    }

    /// Results of a trial.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Number of shards.
    pub fn shards(&self) -> u64 {
        self.study.all_trials().div_ceil(self.study.task.trials_of_a_shard())
    }

    /// Trials of a shard.
    pub fn trials_of(&self, shard: u64) -> std::ops::Range<u64> {
        let size = self.study.task.trials_of_a_shard();
        shard * size..((shard + 1) * size).min(self.study.all_trials())
    }

    /// Poses of a designed plan; empty for other plans.
    ///
    /// # Errors
    /// [`Status::NoPlan`] when a drawn machine has none.
    pub fn designed(
        &self,
        cell: &Cell<'_>,
        hexapod: &Hexapod,
        space: &Space,
    ) -> Result<Cow<'_, [Pose]>, Status> {
        if !matches!(cell.plan().source, PlanSource::Designed(_)) {
            return Ok(Cow::Borrowed(&[]));
        }
        match self.designs.get(&design_key(cell)) {
            Some(poses) => Ok(Cow::Borrowed(poses)),
            None => design(&self.study, cell, hexapod, space).map(Cow::Owned).map_err(|_| Status::NoPlan),
        }
    }

    /// Computes a shard: a pure function of the study and the number.
    pub fn run(&self, shard: u64) -> Shard {
        let mut done = Shard::empty(shard, self.trials_of(shard), &self.columns);
        match self.study.task {
            Task::Springs => springs::run(self, &mut done),
            Task::Diagnose => diagnose::run(self, &mut done),
        }
        done
    }
}

fn design_key(cell: &Cell<'_>) -> DesignKey {
    let by_noise = matches!(cell.axes.noise, Noises::Sigmas(_));
    [cell.position[0], cell.position[1], cell.position[2], if by_noise { cell.position[7] } else { 0 }]
}

fn design(study: &Study, cell: &Cell<'_>, hexapod: &Hexapod, space: &Space) -> Result<Vec<Pose>, StudyError> {
    let PlanSource::Designed(criterion) = cell.plan().source else { return Ok(Vec::new()) };
    let noise = cell.noise();
    // A common factor of the noise moves no optimum: the level of the first value keeps the rounding equal too.
    let level = match &cell.axes.noise {
        Noises::Scales(_) => cell.axes.noise.noise(0, cell.geometry()),
        Noises::Sigmas(_) => noise,
    };
    let sigma = [level.sigma_translation, level.sigma_rotation];
    let poses = cell.poses().unwrap_or(1);
    designed_poses(criterion, poses, hexapod, space, sigma, study.starts).map_err(|cause| {
        StudyError::Design {
            plan: cell.plan().name.clone(),
            poses,
            geometry: cell.geometry().name.clone(),
            cause,
        }
    })
}
