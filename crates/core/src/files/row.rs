//! From the cells of a line to an observation.

use super::FileProblem;
use super::columns::{
    APPROACH, DELTA_T, ELAPSED, Group, MEASURED, POSE, POSE_ID, REFERENCE, REPEAT, Row, SIGMA, WRENCH,
};
use super::header::{Plan, Source};
use crate::Approach;
use crate::{Observation, Pose, Wrench};
use std::f64::consts::TAU;

/// Largest whole number that every smaller one is kept apart from.
const LARGEST_WHOLE: f64 = 9_007_199_254_740_992.0;

/// Largest believable angle, rad: a full turn, and a rounding.
const LARGEST_ANGLE: f64 = TAU * (1.0 + 1e-12);

/// A row before its cells are read: the values of absent columns.
pub(crate) fn defaults() -> Row {
    let mut row = [0.0; super::columns::PLACES];
    row[APPROACH] = Approach::default().sign();
    row[REPEAT] = 1.0;
    row
}

/// Puts one number into its place, in SI, after checking it.
pub(crate) fn fill(row: &mut Row, source: &Source, value: f64) -> Result<(), FileProblem> {
    let si = source.unit.to_si(value);
    check(source, si)?;
    row[source.column.places.range()].fill(si);
    Ok(())
}

fn check(source: &Source, si: f64) -> Result<(), FileProblem> {
    use super::Dimension;
    match source.column.group {
        _ if !si.is_finite() => Err(FileProblem::TooLarge),
        Group::Number if si.fract() != 0.0 || si.abs() > LARGEST_WHOLE => Err(FileProblem::NotWhole),
        Group::Covariate if source.column.places.first == APPROACH && Approach::of_sign(si).is_none() => {
            Err(FileProblem::Approach)
        }
        Group::Sigma if si <= 0.0 => Err(FileProblem::Sigma),
        Group::Sigma | Group::Number | Group::Covariate => Ok(()),
        _ if source.column.kind == Dimension::Angle && si.abs() > LARGEST_ANGLE => {
            Err(FileProblem::AngleTooLarge { turns: si.abs() / TAU })
        }
        _ => Ok(()),
    }
}

/// The observation of a filled row.
pub(crate) fn observation(row: &Row, plan: &Plan, line: u64, running: i64) -> Observation {
    Observation {
        pose_id: if plan.has_pose { whole(row[POSE_ID]) } else { running },
        repeat: whole(row[REPEAT]),
        line,
        pose: Pose::from_array(six(row, POSE)),
        wrench: Wrench::from_array(six(row, WRENCH)),
        reference: Wrench::from_array(six(row, REFERENCE)),
        approach: Approach::of_sign(row[APPROACH]).unwrap_or_default(),
        delta_t: row[DELTA_T],
        elapsed: row[ELAPSED],
        measured: six(row, MEASURED),
        sigma: plan.columns.sigma.then(|| six(row, SIGMA)),
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "checked to be whole and below 2^53 when it was filled in"
)]
fn whole(value: f64) -> i64 {
    value as i64
}

fn six(row: &Row, first: usize) -> [f64; 6] {
    std::array::from_fn(|i| row[first + i])
}
