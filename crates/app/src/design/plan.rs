//! A plan as a table: the columns of measurements.csv that say what is set.

use hexbench_core::{Columns, Dataset, Measurand, Observation};
use hexbench_design::regressor::reading;
use hexbench_design::space::Conditions;
use hexbench_design::{Space, Visit};

use super::Designed;

impl Designed {
    /// The readings to be taken: poses in order, at each the settings in order, of each its repeats. Nothing is measured yet.
    pub fn readings_to_take(&self) -> Dataset {
        let columns = columns(&self.space.conditions);
        Dataset::of_poses("", Measurand::DeflectionEuler, columns, readings(&self.space, &self.visits))
    }
}

/// A column is there when the space says something about it.
fn columns(conditions: &Conditions) -> Columns {
    let usual = Conditions::default();
    Columns {
        reference: true,
        approach: conditions.approaches != usual.approaches,
        delta_t: conditions.delta_t != usual.delta_t,
        elapsed: conditions.waits != usual.waits,
        ..Columns::default()
    }
}

fn readings(space: &Space, visits: &[Visit]) -> Vec<Observation> {
    let settings = space.settings();
    let mut readings = Vec::new();
    for (pose_id, visit) in (1..).zip(visits) {
        for (setting, &count) in settings.iter().zip(&visit.counts) {
            let row = reading(visit.pose, setting);
            readings.extend((1..).take(count).map(|repeat| Observation { pose_id, repeat, ..row }));
        }
    }
    readings
}
