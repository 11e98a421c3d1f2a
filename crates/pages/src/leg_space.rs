//! Where the springs fail: residuals as leg elongations, per load.
//!
//! Six legs measure six degrees of freedom, so every residual of a deflection is one elongation per leg.

use hexbench_core::Vector6;
use hexbench_model::campaign::Condition;
use hexbench_model::error::ModelError;
use hexbench_model::linearization::Linearization;
use hexbench_report::number::significant;

use super::subject::Subject;
use crate::text::{Paper, Table};

/// Sums of squares per leg under one load.
struct Row {
    load: String,
    squares: Vector6,
    count: f64,
}

impl Row {
    fn root_mean_square(&self) -> Vector6 {
        (self.squares / self.count.max(1.0)).map(f64::sqrt)
    }

    fn add(&mut self, squares: &Vector6) {
        self.squares += squares;
        self.count += 1.0;
    }
}

/// Unexplained elongation of each leg, um, one row per load, beside the noise.
pub(super) fn section(paper: &mut Paper, subject: &Subject<'_>) -> Result<(), ModelError> {
    let mut table = Table::default();
    table.row(["load change", "leg 1", "2", "3", "4", "5", "6", "x noise"]);
    let (rows, noise) = rows(subject)?;
    let level = noise.root_mean_square();
    for row in &rows {
        table.row(cells(&row.load, &row.root_mean_square(), Some(&level)));
    }
    table.row(cells("noise", &level, None));
    table.lines().iter().for_each(|line| paper.line(line));
    Ok(())
}

fn cells(name: &str, rms: &Vector6, noise: Option<&Vector6>) -> Vec<String> {
    let legs = rms.iter().map(|e| format!("{:.2}", e * 1e6));
    let times = noise.map_or(1.0, |noise| rms.norm() / noise.norm());
    std::iter::once(name.to_owned()).chain(legs).chain([format!("{times:.2}")]).collect()
}

fn rows(subject: &Subject<'_>) -> Result<(Vec<Row>, Row), ModelError> {
    let lin = Linearization::at(&subject.study.campaign, &subject.study.outcome.baseline.point)?;
    let mut rows: Vec<Row> = Vec::new();
    let mut noise = Row { load: "noise".into(), squares: Vector6::zeros(), count: 0.0 };
    for (k, reader) in lin.elongation_readers().iter().enumerate() {
        let Some(legs) = reader.try_inverse() else { continue };
        let load = load(&lin.conditions[k]);
        let elongation = (legs * lin.residual(k)).map(|e| e * e);
        // Whitened noise has unit variance, so that of leg i is the squared length of row i.
        noise.add(&Vector6::from_fn(|leg, _| legs.row(leg).norm_squared()));
        match rows.iter_mut().find(|r| r.load == load) {
            Some(row) => row.add(&elongation),
            None => rows.push(Row { load, squares: elongation, count: 1.0 }),
        }
    }
    Ok((rows, noise))
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
