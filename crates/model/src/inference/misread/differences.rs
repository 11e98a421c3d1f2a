//! Absolute poses as deflections: what the loads at a pose do to it, wherever frames and joints are.
//!
//! Of readings `Y = M X T` under several loads at one commanded pose the differences are deflections. Errors of joints and of the
//! controller, which are far larger, drop out, and with the mean over the loads as the reference state
//!
//! ```text
//! X_i - mean X = H P diag(P' (W_i - mean W)) c
//! ```
//!
//! holds to first order. So whatever tells a misread file of deflections by its loads tells one of absolute poses.

use std::borrow::Cow;
use std::collections::HashMap;

use hexbench_core::{
    Columns, Dataset, Hexapod, LoadSequences, Measurand, Observation, Vector6, Wrench, spread_of,
};

use super::sample::like;
use crate::estimation::campaign::row_sigma;
use crate::estimation::frames::Frames;
use crate::estimation::noise::{Noise, stated_or_repeated};

/// Rows from which the frames are found.
const ROWS_OF_FRAMES: usize = 480;

/// Deflections as they are; absolute poses as differences from the mean of each pose, none where no pose was measured under two loads.
pub(crate) fn as_deflections<'a>(hexapod: &Hexapod, data: &'a Dataset) -> Option<Cow<'a, Dataset>> {
    if !data.is_absolute() {
        return Some(Cow::Borrowed(data));
    }
    let frames = Frames::closest(hexapod, &spread_of(&data.observations, ROWS_OF_FRAMES).collect::<Vec<_>>());
    let noise = stated_or_repeated(hexapod, data).filter(Noise::is_stated);
    let at_poses = at_poses(&data.observations);
    let mut observations: Vec<Observation> = at_poses
        .iter()
        .filter(|rows| is_loaded(rows))
        .flat_map(|rows| about_mean(rows, &frames, noise))
        .collect();
    observations.sort_by_key(|row| row.line);
    let columns = Columns {
        reference: true,
        approach: false,
        overload: false,
        reference_age: false,
        reference_record: false,
        order: false,
        sigma: noise.is_some(),
        ..data.columns
    };
    let (measurand, sequences) = (Measurand::DeflectionRotationVector, LoadSequences::default());
    (!observations.is_empty())
        .then(|| Cow::Owned(Dataset { measurand, columns, sequences, observations, ..like(data) }))
}

/// Rows of each commanded pose, in order of first appearance.
pub(super) fn at_poses(rows: &[Observation]) -> Vec<Vec<&Observation>> {
    let mut known: HashMap<[u64; 6], usize> = HashMap::new();
    let mut all: Vec<Vec<&Observation>> = Vec::new();
    for row in rows {
        let place = *known.entry(row.pose.bits()).or_insert(all.len());
        if place == all.len() {
            all.push(Vec::new());
        }
        all[place].push(row);
    }
    all
}

/// True for several loads.
fn is_loaded(rows: &[&Observation]) -> bool {
    rows.iter().any(|row| row.wrench != rows[0].wrench)
}

/// Readings of one pose less their mean, as those of the platform in the fixed frame.
fn about_mean(rows: &[&Observation], frames: &Frames, noise: Option<Noise>) -> Vec<Observation> {
    let count = rows.len() as f64;
    let first = frames.platform(&rows[0].measured);
    let motion = |row: &&Observation| {
        let there = frames.platform(&row.measured);
        let shift = there.translation.vector - first.translation.vector;
        let turn = (there.rotation * first.rotation.inverse()).scaled_axis();
        Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z)
    };
    let motions: Vec<Vector6> = rows.iter().map(motion).collect();
    let mean = motions.iter().sum::<Vector6>() / count;
    let load = rows.iter().map(|row| row.wrench.to_vector()).sum::<Vector6>() / count;
    let delta_t = rows.iter().map(|row| row.delta_t).sum::<f64>() / count;
    let arm = frames.target.translation.vector.norm();
    // A mean holds a share of each reading.
    let less = (1.0 - count.recip()).sqrt();
    let sigma = |row: &Observation| {
        let own = row_sigma(row, noise.as_ref()?);
        let turn = own[3..].iter().fold(0.0_f64, |a, b| a.max(*b));
        Some(std::array::from_fn(|k| less * if k < 3 { own[k].hypot(arm * turn) } else { own[k] }))
    };
    let deflection = |(row, motion): (&&Observation, &Vector6)| Observation {
        reference: Wrench::from_array(load.into()),
        measured: (motion - mean).into(),
        sigma: sigma(row),
        delta_t: row.delta_t - delta_t,
        reference_age: None,
        reference_record: None,
        order: None,
        ..**row
    };
    rows.iter().zip(&motions).map(deflection).collect()
}

#[cfg(test)]
mod tests {
    use hexbench_core::{Pose, Wrench};

    use super::*;

    #[test]
    fn poses_that_differ_by_the_sign_of_a_zero_are_one() {
        let row = |a: f64| {
            let pose = Pose::from_array([a, 0.1, 0.0, 0.0, 0.0, 0.0]);
            Observation::unread(pose, Wrench::from_array([0.0; 6]), Wrench::from_array([0.0; 6]))
        };
        let counts: Vec<usize> = at_poses(&[row(0.0), row(0.2), row(-0.0)]).iter().map(Vec::len).collect();
        assert_eq!(counts, [2, 1]);
    }
}
