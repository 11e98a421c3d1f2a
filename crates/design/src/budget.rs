//! What a plan may cost.
//!
//! ```text
//! time = pose_change * poses + sum over readings (load_change * changes + elapsed + reading)
//! ```
//!
//! A reading is a deflection: read the reference, change the load, wait, read again. With approach -1 the load is first
//! exceeded: two changes. Every reading is loaded for by itself, as `elapsed_s` and `approach` say; readings at one pose follow
//! each other.

use crate::space::Setting;
use hexbench_core::Approach;

/// Most that a plan may cost, and what its parts cost. SI units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Budget {
    /// Most readings or longest time; none: as asked for.
    pub limit: Option<Amount>,
    /// Time to read a deflection once the load rests, s.
    pub reading: f64,
    /// Time of one change of load, s.
    pub load_change: f64,
    /// Time of one change of pose, s.
    pub pose_change: f64,
}

/// In what a budget is counted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Amount {
    /// Number of readings.
    Readings(usize),
    /// Time, s.
    Time(f64),
}

impl Budget {
    /// Time of one reading without the change of pose, s.
    pub fn time_of(&self, setting: &Setting) -> f64 {
        let changes = match setting.approach {
            Approach::Direct => 1.0,
            Approach::Overloaded => 2.0,
        };
        changes * self.load_change + setting.elapsed + self.reading
    }

    /// Time of a whole plan, s.
    pub fn time<'s>(&self, poses: usize, readings: impl IntoIterator<Item = &'s Setting>) -> f64 {
        self.pose_change * poses as f64 + readings.into_iter().map(|s| self.time_of(s)).sum::<f64>()
    }
}
