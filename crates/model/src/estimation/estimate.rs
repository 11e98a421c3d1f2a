//! Estimates with names, units and uncertainty, as people and files read them.

use hexbench_core::Vector6;
use serde::{Deserialize, Serialize};

use crate::application::model_file::Model;
use crate::estimation::fit::Fit;
use crate::estimation::linearization::ModelPoint;
use crate::estimation::parameters::{ParameterPlace, Parameters};

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
pub struct LegCompliances {
    /// m/N.
    pub compliance: Vector6,
    /// (m/N)^2.
    pub variance: Vector6,
    /// False where the data leave a compliance open.
    pub determined: [bool; 6],
}

impl LegCompliances {
    /// Those of one fit.
    pub fn of(fit: &Fit) -> Self {
        Self {
            compliance: fit.point.compliances,
            variance: Vector6::from_fn(|leg, _| fit.std(leg).powi(2)),
            determined: std::array::from_fn(|leg| fit.is_determined(leg)),
        }
    }

    /// Compliance, its standard uncertainty, and whether it has a stiffness: one that may be zero has none.
    fn known(&self, leg: usize) -> (f64, f64, bool) {
        let (c, std) = (self.compliance[leg], self.variance[leg].sqrt());
        (c, std, self.determined[leg] && c > 0.0 && std < 0.5 * c)
    }
}

/// Stiffness of every leg, then the parameters and shape of every term.
pub fn estimates(fit: &Fit) -> Estimates {
    estimates_with(&LegCompliances::of(fit), fit)
}

/// The same with springs from elsewhere.
pub fn estimates_with(springs: &LegCompliances, fit: &Fit) -> Estimates {
    all_estimates(springs, &fit.parameters, &fit.point, |k| (fit.std(k), fit.is_determined(k)))
}

/// The same of a model that was kept.
pub fn estimates_of(model: &Model) -> Estimates {
    let is_determined = |k: usize| model.determined.get(k).copied().unwrap_or(true);
    let springs = LegCompliances {
        compliance: model.point.compliances,
        variance: Vector6::from_fn(|leg, _| model.std(leg).powi(2)),
        determined: std::array::from_fn(is_determined),
    };
    all_estimates(&springs, &model.parameters, &model.point, |k| (model.std(k), is_determined(k)))
}

/// `known`: standard uncertainty of a column, and whether the data determine it.
fn all_estimates(
    springs: &LegCompliances,
    parameters: &Parameters,
    point: &ModelPoint,
    known: impl Fn(usize) -> (f64, bool),
) -> Estimates {
    let mut all = Estimates::default();
    for (k, parameter) in parameters.iter().enumerate() {
        let Some(name) = parameter.quantity() else { continue };
        let (value, std, determined) = if let ParameterPlace::Spring(leg) = parameter.place {
            springs.known(leg)
        } else {
            let (std, determined) = known(k);
            (parameter.value(point), std, determined)
        };
        let shown = parameter.shown(value, std);
        all.push(name, parameter.unit, shown.value, shown.std, determined);
    }
    all
}
