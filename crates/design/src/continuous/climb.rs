//! What one start moves: the free coordinates of poses and the chosen parts of loads, each scaled to 0..1 over its range.

use hexbench_core::{Hexapod, Pose, Vector6};
use nalgebra::DMatrix;

use super::ascent::{Ascent, Hill};
use crate::regressor::PoseRegressor;
use crate::space::{Loading, Slope};
use crate::{DesignError, Objective, Space};

/// Excess over a limit that rounding excuses.
pub(super) const SLACK: f64 = 1e-6;

/// A search from one start.
pub(crate) struct Climb<'a, R> {
    hexapod: &'a Hexapod,
    space: &'a Space,
    criterion: &'a Objective,
    known: Option<&'a DMatrix<f64>>,
    /// Readings of each pose.
    regressors: Vec<&'a R>,
    /// Where poses and loads begin; coordinates that are not free stay there.
    start: &'a [Pose],
    /// Indices of the pose coordinates that move.
    free: Vec<usize>,
    /// Changes of the loads of all settings with each chosen part.
    directions: Vec<Vec<Vector6>>,
    /// Readings that the value counts.
    readings: usize,
    /// Limits of one pose; none where poses stay.
    limits: usize,
}

/// A point of the search.
pub(crate) struct Reached {
    pub(crate) poses: Vec<Pose>,
    pub(crate) loads: Vec<Loading>,
    pub(crate) value: f64,
}

/// Poses and loads of a point, and the regressors under those loads where loads are chosen.
struct Point<R> {
    poses: Vec<Pose>,
    loads: Vec<Loading>,
    under: Vec<R>,
}

impl<'a, R: PoseRegressor> Climb<'a, R> {
    /// Of poses, which move within the space, and of its chosen loads; `regressors` has one for each pose.
    pub(crate) fn new(
        hexapod: &'a Hexapod,
        space: &'a Space,
        criterion: &'a Objective,
        regressors: Vec<&'a R>,
        start: &'a [Pose],
    ) -> Self {
        let (free, directions, known) = (space.free(), space.load_directions(), None);
        let readings = regressors.iter().map(|r| r.readings()).sum();
        let limits = start.first().map_or(0, |pose| space.limits(hexapod, pose).len());
        let limits = if free.is_empty() { 0 } else { limits };
        Self { hexapod, space, criterion, known, regressors, start, free, directions, readings, limits }
    }

    /// With information that is there without the poses, inputs included.
    pub(crate) fn beside(self, known: Option<&'a DMatrix<f64>>) -> Self {
        Self { known, ..self }
    }

    /// With poses that stay, valued as for one reading.
    pub(crate) fn of_loads(self) -> Self {
        Self { free: Vec::new(), readings: 1, limits: 0, ..self }
    }

    /// The nearest optimum from a start that keeps the limits; none when it determines nothing.
    ///
    /// What little the last step breaks of a limit is undone on the way back to the start.
    pub(crate) fn end(&self) -> Option<Reached> {
        let from = self.scaled();
        let end = if from.is_empty() { Vec::new() } else { Ascent::new(self).end(&from) };
        let point = self.point(&self.pulled_back(&from, &end));
        let value = self.criterion.value(&self.information(&point).ok()?, self.readings);
        (value > 0.0).then_some(Reached { poses: point.poses, loads: point.loads, value })
    }

    fn scaled(&self) -> Vec<f64> {
        let (low, high) = (self.space.low, self.space.high);
        let of_pose = |pose: &Pose| {
            let x = pose.to_array();
            self.free.iter().map(|&k| (x[k] - low[k]) / (high[k] - low[k])).collect::<Vec<_>>()
        };
        let poses = self.start.iter().flat_map(of_pose);
        poses.chain(self.space.load_shares(&self.space.loads)).collect()
    }

    /// Length of the part of a point that is about poses.
    fn of_poses(&self) -> usize {
        self.start.len() * self.free.len()
    }

    fn poses_at(&self, x: &[f64]) -> Vec<Pose> {
        let pose = |(k, start): (usize, &Pose)| {
            let mut pose = start.to_array();
            for (share, &i) in x[k * self.free.len()..].iter().zip(&self.free) {
                pose[i] = self.space.low[i] + share * (self.space.high[i] - self.space.low[i]);
            }
            Pose::from_array(pose)
        };
        self.start.iter().enumerate().map(pose).collect()
    }

    fn point(&self, x: &[f64]) -> Point<R> {
        let poses = self.poses_at(x);
        if self.directions.is_empty() {
            return Point { poses, loads: self.space.loads.clone(), under: Vec::new() };
        }
        let loads = self.space.loads_at(&x[self.of_poses()..]);
        let settings = self.space.settings_of(&loads);
        let under = self.regressors.iter().map(|r| r.under(&settings)).collect();
        Point { poses, loads, under }
    }

    /// Poses with their readings.
    fn read<'p>(&'p self, point: &'p Point<R>) -> impl Iterator<Item = (&'p Pose, &'p R)> {
        let regressor = |k: usize| point.under.get(k).unwrap_or(self.regressors[k]);
        point.poses.iter().enumerate().map(move |(k, pose)| (pose, regressor(k)))
    }

    fn information(&self, point: &Point<R>) -> Result<DMatrix<f64>, DesignError> {
        let n = self.regressors.first().map_or(0, |r| r.width());
        let mut information = self.known.cloned().unwrap_or_else(|| DMatrix::zeros(n, n));
        self.read(point).try_for_each(|(pose, regressor)| regressor.inform(pose, &mut information))?;
        Ok(information)
    }

    /// Limits of one pose with derivatives by its scaled free coordinates.
    fn limits_of(&self, pose: &Pose) -> Option<Vec<Slope>> {
        let mut limits = self.space.limit_slopes(self.hexapod, pose)?;
        for (_, slope) in &mut limits {
            *slope = std::array::from_fn(|j| {
                let span = |&k: &usize| slope[k] * (self.space.high[k] - self.space.low[k]);
                self.free.get(j).map_or(0.0, span)
            });
        }
        Some(limits)
    }

    /// The point nearest to `end` on the way back to the feasible `start` that keeps all limits, to a millionth of the way.
    fn pulled_back(&self, start: &[f64], end: &[f64]) -> Vec<f64> {
        const HALVINGS: usize = 40;
        let at =
            |share: f64| -> Vec<f64> { start.iter().zip(end).map(|(s, e)| s + share * (e - s)).collect() };
        let keeps = |x: &[f64]| {
            let kept = |p: &Pose| self.space.worst_limit(self.hexapod, p).is_none_or(|l| l.excess <= SLACK);
            self.free.is_empty() || self.poses_at(x).iter().all(kept)
        };
        if keeps(end) {
            return end.to_vec();
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            if keeps(&at(middle)) { low = middle } else { high = middle }
        }
        at(low)
    }

    /// Derivatives of `-ln value` by the scaled coordinates, from those of the value by the information.
    fn descend(
        &self,
        point: &Point<R>,
        value: f64,
        slope: &DMatrix<f64>,
        gradient: &mut [f64],
    ) -> Result<(), DesignError> {
        let (of_poses, of_loads) = gradient.split_at_mut(self.of_poses());
        if !self.free.is_empty() {
            for ((pose, regressor), part) in self.read(point).zip(of_poses.chunks_mut(self.free.len())) {
                let slopes = regressor.slopes(pose, slope)?;
                for (slope, &k) in part.iter_mut().zip(&self.free) {
                    *slope = -slopes[k] * (self.space.high[k] - self.space.low[k]) / value;
                }
            }
        }
        for (part, directions) in of_loads.iter_mut().zip(&self.directions) {
            let mut sum = 0.0;
            for (pose, regressor) in self.read(point) {
                sum += regressor.load_slope(pose, slope, directions)?;
            }
            *part = -sum / value;
        }
        Ok(())
    }
}

impl<R: PoseRegressor> Hill for Climb<'_, R> {
    fn size(&self) -> usize {
        self.of_poses() + self.directions.len()
    }

    fn limits(&self) -> usize {
        self.limits * self.start.len()
    }

    fn logarithm(&self, x: &[f64], gradient: Option<&mut [f64]>) -> Option<f64> {
        let point = self.point(x);
        let information = self.information(&point).ok()?;
        let Some(gradient) = gradient else {
            let value = self.criterion.value(&information, self.readings);
            return (value > 0.0).then(|| -value.ln());
        };
        let (value, slope) = self.criterion.gradient(&information, self.readings);
        if value <= 0.0 {
            return None;
        }
        self.descend(&point, value, &slope, gradient).ok()?;
        Some(-value.ln())
    }

    fn excesses(&self, x: &[f64]) -> Vec<f64> {
        if self.limits == 0 {
            return Vec::new();
        }
        let of = |pose: &Pose| match self.limits_of(pose) {
            Some(limits) => limits.into_iter().map(|(excess, _)| excess).collect(),
            None => vec![f64::INFINITY; self.limits],
        };
        self.poses_at(x).iter().flat_map(of).collect()
    }

    fn excess_slopes(&self, x: &[f64]) -> Vec<f64> {
        let (each, of_a_pose) = (self.free.len(), self.limits * x.len());
        let mut slopes = vec![0.0; of_a_pose * self.start.len()];
        if self.limits == 0 {
            return slopes;
        }
        for (k, (rows, pose)) in slopes.chunks_mut(of_a_pose).zip(self.poses_at(x)).enumerate() {
            for (row, (_, slope)) in rows.chunks_mut(x.len()).zip(self.limits_of(&pose).into_iter().flatten())
            {
                row[k * each..][..each].copy_from_slice(&slope[..each]);
            }
        }
        slopes
    }
}

#[cfg(test)]
mod tests;
