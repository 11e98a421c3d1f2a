//! Estimates with names, units and uncertainty, as people and files read them.

use hexbench_core::Vector6;
use serde::{Deserialize, Serialize};

use crate::fit::Fit;
use crate::linearization::Active;
use crate::model_file::Model;
use crate::term::Rich;

/// N/m to N/um.
const STIFFNESS_PER_SI: f64 = 1e-6;

/// One number of a fitted model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct Estimate {
    /// `leg-1.stiffness`, `base-compliance.rotation-x`, ...
    pub name: String,
    /// Value.
    pub value: f64,
    /// Standard uncertainty (k = 1).
    pub std: f64,
    /// Unit of both.
    pub unit: String,
}

/// The numbers of a fitted model, and the names of those that the data do not determine.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Estimates {
    /// Determined numbers.
    pub determined: Vec<Estimate>,
    /// Names of the others: no number is given for them.
    pub not_determined: Vec<String>,
}

impl Estimates {
    fn push(&mut self, name: String, unit: &str, value: f64, std: f64, determined: bool) {
        if determined && value.is_finite() && std.is_finite() {
            self.determined.push(Estimate { name, value, std, unit: unit.to_owned() });
        } else {
            self.not_determined.push(name);
        }
    }
}

/// Leg compliances with their uncertainty, of one model or averaged over several.
#[derive(Debug, Clone, PartialEq)]
pub struct Springs {
    /// m/N.
    pub compliance: Vector6,
    /// (m/N)^2.
    pub variance: Vector6,
    /// False where the data leave a compliance open.
    pub determined: [bool; 6],
}

impl Springs {
    /// Those of one fit.
    pub fn of(fit: &Fit) -> Self {
        Self {
            compliance: fit.point.springs,
            variance: Vector6::from_fn(|leg, _| fit.std(leg).powi(2)),
            determined: std::array::from_fn(|leg| fit.is_determined(leg)),
        }
    }
}

/// Stiffness of every leg, then the parameters and shape of every term.
pub fn estimates(fit: &Fit) -> Estimates {
    estimates_with(&Springs::of(fit), fit)
}

/// The same with springs from elsewhere.
pub fn estimates_with(springs: &Springs, fit: &Fit) -> Estimates {
    let columns = Columns { std: &|k| fit.std(k), is_determined: &|k| fit.is_determined(k) };
    all_estimates(springs, &fit.point.active, &fit.offsets, &columns)
}

/// The same of a model that was kept.
pub fn estimates_of(model: &Model) -> Estimates {
    let is_determined = |k: usize| model.determined.get(k).copied().unwrap_or(true);
    let springs = Springs {
        compliance: model.point.springs,
        variance: Vector6::from_fn(|leg, _| model.std(leg).powi(2)),
        determined: std::array::from_fn(is_determined),
    };
    let columns = Columns { std: &|k| model.std(k), is_determined: &is_determined };
    all_estimates(&springs, &model.point.active, &model.offsets(), &columns)
}

/// What is known of each column of a covariance.
struct Columns<'a> {
    std: &'a dyn Fn(usize) -> f64,
    is_determined: &'a dyn Fn(usize) -> bool,
}

fn all_estimates(
    springs: &Springs,
    active: &[Active],
    offsets: &[usize],
    columns: &Columns<'_>,
) -> Estimates {
    let mut all = Estimates::default();
    for leg in 0..6 {
        stiffness(springs, leg, &mut all);
    }
    for (a, &offset) in active.iter().zip(offsets) {
        term_estimates(columns, a, offset, &mut all);
    }
    all
}

/// Stiffness `k = 1 / c` with `std(k) = std(c) k^2`.
fn stiffness(springs: &Springs, leg: usize, all: &mut Estimates) {
    let (c, std) = (springs.compliance[leg], springs.variance[leg].sqrt());
    let k = 1.0 / c;
    // A compliance that may be zero has no stiffness to report.
    let determined = springs.determined[leg] && c > 0.0 && std < 0.5 * c;
    let std = std * k * k;
    let name = format!("leg-{}.stiffness", leg + 1);
    all.push(name, "N/um", k * STIFFNESS_PER_SI, std * STIFFNESS_PER_SI, determined);
}

fn term_estimates(columns: &Columns<'_>, a: &Active, offset: usize, all: &mut Estimates) {
    let info = a.term.info();
    for (k, p) in info.parameters.iter().enumerate() {
        let (value, std) = (a.values[k] * p.per_si, (columns.std)(offset + k) * p.per_si);
        all.push(format!("{}.{}", info.id, p.name), p.unit, value, std, (columns.is_determined)(offset + k));
    }
    for k in info.parameters.len()..a.values.len() {
        let (name, unit, per_si) = rich_parameter(a, k - info.parameters.len());
        let (value, std) = (a.values[k] * per_si, (columns.std)(offset + k) * per_si);
        all.push(format!("{}.{name}", info.id), unit, value, std, (columns.is_determined)(offset + k));
    }
    if let Some(shape) = info.shape.filter(|_| !a.term.shape_is_parameter()) {
        // The covariance holds the logarithm of the shape.
        let std = (columns.std)(offset + a.values.len()) * a.shape * shape.per_si;
        let determined = (columns.is_determined)(offset + a.values.len());
        let name = format!("{}.{}", info.id, shape.name);
        all.push(name, shape.unit, a.shape * shape.per_si, std, determined);
    }
}

/// Name, unit and factor from SI of every linear parameter of an active term, ideal ones first.
pub fn parameter_names(a: &Active) -> Vec<(String, &'static str, f64)> {
    let ideal = a.term.info().parameters;
    let of_ideal = ideal.iter().map(|p| (p.name.to_owned(), p.unit, p.per_si));
    let richer = (0..a.values.len().saturating_sub(ideal.len())).map(|k| rich_parameter(a, k));
    of_ideal.chain(richer).collect()
}

/// Name, unit and conversion of the parameters of a richer form.
fn rich_parameter(a: &Active, k: usize) -> (String, &'static str, f64) {
    let info = a.term.info();
    if info.rich == Rich::PerLeg {
        let p = &info.parameters[0];
        return (format!("leg-{}.{}", k + 1, p.name), p.unit, p.per_si);
    }
    let (i, j) = cross_pair(k);
    let axes = ["x", "y", "z", "rx", "ry", "rz"];
    let (unit, per_si) = match (i < 3, j < 3) {
        (true, true) => ("nm/N", 1e9),
        (false, false) => ("urad/(N m)", 1e6),
        _ => ("urad/N", 1e6),
    };
    (format!("cross-{}-{}", axes[i], axes[j]), unit, per_si)
}

/// Indices of the k-th off-diagonal element of a symmetric 6x6 matrix, row by row.
fn cross_pair(k: usize) -> (usize, usize) {
    let pairs = (0..6).flat_map(|i| (i + 1..6).map(move |j| (i, j)));
    pairs.into_iter().nth(k).unwrap_or((0, 1))
}
