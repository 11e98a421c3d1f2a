//! What small errors of the inputs do to every averaged reading. Readings that are left out leave those of other conditions as they
//! are, and with them their slopes.

use std::collections::HashMap;

use hexbench_core::{Dataset, Observation, Pose};
use nalgebra::{DMatrix, DVector};

use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::linearization::{ModelPoint, own_residuals};
use crate::estimation::tolerances::{InputKind, input_columns};

/// Steps of a commanded pose for its derivatives, m and rad.
const POSE_STEP: [f64; 6] = [1e-5, 1e-5, 1e-5, 1e-4, 1e-4, 1e-4];

/// Slopes at every condition of a campaign, six rows each, over the standard deviations of its averaged numbers.
pub(super) struct Slopes {
    /// Place of a condition by the lines of its readings.
    places: HashMap<Vec<u64>, usize>,
    /// By a standard deviation of every input.
    pub(super) inputs: DMatrix<f64>,
    /// By a unit of every component of the commanded poses; none where a pose beside one is singular.
    pub(super) by_pose: Option<DMatrix<f64>>,
}

impl Slopes {
    /// Of a campaign with independent errors. `before`: those of the same readings, of the same noise, and of more of them.
    ///
    /// # Errors
    /// As [`input_columns`].
    pub(super) fn of(
        data: &Dataset,
        campaign: &Campaign,
        point: &ModelPoint,
        before: Option<Self>,
    ) -> Result<Self, ModelError> {
        let line = |&row: &u32| data.observations[row as usize].line;
        let lines: Vec<Vec<u64>> =
            campaign.groups.iter().map(|group| group.rows.iter().map(line).collect()).collect();
        // Sensors have columns of their own, as long as any of their readings is left.
        let reads_poses = |known: &Self| known.inputs.ncols() == InputKind::COLUMNS && campaign.reads_poses;
        let slopes = match before.filter(reads_poses) {
            Some(known) => known.with_more(campaign, point, &lines)?,
            None => (inputs(campaign, point)?, by_pose(campaign, point)),
        };
        let places = lines.into_iter().enumerate().map(|(place, lines)| (lines, place)).collect();
        Ok(Self { places, inputs: slopes.0, by_pose: slopes.1 })
    }

    /// Slopes of other conditions, by the lines of their readings, of which most are known.
    fn with_more(
        self,
        campaign: &Campaign,
        point: &ModelPoint,
        lines: &[Vec<u64>],
    ) -> Result<(DMatrix<f64>, Option<DMatrix<f64>>), ModelError> {
        let known: Vec<Option<usize>> = lines.iter().map(|lines| self.places.get(lines).copied()).collect();
        let new: Vec<usize> = (0..known.len()).filter(|&g| known[g].is_none()).collect();
        let part = campaign.unwhitened_part(&new);
        let (more, more_by_pose) = if new.is_empty() {
            // Nothing to linearize.
            (self.inputs.rows(0, 0).into_owned(), Some(DMatrix::zeros(0, POSE_STEP.len())))
        } else {
            (inputs(&part, point)?, by_pose(&part, point))
        };
        let by_pose = self.by_pose.zip(more_by_pose);
        let by_pose = by_pose.map(|(all, more)| gathered(&all, &more, &known));
        Ok((gathered(&self.inputs, &more, &known), by_pose))
    }
}

/// Six rows for each condition: the known ones from their place, the others in turn.
fn gathered(known: &DMatrix<f64>, more: &DMatrix<f64>, places: &[Option<usize>]) -> DMatrix<f64> {
    let mut all = DMatrix::zeros(6 * places.len(), known.ncols());
    let mut next = 0;
    for (g, place) in places.iter().enumerate() {
        let (from, first) = place.map_or((more, next), |place| (known, place));
        next += usize::from(place.is_none());
        all.rows_mut(6 * g, 6).copy_from(&from.rows(6 * first, 6));
    }
    all
}

fn inputs(campaign: &Campaign, point: &ModelPoint) -> Result<DMatrix<f64>, ModelError> {
    input_columns(campaign, point, &campaign.hexapod.tolerances)
}

fn by_pose(campaign: &Campaign, point: &ModelPoint) -> Option<DMatrix<f64>> {
    let at = |k: usize, step: f64| {
        let moved = |_, o: &Observation| {
            let mut pose = o.pose.to_array();
            pose[k] += step;
            Observation { pose: Pose::from_array(pose), ..*o }
        };
        own_residuals(campaign, point, moved).ok()
    };
    let slope = |k: usize| {
        let (plus, minus) = (at(k, POSE_STEP[k])?, at(k, -POSE_STEP[k])?);
        // A residual falls as the prediction rises.
        Some((minus - plus) / (2.0 * POSE_STEP[k]))
    };
    let columns: Vec<DVector<f64>> = (0..POSE_STEP.len()).map(slope).collect::<Option<_>>()?;
    Some(DMatrix::from_columns(&columns))
}

#[cfg(test)]
mod tests {
    use hexbench_core::Measurand;

    use super::*;
    use crate::test_machine::readings;

    #[test]
    fn slopes_of_some_of_the_readings_are_those_of_a_file_of_them() {
        let (hexapod, mut data) = readings(Measurand::DeflectionRotationVector, Vec::new());
        // Every condition is read twice.
        for mut again in data.observations.clone() {
            again.line += 100;
            again.measured[2] += 1e-6;
            data.observations.push(again);
        }
        let campaign = |data: &Dataset| Campaign::new(&hexapod, data).unwrap();
        let all = campaign(&data);
        let mut point = ModelPoint::start(&all);
        point.compliances.fill(1e-7);
        let mut known = Slopes::of(&data, &all, &point, None).unwrap();
        // One of two readings, both readings, and nothing.
        for left_out in [vec![3], vec![6, 106], vec![]] {
            data.observations.retain(|o| !left_out.contains(&o.line));
            let rest = Campaign::with_noise(&hexapod, &data, all.noise).unwrap();
            known = Slopes::of(&data, &rest, &point, Some(known)).unwrap();
            let anew = Slopes::of(&data, &rest, &point, None).unwrap();
            assert_eq!((&known.inputs, &known.by_pose), (&anew.inputs, &anew.by_pose), "{left_out:?}");
        }
    }
}
