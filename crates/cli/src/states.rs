//! A table of states of rest: what was done, and where the simulated world came to rest.

use hexbench_core::files::CsvText;
use hexbench_core::{Columns, Dataset, Measurand, Observation, Pose};
use hexbench_truth::campaign::PlanRow;
use hexbench_truth::equilibrium::Equilibrium;
use hexbench_truth::scene::PartName;

use crate::csv::{self, Unit};

/// Rows of the table, each with its model file and its rest.
#[derive(Debug, Default)]
pub(crate) struct States {
    rows: Vec<(Observation, PartName, String, Pose, [f64; 6])>,
}

impl States {
    /// Adds a state; the pose is that of the platform itself, not what an instrument reads.
    pub(crate) fn push(&mut self, row: &PlanRow, part: PartName, model: &str, rest: &Equilibrium) {
        let pose = Pose::from_rotation(rest.platform.origin, &rest.platform.axes);
        self.rows.push((row.read(0, [0.0; 6], None), part, model.to_owned(), pose, rest.forces));
    }

    /// The table as CSV: conditions, part, model, resting pose, leg forces (tension positive).
    pub(crate) fn csv(&self, source: &str) -> String {
        let columns =
            Columns { reference: true, approach: true, delta_t: true, elapsed: true, ..Columns::default() };
        let dataset = Dataset {
            blocks: hexbench_core::Dataset::pose_blocks(),
            source: source.to_owned(),
            measurand: Measurand::AbsolutePose,
            columns,
            observations: Vec::new(),
        };
        let pose = csv::names("rest_", &["a", "b", "c", "alpha", "beta", "gamma"], [Unit::Mm, Unit::Deg]);
        let conditions =
            csv::conditions_header(&dataset).into_iter().chain(["part", "model"]).map(str::to_owned);
        let forces = (1..=6).map(|leg| format!("force_{leg}_N"));
        let mut text = CsvText::new(conditions.chain(pose).chain(forces));
        for (observation, part, model, pose, forces) in &self.rows {
            let what = [name(*part).to_owned(), model.clone()];
            let pose = csv::values(&pose.to_array(), [Unit::Mm, Unit::Deg]);
            let forces = forces.iter().map(ToString::to_string);
            text.row(csv::condition(&dataset, observation).into_iter().chain(what).chain(pose).chain(forces));
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
