//! What the plan of a cell costs: readings, and hours where the study says what the parts cost.

use hexbench_design::Budget;
use hexbench_design::space::{Loading, Setting};
use hexbench_truth::campaign::PlanRow;

use crate::sweep::bench;
use crate::sweep::cells::GridCell;
use crate::sweep::runner::Runner;

/// Cost of a plan; the lower one is the cheaper.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct PlanCost {
    /// Time, h; none where the study states no costs.
    pub hours: Option<f64>,
    /// Readings, each a deflection.
    pub readings: usize,
}

impl PlanCost {
    /// Of the first plan that is drawn for a cell; none where none can be drawn.
    pub fn of(runner: &Runner, cell: &GridCell<'_>) -> Option<Self> {
        let rows = bench::training_rows(runner, cell, 0).ok()?;
        let hours = runner.study().cost.map(|budget| time(&budget, &rows) / 3600.0);
        Some(Self { hours, readings: rows.len() })
    }
}

/// How a reading of a plan is set.
pub fn setting(row: &PlanRow) -> Setting {
    let s = &row.situation;
    Setting {
        loading: Loading { reference: s.reference, load: s.wrench },
        approach: s.approach,
        delta_t: s.delta_t,
        elapsed: s.elapsed,
    }
}

fn time(budget: &Budget, rows: &[PlanRow]) -> f64 {
    let mut poses: Vec<i64> = rows.iter().map(|row| row.pose_id).collect();
    poses.sort_unstable();
    poses.dedup();
    let settings: Vec<Setting> = rows.iter().map(setting).collect();
    budget.time(poses.len(), &settings)
}
