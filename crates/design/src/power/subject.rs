//! What is looked for: a term, and effects of the size one is used to.

use std::sync::Arc;

use hexbench_core::statistics::root_mean_square;
use hexbench_model::effects::sizes::{WIDEST, sizes};
use hexbench_model::effects::term::{ParameterInfo, Term};
use nalgebra::DVector;
use serde::Serialize;

use super::Planned;

/// One effect: its parameters and its shape.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Example {
    /// Parameters of the ideal form, SI.
    pub values: Vec<f64>,
    /// Shape, SI; 1 without one.
    pub shape: f64,
}

/// What multiples of an effect's size refer to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Reference {
    /// The size the effect usually has.
    Usual,
    /// The size that is natural to machine and plan, for effects without a usual one.
    Natural,
}

/// A term with effects of its usual size.
#[derive(Clone)]
pub struct EffectSizes {
    /// The term.
    pub term: Arc<dyn Term>,
    /// Effects that differ in direction and shape.
    pub examples: Vec<Example>,
    /// What their size is.
    pub reference: Reference,
}

impl EffectSizes {
    /// All parameters at their natural sizes, at every shape of the grid.
    pub fn natural(term: &Arc<dyn Term>, planned: &Planned) -> Self {
        let values = |shape| sizes(term.as_ref(), false, shape, &planned.natural);
        let example = |shape| Example { values: values(shape), shape };
        let examples = shapes(term.as_ref(), planned).into_iter().map(example).collect();
        Self { term: Arc::clone(term), examples, reference: Reference::Natural }
    }

    /// Size of an example in the unit of its first parameter: root mean square of the parameters that have this unit.
    pub fn size(&self, example: &Example) -> f64 {
        effect_size(self.term.info().parameters, &example.values)
    }

    /// Whitened signature of an example `scale` times as large, springs included.
    pub(super) fn signature(&self, planned: &Planned, example: &Example, scale: f64) -> DVector<f64> {
        let values: Vec<f64> = example.values.iter().map(|v| v * scale).collect();
        let shape = if self.is_its_own_shape() { values[0].abs() } else { example.shape };
        planned.signature(self.term.as_ref(), shape, &values)
    }

    /// True when the size of the effect is its shape: its signature does not just grow with its size.
    pub(super) fn is_its_own_shape(&self) -> bool {
        self.term.shape_is_parameter()
    }

    /// Largest multiple of an example that makes physical sense.
    pub(super) fn sensible(&self, planned: &Planned, example: &Example) -> f64 {
        let natural = sizes(self.term.as_ref(), false, example.shape, &planned.natural);
        let limit = |(v, n): (&f64, &f64)| WIDEST * n / v.abs();
        example.values.iter().zip(&natural).map(limit).fold(f64::INFINITY, f64::min)
    }
}

/// Size of an effect in the unit of its first parameter: root mean square of the values (SI) of the parameters that have this unit.
pub fn effect_size(parameters: &[ParameterInfo], values: &[f64]) -> f64 {
    let alike = parameters.iter().zip(values).filter(|(p, _)| p.unit == parameters[0].unit);
    root_mean_square(alike.map(|(p, v)| v * p.per_si)).unwrap_or(0.0)
}

/// Shapes a term is tried with on a plan.
pub(super) fn shapes(term: &dyn Term, planned: &Planned) -> Vec<f64> {
    if term.info().shape.is_none() { vec![1.0] } else { term.shape_grid(&planned.lin.conditions) }
}
