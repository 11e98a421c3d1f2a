//! The rows of a part of a plan, each from its number alone.

use super::{ScenePurpose, Streams};
use crate::campaign::{PlanRow, Scheme};

/// Which part of a plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PartName {
    /// Rows to learn from.
    Training,
    /// Rows to judge by.
    Holdout,
}

impl PartName {
    /// In messages.
    pub fn word(self) -> &'static str {
        match self {
            Self::Training => "training",
            Self::Holdout => "holdout",
        }
    }

    /// Name of its table.
    pub fn file(self) -> &'static str {
        match self {
            Self::Training => "measurements.csv",
            Self::Holdout => "holdout.csv",
        }
    }
}

/// Where the rows of a part come from.
#[derive(Debug, Clone, Copy)]
pub(super) enum Source<'a> {
    Scheme(&'a Scheme),
    Rows { rows: &'a [PlanRow], repeats: u64 },
}

/// A part of a plan.
#[derive(Debug, Clone, Copy)]
pub struct PlanPart<'a> {
    pub(super) name: PartName,
    pub(super) source: Source<'a>,
    pub(super) streams: Streams,
}

impl PlanPart<'_> {
    /// Which part it is.
    pub fn name(&self) -> PartName {
        self.name
    }

    /// Number of rows.
    pub fn len(&self) -> u64 {
        match self.source {
            Source::Scheme(scheme) => scheme.rows(),
            Source::Rows { rows, repeats } => rows.len() as u64 * repeats,
        }
    }

    /// True when there is no row.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of different poses.
    pub fn poses(&self) -> u64 {
        match self.source {
            Source::Scheme(scheme) => scheme.poses.count(),
            Source::Rows { rows, .. } => {
                let mut ids: Vec<i64> = rows.iter().map(|row| row.pose_id).collect();
                ids.sort_unstable();
                ids.dedup();
                ids.len() as u64
            }
        }
    }

    /// All rows in order.
    pub fn iter(&self) -> impl Iterator<Item = PlanRow> {
        (0..self.len()).filter_map(|index| self.row(index))
    }

    /// The row of an index; none beyond the last.
    pub fn row(&self, index: u64) -> Option<PlanRow> {
        match self.source {
            Source::Scheme(scheme) => (index < scheme.rows()).then(|| self.sampled(scheme, index)),
            Source::Rows { rows, repeats } => {
                let row = rows.get(usize::try_from(index / repeats).ok()?)?;
                let again = i64::try_from(index % repeats).ok()?;
                Some(PlanRow { repeat: if repeats == 1 { row.repeat } else { again + 1 }, ..*row })
            }
        }
    }

    fn sampled(&self, scheme: &Scheme, index: u64) -> PlanRow {
        let loads = scheme.loads.len() as u64;
        let (condition, repeat) = (index / scheme.repeats, index % scheme.repeats);
        let (pose_index, load) = (condition / loads, condition % loads);
        let pose = scheme.pose(pose_index, &mut self.streams.of(ScenePurpose::Pose(self.name), pose_index));
        let surroundings = ScenePurpose::Surroundings(self.name);
        let mut rng = self.streams.of(surroundings, if scheme.anew { index } else { condition });
        let wrench =
            usize::try_from(load).ok().and_then(|i| scheme.loads.get(i)).copied().unwrap_or_default();
        let mut situation = scheme.situation(pose, wrench, &mut rng);
        if scheme.in_sequence && load > 0 {
            situation.elapsed += self.sampled(scheme, index - scheme.repeats).situation.elapsed;
        }
        let from_one = |n: u64| i64::try_from(n).unwrap_or(i64::MAX - 1) + 1;
        let mut row = PlanRow::alone(from_one(pose_index), from_one(repeat), situation);
        scheme.place(&mut row, [pose_index, repeat, load]);
        row
    }

    /// The rows that come before one at its pose, in the sequence of loads.
    pub(super) fn earlier(&self, row: &PlanRow) -> Vec<PlanRow> {
        let Some(order) = row.order else { return Vec::new() };
        let before = |other: &PlanRow| other.order.is_some_and(|place| place < order);
        let is_here = |other: &PlanRow| other.situation.pose == row.situation.pose;
        let mut earlier: Vec<PlanRow> = match self.source {
            Source::Scheme(scheme) => {
                let rows = scheme.repeats * scheme.loads.len() as u64;
                let first = u64::try_from(row.pose_id - 1).unwrap_or_default() * rows;
                (first..first + rows).filter_map(|index| self.row(index)).filter(before).collect()
            }
            Source::Rows { rows, .. } => {
                let moved = rows.iter().filter(|r| before(r) && !is_here(r)).filter_map(|r| r.order).max();
                rows.iter().filter(|r| before(r) && r.order > moved).copied().collect()
            }
        };
        earlier.sort_by_key(|row| row.order);
        earlier
    }
}
