//! Where the springs fail: residuals as leg elongations, per load.
//!
//! Six legs measure six degrees of freedom, so every residual of a deflection is one elongation per leg.

use hexbench_core::Vector6;
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::Condition;
use hexbench_model::estimation::linearization::Linearization;
use hexbench_model::results::compare::legs::{LegSpace, leg_space};

use super::subject::ReportSubject;
use crate::number::significant;
use crate::page::Table;

/// Sums of squares per leg under one load.
pub(crate) struct Row {
    pub(crate) load: String,
    squares: Vector6,
    count: f64,
}

impl Row {
    fn new(load: String) -> Self {
        Self { load, squares: Vector6::zeros(), count: 0.0 }
    }

    pub(crate) fn root_mean_square(&self) -> Vector6 {
        (self.squares / self.count.max(1.0)).map(f64::sqrt)
    }

    fn add(&mut self, elongation: &Vector6) {
        self.squares += elongation.map(|e| e * e);
        self.count += 1.0;
    }
}

/// Unexplained elongation of each leg, um, one row per load, beside the noise.
pub(super) fn table(subject: &ReportSubject<'_>) -> Result<Table, ModelError> {
    let study = subject.study;
    let lin = Linearization::at(&study.campaign, &study.outcome.baseline.point)?;
    let (rows, noise) = by_load(&lin.conditions, &leg_space(&study.campaign, &lin));
    let level = noise.root_mean_square();
    let loads = rows.iter().map(|row| cells(&row.load, &row.root_mean_square(), Some(&level)));
    let header = ["load change", "leg 1", "2", "3", "4", "5", "6", "x noise"];
    Ok(Table::named(header).rows(loads).rows([cells("noise", &level, None)]))
}

fn cells(name: &str, rms: &Vector6, noise: Option<&Vector6>) -> Vec<String> {
    let legs = rms.iter().map(|e| format!("{:.2}", e * 1e6));
    let times = noise.map_or(1.0, |noise| rms.norm() / noise.norm());
    std::iter::once(name.to_owned()).chain(legs).chain([format!("{times:.2}")]).collect()
}

/// Residual elongations of each load (m), and what noise alone would give.
pub(crate) fn by_load(conditions: &[Condition], space: &LegSpace) -> (Vec<Row>, Row) {
    let mut rows: Vec<Row> = Vec::new();
    let mut noise = Row::new("noise".to_owned());
    for k in space.determined() {
        let at = &conditions[k];
        noise.add(&space.sigma[k]);
        let load = load(at);
        let known = rows.iter().position(|r| r.load == load);
        let row = known.unwrap_or_else(|| {
            rows.push(Row::new(load));
            rows.len() - 1
        });
        rows[row].add(&space.elongation[k]);
    }
    (rows, noise)
}

/// `Fx +100 N`: what changes between reference and load.
fn load(c: &Condition) -> String {
    let names = ["Fx", "Fy", "Fz", "Mx", "My", "Mz"];
    let change = c.wrench.to_vector() - c.reference.to_vector();
    let part = |k: usize| {
        let sign = if change[k] > 0.0 { "+" } else { "" };
        let unit = if k < 3 { "N" } else { "N m" };
        format!("{} {sign}{} {unit}", names[k], significant(change[k], 3))
    };
    let parts: Vec<String> = (0..6).filter(|&k| change[k] != 0.0).map(part).collect();
    parts.join(", ")
}
