//! Estimates with names, units and uncertainty, as people and files read them.

use hexbench_core::Vector6;
use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use crate::effects::term::Rich;
use crate::estimation::fit::Fit;
use crate::estimation::linearization::ModelPoint;
use crate::estimation::parameters::{ParameterPlace, Parameters, stiffness_name};

/// A sum is determined where it is this much better known than one of its parts.
const BETTER_KNOWN: f64 = 0.5;

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

    /// The same where so large a share of every compliance is open beside.
    #[must_use]
    pub fn open_by(self, share: &Vector6) -> Self {
        let open = self.compliance.component_mul(share);
        Self { variance: self.variance + open.component_mul(&open), ..self }
    }

    /// True where every leg has a stiffness.
    pub(crate) fn are_known(&self) -> bool {
        (0..6).all(|leg| self.known(leg).2)
    }

    /// Compliance, its standard uncertainty, and whether it has a stiffness: one that may be zero has none.
    fn known(&self, leg: usize) -> (f64, f64, bool) {
        let (c, std) = (self.compliance[leg], self.variance[leg].sqrt());
        (c, std, self.determined[leg] && c > 0.0 && std < 0.5 * c)
    }
}

/// Stiffness of a leg, from 0, where it is among the estimates.
pub fn stiffness_of(estimates: &[Estimate], leg: usize) -> Option<&Estimate> {
    let name = stiffness_name(leg);
    estimates.iter().find(|estimate| estimate.name == name)
}

/// Stiffness of every leg, then the parameters and shape of every term.
pub fn estimates(fit: &Fit) -> Estimates {
    estimates_with(&LegCompliances::of(fit), fit)
}

/// The same with springs from elsewhere.
pub fn estimates_with(springs: &LegCompliances, fit: &Fit) -> Estimates {
    let determined: Vec<bool> = (0..fit.parameters.len()).map(|k| fit.is_determined(k)).collect();
    let numbers = Numbers {
        parameters: &fit.parameters,
        point: &fit.point,
        covariance: &fit.covariance,
        determined: &determined,
    };
    numbers.estimates(springs)
}

/// The numbers of a model with their covariance.
pub(crate) struct Numbers<'a> {
    pub(crate) parameters: &'a Parameters,
    pub(crate) point: &'a ModelPoint,
    pub(crate) covariance: &'a DMatrix<f64>,
    pub(crate) determined: &'a [bool],
}

impl Numbers<'_> {
    pub(crate) fn estimates(&self, springs: &LegCompliances) -> Estimates {
        let mut all = Estimates::default();
        for (k, parameter) in self.parameters.iter().enumerate() {
            let Some(name) = parameter.quantity() else { continue };
            let known = match parameter.place {
                ParameterPlace::Spring(leg) => springs.known(leg),
                ParameterPlace::Value { term, index } => match leg_form(self.point, term, index) {
                    LegForm::Common => continue,
                    LegForm::OfLeg => self.total(self.parameters.of_term(term).start, k),
                    LegForm::None => self.own(k),
                },
                ParameterPlace::Shape { .. } => self.shape(k),
                ParameterPlace::Frames(_) => self.own(k),
            };
            let (value, std, determined) = known;
            let shown = parameter.shown(value, std);
            all.push(name, parameter.unit, shown.value, shown.std, determined);
        }
        all
    }

    fn std(&self, column: usize) -> f64 {
        self.covariance[(column, column)].max(0.0).sqrt()
    }

    fn own(&self, column: usize) -> (f64, f64, bool) {
        (self.parameters[column].value(self.point), self.std(column), self.determined[column])
    }

    /// A shape without an uncertainty is as open as can be: its covariance is averaged over shapes, and every other one is outside its
    /// bounds.
    fn shape(&self, column: usize) -> (f64, f64, bool) {
        let (value, std, determined) = self.own(column);
        (value, std, determined && std > 0.0)
    }

    /// A common size and the deviation of one leg from it: only their sum is a property of the leg, and known where the data
    /// determine it although each of the two may be open.
    fn total(&self, common: usize, deviation: usize) -> (f64, f64, bool) {
        let value = self.parameters[common].value(self.point) + self.parameters[deviation].value(self.point);
        let variance = self.covariance[(common, common)]
            + self.covariance[(deviation, deviation)]
            + 2.0 * self.covariance[(common, deviation)];
        let std = variance.max(0.0).sqrt();
        let both = self.determined[common] && self.determined[deviation];
        (value, std, both || std < BETTER_KNOWN * self.std(common).max(self.std(deviation)))
    }
}

/// Part of a richer form leg by leg that a value of a term is.
enum LegForm {
    /// The size that all legs share.
    Common,
    /// The deviation of one leg from it.
    OfLeg,
    /// None: the term has its ideal form, or another richer one.
    None,
}

fn leg_form(point: &ModelPoint, term: usize, index: usize) -> LegForm {
    let active = &point.active[term];
    match (active.rich && active.term.info().rich == Rich::PerLeg, index) {
        (false, _) => LegForm::None,
        (true, 0) => LegForm::Common,
        (true, _) => LegForm::OfLeg,
    }
}
