//! How the stiffness error grows with numbers: powers, by least squares on logarithms.
//!
//! ```text
//! rms error = factor * noise^a * poses^b * repeats^c
//! ```

use nalgebra::{DMatrix, DVector};

use crate::sweep::cells::{AXES, AxisLevels};
use crate::sweep::results::CellStatistics;
use crate::sweep::study::{SweepStudy, SweepTask};

/// A law of powers for the cells of one value of a group.
#[derive(Debug, Clone, PartialEq)]
pub struct PowerLaw {
    /// Value of the group, empty without one.
    pub group: String,
    /// Axes and their exponents.
    pub exponents: Vec<(&'static str, f64)>,
    /// Root mean square of what the law leaves over, as a share of the error.
    pub misfit: f64,
    /// Cells behind it.
    pub cells: usize,
}

/// Axes of numbers that may be raised to a power.
const PLAN: usize = 1;

/// One law for each plan, over all axes of positive numbers with more than one value.
pub fn laws(study: &SweepStudy, cells: &[CellStatistics]) -> Vec<PowerLaw> {
    let levels = study.axes.levels();
    let axes: Vec<usize> = (0..AXES).filter(|&k| is_scale(&levels[k])).collect();
    if study.task != SweepTask::Springs || axes.is_empty() {
        return Vec::new();
    }
    let plans = 0..levels[PLAN].levels.len();
    plans.filter_map(|plan| law(study, cells, &levels, &axes, plan)).collect()
}

fn is_scale(axis: &AxisLevels) -> bool {
    axis.varies() && axis.numbers().is_some_and(|all| all.iter().all(|x| *x > 0.0))
}

fn law(
    study: &SweepStudy,
    cells: &[CellStatistics],
    levels: &[AxisLevels; AXES],
    axes: &[usize],
    plan: usize,
) -> Option<PowerLaw> {
    let of_plan =
        |c: &&CellStatistics| study.axes.cell(c.cell).position[PLAN] == plan && c.springs.errors.rms() > 0.0;
    let kept: Vec<&CellStatistics> = cells.iter().filter(of_plan).collect();
    let value = |cell: &CellStatistics, axis: usize| {
        let level = study.axes.cell(cell.cell).position[axis];
        levels[axis].numbers().map_or(1.0, |numbers| numbers[level])
    };
    let a = DMatrix::from_fn(kept.len(), axes.len() + 1, |i, j| {
        if j == 0 { 1.0 } else { value(kept[i], axes[j - 1]).ln() }
    });
    let y = DVector::from_fn(kept.len(), |i, _| kept[i].springs.errors.rms().ln());
    if kept.len() < axes.len() + 2 {
        return None;
    }
    let x = a.tr_mul(&a).cholesky()?.solve(&a.tr_mul(&y));
    let misfit = ((&a * &x - y).norm_squared() / kept.len() as f64).sqrt();
    let exponents = axes.iter().enumerate().map(|(k, &axis)| (levels[axis].name, x[k + 1])).collect();
    Some(PowerLaw { group: levels[PLAN].levels[plan].text(), exponents, misfit, cells: kept.len() })
}
