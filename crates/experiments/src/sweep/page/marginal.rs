//! Results by the value of an axis, all trials with that value taken together.
//!
//! The factorial is full: every value meets every combination of the others equally often, so that values may be compared. A value of
//! a range meets those of its point alone.

use crate::sweep::cells::{AXES, AxisLevels};
use crate::sweep::results::CellStatistics;
use crate::sweep::study::SweepStudy;

/// Results by the values of one axis, or of two.
#[derive(Debug, Clone, PartialEq)]
pub struct Marginal {
    /// The axis.
    pub axis: usize,
    /// The axis that tells its lines apart.
    pub group: Option<usize>,
    /// Results, group after group, value after value.
    pub groups: Vec<Vec<CellStatistics>>,
}

/// Indices of the axes with more than one value.
pub(super) fn varying(levels: &[AxisLevels; AXES]) -> Vec<usize> {
    (0..AXES).filter(|&k| levels[k].varies()).collect()
}

/// The axis whose values are drawn as lines over another: one of names before one of numbers, the plan first; at most six, and no range.
pub(super) fn group_of(study: &SweepStudy, levels: &[AxisLevels; AXES], axis: usize) -> Option<usize> {
    const MOST_LINES: usize = 6;
    const PLAN: usize = 1;
    let fits = |k: &usize| *k != axis && levels[*k].levels.len() <= MOST_LINES && !study.axes.is_ranged(*k);
    let rank = |k: &usize| (levels[*k].numbers().is_some(), *k != PLAN, *k);
    varying(levels).into_iter().filter(fits).min_by_key(rank)
}

/// Results by an axis, and by a group.
pub fn marginal(study: &SweepStudy, cells: &[CellStatistics], axis: usize, group: Option<usize>) -> Marginal {
    let levels = study.axes.levels();
    let lines = group.map_or(1, |g| levels[g].levels.len());
    let empty = || vec![CellStatistics::empty(0); levels[axis].levels.len()];
    let mut groups: Vec<Vec<CellStatistics>> = (0..lines).map(|_| empty()).collect();
    for cell in cells {
        let position = study.axes.cell(cell.cell).position;
        let place = &mut groups[group.map_or(0, |g| position[g])][position[axis]];
        *place = place.clone().and(cell);
    }
    Marginal { axis, group, groups }
}
