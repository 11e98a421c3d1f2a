//! A table of states of rest: what was done, and where the simulated world came to rest.

use hexbench_core::files::CsvText;
use hexbench_core::{Channel, Columns, Dataset, Hexapod, Measurand, Observation, Pose};
use hexbench_truth::campaign::PlanRow;
use hexbench_truth::equilibrium::Equilibrium;
use hexbench_truth::scene::PartName;

use crate::csv::{self, Unit};

/// Rows of the table, each with its model file and its rest.
#[derive(Debug, Default)]
pub(crate) struct States {
    rows: Vec<State>,
}

#[derive(Debug)]
struct State {
    condition: Observation,
    part: PartName,
    model: String,
    pose: Pose,
    forces: [f64; 6],
    sensors: Vec<f64>,
}

impl States {
    /// Adds a state; the pose is that of the platform itself, not what an instrument reads. `sensors`: loaded minus reference.
    pub(crate) fn push(
        &mut self,
        (part, row): (PartName, &PlanRow),
        model: &str,
        rest: &Equilibrium,
        sensors: Vec<f64>,
    ) {
        self.rows.push(State {
            condition: row.read(0, [0.0; 6], None),
            part,
            model: model.to_owned(),
            pose: Pose::from_rotation(rest.platform.origin, &rest.platform.axes),
            forces: rest.forces,
            sensors,
        });
    }

    /// The table as CSV: conditions, part, model, resting pose, leg forces (tension positive), sensors.
    pub(crate) fn csv(&self, hexapod: &Hexapod, source: &str) -> String {
        let columns =
            Columns { reference: true, approach: true, delta_t: true, elapsed: true, ..Columns::default() };
        let dataset = Dataset::of_poses(source, Measurand::AbsolutePose, columns, Vec::new());
        let pose = csv::names("rest_", &dataset.measurand.names(), [Unit::Mm, Unit::Deg]);
        let conditions = csv::condition_columns(&dataset);
        let what = ["part", "model"].map(str::to_owned);
        let forces = (1..=6).map(|leg| format!("force_{leg}_N"));
        let channels = Channel::all([], &hexapod.sensors);
        let read = channels.iter().map(|c| c.column(&hexapod.sensors, dataset.measurand));
        let mut text = CsvText::new(conditions.names().chain(what).chain(pose).chain(forces).chain(read));
        let resting =
            self.rows.iter().map(|state| Observation { measured: state.pose.to_array(), ..state.condition });
        let rows = Dataset { observations: resting.collect(), ..dataset.clone() };
        for (state, stated) in self.rows.iter().zip(&hexapod.angles.as_stated(&rows).observations) {
            let what = [name(state.part).to_owned(), state.model.clone()];
            let pose = csv::values(&stated.measured, [Unit::Mm, Unit::Deg]);
            let forces = state.forces.iter().map(ToString::to_string);
            let read = state.sensors.iter().map(|x| (x * 1e6).to_string());
            let condition = csv::condition(&conditions, stated);
            text.row(condition.into_iter().chain(what).chain(pose).chain(forces).chain(read));
        }
        text.into_text()
    }
}

fn name(part: PartName) -> &'static str {
    match part {
        PartName::Training => "training",
        PartName::Holdout => "holdout",
    }
}
