//! A study ready to run: designed plans are found, shards are counted.

use std::borrow::Cow;
use std::collections::BTreeMap;

use hexbench_core::{Hexapod, Pose};
use hexbench_design::{DesignError, Objective, Space};
use hexbench_truth::campaign::PlanRow;

use crate::error::ExperimentError;
use crate::harness::{Progress, Sharded};
use crate::journal::{Identity, Shards};
use crate::sweep::axes::{Noises, PlanSource};
use crate::sweep::bench;
use crate::sweep::cells::GridCell;
use crate::sweep::columns::{Status, TrialColumn, columns};
use crate::sweep::error::StudyError;
use crate::sweep::indices::{self, INDICES};
use crate::sweep::plan::designed_poses;
use crate::sweep::shard::Shard;
use crate::sweep::study::{STUDY_FILE, SweepStudy, SweepTask};
use crate::sweep::task::{diagnose, springs};

/// Format of the journal: of its records, and of how results are drawn and computed.
pub const FORMAT: &str = "study-journal/2";

/// What a designed plan depends on: geometry, plan, number of poses, and the noise where its two levels are given.
type DesignKey = (usize, usize, u64, usize);

/// A study with everything that is computed once.
pub struct Runner {
    study: SweepStudy,
    columns: Vec<TrialColumn>,
    designs: BTreeMap<DesignKey, Vec<Pose>>,
    /// Criteria of machines whose drawings are fixed, by geometry and noise.
    objectives: BTreeMap<[usize; 2], Vec<Objective>>,
}

impl Runner {
    /// Finds the designed plans of machines whose drawings are fixed.
    ///
    /// # Errors
    /// [`StudyError::Design`].
    pub fn new(study: SweepStudy) -> Result<Self, StudyError> {
        let (mut designs, mut objectives) = (BTreeMap::new(), BTreeMap::new());
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
        for index in (0..study.axes.cells()).filter(|_| study.indices) {
            let cell = study.axes.cell(index);
            if cell.geometry().is_fixed() && !objectives.contains_key(&objective_key(&cell)) {
                let (hexapod, _) = bench::machine_as_read(study.seed, &cell, 0);
                let space = bench::space(cell.geometry(), &hexapod);
                let ready = indices::objectives(&hexapod, &space, cell.sigmas());
                objectives.insert(objective_key(&cell), ready.map_err(|cause| not_planned(&cell, cause))?);
            }
        }
        let columns = columns(&study);
        Ok(Self { study, columns, designs, objectives })
    }

    /// The study.
    pub fn study(&self) -> &SweepStudy {
        &self.study
    }

    /// Results of a trial.
    pub fn columns(&self) -> &[TrialColumn] {
        &self.columns
    }

    /// Poses of a designed plan; empty for other plans.
    ///
    /// # Errors
    /// [`Status::NoPlan`] when a drawn machine has none.
    pub fn designed(
        &self,
        cell: &GridCell<'_>,
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

    /// Indices of a plan; none where the study does not ask for them.
    ///
    /// # Errors
    /// [`Status::NoPlan`] for a space or a pose that is singular.
    pub fn indices(
        &self,
        cell: &GridCell<'_>,
        hexapod: &Hexapod,
        space: &Space,
        rows: &[PlanRow],
    ) -> Result<Option<[f64; INDICES]>, Status> {
        if !self.study.indices {
            return Ok(None);
        }
        let known =
            self.objectives.get(&objective_key(cell)).map(|known| Ok(Cow::Borrowed(known.as_slice())));
        let own = || indices::objectives(hexapod, space, cell.sigmas()).map(Cow::Owned);
        let objectives = known.unwrap_or_else(own).map_err(|_| Status::NoPlan)?;
        let values = indices::values(&objectives, hexapod, rows, cell.sigmas());
        values.map(Some).map_err(|_| Status::NoPlan)
    }

    /// What decides to which part a shard belongs: its number; its cell where cells stop when they are decided, all of whose shards
    /// one part then has.
    pub fn place_of_shard(&self, shard: u64) -> u64 {
        match self.study.until {
            None => shard,
            Some(_) => self.study.place(self.shards().trials_of(shard).start).0 as u64,
        }
    }

    /// A shard whose results are still to come.
    pub fn empty(&self, shard: u64) -> Shard {
        Shard::empty(shard, self.shards().trials_of(shard), &self.columns)
    }
}

impl Sharded for Runner {
    fn identity(&self) -> Identity {
        Identity { name: STUDY_FILE, format: FORMAT, inputs: self.study.inputs.clone() }
    }

    fn shards(&self) -> Shards {
        Shards { trials: self.study.all_trials(), size: self.study.task.trials_of_a_shard() }
    }

    fn content(&self, shard: u64, progress: &dyn Progress) -> Result<Vec<u8>, ExperimentError> {
        let mut done = self.empty(shard);
        match self.study.task {
            SweepTask::Springs => springs::run(self, &mut done),
            SweepTask::Diagnose => diagnose::run(self, &mut done),
        }
        progress.advance(done.trials.end - done.trials.start);
        Ok(done.to_bytes())
    }
}

fn objective_key(cell: &GridCell<'_>) -> [usize; 2] {
    [cell.position[0], cell.position[7]]
}

fn not_planned(cell: &GridCell<'_>, cause: DesignError) -> StudyError {
    StudyError::Design {
        plan: cell.plan().name.clone(),
        poses: cell.poses().unwrap_or(1),
        geometry: cell.geometry().name.clone(),
        cause,
    }
}

fn design_key(cell: &GridCell<'_>) -> DesignKey {
    let by_noise = matches!(cell.axes.noise, Noises::Sigmas(_));
    let noise = if by_noise { cell.position[7] } else { 0 };
    (cell.position[0], cell.position[1], cell.poses().unwrap_or(0), noise)
}

fn design(
    study: &SweepStudy,
    cell: &GridCell<'_>,
    hexapod: &Hexapod,
    space: &Space,
) -> Result<Vec<Pose>, StudyError> {
    let PlanSource::Designed(criterion) = cell.plan().source else { return Ok(Vec::new()) };
    let noise = cell.noise();
    // A common factor of the noise moves no optimum: the level of the first value keeps the rounding equal too.
    let level = match &cell.axes.noise {
        Noises::Scales(_) => cell.axes.noise.noise(0, cell.geometry()),
        Noises::Sigmas(_) => noise,
    };
    let sigma = [level.sigma_translation, level.sigma_rotation];
    let poses = cell.poses().unwrap_or(1);
    designed_poses(criterion, poses, hexapod, space, sigma, study.starts)
        .map_err(|cause| not_planned(cell, cause))
}
